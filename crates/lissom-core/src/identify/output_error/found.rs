//! Input and result of the output-error method.

use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;

use crate::identify::estimate::Estimate;
use crate::identify::friction_estimates::Friction;
use crate::identify::interrupt::Interrupt;
use crate::identify::methods::friction_law::{KnownArm, LawTerm, Unused};
use crate::identify::output_error::engine::by_run::ByRun;
use crate::identify::output_error::engine::covariance::standard_error;
use crate::identify::output_error::model::fit::{Extension, StageReport};
use crate::information::{beside, propagated};
use crate::replay::{ModalArm, Parameter, SensorNoise, Window};

/// Differences for the slopes of estimates are taken over this many standard errors to either side \[1\].
const SLOPE_STEP: f64 = 0.5;

/// How a search ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SearchEnd {
    /// The search ended by itself.
    Done,
    /// The limit of evaluations was reached.
    Evaluations,
    /// The user requested it, or a time limit was reached.
    Interrupted,
}

/// Result of the output-error method.
#[derive(Debug, Clone)]
pub struct OutputError {
    /// The identified arm.
    pub arm: ModalArm,
    /// Parameters that were estimated.
    pub parameters: Vec<Parameter>,
    /// Covariance of the parameters, in their own units. It includes the changes by terms whose presence the logs do
    /// not decide.
    pub covariance: DMatrix<f64>,
    /// Covariance if the residual is white noise.
    pub white: DMatrix<f64>,
    /// Covariance by blocks of samples within which the residual may be correlated.
    pub blocks: DMatrix<f64>,
    /// The information of each run on the parameters.
    pub by_run: ByRun,
    /// Noise of each channel, including its sensor's steps, motor first, then tips.
    pub noise: Vec<SensorNoise>,
    /// Windows of the last stage, with their initial states.
    pub windows: Vec<Window>,
    /// All stages, in order.
    pub stages: Vec<StageReport>,
    /// All parameters that were tried in addition to those of the simplest law.
    pub extensions: Vec<Extension>,
    /// Whether the beam is modelled with point masses at its tips.
    pub point_masses: bool,
    /// Whether windows were lengthened to whole runs, or to the longest windows over which
    /// neighbouring motions do not diverge.
    pub whole_runs: bool,
    /// Evaluations made: samples replayed, and derivatives of these by a parameter.
    pub evaluations: u64,
    /// How the search ended.
    pub end: SearchEnd,
    /// Parameters whose standard errors are at least twice as large because the samples do not distinguish damping
    /// within the beam from damping against the frame. The standard errors include both cases.
    pub open_by_damping: Vec<Parameter>,
    /// Largest ratio of a channel's residual in the last stage to its noise as estimated from the samples alone.
    pub beyond_noise: f64,
    /// Largest such ratio up to which the arm is accepted.
    pub(crate) accepted_residual: f64,
    /// Whether the windows of the last stage are whole runs, or determine each mode.
    pub(crate) sees_modes: bool,
    /// Share of each channel's squared residual, motor first, that is slower than its sensor's noise.
    pub left_over: Vec<f64>,
    /// Noise of a measured command that is counted, as acceleration of the motor \[rad/s² or m/s²\]; zero if there is none.
    pub command_noise: f64,
    /// What the arm and the line leave of the torque in slip phases; `None` of an arm with modes or tips.
    pub(crate) unused: Option<Unused>,
}

impl OutputError {
    /// Estimate of a parameter; `None` if it was not free.
    pub fn estimate(&self, parameter: Parameter) -> Option<Estimate> {
        let i = self.parameters.iter().position(|p| *p == parameter)?;
        Some(Estimate { value: parameter.of(&self.arm), std: standard_error(&self.covariance, i) })
    }

    /// Estimate of a quantity of the arm, with its standard error from the parameters' covariance.
    pub fn estimate_of(&self, of: impl Fn(&ModalArm) -> f64) -> Estimate {
        let std = propagated(&self.arm, &self.parameters, &self.covariance, SLOPE_STEP, &of);
        Estimate { value: of(&self.arm), std }
    }

    /// Covariance `G·C·Gᵀ` of quantities of the arm, from the covariance C of the parameters and the derivatives G, which are
    /// differences over half a standard error of each parameter to either side. `None` if a changed arm has another number
    /// of them.
    pub(crate) fn covariance_of(
        &self,
        of: impl Fn(&ModalArm) -> DVector<f64>,
    ) -> Option<DMatrix<f64>> {
        let count = of(&self.arm).len();
        let mut slopes = DMatrix::zeros(count, self.parameters.len());
        for (i, parameter) in self.parameters.iter().enumerate() {
            let half = SLOPE_STEP * standard_error(&self.covariance, i);
            let (half, [above, below]) = beside(&self.arm, *parameter, half);
            let (above, below) = (of(&above), of(&below));
            if above.len() != count || below.len() != count {
                return None;
            }
            if half > 0.0 {
                slopes.set_column(i, &((above - below) / (2.0 * half)));
            }
        }
        Some(&slopes * &self.covariance * slopes.transpose())
    }

    /// Variances `E|Δ|²` of quantities of the arm, from the parameters' covariance. The derivatives are differences
    /// over half a standard error of each parameter to either side. `None` if the quantities cannot be computed for a
    /// changed arm.
    pub(crate) fn variances(
        &self,
        of: &dyn Fn(&ModalArm) -> Option<Vec<Complex64>>,
    ) -> Option<Vec<f64>> {
        let slopes = |(i, p): (usize, &Parameter)| {
            let half = SLOPE_STEP * standard_error(&self.covariance, i);
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

/// Input of the output-error method in addition to the logs.
#[derive(Debug, Clone)]
pub struct OutputErrorStart {
    /// Starting arms; the likelier or simpler ones first.
    pub arms: Vec<ModalArm>,
    /// Frequency of each run that is a sinusoid in steady state \[rad/s\].
    pub omega_rad_s: Vec<Option<f64>>,
    /// Length of the first windows \[s\]; chosen from the arm if `None`. Short windows also lead to the result from a
    /// start that is wrong by a large factor.
    pub first_window_s: Option<f64>,
    /// Most evaluations.
    pub most_evaluations: u64,
    /// Ends the search early, with the best result so far.
    pub interrupt: Interrupt,
    /// Modes that the responses of the tips show \[rad/s\]; the arm gets further modes there, if the fit is better with them.
    pub shown_rad_s: Vec<f64>,
    /// Terms of friction that slip phases hardly show. They are tried if the residual is above the noise.
    pub further_terms: Vec<LawTerm>,
}

impl KnownArm for OutputError {
    fn arm(&self) -> &ModalArm {
        &self.arm
    }

    fn friction(&self, back_emf_viscous: f64) -> Friction {
        Self::friction(self, back_emf_viscous)
    }

    fn variances(&self, of: &dyn Fn(&ModalArm) -> Option<Vec<Complex64>>) -> Option<Vec<f64>> {
        Self::variances(self, of)
    }
}
