//! The contents of a `plan.toml`.

use lissom_core::rig::Experiment;

/// A virtual campaign.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanFile {
    /// Title of the campaign; may be empty.
    pub title: String,
    /// Seed of the sensor noise.
    pub seed: u64,
    /// The runs in order.
    pub runs: Vec<PlanRun>,
}

/// One run of a virtual campaign.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanRun {
    /// Name of the log, without its extension.
    pub name: String,
    /// The experiment.
    pub experiment: Experiment,
    /// Frequency of a sine \[rad/s\].
    pub omega_rad_s: Option<f64>,
    /// Seed of the sensor noise of this run.
    pub seed: u64,
}
