//! Input of `lissom equivalent`: responses from a campaign or from tables.

use std::path::Path;

use lissom::identify::{
    Effort, EquivalentData, Estimate, Identified, MotorData, Response, StdSource, without_origin,
};
use lissom::record::{Axis, CommandQuantity};
use lissom_io::units::{Dimension, parse_any_unit, parse_quantity};
use lissom_io::{MeasuredResponse, UnitNames, read_campaign, read_responses};

use super::identification::{Asked, identified};
use crate::args::equivalent_args::EquivalentArgs;
use crate::shared::failure::Failure;

/// Relative standard error of responses without one. It is so small that the residual of the model decides.
const UNKNOWN: f64 = 1e-6;
/// Magnitude, as a share of the median magnitude, below which the standard error of a response does not fall. Without
/// it a response near a zero would count more than its neighbours.
const SMALL: f64 = 1e-2;

/// The responses, the names of their units, and what is known about the motor.
pub(crate) struct Input {
    pub(crate) data: EquivalentData,
    pub(crate) names: UnitNames,
    /// Estimates of `identify` from a campaign: inertia, viscous friction with back-EMF, coupling, natural frequencies.
    pub(crate) identified: Option<KnownMotor>,
}

/// Estimates to compare with the equivalent arm.
pub(crate) struct KnownMotor {
    pub(crate) inertia: Option<Estimate>,
    pub(crate) viscous: Option<Estimate>,
    pub(crate) coupling: Option<Estimate>,
    /// Coulomb friction forward and backward \[N·m\].
    pub(crate) coulomb: Option<[f64; 2]>,
    pub(crate) modes_rad_s: Vec<Estimate>,
}

impl Input {
    pub(crate) fn read(args: &EquivalentArgs) -> Result<Self, Failure> {
        let is_toml = |p: &Path| p.extension().is_some_and(|e| e.eq_ignore_ascii_case("toml"));
        if args.inputs.iter().any(|p| is_toml(p)) {
            if args.inputs.len() > 1 {
                let words = "a campaign.toml cannot be combined with other inputs".to_owned();
                return Err(Failure::Asked(words, "give one campaign.toml, or tables only"));
            }
            if args.torque_constant.is_some() {
                let words =
                    "--torque-constant is for tables, but the input is a campaign.toml".to_owned();
                let hint = "give torque_constant in the [drive] of the campaign.toml";
                return Err(Failure::Asked(words, hint));
            }
            return Self::campaign(&args.inputs[0], args.quick);
        }
        Self::tables(args)
    }

    fn campaign(path: &Path, quick: bool) -> Result<Self, Failure> {
        let file = read_campaign(path)?;
        let id = {
            let effort = if quick { Effort::Quick } else { Effort::Normal };
            identified(path, &file, Asked { effort, ..Asked::default() })?
        };
        let data =
            EquivalentData::of_campaign(&file.campaign, &id.responses).map_err(|source| {
                Failure::Equivalent {
                    input: path.to_owned(),
                    source: Box::new(source),
                    place: None,
                }
            })?;
        let names = UnitNames::new(&file.campaign.channels);
        let back_emf = file.campaign.channels.command.back_emf_viscous;
        Ok(Self { data, names, identified: Some(KnownMotor::of(&id, back_emf)) })
    }

    fn tables(args: &EquivalentArgs) -> Result<Self, Failure> {
        let read = read_responses(&args.inputs).map_err(lissom_io::Error::from)?;
        let all = || read.points.iter().chain(&read.motor);
        let std_known = all().all(|r| r.std.is_some());
        if !std_known && all().any(|r| r.std.is_some()) {
            let words = "some responses have a standard error and some have none".to_owned();
            let hint = "give a std column for each response, or for none";
            return Err(Failure::Asked(words, hint));
        }
        let (command, constant) = command(read.motor.as_ref(), args.torque_constant.as_deref())?;
        let motor = read.motor.as_ref().map(|motor| MotorData {
            omega_rad_s: read.omega_rad_s.clone(),
            response: with_deviations(motor),
            torque_per_command: constant.unwrap_or(1.0),
        });
        let angles = |point: &MeasuredResponse| {
            let zeros = point.zeros_at_origin().unwrap_or(0);
            without_origin(&read.omega_rad_s, &with_deviations(point), zeros)
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

fn with_deviations(measured: &MeasuredResponse) -> Vec<Response> {
    let mut sizes: Vec<f64> = measured.response.iter().map(|v| v.norm()).collect();
    sizes.sort_by(f64::total_cmp);
    let median = sizes.get(sizes.len() / 2).copied().unwrap_or(0.0);
    let one = |(i, value): (usize, &num_complex::Complex64)| {
        let unknown = UNKNOWN * value.norm().hypot(SMALL * median);
        Response { value: *value, std: measured.std.as_ref().map_or(unknown, |std| std[i]) }
    };
    measured.response.iter().enumerate().map(one).collect()
}

/// The quantity of the command that the motor's response is given for, and the torque constant.
fn command(
    motor: Option<&MeasuredResponse>,
    constant: Option<&str>,
) -> Result<(CommandQuantity, Option<f64>), Failure> {
    let inverse = |d: Dimension| Dimension::new(-d.kg, -d.m, -d.s, -d.a);
    let said = match motor.and_then(|m| m.dimension) {
        Some(d) if d == inverse(Dimension::CURRENT) => Some(CommandQuantity::Current),
        Some(d) if d == inverse(Dimension::VOLTAGE) => Some(CommandQuantity::Voltage),
        _ => None,
    };
    let Some(text) = constant else {
        return Ok((said.unwrap_or(CommandQuantity::Arbitrary), None));
    };
    let hint = "give torque per ampere or per volt, as the motor's response has it, such as \"0.25 N*m/A\"; for \
                another command a torque such as \"0.25 N*m\" per unit";
    let wrong = |why: String| Failure::Asked(format!("--torque-constant: {why}"), hint);
    let unit = text.trim_start_matches(|c: char| !c.is_alphabetic() || c == 'e' || c == 'E');
    if unit.trim().is_empty() {
        return Err(wrong(format!("\"{text}\" has no unit")));
    }
    let dimension = parse_any_unit(unit).map_err(|e| wrong(e.to_string()))?.1;
    let per = if dimension == Dimension::TORQUE_PER_CURRENT {
        CommandQuantity::Current
    } else if dimension == Dimension::TORQUE_PER_VOLTAGE {
        CommandQuantity::Voltage
    } else if dimension == Dimension::TORQUE {
        CommandQuantity::Arbitrary
    } else {
        return Err(wrong(format!(
            "\"{text}\" is not a torque per current, per voltage or per unit of command"
        )));
    };
    if said.is_some_and(|said| said != per) {
        return Err(wrong(format!(
            "\"{text}\" has another unit of command than the motor's response"
        )));
    }
    let value = parse_quantity(text, dimension).map_err(|e| wrong(e.to_string()))?;
    if !(value.is_finite() && value > 0.0) {
        return Err(wrong(format!("\"{text}\" must be greater than zero")));
    }
    Ok((per, Some(value)))
}
