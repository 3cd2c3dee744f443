//! State of a fit, and a report of its stages.

use crate::identify::output_error::engine::by_run::ByRun;
use crate::identify::output_error::engine::covariance::Covariances;
use crate::identify::output_error::engine::search::{Iteration, Stop};
use crate::identify::output_error::thresholds::RESIDUAL_GROWN;
use crate::replay::{Body, ModalArm, Parameter, SensorNoise, Window, WindowSums};

/// State of a fit.
#[derive(Debug, Clone)]
pub(crate) struct ArmFit {
    pub(crate) body: Body,
    pub(crate) windows: Vec<Window>,
    /// Parameters that are estimated.
    pub(crate) free: Vec<Parameter>,
    /// Assumed noise of each channel.
    pub(crate) noise: Vec<SensorNoise>,
    /// Assumed noise of a measured command, as acceleration of the motor \[rad/s² or m/s²\].
    pub(crate) command_noise: f64,
    /// Standard deviation of each channel's residual, corrected for the number of unknowns.
    pub(crate) residual: Vec<f64>,
    /// Whether windows are whole runs, or all windows of the longest length over which motions do not grow apart.
    pub(crate) whole_runs: bool,
    pub(crate) window_s: f64,
}

impl ArmFit {
    /// Noise of the channels and of the command.
    pub(crate) fn assumed_noise(&self) -> (&[SensorNoise], f64) {
        (&self.noise, self.command_noise)
    }

    /// Number of coordinates that a search changes.
    pub(crate) fn coordinates(&self) -> usize {
        self.body.coordinates(&self.free).len()
    }

    /// Covariances of the free parameters, from sums by the coordinates.
    pub(crate) fn covariances(&self, sums: &[WindowSums]) -> Covariances {
        let found = Covariances::at(sums, self.coordinates());
        match self.body.jacobian(&self.free) {
            Some(jacobian) => found.through(&jacobian),
            None => found,
        }
    }

    /// The sums of each run.
    pub(crate) fn by_run(&self, sums: &[WindowSums]) -> ByRun {
        ByRun::of(sums, &self.windows, self.coordinates(), self.body.jacobian(&self.free))
    }
}

/// A parameter that was tried.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extension {
    /// The parameter.
    pub parameter: Parameter,
    /// Value that a single step of the search would give it.
    pub value: f64,
    /// Standard error of the value.
    pub std: f64,
    /// Share by which it, or its group, was expected to lower the cost.
    pub share: f64,
    /// Whether it was added.
    pub added: bool,
}

/// A stage: a search at one length of the windows.
#[derive(Debug, Clone, PartialEq)]
pub struct StageReport {
    /// Longest window \[s\].
    pub window_s: f64,
    /// Number of windows.
    pub windows: usize,
    /// Every step tried.
    pub iterations: Vec<Iteration>,
    /// Why the search ended.
    pub stop: Stop,
    /// Assumed noise of each channel, motor first, then tips.
    pub noise: Vec<SensorNoise>,
    /// Standard deviation of each channel's residual, corrected for the number of unknowns.
    pub residual: Vec<f64>,
    /// The arm after the search.
    pub arm: ModalArm,
}

/// What was done.
#[derive(Debug, Default)]
pub(crate) struct Report {
    pub(crate) stages: Vec<StageReport>,
    /// Parameters that were added.
    pub(crate) added: Vec<Extension>,
    /// Parameters that were not added when they were last tried.
    pub(crate) refused: Vec<Extension>,
}

impl Report {
    /// Whether a residual is larger than on the first windows, by [`RESIDUAL_GROWN`].
    pub(crate) fn grown(&self, residual: &[f64]) -> bool {
        let first = self.stages.first();
        let least = first.map_or(residual, |s| &s.residual);
        least.iter().zip(residual).any(|(a, b)| *b > RESIDUAL_GROWN * a)
    }
}
