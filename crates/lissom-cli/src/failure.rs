//! Why a command could not be carried out.

use std::path::PathBuf;

use lissom::identify::IdentifyError;
use lissom::rig::RigError;
use lissom_report::FigureError;
use thiserror::Error;

/// A reason that goes to the user with its hint.
#[derive(Debug, Error)]
pub(crate) enum Failure {
    #[error(transparent)]
    Io(#[from] lissom_io::Error),
    #[error(transparent)]
    Write(#[from] lissom_io::WriteError),
    #[error("{}: {source}", campaign.display())]
    Identify { campaign: PathBuf, source: IdentifyError },
    #[error("{}: exists and is no earlier output; it is not written over", file.display())]
    NotAnOutput { file: PathBuf },
    #[error("{}: one name for two outputs", file.display())]
    SameOutput { file: PathBuf },
    /// What was asked for is not there for this beam.
    #[error("{}: {reason}", arm.display())]
    Model { arm: PathBuf, reason: String, hint: &'static str },
    #[error(transparent)]
    Rig(#[from] RigError),
    #[error("the plot could not be drawn: {0}")]
    Figure(#[from] FigureError),
}

impl Failure {
    /// What to do about it.
    pub(crate) fn hint(&self) -> Option<String> {
        match self {
            Self::Io(error) => error.hint(),
            Self::Write(error) => error.hint(),
            Self::NotAnOutput { .. } => Some(
                "put the input before `--json FILE`, or remove the file if it is to go"
                    .to_owned(),
            ),
            Self::Model { hint, .. } => Some((*hint).to_owned()),
            Self::SameOutput { .. } => Some("give each output its own file".to_owned()),
            Self::Identify { source: IdentifyError::NothingMoves { .. }, .. } => Some(
                "check the wiring and which columns the campaign names; a tip without a signal can be \
                 left out of [signals]"
                    .to_owned(),
            ),
            Self::Identify { source: IdentifyError::Window { .. }, .. } => {
                Some("give a time such as \"0.3 s\"".to_owned())
            }
            _ => None,
        }
    }
}
