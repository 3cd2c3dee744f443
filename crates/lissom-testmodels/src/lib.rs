//! Analytic plants shared by tests, benches and examples, and exact figures of them.

mod beams;
mod double_double;
pub mod exact;
pub mod limit;
mod report;
mod schema;

pub use beams::{contrast_beam, random_beam, uniform_beam};
pub use report::{report_arm, report_rig};
pub use schema::SchemaCheck;
