//! The arm of an `arm.toml`, for export.

use std::path::Path;

use lissom_core::arm::Arm;
use lissom_core::beam::Beam;

use super::export_model::{ExportModel, export_model_of_arm};
use super::hinge_chain::HingeChain;
use super::mjcf::mjcf;
use super::mjcf_chain::mjcf_chain;
use crate::arm_file::arm_error::load_on_beam;
use crate::arm_file::{ArmFile, BeamKind, DriveSpec};
use crate::config::ConfigError;
use crate::io_error::Error;

/// The model of the arm that an `arm.toml` describes, with its whole friction law and, for a rigid joint, gravity of its
/// load; `path` is the file's name in errors.
///
/// # Errors
/// [`Error::Config`] if the file describes no arm of point masses, modes or a rigid joint; [`Error::Export`] if the arm has
/// no such model: too many modes, or modes that are not distinct.
pub fn export_model_of_arm_file(path: &Path, file: &ArmFile) -> Result<ExportModel, Error> {
    with_joint(path, file, &file.arm(path)?)
}

/// A whole MuJoCo model of the arm that an `arm.toml` describes: the beam as a chain of hinges if its spans are known,
/// otherwise its modes as oscillators on the motor's axis ([`mjcf`]); `path` is the file's name in errors.
///
/// # Errors
/// [`Error::Config`] if the file describes no arm, [`Error::Export`] if the arm has no such model.
pub fn mjcf_of_arm_file(path: &Path, file: &ArmFile) -> Result<String, Error> {
    let kind = if file.rigid { None } else { Some(file.beam_kind(path)?) };
    if matches!(kind, None | Some(BeamKind::Modal)) {
        return Ok(mjcf(&export_model_of_arm_file(path, file)?)?);
    }
    let (motor, coulomb) = file.motor(path)?;
    let inertia = motor.inertia_kg_m2();
    let chain = if kind == Some(BeamKind::Distributed) {
        HingeChain::of_distributed(&file.distributed_beam(path)?, inertia)
    } else {
        HingeChain::of_lumped(&file.lumped_beam(path)?, inertia)
    };
    let joint = Arm::new(Beam::Rigid, motor, coulomb)
        .map_err(|source| ConfigError::of_arm(path, source))?;
    Ok(mjcf_chain(&with_joint(path, file, &joint)?, &chain)?)
}

/// The model of an arm with friction and load of the file.
fn with_joint(path: &Path, file: &ArmFile, arm: &Arm) -> Result<ExportModel, Error> {
    let mut model = export_model_of_arm(path, arm)?;
    if let Some(drive) = &file.drive {
        add_friction(&mut model, drive);
    }
    if let Some(load) = &file.load {
        if !file.rigid {
            return Err(load_on_beam(path).into());
        }
        model.arm.gravity = Some(load.gravity());
    }
    Ok(model)
}

/// Friction of the joint that is not constant, and torque ripples.
fn add_friction(model: &mut ExportModel, drive: &DriveSpec) {
    model.arm.torque_ripples.clone_from(&drive.torque_ripples);
    let (mean, apart) = (drive.motor.viscous_nm_s_per_rad(), drive.viscous_apart_nm_s_per_rad);
    model.arm.viscous_nm_s_per_rad = [mean + apart, mean - apart];
    model.bristles = drive.friction.bristles.is_some();
    // Bristles slide as their law of steady motion.
    if !drive.friction.law.is_constant() {
        model.arm.dry_terms = drive.friction.law.terms().clone();
    }
}
