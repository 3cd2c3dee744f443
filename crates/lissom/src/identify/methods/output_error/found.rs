//! What the output-error method gives, and where it begins.

use nalgebra::DMatrix;
use num_complex::Complex64;

use crate::identify::estimate::Estimate;
use crate::identify::methods::friction_law::LawTerm;
use crate::identify::methods::output_error::by_run::ByRun;
use crate::identify::methods::output_error::covariance::deviation;
use crate::identify::methods::output_error::fit::{Extension, StageReport};
use crate::information::{beside, propagated};
use crate::replay::{ModalArm, Parameter, SensorNoise, Window};

/// Differences for the slopes of estimates are taken over this many standard errors to either side \[1\].
const SLOPE_STEP: f64 = 0.5;

/// What the output error gives.
#[derive(Debug, Clone)]
pub struct OutputError {
    /// The arm found.
    pub arm: ModalArm,
    /// What was free.
    pub parameters: Vec<Parameter>,
    /// Covariance of these, in their own units; what an undecided term of the equation would move them
    /// by counts in it.
    pub covariance: DMatrix<f64>,
    /// As if the residual were white.
    pub white: DMatrix<f64>,
    /// By blocks left out.
    pub blocks: DMatrix<f64>,
    /// What each run says of them.
    pub by_run: ByRun,
    /// Noise of each channel, its sensor's steps counted with it, motor first, then tips.
    pub noise: Vec<SensorNoise>,
    /// Windows of the last stage, with the states at which they begin.
    pub windows: Vec<Window>,
    /// Every length of windows, in order.
    pub stages: Vec<StageReport>,
    /// Every parameter that was tried beside those of the simplest law.
    pub extensions: Vec<Extension>,
    /// Whether the beam is taken for point masses at its tips: nothing speaks against it.
    pub point_masses: bool,
    /// Whether windows were widened to the whole of the runs, or as far as neighbouring motions stay together: the arm
    /// describes them.
    pub whole_runs: bool,
    /// Evaluations made: samples replayed, and derivatives of these by a parameter.
    pub evaluations: u64,
    /// Whether these were all that it was allowed: the search ended where it was.
    pub budget_spent: bool,
    /// Parameters whose deviations are twice as long or more because the samples do not tell damping within the beam from
    /// damping against the frame: they count both.
    pub open_by_damping: Vec<Parameter>,
    /// Residual of the last stage beside the noise of the samples alone: the largest ratio of a channel.
    pub beyond_noise: f64,
    /// Share of each channel's squared residual, motor first, that is slower than what its sensor adds.
    pub left_over: Vec<f64>,
}

impl OutputError {
    /// A parameter with its deviation; `None` where it was not free.
    pub fn estimate(&self, parameter: Parameter) -> Option<Estimate> {
        let i = self.parameters.iter().position(|p| *p == parameter)?;
        Some(Estimate { value: parameter.of(&self.arm), std: deviation(&self.covariance, i) })
    }

    /// Any figure of the arm, its deviation from the parameters'.
    pub fn figure(&self, of: impl Fn(&ModalArm) -> f64) -> Estimate {
        let std = propagated(&self.arm, &self.parameters, &self.covariance, SLOPE_STEP, &of);
        Estimate { value: of(&self.arm), std }
    }

    /// What the parameters' covariance gives quantities of the arm: `E|Δ|²` of each, by differences over
    /// half a deviation of each parameter to both sides. `None` where they cannot be had of an arm beside.
    pub(crate) fn variances(
        &self,
        of: &dyn Fn(&ModalArm) -> Option<Vec<Complex64>>,
    ) -> Option<Vec<f64>> {
        let slopes = |(i, p): (usize, &Parameter)| {
            let half = SLOPE_STEP * deviation(&self.covariance, i);
            let (half, [above, below]) = beside(&self.arm, *p, half);
            let (above, below) = (of(&above)?, of(&below)?);
            let slope = |(a, b)| if half > 0.0 { (a - b) / (2.0 * half) } else { Complex64::ZERO };
            Some(above.iter().zip(&below).map(slope).collect())
        };
        let slopes: Vec<Vec<Complex64>> =
            self.parameters.iter().enumerate().map(slopes).collect::<Option<_>>()?;
        let quantities = slopes.first().map_or(0, Vec::len);
        let variance = |k: usize| {
            let pairs = slopes.iter().enumerate().flat_map(|(i, a)| {
                let with = move |(j, b): (usize, &Vec<Complex64>)| {
                    self.covariance[(i, j)] * (a[k] * b[k].conj()).re
                };
                slopes.iter().enumerate().map(with)
            });
            pairs.sum::<f64>().max(0.0)
        };
        Some((0..quantities).map(variance).collect())
    }
}

/// Where an output error begins and what it may know.
#[derive(Debug, Clone)]
pub struct OutputErrorStart {
    /// Arms to start from, the likelier or simpler first.
    pub arms: Vec<ModalArm>,
    /// Frequency of each run that is a sinusoid in steady state \[rad/s\].
    pub omega_rad_s: Vec<Option<f64>>,
    /// Length of the first windows \[s\]; chosen from the arm when `None`. Short ones find the way from
    /// a start that is wrong by factors.
    pub first_window_s: Option<f64>,
    /// Most evaluations; the method's own number when `None`.
    pub most_evaluations: Option<u64>,
    /// Terms of friction that slip phases show: speeds and periods to try, where the residual calls for
    /// another law.
    pub law: Vec<LawTerm>,
}
