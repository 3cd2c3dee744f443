//! Errors of a plan whose keys are valid.

use lissom_core::rig::RigError;
use thiserror::Error;

use crate::config::ConfigPlace;

/// Why a plan cannot be simulated.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum PlanError {
    /// An experiment that cannot be simulated.
    #[error("{place}: {source}")]
    Experiment {
        /// Place of the experiment.
        place: ConfigPlace,
        /// The cause.
        source: RigError,
    },
    /// Two runs with the same name.
    #[error("{place}: two runs have the name `{name}`")]
    SameName {
        /// The list of runs.
        place: ConfigPlace,
        /// The name.
        name: String,
    },
    /// A name that is not a valid file name.
    #[error("{place}: `{name}` is not a valid name for a log")]
    Name {
        /// The list of runs.
        place: ConfigPlace,
        /// The name.
        name: String,
    },
}

impl PlanError {
    /// What the user can do.
    pub fn hint(&self) -> Option<String> {
        Some(match self {
            Self::Experiment { source: RigError::AboveNyquist { .. }, .. } => {
                "use lower frequencies, or sample faster".to_owned()
            }
            Self::Experiment { source: RigError::NoLines | RigError::Line { .. }, .. } => {
                "give a `to` of at least `frequency`: a multisine has odd multiples of `frequency` up to `to`".to_owned()
            }
            Self::Experiment { .. } => "check the numbers and their units".to_owned(),
            Self::SameName { .. } => "give each run its own `name`, or none".to_owned(),
            Self::Name { .. } => {
                "use letters, digits, `-`, `_` and `.`, and begin with a letter or digit".to_owned()
            }
        })
    }
}
