//! What a `plan.toml` says.

use lissom_core::rig::Experiment;

/// A virtual campaign.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanFile {
    /// What it is for; may be empty.
    pub title: String,
    /// Seed of the sensors' noise.
    pub seed: u64,
    /// The runs in order.
    pub runs: Vec<PlanRun>,
}

/// One run of a virtual campaign.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanRun {
    /// Name of its log without the ending.
    pub name: String,
    /// What is done.
    pub experiment: Experiment,
    /// Frequency of a sine \[rad/s\].
    pub omega_rad_s: Option<f64>,
    /// Seed of its noise.
    pub seed: u64,
}
