//! From an `arm.toml` to an arm and a rig.

use std::path::{Path, PathBuf};

use lissom::arm::Arm;
use lissom::beam::{Beam, BeamError, DistributedBeam, LumpedBeam, ModalBeam, Piece, Span};
use lissom::drive::{Coulomb, DriveError, Motor};
use lissom::rig::RigError;
use thiserror::Error;

use super::{ArmFile, BeamKind, BeamSpec, SpanSpec};

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
    /// A beam with mass along its length, where one of point masses is needed.
    #[error("{}: the beam has mass along its length; here it must have point masses", file.display())]
    Distributed {
        /// The file.
        file: PathBuf,
    },
    /// A beam of point masses, where one with mass along its length is needed.
    #[error("{}: the beam has point masses; here it must have mass along its length", file.display())]
    Lumped {
        /// The file.
        file: PathBuf,
    },
    /// A beam known by its modes, where one of spans is needed.
    #[error("{}: the beam is known by its modes; here it must have spans", file.display())]
    Modal {
        /// The file.
        file: PathBuf,
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
            Self::Distributed { .. } => Some(
                "give each span a `mass` in place of `density` or `mass_per_length`; more spans \
                 come closer to the heavy beam"
                    .to_owned(),
            ),
            Self::Lumped { .. } => {
                Some("add `mass_per_length`, or `density` and `section`, to [beam]".to_owned())
            }
            Self::Modal { .. } => Some("give `spans` in place of `modes` in [beam]".to_owned()),
            Self::Beam { source: BeamError::ModesAndPoints { .. }, .. } => {
                Some("give every mode one gain for each point, and as many modes as points".to_owned())
            }
            Self::Beam { source: BeamError::GainsSum { .. }, .. } => Some(
                "give what a point's gains lack of one to the highest mode: it stands for those left out"
                    .to_owned(),
            ),
            Self::Beam { source: BeamError::NoTip, .. } => {
                Some("describe the beam by its spans, or leave the load away".to_owned())
            }
            Self::Beam { source: BeamError::TooManyMasses { .. }, .. } => {
                Some("use fewer spans".to_owned())
            }
            Self::Beam { source: BeamError::ModalDistributed, .. } => Some(
                "write damping = { mass_proportional = \"...\", stiffness_proportional = \"...\" }, or \
                 describe the beam by point masses"
                    .to_owned(),
            ),
            Self::Beam { source: BeamError::ModalWithDampers, .. } => Some(
                "leave out the `damping` of the spans, or write damping = { mass_proportional = \
                 \"...\", stiffness_proportional = \"...\" } in place of ratios"
                    .to_owned(),
            ),
            Self::Rig { source: RigError::Unsupported { .. }, .. } => {
                Some("use fewer spans, or `masses` in [rig] for a beam with mass along it".to_owned())
            }
            Self::Beam { .. } | Self::Drive { .. } | Self::Rig { .. } => {
                Some("check the numbers and their units".to_owned())
            }
        }
    }
}

impl ArmFile {
    /// The arm that the file describes; `path` names the file in errors.
    ///
    /// # Errors
    /// [`ArmError`] where `[beam]` or `[drive]` is absent or its numbers make no arm.
    pub fn arm(&self, path: &Path) -> Result<Arm, ArmError> {
        let beam: Beam = match self.beam_kind(path)? {
            BeamKind::Modal => self.modal_beam(path)?.into(),
            _ => self.lumped_beam(path)?.into(),
        };
        let (motor, coulomb) = self.motor(path)?.ok_or_else(|| absent(path, "drive"))?;
        Arm::new(beam, motor, coulomb)
            .map_err(|source| ArmError::Beam { file: path.to_owned(), source })
    }

    /// The drive that the file describes, if it does; `path` names the file in errors.
    ///
    /// # Errors
    /// [`ArmError::Drive`] where its numbers make no drive.
    pub fn motor(&self, path: &Path) -> Result<Option<(Motor, Coulomb)>, ArmError> {
        let Some(d) = &self.drive else { return Ok(None) };
        let failed = |source| ArmError::Drive { file: path.to_owned(), source };
        let motor = Motor::new(d.inertia_kg_m2, d.viscous_nm_s_per_rad, d.torque_constant_nm_per_a);
        let coulomb = Coulomb::by_direction(d.coulomb_forward_nm, d.coulomb_backward_nm);
        Ok(Some((motor.map_err(failed)?, coulomb.map_err(failed)?)))
    }

    /// How the table `[beam]` describes the beam; `path` names the file in errors.
    ///
    /// # Errors
    /// [`ArmError::MissingTable`] where it is absent.
    pub fn beam_kind(&self, path: &Path) -> Result<BeamKind, ArmError> {
        match (&self.modes, &self.beam) {
            (Some(_), _) => Ok(BeamKind::Modal),
            (None, Some(beam)) => Ok(beam.kind()),
            (None, None) => Err(absent(path, "beam")),
        }
    }

    /// The beam by its spans; `path` names the file in errors.
    ///
    /// # Errors
    /// [`ArmError::MissingTable`] where `[beam]` is absent, [`ArmError::Modal`] where it has modes.
    pub fn beam(&self, path: &Path) -> Result<&BeamSpec, ArmError> {
        match self.beam_kind(path)? {
            BeamKind::Modal => Err(ArmError::Modal { file: path.to_owned() }),
            _ => self.beam.as_ref().ok_or_else(|| absent(path, "beam")),
        }
    }

    /// The beam by its modes; `path` names the file in errors.
    ///
    /// # Errors
    /// [`ArmError`] where `[beam]` has none, or their numbers make no beam.
    pub fn modal_beam(&self, path: &Path) -> Result<ModalBeam, ArmError> {
        let modes = self.modes.clone().ok_or_else(|| absent(path, "beam"))?;
        ModalBeam::new(modes).map_err(|source| ArmError::Beam { file: path.to_owned(), source })
    }

    /// The beam of point masses that the file describes; `path` names the file in errors.
    ///
    /// # Errors
    /// [`ArmError`] where `[beam]` is absent, has modes or mass along its length, or its numbers make no
    /// beam.
    pub fn lumped_beam(&self, path: &Path) -> Result<LumpedBeam, ArmError> {
        let beam = self.beam(path)?;
        if beam.kind() == BeamKind::Distributed {
            return Err(ArmError::Distributed { file: path.to_owned() });
        }
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
        LumpedBeam::new(&spans)
            .and_then(|b| b.with_hub_radius(beam.hub_radius_m))
            .and_then(|b| b.with_payload(beam.tip()))
            .and_then(|b| b.with_damping(beam.damping.clone()))
            .map_err(|source| ArmError::Beam { file: path.to_owned(), source })
    }

    /// The beam with mass along it that the file describes; `path` names the file in errors.
    ///
    /// # Errors
    /// [`ArmError`] where `[beam]` is absent, has point masses alone or its numbers make no beam.
    pub fn distributed_beam(&self, path: &Path) -> Result<DistributedBeam, ArmError> {
        let beam = self.beam(path)?;
        let piece = |s: &SpanSpec| {
            Some(Piece {
                length_m: s.length_m,
                flexural_rigidity_n_m2: s.flexural_rigidity_n_m2,
                mass_per_length_kg_per_m: s.mass_per_length_kg_per_m?,
                end_mass_kg: s.mass_kg,
                end_damping_n_s_per_m: s.damping_n_s_per_m,
            })
        };
        let pieces: Option<Vec<Piece>> = beam.spans.iter().map(piece).collect();
        let pieces = pieces.ok_or_else(|| ArmError::Lumped { file: path.to_owned() })?;
        DistributedBeam::new(&pieces)
            .and_then(|b| b.with_hub_radius(beam.hub_radius_m))
            .and_then(|b| b.with_payload(beam.tip()))
            .and_then(|b| b.with_damping(beam.damping.clone()))
            .map_err(|source| ArmError::Beam { file: path.to_owned(), source })
    }
}

pub(super) fn absent(path: &Path, table: &'static str) -> ArmError {
    ArmError::MissingTable { file: path.to_owned(), table }
}
