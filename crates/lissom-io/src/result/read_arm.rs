//! Reads the arm of a `result.json`.

use std::path::Path;

use lissom_core::identify::FoundArm;
use lissom_core::record::{Channels, TipQuantity};

use super::arm_entry::ArmEntry;
use super::result_error::ResultError;
use super::result_file::ResultFile;
use super::unit_names::UnitNames;
use crate::io_error::Error;

/// Relative difference above which torque constants differ; one constant may be written with six digits.
const SAME: f64 = 1e-5;

/// Reads the arm of a result, to predict logs with these channels.
///
/// # Errors
/// [`Error::Result`] if the file is not a result, has no arm, or belongs to another drive.
pub fn read_arm(path: &Path, channels: &Channels) -> Result<FoundArm, Error> {
    let result = ResultFile::read(path)?;
    Ok(found_arm(&path.display().to_string(), &result, channels)?)
}

/// The arm of the text of a `result.json`, which errors call `file`, to predict logs with these channels.
///
/// # Errors
/// As [`read_arm`].
pub fn arm_of_text(file: &str, text: &str, channels: &Channels) -> Result<FoundArm, ResultError> {
    found_arm(file, &ResultFile::of_text(file, text)?, channels)
}

fn found_arm(
    file: &str,
    result: &ResultFile,
    channels: &Channels,
) -> Result<FoundArm, ResultError> {
    let file = || file.to_owned();
    same_drive(result, channels, file)?;
    let Some(arm) = &result.arm else { return Err(ResultError::NoArm { file: file() }) };
    same_tips(arm, channels, file)?;
    arm.found(UnitNames::new(channels)).map_err(|wrong| ResultError::Key {
        file: file(),
        key: wrong.key,
        expected: wrong.expected,
    })
}

/// Checks axis, command and torque constant: if they differ, the result has other units.
fn same_drive(
    result: &ResultFile,
    channels: &Channels,
    file: impl Fn() -> String,
) -> Result<(), ResultError> {
    let axis = channels.axis;
    let constant = channels.command.torque_per_command;
    let said = |constant: Option<f64>| match constant {
        Some(k) => format!("with a torque constant of {k} in SI units"),
        None => "without a torque constant".to_owned(),
    };
    let same = match (result.torque_per_command, constant) {
        (Some(a), Some(b)) => (a - b).abs() <= SAME * b.abs(),
        (None, None) => true,
        _ => false,
    };
    if result.axis == axis && same {
        return Ok(());
    }
    Err(ResultError::OtherDrive {
        file: file(),
        of_result: format!("a {} axis {}", result.axis.name(), said(result.torque_per_command)),
        of_log: format!("has a {} axis {}", axis.name(), said(constant)),
    })
}

fn same_tips(
    arm: &ArmEntry,
    channels: &Channels,
    file: impl Fn() -> String,
) -> Result<(), ResultError> {
    let of_result: Vec<_> = arm.tips.iter().map(|tip| tip.quantity).collect();
    let of_log: Vec<_> = channels.tips.iter().map(|tip| tip.quantity).collect();
    if of_result == of_log {
        return Ok(());
    }
    let told = |list: &[TipQuantity]| match list {
        [] => "none".to_owned(),
        list => list.iter().map(|quantity| quantity.name()).collect::<Vec<_>>().join(", "),
    };
    Err(ResultError::OtherTips { file: file(), of_result: told(&of_result), of_log: told(&of_log) })
}
