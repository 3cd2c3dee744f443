//! What identification gives.

use crate::identify::drive_estimates::Method;
use crate::identify::equivalent::Equivalent;
use crate::identify::estimate::{Estimate, ModeEstimate};
use crate::identify::findings::Finding;
use crate::identify::found_arm::FoundArm;
use crate::identify::friction_estimates::Friction;
use crate::identify::gravity_estimate::Gravity;
use crate::identify::judge::{Conclusion, Methods};
use crate::identify::methods::constant_velocity::ConstantVelocity;
use crate::identify::methods::friction_law::FrictionLaw;
use crate::identify::methods::least_squares::LeastSquares;
use crate::identify::methods::output_error::OutputError;
use crate::identify::methods::regression::{BeamRegression, MotorRegression};
use crate::identify::methods::third_harmonic::ThirdHarmonic;
use crate::identify::prepare::run_analysis::RunAnalysis;
use crate::identify::responses::linear_models::LinearModels;
use crate::identify::responses::rational::{BeamFit, MotorFit};
use crate::identify::responses::response_point::ResponsePoint;
use crate::identify::separability::Separability;
use crate::record::Campaign;

/// The beam's figures.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct BeamEstimates {
    /// Modes with the motor clamped, ascending.
    pub modes: Vec<ModeEstimate>,
    /// Torque per angle between motor and beam, Σκ_i = h_{n+1} of (15).
    pub coupling: Option<Estimate>,
    /// κ_i of each tip of the campaign, `None` where its angle is not known; empty where none is.
    pub coupling_by_tip: Vec<Option<Estimate>>,
}

/// All that a campaign gave.
#[derive(Debug, Clone)]
pub struct Identified {
    /// The method whose solution friction, inertia and coupling are, whole; `None` where no method has one.
    pub method: Option<Method>,
    /// Friction of that solution.
    pub friction: Friction,
    /// Inertia or mass of that solution.
    pub inertia: Option<Estimate>,
    /// Gravity of that solution, where the campaign has it and the data tell it.
    pub gravity: Option<Gravity>,
    /// Torque per command by that gravity, where the campaign says what m·g·l is \[N·m per unit of command\].
    pub torque_constant: Option<Estimate>,
    /// The beam.
    pub beam: BeamEstimates,
    /// The report's method.
    pub third_harmonic: Option<ThirdHarmonic>,
    /// Rational model of the motor from the response corrected with that friction, as in Section 6.2.2 of the 1989 report.
    pub third_harmonic_model: Option<MotorFit>,
    /// Regression on slip phases.
    pub regression: Option<MotorRegression>,
    /// ‖y − X·q‖/‖y‖ of the regression, also where it is refused; `None` without windows enough.
    pub regression_residual: Option<f64>,
    /// Ordinary least squares of smoothed samples, the baseline; `None` where too few slip.
    pub least_squares: Option<LeastSquares>,
    /// Friction against speed, and its law; `None` without a regression.
    pub friction_law: Option<FrictionLaw>,
    /// Steady velocities extrapolated to rest; `None` where no line goes through any and no run was
    /// made for them.
    pub constant_velocity: Option<ConstantVelocity>,
    /// The beam's regression.
    pub beam_regression: Option<BeamRegression>,
    /// The runs replayed; `None` where it was not asked for or has nothing to start from.
    pub output_error: Option<OutputError>,
    /// What each run is.
    pub runs: Vec<RunAnalysis>,
    /// Responses, ascending in frequency.
    pub responses: Vec<ResponsePoint>,
    /// Rational model of the beam, fitted to its tips' responses.
    pub beam_model: Option<BeamFit>,
    /// Rational model of the motor, fitted to the corrected response.
    pub motor_model: Option<MotorFit>,
    /// Linear models of drive and beam: of the arm where the output error stands, else these fits.
    pub models: LinearModels,
    /// The equivalent arm of Section 4, where more than one tip's angle is known and the data carry it.
    pub equivalent: Option<Equivalent>,
    /// Which of these the logs separate, run by run; `None` without a covariance.
    pub separability: Option<Separability>,
    /// The arm that stands for these figures, to predict other logs with; `None` where they make none.
    pub arm: Option<FoundArm>,
    /// Torque per command used; `None`: figures are per unit of command.
    pub torque_per_command: Option<f64>,
    /// What the data could not carry.
    pub findings: Vec<Finding>,
}

impl Identified {
    /// Joins what the methods found and what was taken of it; nothing changes afterwards.
    pub(super) fn new(
        campaign: &Campaign,
        methods: Methods,
        runs: Vec<RunAnalysis>,
        responses: Vec<ResponsePoint>,
        (models, equivalent): (LinearModels, Option<Equivalent>),
        conclusion: Conclusion,
    ) -> Self {
        let Conclusion { chosen, separability, arm, findings } = conclusion;
        Self {
            method: chosen.method,
            friction: chosen.drive.friction,
            inertia: chosen.drive.inertia,
            gravity: chosen.drive.gravity,
            torque_constant: torque_constant(campaign, chosen.drive.gravity),
            beam: chosen.beam,
            third_harmonic: methods.third_harmonic,
            third_harmonic_model: methods.third_harmonic_model,
            regression: methods.regression,
            regression_residual: methods.regression_residual,
            least_squares: methods.least_squares,
            friction_law: methods.friction_law,
            constant_velocity: methods.constant_velocity,
            beam_regression: methods.beam_regression,
            output_error: methods.output_error,
            runs,
            responses,
            beam_model: methods.beam_model,
            motor_model: methods.motor_model,
            models,
            equivalent,
            separability,
            arm,
            torque_per_command: campaign.channels.command.torque_per_command,
            findings,
        }
    }
}

/// Torque per command by which the load that was found is the one that the campaign says.
pub(super) fn torque_constant(campaign: &Campaign, gravity: Option<Gravity>) -> Option<Estimate> {
    let assumed = campaign.channels.command.torque_per_unit();
    Some(gravity?.torque_constant(campaign.mgl_nm?, assumed))
}
