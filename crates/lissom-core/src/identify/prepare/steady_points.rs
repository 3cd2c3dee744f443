//! Parts of a run at constant velocity: their velocities and mean commands.

use crate::identify::estimate::Estimate;
use crate::identify::prepare::steady_stretches::stretches;
use crate::record::{Campaign, Run};

/// A part of a run in which the motor turns at a constant velocity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SteadyPoint {
    /// Index of the run.
    pub run: usize,
    /// Start of the part, since the first sample of the run \[s\].
    pub start_s: f64,
    /// End of the part \[s\].
    pub end_s: f64,
    /// Velocity, with its sign \[rad/s or m/s\].
    pub velocity: Estimate,
    /// Mean command, in its own unit.
    pub command: Estimate,
}

/// The stretches at constant velocity of run `index`.
pub(crate) fn steady_points(campaign: &Campaign, index: usize) -> Vec<SteadyPoint> {
    let run = &campaign.runs[index];
    let t = run.sample_time_s();
    stretches(run, campaign.channels.command.hold)
        .into_iter()
        .map(|s| SteadyPoint {
            run: index,
            start_s: s.intervals.start as f64 * t,
            end_s: s.intervals.end as f64 * t,
            velocity: Estimate { value: s.velocity.mean, std: s.velocity.std },
            command: Estimate { value: s.command.mean, std: s.command.std },
        })
        .collect()
}

/// Share of the time in motion that the points of a run take up; the motor rests for `at_rest` of
/// the run.
pub(crate) fn steady_share(run: &Run, points: &[SteadyPoint], at_rest: f64) -> f64 {
    let steady: f64 = points.iter().map(|p| p.end_s - p.start_s).sum();
    let whole = (run.len() - 1) as f64 * run.sample_time_s();
    steady / (whole * (1.0 - at_rest)).max(steady).max(f64::MIN_POSITIVE)
}
