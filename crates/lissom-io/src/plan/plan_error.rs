//! What can be wrong with a plan beside its keys.

use lissom_core::rig::RigError;
use thiserror::Error;

use crate::config::ConfigPlace;

/// Why a plan cannot be carried out.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum PlanError {
    /// An experiment that makes no sense.
    #[error("{place}: {source}")]
    Experiment {
        /// Its key.
        place: ConfigPlace,
        /// What is wrong with it.
        source: RigError,
    },
    /// Two runs of one name.
    #[error("{place}: two runs are named `{name}`")]
    SameName {
        /// The list of runs.
        place: ConfigPlace,
        /// The name.
        name: String,
    },
    /// A name that makes no file name.
    #[error("{place}: `{name}` is no name for a log")]
    Name {
        /// The list of runs.
        place: ConfigPlace,
        /// The name.
        name: String,
    },
}

impl PlanError {
    /// What to do about it.
    pub fn hint(&self) -> Option<String> {
        Some(match self {
            Self::Experiment { source: RigError::AboveNyquist { .. }, .. } => {
                "ask for lower frequencies, or sample faster".to_owned()
            }
            Self::Experiment { source: RigError::NoLines | RigError::Line { .. }, .. } => {
                "a multisine has odd lines only: `to` must be at least `frequency`".to_owned()
            }
            Self::Experiment { .. } => "check the numbers and their units".to_owned(),
            Self::SameName { .. } => "give each run its own `name`, or none".to_owned(),
            Self::Name { .. } => {
                "use letters, digits, `-`, `_` and `.`, and begin with a letter or digit".to_owned()
            }
        })
    }
}
