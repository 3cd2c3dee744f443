//! The result of an identification.

use crate::identify::drive_estimates::{BeamEstimates, Method};
use crate::identify::equivalent::Equivalent;
use crate::identify::estimate::Estimate;
use crate::identify::findings::Finding;
use crate::identify::found_arm::FoundArm;
use crate::identify::friction_estimates::Friction;
use crate::identify::gravity_estimate::{Gravity, torque_constant};
use crate::identify::judge::{Conclusion, Methods};
use crate::identify::linear_models::LinearModels;
use crate::identify::methods::constant_velocity::ConstantVelocity;
use crate::identify::methods::friction_law::{FrictionLaw, Unused, UnusedTorque};
use crate::identify::methods::least_squares::LeastSquares;
use crate::identify::methods::regression::{BeamRegression, MotorRegression};
use crate::identify::methods::third_harmonic::ThirdHarmonic;
use crate::identify::output_error::{OutputError, SearchEnd};
use crate::identify::prepare::run_analysis::RunAnalysis;
use crate::identify::responses::rational::{BeamFit, MotorFit};
use crate::identify::responses::response_point::ResponsePoint;
use crate::identify::separability::Separability;
use crate::record::Campaign;

/// The complete result of an identification.
#[derive(Debug, Clone)]
pub struct Identified {
    /// The method whose complete solution friction, inertia and coupling are; `None` if no method has one.
    pub method: Option<Method>,
    /// Friction of that solution.
    pub friction: Friction,
    /// Inertia \[kg·m²\] or mass \[kg\] of that solution.
    pub inertia: Option<Estimate>,
    /// Gravity of that solution, if the campaign has it and the data determine it.
    pub gravity: Option<Gravity>,
    /// Torque constant that follows from gravity, if the campaign gives m·g·l \[N·m per unit of command\].
    pub torque_constant: Option<Estimate>,
    /// Modes and coupling of the beam.
    pub beam: BeamEstimates,
    /// Third-harmonic method of the 1989 report.
    pub third_harmonic: Option<ThirdHarmonic>,
    /// Rational model of the motor from the response that the third-harmonic method corrects, as in Section 6.2.2 of
    /// the 1989 report.
    pub third_harmonic_model: Option<MotorFit>,
    /// Regression in slip phases.
    pub regression: Option<MotorRegression>,
    /// Relative residual ‖y − X·q‖/‖y‖ of the regression \[1\], also if its estimates are refused; `None` if there are
    /// too few windows.
    pub regression_residual: Option<f64>,
    /// Ordinary least squares of smoothed samples, the baseline; `None` if there is too little slipping motion.
    pub least_squares: Option<LeastSquares>,
    /// Friction against speed, and the friction law; `None` without a regression.
    pub friction_law: Option<FrictionLaw>,
    /// Constant-velocity method; `None` if no line can be fitted and no run was made for this method.
    pub constant_velocity: Option<ConstantVelocity>,
    /// Regression of the beam's equation.
    pub beam_regression: Option<BeamRegression>,
    /// Output-error method; `None` if it was not requested or has no arm to start from.
    pub output_error: Option<OutputError>,
    /// What each run is, and how it is used.
    pub runs: Vec<RunAnalysis>,
    /// Frequency responses, ascending in frequency.
    pub responses: Vec<ResponsePoint>,
    /// Rational model of the beam, fitted to the responses of its tips.
    pub beam_model: Option<BeamFit>,
    /// Rational model of the motor, fitted to the corrected response.
    pub motor_model: Option<MotorFit>,
    /// Linear models of drive and beam: those of the identified arm if the output-error method is accepted, otherwise
    /// the fits to the responses.
    pub models: LinearModels,
    /// The equivalent arm of Section 4 of the 1989 report, if several tips measure angles and the data support it.
    pub equivalent: Option<Equivalent>,
    /// Which parameters the logs separate, run by run; `None` without a covariance.
    pub separability: Option<Separability>,
    /// The arm of this result, to predict other logs with; `None` if the estimates do not make a complete arm.
    pub arm: Option<FoundArm>,
    /// What the line and this result's model leave of torque that was not used for their fit; `None` without a friction law, and
    /// if the solution is not from slip phases or of a rigid arm.
    pub unused_torque: Option<UnusedTorque>,
    /// Torque constant that was used; `None` if estimates are per unit of command.
    pub torque_per_command: Option<f64>,
    /// Findings: what the logs do not determine, what is wrong with them, and what to know about the estimates.
    pub findings: Vec<Finding>,
}

impl Identified {
    /// Whether the search was ended early, with the best result so far.
    pub fn is_interrupted(&self) -> bool {
        self.output_error.as_ref().is_some_and(|found| found.end == SearchEnd::Interrupted)
    }

    /// Slowest and fastest speed at which Coulomb and viscous friction of the line hold \[rad/s or m/s\]: those of the windows that
    /// they are estimated in, or, where they stand for a law, those of the motion that they are the nearest line in. `None` if no
    /// method knows them.
    pub fn speeds_of_line(&self) -> Option<[f64; 2]> {
        self.friction.coulomb.or(self.friction.viscous)?;
        match self.method? {
            Method::LeastSquares => self.least_squares.as_ref().map(|line| line.speed_range),
            Method::OutputError | Method::FrictionLaw | Method::Regression => {
                let law = self.friction_law.as_ref()?;
                let is_line = self.friction.law.is_none();
                Some(if is_line { law.speed_range } else { law.line_speed_range })
            }
            Method::FrequencyResponse | Method::ThirdHarmonic | Method::ConstantVelocity => None,
        }
    }

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
        let unused = match chosen.method {
            Some(Method::OutputError) => {
                methods.output_error.as_ref().and_then(|oe| oe.unused.as_ref())
            }
            Some(Method::FrictionLaw | Method::Regression) => {
                methods.friction_law.as_ref().map(|law| &law.unused)
            }
            _ => None,
        };
        let unused_torque = unused.map(Unused::shares);
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
            unused_torque,
            torque_per_command: campaign.channels.command.torque_per_command,
            findings,
        }
    }
}
