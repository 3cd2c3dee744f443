//! Names of efforts in files.

use lissom_core::identify::Effort;
use serde::{Deserialize, Serialize};

/// Effort of the output-error method.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum EffortName {
    /// None.
    Quick,
    /// About 10 s.
    #[default]
    Normal,
    /// Minutes.
    Thorough,
}

impl EffortName {
    /// The effort.
    pub fn effort(self) -> Effort {
        match self {
            Self::Quick => Effort::Quick,
            Self::Normal => Effort::Normal,
            Self::Thorough => Effort::Thorough,
        }
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Quick => "quick",
            Self::Normal => "normal",
            Self::Thorough => "thorough",
        }
    }

    /// The effort with this name.
    pub fn of(name: &str) -> Option<Self> {
        [Self::Quick, Self::Normal, Self::Thorough].into_iter().find(|e| e.name() == name)
    }
}
