//! Errors of quantities and units.

use thiserror::Error;

use super::dimension::Dimension;
use crate::excerpt::excerpt;

/// Why a text is not a valid quantity or unit.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum UnitError {
    /// The text does not begin with a number.
    #[error("\"{}\" does not begin with a number", excerpt(text))]
    NoNumber {
        /// The whole text.
        text: String,
    },
    /// A number without a unit.
    #[error("\"{}\" has no unit; {expected} is expected", excerpt(text))]
    NoUnit {
        /// The whole text.
        text: String,
        /// The dimension expected.
        expected: Dimension,
    },
    /// A name that is not a unit.
    #[error("\"{}\": there is no unit `{}`", excerpt(text), excerpt(unit))]
    Unknown {
        /// The whole text.
        text: String,
        /// The name.
        unit: String,
        /// The unit with the most similar name.
        nearest: Option<String>,
    },
    /// The expression ends too early or has a wrong character.
    #[error("\"{}\" is not a unit: {}", excerpt(text), found.map_or("it ends too early".to_owned(), |c| format!("unexpected `{c}`")))]
    Syntax {
        /// The whole text.
        text: String,
        /// The character; `None` at the end of the text.
        found: Option<char>,
    },
    /// An exponent that is too large.
    #[error("\"{}\" has an exponent above {largest}", excerpt(text))]
    Power {
        /// The whole text.
        text: String,
        /// The largest exponent allowed.
        largest: i32,
    },
    /// A unit of another dimension.
    #[error("\"{}\" is {found}, where {expected} is expected", excerpt(text))]
    Dimension {
        /// The whole text.
        text: String,
        /// Its dimension.
        found: Dimension,
        /// The dimension expected.
        expected: Dimension,
    },
    /// A number that is too large or too small.
    #[error("\"{}\" is out of range", excerpt(text))]
    OutOfRange {
        /// The whole text.
        text: String,
    },
}

impl UnitError {
    /// What the user can do.
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::NoNumber { .. } => Some("write a number and a unit, such as \"7 in\"".to_owned()),
            Self::NoUnit { expected, .. } => expected
                .example()
                .map(|e| format!("write it as in \"{e}\"; in a file, a number without quotes is SI")),
            Self::Unknown { nearest, .. } => Some(match nearest {
                Some(name) => format!("did you mean `{name}`?"),
                None => "write units as in \"mA\", \"deg\" or \"lbf*in/A\", with * for products and / for quotients".to_owned(),
            }),
            Self::Syntax { found: Some(','), .. } => {
                Some("write numbers with a point, as in \"0.2 N*m/A\"".to_owned())
            }
            Self::Syntax { .. } => {
                Some("write * for products and / for quotients, as in \"N*m^2\"".to_owned())
            }
            Self::Dimension { found, expected, .. } => Some(dimension_hint(*found, *expected)),
            Self::Power { .. } => Some("check the exponent of the unit".to_owned()),
            Self::OutOfRange { .. } => {
                Some("check the exponent of the number and its unit".to_owned())
            }
        }
    }

    /// The same error with the longer text that contains the unit.
    pub(super) fn within(mut self, whole: &str) -> Self {
        match &mut self {
            Self::NoNumber { text }
            | Self::NoUnit { text, .. }
            | Self::Unknown { text, .. }
            | Self::Syntax { text, .. }
            | Self::Power { text, .. }
            | Self::Dimension { text, .. }
            | Self::OutOfRange { text } => whole.clone_into(text),
        }
        self
    }
}

/// Hint for a wrong dimension. Usual mistakes are a mass instead of a force, and a voltage instead of a current.
fn dimension_hint(found: Dimension, expected: Dimension) -> String {
    match (found, expected) {
        (Dimension::VOLTAGE, Dimension::CURRENT) => {
            return "for a logged voltage write `voltage = …` instead of `current`, and `voltage_limit`".into();
        }
        (Dimension::CURRENT, Dimension::VOLTAGE) => {
            return "for a logged current write `current = …` instead of `voltage`, and `current_limit`".into();
        }
        _ => {}
    }
    if found.times(Dimension::ACCELERATION, 1) == expected {
        return "`lb`, `oz` and `kg` are masses; the forces are `lbf`, `ozf` and `kgf`".into();
    }
    if expected.times(Dimension::ACCELERATION, 1) == found {
        return "`lbf`, `ozf` and `kgf` are forces; the masses are `lb`, `oz` and `kg`".into();
    }
    expected.example().map_or_else(
        || "check the unit of this quantity".to_owned(),
        |example| format!("write it as in \"{example}\""),
    )
}
