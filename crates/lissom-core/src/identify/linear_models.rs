//! Linear models of drive and beam, for use in other tools.

use nalgebra::DVector;
use num_complex::Complex64;

use crate::identify::estimate::Estimate;
use crate::identify::judge::{Evidence, Methods};
use crate::identify::output_error::OutputError;
use crate::identify::responses::model::state_space;
use crate::identify::responses::rational::MotorFit;
use crate::lti::{CoefficientCovariance, StateSpace, TransferFunction};
use crate::record::{Axis, Campaign, Tip, TipQuantity};
use crate::replay::{ModalArm, Parameter};

/// Origin of linear models.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum ModelSource {
    /// The identified arm of the output-error method, with all kinds of damping that it has.
    Arm,
    /// Fits to the responses, or estimates of the regressions; damping of the beam acts against the fixed frame.
    #[default]
    Responses,
}

/// Transfer function from the motor's angle to what a tip measures.
#[derive(Debug, Clone, PartialEq)]
pub struct TipModel {
    /// θ_i/θ_m for an angle or a calibrated deflection; s² times that for an acceleration. For a deflection of unknown
    /// scale, the deflection itself in its own unit.
    pub function: TransferFunction,
    /// Delay of the tip's readings relative to the motor's \[s\], not part of `function`;
    /// `None` if it is not estimated.
    pub delay_s: Option<f64>,
    /// Covariance of the coefficients and of the delay; `None` if the data do not determine it.
    pub covariance: Option<CoefficientCovariance>,
}

/// Linear models of drive and beam, without dry friction.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LinearModels {
    /// Origin of the models.
    pub source: ModelSource,
    /// θ_m per unit of command, with a monic denominator.
    pub motor: Option<TransferFunction>,
    /// Delay of the command \[s\], not part of `motor`; `None` if the data do not show one.
    pub motor_delay: Option<Estimate>,
    /// Covariance of the coefficients of `motor` and of `motor_delay`; `None` if the data do not determine it.
    pub motor_covariance: Option<CoefficientCovariance>,
    /// One model for each tip, in order; empty if there is no model of the beam.
    pub tips: Vec<TipModel>,
    /// State space model from the command to the angles of the motor and of each tip that
    /// measures an angle; without delays.
    pub state_space: Option<StateSpace>,
}

impl LinearModels {
    /// Of the output error's arm where it stands, else of the rational fits. A tip that is dead counts as
    /// one of unknown scale.
    pub(crate) fn of(evidence: &Evidence<'_>) -> Self {
        let campaign = evidence.used;
        let constant = campaign.channels.command.torque_per_unit();
        match evidence.replay() {
            Some(oe) => Self::of_arm(campaign, &oe.arm, oe, constant),
            None => Self::of_fits(campaign, evidence.methods, constant),
        }
    }

    fn of_arm(campaign: &Campaign, arm: &ModalArm, oe: &OutputError, constant: f64) -> Self {
        let tips = campaign.channels.tips.iter().enumerate();
        let of_tip = |i: usize, tip: &Tip, arm: &ModalArm| {
            let mut function = arm.tip_function(i);
            match (tip.quantity, tip.calibrated) {
                (TipQuantity::Angle, _) | (TipQuantity::Deflection, true) => {}
                (TipQuantity::Acceleration, _) => function.num.extend([0.0, 0.0]),
                (TipQuantity::Deflection, false) => function = less_one(&function),
            }
            (function, Parameter::TipLag(i).of(arm))
        };
        let tip = |(i, tip): (usize, &Tip)| {
            let (function, lag) = of_tip(i, tip, arm);
            let covariance = coefficient_covariance(oe, |arm| of_tip(i, tip, arm));
            TipModel { function, delay_s: Some(lag), covariance }
        };
        let of_motor =
            |arm: &ModalArm| (arm.motor_function(constant), Parameter::CommandLag.of(arm));
        Self {
            source: ModelSource::Arm,
            motor: Some(arm.motor_function(constant)),
            motor_delay: oe.estimate(Parameter::CommandLag),
            motor_covariance: coefficient_covariance(oe, of_motor),
            tips: tips.map(tip).collect(),
            state_space: Some(arm.state_space(constant, &angles(campaign), unit(campaign))),
        }
    }

    fn of_fits(campaign: &Campaign, methods: &Methods, constant: f64) -> Self {
        let beam = methods.beam_model.as_ref();
        let functions = beam.map_or(&[][..], |b| &b.transfer_functions);
        let tip = |(i, g): (usize, &TransferFunction)| TipModel {
            function: g.clone(),
            delay_s: None,
            covariance: beam.and_then(|b| b.coefficient_covariance(i)),
        };
        let joined =
            |m: &MotorFit| state_space(m, constant, beam, &angles(campaign), unit(campaign));
        Self {
            source: ModelSource::Responses,
            motor: methods.motor_model.as_ref().map(|m| m.transfer_function.clone()),
            motor_delay: methods.motor_model.as_ref().and_then(|m| m.delay_s),
            motor_covariance: methods
                .motor_model
                .as_ref()
                .and_then(MotorFit::coefficient_covariance),
            tips: functions.iter().enumerate().map(tip).collect(),
            state_space: methods.motor_model.as_ref().map(joined),
        }
    }

    /// θ_m per unit of logged command at ω, with the delay.
    pub fn motor_response(&self, omega_rad_s: f64) -> Option<Complex64> {
        let delay_s = self.motor_delay.map_or(0.0, |d| d.value);
        Some(delayed(self.motor.as_ref()?, delay_s, omega_rad_s))
    }

    /// Reading of a tip per angle of the motor at ω, with its delay; `None` without a model of the tip.
    pub fn tip_response(&self, tip: usize, omega_rad_s: f64) -> Option<Complex64> {
        let tip = self.tips.get(tip)?;
        Some(delayed(&tip.function, tip.delay_s.unwrap_or(0.0), omega_rad_s))
    }
}

/// Covariance of the coefficients and of the delay of a model of the arm; `None` if a change of a parameter changes the
/// number of coefficients.
fn coefficient_covariance(
    oe: &OutputError,
    of: impl Fn(&ModalArm) -> (TransferFunction, f64),
) -> Option<CoefficientCovariance> {
    let coefficients = |arm: &ModalArm| {
        let (function, delay_s) = of(arm);
        let all = function.num.iter().chain(&function.den).copied().chain([delay_s]);
        DVector::from_iterator(function.num.len() + function.den.len() + 1, all)
    };
    oe.covariance_of(coefficients).map(|matrix| CoefficientCovariance { matrix })
}

fn delayed(function: &TransferFunction, delay_s: f64, omega_rad_s: f64) -> Complex64 {
    function.response(omega_rad_s) * Complex64::cis(-omega_rad_s * delay_s)
}

/// G − 1 of one over the same denominator.
fn less_one(g: &TransferFunction) -> TransferFunction {
    let offset = g.den.len() - g.num.len();
    let at = |i: usize| i.checked_sub(offset).map_or(0.0, |k| g.num[k]);
    let num = g.den.iter().enumerate().map(|(i, d)| at(i) - d).collect();
    TransferFunction { num, den: g.den.clone() }
}

/// Tips whose angle is known, by index and name.
fn angles(campaign: &Campaign) -> Vec<(usize, String)> {
    let tips = campaign.channels.tips.iter().enumerate();
    tips.filter(|(_, t)| t.calibrated && t.quantity != TipQuantity::Acceleration)
        .map(|(i, t)| (i, t.name.clone()))
        .collect()
}

fn unit(campaign: &Campaign) -> &'static str {
    match campaign.channels.axis {
        Axis::Rotary => "rad",
        Axis::Linear => "m",
    }
}
