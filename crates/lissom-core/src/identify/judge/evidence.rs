//! What the methods found, and what was taken of it.

use crate::identify::drive_estimates::BeamEstimates;
use crate::identify::drive_estimates::{DriveEstimates, Method};
use crate::identify::methods::constant_velocity::ConstantVelocity;
use crate::identify::methods::friction_law::{FrictionLaw, MissingTerm};
use crate::identify::methods::least_squares::LeastSquares;
use crate::identify::methods::regression::{BeamRegression, MotorRegression};
use crate::identify::methods::third_harmonic::ThirdHarmonic;
use crate::identify::output_error::OutputError;
use crate::identify::prepare::prepared::Prepared;
use crate::identify::prepare::run_analysis::RunAnalysis;
use crate::identify::responses::rational::{BeamFit, MotorFit};
use crate::record::Campaign;

/// What each method gave, complete: nothing is added later.
#[derive(Debug, Default)]
pub(crate) struct Methods {
    pub(crate) third_harmonic: Option<ThirdHarmonic>,
    /// Rational model of the motor from the response corrected with that method's friction, as in Section 6.2.2 of
    /// [Feliu1989].
    pub(crate) third_harmonic_model: Option<MotorFit>,
    pub(crate) regression: Option<MotorRegression>,
    /// Share of the torque that the regression leaves, also where it is refused.
    pub(crate) regression_residual: Option<f64>,
    /// Effects that the logs show and the model of the torque does not contain, also where the regression is refused.
    pub(crate) missing: Vec<MissingTerm>,
    pub(crate) least_squares: Option<LeastSquares>,
    pub(crate) friction_law: Option<FrictionLaw>,
    pub(crate) constant_velocity: Option<ConstantVelocity>,
    pub(crate) beam_regression: Option<BeamRegression>,
    pub(crate) output_error: Option<OutputError>,
    /// Rational model of the beam from its tips' responses.
    pub(crate) beam_model: Option<BeamFit>,
    /// Rational model of the motor from its corrected response.
    pub(crate) motor_model: Option<MotorFit>,
}

/// The campaign, its runs and what the methods found in them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Evidence<'a> {
    pub(crate) campaign: &'a Campaign,
    /// The runs that the methods used.
    pub(crate) used: &'a Campaign,
    /// What the runs used have no more of the tips' lags \[s\]; empty if there is none.
    pub(crate) tip_lags_s: &'a [f64],
    pub(crate) runs: &'a [RunAnalysis],
    pub(crate) methods: &'a Methods,
}

impl<'a> Evidence<'a> {
    /// What `methods` found in a prepared campaign.
    pub(crate) fn of(prepared: &'a Prepared<'_>, methods: &'a Methods) -> Self {
        let (campaign, used, runs) = (prepared.campaign(), prepared.used(), prepared.runs());
        Self { campaign, used, tip_lags_s: prepared.tip_lags_s(), runs, methods }
    }

    /// The output-error method, where its arm describes the runs.
    pub(crate) fn replay(&self) -> Option<&'a OutputError> {
        self.methods.output_error.as_ref().filter(|oe| oe.stands())
    }

    /// Whether constant velocities are all there is, and their transitions give no inertia either.
    pub(crate) fn rests_on_constant_velocities(&self) -> bool {
        let other = |r: &RunAnalysis| r.usable && !r.is_constant_velocity();
        self.methods.regression.is_none()
            && self.methods.constant_velocity.is_some()
            && !self.runs.iter().any(other)
    }
}

/// The estimates that the result states.
#[derive(Debug, Clone, Default)]
pub(crate) struct Chosen {
    /// Whose solution `drive` is; `None` where no method has one.
    pub(crate) method: Option<Method>,
    /// All that this method gives.
    pub(crate) solution: DriveEstimates,
    /// The same without what the data do not support.
    pub(crate) drive: DriveEstimates,
    /// Modes, and the coupling of `drive`.
    pub(crate) beam: BeamEstimates,
}
