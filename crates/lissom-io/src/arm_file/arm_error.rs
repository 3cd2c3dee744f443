//! Errors of an `arm.toml`.

use std::path::{Path, PathBuf};

use lissom_core::beam::BeamError;
use lissom_core::drive::DriveError;
use lissom_core::rig::RigError;
use thiserror::Error;

/// Why an `arm.toml` describes no usable arm or rig.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ArmError {
    /// A required table is missing.
    #[error("{}: the table [{table}] is missing", file.display())]
    MissingTable {
        /// The file.
        file: PathBuf,
        /// The missing table.
        table: &'static str,
    },
    /// A beam with mass along its length, where a beam with point masses is needed.
    #[error("{}: the beam has mass along its length; here it must have point masses", file.display())]
    Distributed {
        /// The file.
        file: PathBuf,
    },
    /// A beam with point masses, where a beam with mass along its length is needed.
    #[error("{}: the beam has point masses; here it must have mass along its length", file.display())]
    Lumped {
        /// The file.
        file: PathBuf,
    },
    /// A beam given by its modes, where a beam with spans is needed.
    #[error("{}: the beam is given by its modes; here it must have spans", file.display())]
    Modal {
        /// The file.
        file: PathBuf,
    },
    /// A rigid joint, where a beam is needed.
    #[error("{}: the joint is rigid; here it must have a beam", file.display())]
    Rigid {
        /// The file.
        file: PathBuf,
    },
    /// Gravity on an arm with a beam.
    #[error("{}: [load] gives gravity to an arm with a beam, but gravity is simulated only for a rigid joint", file.display())]
    LoadOnBeam {
        /// The file.
        file: PathBuf,
    },
    /// Numbers of the beam that cannot be used.
    #[error("{}: {source}", file.display())]
    Beam {
        /// The file.
        file: PathBuf,
        /// What is wrong.
        source: BeamError,
    },
    /// Numbers of the drive that cannot be used.
    #[error("{}: {source}", file.display())]
    Drive {
        /// The file.
        file: PathBuf,
        /// What is wrong.
        source: DriveError,
    },
    /// Numbers of the rig that cannot be used.
    #[error("{}: {source}", file.display())]
    Rig {
        /// The file.
        file: PathBuf,
        /// What is wrong.
        source: RigError,
    },
}

impl ArmError {
    /// What the user can do.
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::MissingTable { table, .. } => Some(format!("add the table [{table}]")),
            Self::Distributed { .. } => Some(
                "give each span a `mass` instead of `density` or `mass_per_length`; with more spans \
                 the point masses come closer to a beam with mass along it"
                    .to_owned(),
            ),
            Self::Lumped { .. } => {
                Some("add `mass_per_length`, or `density` and `section`, to [beam]".to_owned())
            }
            Self::Modal { .. } => Some("give `spans` instead of `modes` in [beam]".to_owned()),
            Self::Rigid { .. } => {
                Some("give `spans` or `modes` instead of `rigid` in [beam]".to_owned())
            }
            Self::LoadOnBeam { .. } => Some(
                "remove [load], or write `rigid = true` instead of the other keys of [beam]".to_owned(),
            ),
            Self::Beam { source: BeamError::ModesAndPoints { .. }, .. } => {
                Some("give each mode one gain for each point, and as many modes as points".to_owned())
            }
            Self::Beam { source: BeamError::GainsSum { .. }, .. } => Some(
                "make the gains of each point add up to one: the highest mode takes what is missing"
                    .to_owned(),
            ),
            Self::Beam { source: BeamError::NoTip, .. } => {
                Some("describe the beam by its spans, or remove [tip] and the payload".to_owned())
            }
            Self::Beam { source: BeamError::TooManyMasses { .. }, .. } => {
                Some("use fewer spans".to_owned())
            }
            Self::Beam { source: BeamError::ModalDistributed, .. } => Some(
                "write damping = { mass_proportional = \"...\", stiffness_proportional = \"...\" }, or \
                 give the beam point masses"
                    .to_owned(),
            ),
            Self::Beam { source: BeamError::ModalWithDampers, .. } => Some(
                "leave out the `damping` of the spans, or write damping = { mass_proportional = \
                 \"...\", stiffness_proportional = \"...\" } instead of ratios"
                    .to_owned(),
            ),
            Self::Rig { source: RigError::Unsupported { .. }, .. } => {
                Some("use fewer spans, or set `masses` in [rig] for a beam with mass along it".to_owned())
            }
            Self::Beam { .. } | Self::Drive { .. } | Self::Rig { .. } => {
                Some("check the numbers and their units".to_owned())
            }
        }
    }
}

pub(super) fn absent(path: &Path, table: &'static str) -> ArmError {
    ArmError::MissingTable { file: path.to_owned(), table }
}
