//! Analytic plants shared by tests, benches and examples, and exact estimates of them.

mod beams;
mod double_double;
pub mod exact;
pub mod limit;
mod report;
mod rigid_joint;
mod schema;

pub use beams::{contrast_beam, random_beam, uniform_beam};
pub use report::{report_arm, report_rig};
pub use rigid_joint::{RigidJoint, RigidLog, two_sines};
pub use schema::SchemaCheck;
