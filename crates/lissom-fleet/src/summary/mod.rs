//! Summary of a fleet: distributions, outliers and drift of each parameter.

mod chances;
mod common_course;
mod common_scatter;
mod distribution;
mod drift;
mod fleet_summary;
mod histogram;
mod line_fit;
mod machines;
mod outliers;
mod robust;

pub use distribution::Distribution;
pub use drift::{Drift, DriftValue};
pub use fleet_summary::{
    FailureCount, FindingCount, FleetSummary, ParameterSummary, SummaryOptions, summarise,
};
pub use histogram::Histogram;
pub use outliers::{LogOutlier, MachineOutlier};
