//! The table `[drive]`.

use std::path::Path;

use lissom_core::record::{Axis, Command, CommandQuantity};

use super::campaign_file::DriveConstants;
use super::campaign_signals::{CommandKind, CommandSource};
use crate::arm_file::ArmFile;
use crate::config::{ConfigError, Table, Value};
use crate::io_error::Error;
use crate::units::Dimension;

/// Reads the command channel, the constants of the drive, and the sign of the command: −1 if the torque constant is
/// negative.
pub(super) fn drive(
    table: Option<&Table<'_>>,
    axis: Axis,
    source: &CommandSource,
    folder: &Path,
) -> Result<(Command, DriveConstants, f64), Error> {
    let quantity = source.kind.quantity();
    let mut sign = 1.0;
    let mut command = Command {
        quantity,
        hold: source.hold,
        torque_per_command: (source.kind == CommandKind::Effort).then_some(1.0),
        back_emf_viscous: 0.0,
        limit: None,
    };
    let mut known = DriveConstants::default();
    let Some(table) = table else {
        return Ok((command, known, sign));
    };
    table.only(
        "torque_constant position_gain resistance back_emf limit current_limit voltage_limit \
         gear_ratio gear_efficiency arm",
    )?;
    command.limit = limit(table, axis, source.kind)?;
    known.resistance_ohm = table.positive("resistance", Dimension::RESISTANCE)?;
    let back_emf_unit = match axis {
        Axis::Rotary => Dimension::TORQUE_PER_CURRENT,
        Axis::Linear => Dimension::FORCE_PER_CURRENT,
    };
    known.back_emf = table.not_negative("back_emf", back_emf_unit)?;
    if let Some(value) = table.get("position_gain") {
        if source.kind != CommandKind::Goal {
            return Err(not_for(&value, source.kind, axis).into());
        }
        let gain = match axis {
            Axis::Rotary => Dimension::TORQUE,
            Axis::Linear => Dimension::STIFFNESS,
        };
        command.torque_per_command = Some(value.positive(gain)?);
    }
    let gear = gear(table)?;
    if let Some(value) = table.get("torque_constant") {
        if matches!(source.kind, CommandKind::Effort | CommandKind::Goal) {
            return Err(not_for(&value, source.kind, axis).into());
        }
        let (constant, per_ampere) = torque_constant(&value, axis, quantity)?;
        sign = constant.signum();
        let constant = constant.abs();
        known.torque_constant = Some(constant);
        let per_command = if per_ampere && quantity == CommandQuantity::Voltage {
            let Some(resistance_ohm) = known.resistance_ohm else {
                return Err(value.error(
                    ": a torque constant per ampere needs `resistance` if the command is a voltage",
                    "give `resistance` and `back_emf`, or the torque constant per volt, as in \"0.15 N*m/V\"",
                ).into());
            };
            if known.back_emf.is_none() {
                return Err(value.error(
                    ": a torque constant per ampere needs `back_emf` if the command is a voltage",
                    "for a DC motor `back_emf` equals the torque constant in SI, as in \
                     \"0.0107 V*s/rad\"; with 0 its damping is part of viscous friction",
                ).into());
            }
            constant / resistance_ohm
        } else {
            constant
        };
        let at_joint = per_command * gear.ratio * gear.efficiency;
        command.torque_per_command = Some(at_joint);
        if quantity == CommandQuantity::Voltage {
            command.back_emf_viscous = at_joint * gear.ratio * known.back_emf.unwrap_or(0.0);
        }
    }
    if let Some(value) = table.get("arm") {
        let path = folder.join(value.text()?);
        known.arm = Some(ArmFile::read(&path)?);
        known.arm_path = Some(path);
    }
    Ok((command, known, sign))
}

/// A gear between the motor, whose constants are given, and the joint, whose angle is logged.
///
/// Torque at the joint is ratio·efficiency times the motor's torque; the motor's speed is ratio times the joint's
/// speed.
struct Gear {
    ratio: f64,
    efficiency: f64,
}

fn gear(table: &Table<'_>) -> Result<Gear, ConfigError> {
    let given = |value: &Value<'_>| {
        if table.get("torque_constant").is_none() {
            return Err(value.error(
                " has no effect without `torque_constant`",
                "add the torque constant of the motor, or remove this key: without a constant, \
                 estimates are per unit of command",
            ));
        }
        value.positive(Dimension::NUMBER)
    };
    let ratio = table.optional("gear_ratio", given)?.unwrap_or(1.0);
    let efficiency = table.optional("gear_efficiency", |value| match given(value)? {
        efficiency if efficiency > 1.0 => Err(value.range("no greater than 1")),
        efficiency => Ok(efficiency),
    })?;
    Ok(Gear { ratio, efficiency: efficiency.unwrap_or(1.0) })
}

/// Reads the constant in SI, and whether it is per ampere.
fn torque_constant(
    value: &Value<'_>,
    axis: Axis,
    quantity: CommandQuantity,
) -> Result<(f64, bool), ConfigError> {
    let (per_ampere, per_volt, effort) = match axis {
        Axis::Rotary => {
            (Dimension::TORQUE_PER_CURRENT, Dimension::TORQUE_PER_VOLTAGE, Dimension::TORQUE)
        }
        Axis::Linear => {
            (Dimension::FORCE_PER_CURRENT, Dimension::FORCE_PER_VOLTAGE, Dimension::FORCE)
        }
    };
    let (index, constant) = match quantity {
        CommandQuantity::Current => (0, value.quantity(per_ampere)?),
        CommandQuantity::Voltage if value.as_text().is_none() => {
            value.number()?;
            return Err(value.error(
                ": a torque constant without a unit could be per ampere or per volt",
                "give it a unit: N*m/A or N*m/V, N/A or N/V",
            ));
        }
        CommandQuantity::Voltage => value.quantity_of(&[per_ampere, per_volt])?,
        CommandQuantity::PositionError | CommandQuantity::Effort | CommandQuantity::Arbitrary => {
            (1, value.quantity(effort)?)
        }
    };
    if constant == 0.0 || !constant.is_finite() {
        return Err(value.range("other than zero"));
    }
    Ok((constant, index == 0))
}

fn limit(table: &Table<'_>, axis: Axis, kind: CommandKind) -> Result<Option<f64>, ConfigError> {
    let keys = ["limit", "current_limit", "voltage_limit"];
    let Some((key, value)) = table.one_of(&keys)? else {
        return Ok(None);
    };
    let (fits, dimension) = match (kind, axis) {
        (CommandKind::Current, _) => (key != 2, Dimension::CURRENT),
        (CommandKind::Voltage, _) => (key != 1, Dimension::VOLTAGE),
        (CommandKind::Effort, Axis::Rotary) => (key == 0, Dimension::TORQUE),
        (CommandKind::Effort, Axis::Linear) => (key == 0, Dimension::FORCE),
        (CommandKind::Goal, Axis::Linear) => (key == 0, Dimension::LENGTH),
        (CommandKind::Goal, Axis::Rotary) | (CommandKind::Unknown, _) => {
            (key == 0, Dimension::NUMBER)
        }
    };
    if !fits {
        return Err(not_for(&value, kind, axis));
    }
    value.positive(dimension).map(Some)
}

fn not_for(value: &Value<'_>, kind: CommandKind, axis: Axis) -> ConfigError {
    let problem = format!(" does not apply if the command is {}", kind.name(axis));
    value.error(problem, "remove it, or describe the channel that it belongs to")
}
