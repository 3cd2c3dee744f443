//! Where a fit is, and what led there.

use crate::identify::methods::output_error::by_run::ByRun;
use crate::identify::methods::output_error::coordinates::Body;
use crate::identify::methods::output_error::covariance::Covariances;
use crate::identify::methods::output_error::search::{Iteration, Stop};
use crate::identify::methods::output_error::thresholds::RESIDUAL_GROWN;
use crate::replay::{ModalArm, Parameter, SensorNoise, Window, WindowSums};

/// Where a fit is.
#[derive(Debug, Clone)]
pub(super) struct Fit {
    pub(super) body: Body,
    pub(super) windows: Vec<Window>,
    /// What is free.
    pub(super) free: Vec<Parameter>,
    /// Noise that each channel is taken to have.
    pub(super) noise: Vec<SensorNoise>,
    /// Deviation of each channel's residual, its share of the unknowns taken out.
    pub(super) residual: Vec<f64>,
    /// Whether windows are as long as can be told: whole runs, or all windows of the longest that do not diverge.
    pub(super) whole_runs: bool,
    pub(super) window_s: f64,
}

impl Fit {
    /// How many numbers a search moves.
    pub(super) fn coordinates(&self) -> usize {
        self.body.coordinates(&self.free).len()
    }

    /// Covariances of the free parameters, from sums by what they move.
    pub(super) fn covariances(&self, sums: &[WindowSums]) -> Covariances {
        let found = Covariances::at(sums, self.coordinates());
        match self.body.jacobian(&self.free) {
            Some(jacobian) => found.through(&jacobian),
            None => found,
        }
    }

    /// The same sums run by run.
    pub(super) fn by_run(&self, sums: &[WindowSums]) -> ByRun {
        ByRun::of(sums, &self.windows, self.coordinates(), self.body.jacobian(&self.free))
    }
}

/// A parameter that was tried.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extension {
    /// Which.
    pub parameter: Parameter,
    /// The one that a single step promises.
    pub value: f64,
    /// Deviation of that.
    pub std: f64,
    /// Share of the cost that it, or its group, was expected to take away.
    pub share: f64,
    /// Whether it was added.
    pub added: bool,
}

/// One length of windows.
#[derive(Debug, Clone, PartialEq)]
pub struct StageReport {
    /// Longest window \[s\].
    pub window_s: f64,
    /// Number of windows.
    pub windows: usize,
    /// Every step tried.
    pub iterations: Vec<Iteration>,
    /// Why it ended.
    pub stop: Stop,
    /// Noise that each channel was taken to have, motor first, then tips.
    pub noise: Vec<SensorNoise>,
    /// Deviation of each channel's residual, its share of the unknowns taken out.
    pub residual: Vec<f64>,
    /// The arm at its end.
    pub arm: ModalArm,
}

/// What was done.
#[derive(Debug, Default)]
pub(super) struct Report {
    pub(super) stages: Vec<StageReport>,
    /// First of them under the law that friction has now.
    under_law: usize,
    /// Parameters that were added.
    pub(super) added: Vec<Extension>,
    /// Those that were not, when last tried.
    pub(super) refused: Vec<Extension>,
}

impl Report {
    /// Whether a residual is larger than that of the first windows, under the friction law that they have now, by
    /// what no sensor adds.
    pub(super) fn grown(&self, residual: &[f64]) -> bool {
        let first = self.stages.get(self.under_law);
        let least = first.map_or(residual, |s| &s.residual);
        least.iter().zip(residual).any(|(a, b)| *b > RESIDUAL_GROWN * a)
    }

    /// Friction has another law from the last stage on.
    pub(super) fn law_changed(&mut self) {
        self.under_law = self.stages.len().saturating_sub(1);
    }

    /// What a stage that is taken back began with.
    pub(super) fn mark(&self) -> Mark {
        Mark { under_law: self.under_law, added: self.added.len() }
    }

    /// Takes back what was added since.
    pub(super) fn back_to(&mut self, mark: &Mark) {
        self.under_law = mark.under_law;
        self.added.truncate(mark.added);
    }
}

/// A place that a report may go back to.
pub(super) struct Mark {
    under_law: usize,
    added: usize,
}
