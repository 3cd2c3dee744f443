//! What can be wrong with a plan beside its keys.

use std::collections::HashSet;

use lissom::rig::RigError;
use thiserror::Error;

use super::PlanRun;
use crate::config::{Place, Table};

/// Why a plan cannot be carried out.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum PlanError {
    /// An experiment that makes no sense.
    #[error("{place}: {source}")]
    Experiment {
        /// Its key.
        place: Place,
        /// What is wrong with it.
        source: RigError,
    },
    /// Two runs of one name.
    #[error("{place}: two runs are named `{name}`")]
    SameName {
        /// The list of runs.
        place: Place,
        /// The name.
        name: String,
    },
    /// A name that makes no file name.
    #[error("{place}: `{name}` is no name for a log")]
    Name {
        /// The list of runs.
        place: Place,
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

/// Checks that names are file names, each once.
pub(super) fn names(root: &Table<'_>, runs: &[PlanRun]) -> Result<(), PlanError> {
    let place = || root.get("runs").map_or_else(|| root.place(), |v| v.place());
    let mut seen = HashSet::new();
    for run in runs {
        let name = run.name.clone();
        let fits = |c: char| c.is_alphanumeric() || matches!(c, '-' | '_' | '.');
        let begins = name.chars().next().is_some_and(char::is_alphanumeric);
        if !begins || !name.chars().all(fits) || name.len() > 100 {
            return Err(PlanError::Name { place: place(), name });
        }
        // Some file systems do not tell capitals from small letters.
        if !seen.insert(name.to_lowercase()) {
            return Err(PlanError::SameName { place: place(), name });
        }
    }
    Ok(())
}
