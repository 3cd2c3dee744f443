//! Analytic plants shared by tests, benches and examples.

mod beams;
pub mod limit;
mod report;
mod schema;

pub use beams::{random_beam, uniform_beam};
pub use report::{report_arm, report_rig};
pub use schema::SchemaCheck;
