//! From an `arm.toml` to an arm and a rig.

use std::path::{Path, PathBuf};

use lissom::arm::Arm;
use lissom::beam::{BeamError, LumpedBeam, Payload, Span};
use lissom::drive::{Coulomb, DriveError, Motor};
use lissom::rig::{Pd, Quantiser, Rig, RigError};
use thiserror::Error;

use super::ArmFile;

/// Why an `arm.toml` makes no arm or rig.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ArmError {
    /// A table that the task needs is absent.
    #[error("{}: the table [{table}] is needed and absent", file.display())]
    MissingTable {
        /// The file.
        file: PathBuf,
        /// Its missing table.
        table: &'static str,
    },
    /// The beam's numbers.
    #[error("{}: {source}", file.display())]
    Beam {
        /// The file.
        file: PathBuf,
        /// What is wrong.
        source: BeamError,
    },
    /// The drive's numbers.
    #[error("{}: {source}", file.display())]
    Drive {
        /// The file.
        file: PathBuf,
        /// What is wrong.
        source: DriveError,
    },
    /// The rig's numbers.
    #[error("{}: {source}", file.display())]
    Rig {
        /// The file.
        file: PathBuf,
        /// What is wrong.
        source: RigError,
    },
}

impl ArmError {
    /// What to do about it.
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::MissingTable { table, .. } => Some(format!("add the table [{table}]")),
            _ => None,
        }
    }
}

impl ArmFile {
    /// The arm that the file describes; `path` names the file in errors.
    ///
    /// # Errors
    /// [`ArmError`] where `[beam]` or `[drive]` is absent or its numbers make no arm.
    pub fn arm(&self, path: &Path) -> Result<Arm, ArmError> {
        let file = || path.to_owned();
        let absent = |table| ArmError::MissingTable { file: file(), table };
        let lumped = self.lumped_beam(path)?;
        let drive = self.drive.as_ref().ok_or_else(|| absent("drive"))?;
        let drive_error = |source| ArmError::Drive { file: file(), source };
        let motor = Motor::new(
            drive.inertia_kg_m2,
            drive.viscous_nm_s_per_rad,
            drive.torque_constant_nm_per_a,
        )
        .map_err(drive_error)?;
        let coulomb = Coulomb::by_direction(drive.coulomb_forward_nm, drive.coulomb_backward_nm)
            .map_err(drive_error)?;
        Arm::new(lumped, motor, coulomb).map_err(|source| ArmError::Beam { file: file(), source })
    }

    /// The lumped beam that the file describes; `path` names the file in errors.
    ///
    /// # Errors
    /// [`ArmError`] where `[beam]` is absent or its numbers make no beam.
    pub fn lumped_beam(&self, path: &Path) -> Result<LumpedBeam, ArmError> {
        let file = || path.to_owned();
        let beam = self
            .beam
            .as_ref()
            .ok_or_else(|| ArmError::MissingTable { file: file(), table: "beam" })?;
        let spans: Vec<Span> = beam
            .spans
            .iter()
            .map(|s| Span {
                length_m: s.length_m,
                flexural_rigidity_n_m2: s.flexural_rigidity_n_m2,
                mass_kg: s.mass_kg,
                damping_n_s_per_m: s.damping_n_s_per_m,
            })
            .collect();
        let payload =
            Payload { inertia_kg_m2: beam.tip_inertia_kg_m2.unwrap_or(0.0), ..Payload::default() };
        LumpedBeam::new(&spans)
            .and_then(|b| b.with_payload(payload))
            .map_err(|source| ArmError::Beam { file: file(), source })
    }

    /// The arm in its loop; sensors of the tips are those of the motor.
    ///
    /// # Errors
    /// As [`arm`](Self::arm), and where `[rig]` or its controller is absent.
    pub fn rig(&self, path: &Path) -> Result<Rig, ArmError> {
        let absent = |table| ArmError::MissingTable { file: path.to_owned(), table };
        let rig = self.rig.as_ref().ok_or_else(|| absent("rig"))?;
        let controller = rig.controller.as_ref().ok_or_else(|| absent("rig.controller"))?;
        let sensor = rig
            .motor_sensor
            .as_ref()
            .map(|s| Quantiser::new(s.bits, s.range_rad))
            .transpose()
            .map_err(|source| ArmError::Rig { file: path.to_owned(), source })?;
        Ok(Rig {
            arm: self.arm(path)?,
            controller: Pd {
                proportional_a_per_rad: controller.proportional_a_per_rad,
                derivative_a_s_per_rad: controller.derivative_a_s_per_rad,
                limit_a: rig.current_limit_a.unwrap_or(f64::MAX),
            },
            sample_time_s: rig.sample_time_s,
            motor_sensor: sensor,
            tip_sensor: sensor,
            current_converter: None,
        })
    }
}
