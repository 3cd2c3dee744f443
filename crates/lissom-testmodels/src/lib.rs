//! Analytic plants shared by tests, benches and examples.

mod report;

pub use report::{report_arm, report_rig};
