//! What is found in the logs of many machines.

mod fleet_summary;

pub use fleet_summary::{
    Distribution, Drift, DriftValue, FailureCount, FindingCount, FleetSummary, Histogram,
    LogOutlier, MachineOutlier, ParameterSummary,
};
