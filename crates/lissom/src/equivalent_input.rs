//! What an equivalent arm is made of: responses of a campaign or of tables, their units, and what is known about the motor.

use lissom_core::drive::{Coulomb, Motor};
use lissom_core::identify::{
    Equivalent, EquivalentData, EquivalentRefusal, Estimate, Identified, MotorData, Response,
    StdSource, without_origin,
};
use lissom_core::record::{Axis, Campaign, CommandQuantity};
use lissom_io::units::{Dimension, parse_any_unit, parse_quantity};
use lissom_io::write::{self, WrittenArm};
use lissom_io::{FrequencyResponses, MeasuredResponse, UnitNames};
use thiserror::Error;

/// Relative standard error of responses without one. It is so small that the residual of the model decides.
const UNKNOWN: f64 = 1e-6;
/// Magnitude, as a share of the median magnitude, below which the standard error of a response does not fall. Without
/// it a response near a zero would count more than its neighbours.
const SMALL: f64 = 1e-2;

/// Input of [`equivalent`](fn@crate::identify::equivalent).
#[derive(Debug, Clone)]
pub struct EquivalentInput {
    /// The responses.
    pub data: EquivalentData,
    /// The names of their units.
    pub names: UnitNames,
    /// Estimates of the campaign that the responses are from; `None` for tables.
    pub identified: Option<KnownMotor>,
}

/// Estimates of an identification to compare with the equivalent arm.
#[derive(Debug, Clone)]
pub struct KnownMotor {
    /// Inertia of the motor \[kg·m²\].
    pub inertia: Option<Estimate>,
    /// Viscous friction with back-EMF \[N·m·s/rad\].
    pub viscous: Option<Estimate>,
    /// Coupling \[N·m/rad\].
    pub coupling: Option<Estimate>,
    /// Coulomb friction forward and backward \[N·m\].
    pub coulomb: Option<[f64; 2]>,
    /// Natural frequencies with the motor clamped \[rad/s\].
    pub modes_rad_s: Vec<Estimate>,
}

/// Why tables of responses cannot be used together.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum EquivalentInputError {
    /// Only some responses have standard errors.
    #[error("some responses have a standard error and some have none")]
    SomeStd,
    /// The torque constant is not usable.
    #[error("the torque constant {reason}")]
    TorqueConstant {
        /// What is wrong with it, beginning with the constant.
        reason: String,
    },
}

impl EquivalentInputError {
    /// What to do about it.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::SomeStd => "give a std column for each response, or for none",
            Self::TorqueConstant { .. } => {
                "give torque per ampere or per volt, as the motor's response has it, such as \"0.25 N*m/A\"; for \
                 another command a torque such as \"0.25 N*m\" per unit"
            }
        }
    }
}

/// Why an equivalent arm cannot be written as an arm.toml.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum EquivalentArmError {
    /// Without a response of the motor there is no torque.
    #[error("it has no torque without a usable response of the motor")]
    NoTorque,
    /// The torque per current is unknown.
    #[error("the torque per current is unknown")]
    NoTorqueConstant,
    /// A point is not measured as an angle.
    #[error("a point does not follow the motor at low frequency")]
    NoAngle,
    /// The modes or the motor make no arm.
    #[error("{reason}")]
    Arm {
        /// Why.
        reason: String,
    },
}

impl EquivalentArmError {
    /// What to do about it.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::NoTorque => "add the motor's response to the tables",
            Self::NoTorqueConstant => "give the torque per ampere, as in \"0.25 N*m/A\"",
            Self::NoAngle => "give each point's response as an angle",
            Self::Arm { .. } => {
                "keep fewer modes, or measure longer near the resonance of this mode"
            }
        }
    }
}

impl EquivalentInput {
    /// Takes the responses of an identified campaign.
    ///
    /// # Errors
    /// [`EquivalentRefusal`] if they are not responses of angles of several points.
    pub fn of_campaign(campaign: &Campaign, id: &Identified) -> Result<Self, EquivalentRefusal> {
        let data = EquivalentData::of_campaign(campaign, &id.responses)?;
        let names = UnitNames::new(&campaign.channels);
        let known = KnownMotor::of(id, campaign.channels.command.back_emf_viscous);
        Ok(Self { data, names, identified: Some(known) })
    }

    /// Takes measured responses. `torque_constant` is the torque per unit of the command of the motor's response, such as
    /// `0.25 N*m/A`.
    ///
    /// ```
    /// use lissom::EquivalentInput;
    /// use lissom::io::FrequencyResponses;
    /// let none = FrequencyResponses { omega_rad_s: vec![1.0], points: Vec::new(), motor: None };
    /// let error = EquivalentInput::of_responses(&none, Some("0.25")).unwrap_err();
    /// assert_eq!(error.to_string(), "the torque constant \"0.25\" has no unit");
    /// assert!(EquivalentInput::of_responses(&none, Some("0.25 N*m/A")).is_ok());
    /// ```
    ///
    /// # Errors
    /// [`EquivalentInputError`] if some responses have standard errors and some have none, or if the torque constant is
    /// not one of this command.
    pub fn of_responses(
        read: &FrequencyResponses,
        torque_constant: Option<&str>,
    ) -> Result<Self, EquivalentInputError> {
        let all = || read.points.iter().chain(&read.motor);
        let std_known = all().all(|r| r.std.is_some());
        if !std_known && all().any(|r| r.std.is_some()) {
            return Err(EquivalentInputError::SomeStd);
        }
        let (command, constant) = command(read.motor.as_ref(), torque_constant)
            .map_err(|reason| EquivalentInputError::TorqueConstant { reason })?;
        let motor = read.motor.as_ref().map(|motor| MotorData {
            omega_rad_s: read.omega_rad_s.clone(),
            response: with_std(motor),
            torque_per_command: constant.unwrap_or(1.0),
        });
        let angles = |point: &MeasuredResponse| {
            let zeros = point.zeros_at_origin().unwrap_or(0);
            without_origin(&read.omega_rad_s, &with_std(point), zeros)
        };
        let data = EquivalentData {
            names: read.points.iter().map(|p| p.name.clone()).collect(),
            omega_rad_s: read.omega_rad_s.clone(),
            outputs: read.points.iter().map(angles).collect(),
            motor,
            std_source: if std_known { StdSource::Measured } else { StdSource::FromResidual },
        };
        let names = UnitNames { torque_known: constant.is_some(), axis: Axis::Rotary, command };
        Ok(Self { data, names, identified: None })
    }

    /// The text of an arm.toml with the arm that was found, which models, virtual rigs and plans take.
    ///
    /// # Errors
    /// [`EquivalentArmError`] if the torque per ampere is unknown, or if the modes make no arm.
    pub fn arm_text(&self, found: &Equivalent) -> Result<String, EquivalentArmError> {
        let failed =
            |error: &dyn std::error::Error| EquivalentArmError::Arm { reason: error.to_string() };
        let arm = found.arm.as_ref().ok_or(EquivalentArmError::NoTorque)?;
        if !self.names.torque_known || self.names.command != CommandQuantity::Current {
            return Err(EquivalentArmError::NoTorqueConstant);
        }
        if found.strainless.is_none() {
            return Err(EquivalentArmError::NoAngle);
        }
        let beam = arm.modal_beam().map_err(|error| failed(&error))?;
        let (inertia, viscous) = (arm.inertia.value, arm.viscous.value.max(0.0));
        let motor = Motor::new(inertia, viscous, arm.torque_per_command())
            .map_err(|error| failed(&error))?;
        let coulomb = self.identified.as_ref().and_then(|known| known.coulomb);
        let coulomb =
            coulomb.and_then(|[forward, backward]| Coulomb::by_direction(forward, backward).ok());
        let points: Vec<&str> = found.points.iter().map(|&i| found.names[i].as_str()).collect();
        Ok(write::arm_text(&WrittenArm { motor, coulomb, beam: &beam, points: &points }))
    }
}

impl KnownMotor {
    fn of(id: &Identified, back_emf: f64) -> Self {
        let viscous = id.friction.viscous.map(|v| Estimate { value: v.value + back_emf, ..v });
        Self {
            inertia: id.inertia,
            viscous,
            coupling: id.beam.coupling,
            coulomb: id.friction.forward.zip(id.friction.backward).map(|(f, b)| [f.value, b.value]),
            modes_rad_s: id.beam.modes.iter().map(|m| m.natural_frequency_rad_s).collect(),
        }
    }
}

fn with_std(measured: &MeasuredResponse) -> Vec<Response> {
    let mut sizes: Vec<f64> = measured.response.iter().map(|v| v.norm()).collect();
    sizes.sort_by(f64::total_cmp);
    let median = sizes.get(sizes.len() / 2).copied().unwrap_or(0.0);
    let values = measured.response.iter().enumerate();
    let one = values.map(|(i, value)| {
        let unknown = UNKNOWN * value.norm().hypot(SMALL * median);
        Response { value: *value, std: measured.std.as_ref().map_or(unknown, |std| std[i]) }
    });
    one.collect()
}

/// The quantity of the command that the motor's response is given for, and the torque constant; or what is wrong with it.
fn command(
    motor: Option<&MeasuredResponse>,
    constant: Option<&str>,
) -> Result<(CommandQuantity, Option<f64>), String> {
    let inverse = |d: Dimension| Dimension::new(-d.kg, -d.m, -d.s, -d.a);
    let stated = match motor.and_then(|m| m.dimension) {
        Some(d) if d == inverse(Dimension::CURRENT) => Some(CommandQuantity::Current),
        Some(d) if d == inverse(Dimension::VOLTAGE) => Some(CommandQuantity::Voltage),
        _ => None,
    };
    let Some(text) = constant else {
        return Ok((stated.unwrap_or(CommandQuantity::Arbitrary), None));
    };
    let unit = text.trim_start_matches(|c: char| !c.is_alphabetic() || c == 'e' || c == 'E');
    if unit.trim().is_empty() {
        return Err(format!("\"{text}\" has no unit"));
    }
    let dimension = parse_any_unit(unit).map_err(|e| e.to_string())?.1;
    let per = if dimension == Dimension::TORQUE_PER_CURRENT {
        CommandQuantity::Current
    } else if dimension == Dimension::TORQUE_PER_VOLTAGE {
        CommandQuantity::Voltage
    } else if dimension == Dimension::TORQUE {
        CommandQuantity::Arbitrary
    } else {
        return Err(format!(
            "\"{text}\" is not a torque per current, per voltage or per unit of command"
        ));
    };
    if stated.is_some_and(|stated| stated != per) {
        return Err(format!("\"{text}\" has another unit of command than the motor's response"));
    }
    let value = parse_quantity(text, dimension).map_err(|e| e.to_string())?;
    if !(value.is_finite() && value > 0.0) {
        return Err(format!("\"{text}\" must be greater than zero"));
    }
    Ok((per, Some(value)))
}
