//! The arm with another payload.

use std::fmt;

use strum::{IntoStaticStr, VariantNames};

use crate::identify::findings::describe::Describe;
use crate::identify::findings::number_text::counted;
use crate::identify::findings::result_key as key;
use crate::identify::findings::severity::Severity;

/// The arm with another payload.
#[derive(Debug, Clone, PartialEq, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "kebab-case")]
#[non_exhaustive]
pub enum PayloadFinding {
    /// Modes above those found affect how the beam bends under another load.
    PayloadHighestMode {
        /// Modes found.
        modes: usize,
    },
}

impl fmt::Display for PayloadFinding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self::PayloadHighestMode { modes } = self;
        write!(
            f,
            "modes above the {} found affect how the beam bends under another load: the interval of the highest mode does \
             not include this",
            counted(*modes, "mode", "modes")
        )
    }
}

impl Describe for PayloadFinding {
    fn code(&self) -> &'static str {
        self.into()
    }

    fn severity(&self) -> Severity {
        Severity::Info
    }

    fn affects(&self) -> Vec<&'static str> {
        vec![key::MODES]
    }

    fn hint(&self) -> &'static str {
        "if the beam has mass along its length, use only the modes below the highest one; if you need the highest one, \
         identify one more mode: add runs near its frequency, or a tip"
    }
}
