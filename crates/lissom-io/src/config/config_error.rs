//! Errors of a file with keys and values.

use std::fmt;
use std::io;

use thiserror::Error;

use crate::excerpt::excerpt;
use crate::nearest::nearest;
use crate::units::UnitError;

/// A key in a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ConfigPlace {
    /// The file.
    pub file: String,
    /// The line, from 1.
    pub line: usize,
    /// The key with its tables; empty for the whole file.
    pub key: String,
}

impl fmt::Display for ConfigPlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.key.is_empty() {
            write!(f, "{}", self.file)
        } else {
            write!(f, "{}, line {}: `{}`", self.file, self.line, excerpt(&self.key))
        }
    }
}

/// Rule for a number.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Rule {
    /// Greater than zero.
    Positive,
    /// Zero or greater.
    NotNegative,
    /// Another number than zero.
    NotZero,
    /// Below a limit.
    Below(f64),
    /// No greater than a limit.
    AtMost(f64),
    /// One of two whole numbers.
    OneOf(i64, i64),
    /// A whole number within limits.
    WholeBetween(i64, i64),
    /// Zero, or of a magnitude between these limits in SI.
    Magnitude(f64, f64),
}

impl fmt::Display for Rule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Positive => f.write_str("greater than zero"),
            Self::NotNegative => f.write_str("zero or greater"),
            Self::NotZero => f.write_str("other than zero"),
            Self::Below(most) => write!(f, "below {most}"),
            Self::AtMost(most) => write!(f, "no greater than {most}"),
            Self::OneOf(one, other) => write!(f, "{one} or {other}"),
            Self::Magnitude(least, most) => {
                write!(f, "of a magnitude from {least:e} to {most:e} in SI")
            }
            Self::WholeBetween(least, most) => write!(f, "a whole number from {least} to {most}"),
        }
    }
}

/// Why a file of keys and values cannot be used.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ConfigError {
    /// The file cannot be read.
    #[error("{file}: cannot be read: {source}")]
    Read {
        /// The file.
        file: String,
        /// The cause.
        source: io::Error,
    },
    /// The file is not TOML.
    #[error("{file}, line {line}, column {column}: {message}")]
    Syntax {
        /// The file.
        file: String,
        /// The line, from 1.
        line: usize,
        /// The character in the line, from 1.
        column: usize,
        /// Message of the TOML reader.
        message: String,
    },
    /// An unknown key.
    #[error("{place} is not a known key")]
    UnknownKey {
        /// Place of the value.
        place: ConfigPlace,
        /// The known keys.
        known: Vec<&'static str>,
        /// The key that was probably meant.
        nearest: Option<String>,
    },
    /// A missing key.
    #[error("{place} has no `{key}`")]
    MissingKey {
        /// The table.
        place: ConfigPlace,
        /// The key.
        key: &'static str,
    },
    /// None of several keys, of which one is required.
    #[error("{place} has none of `{}`", keys.join("`, `"))]
    NoneOf {
        /// The table.
        place: ConfigPlace,
        /// The keys.
        keys: Vec<&'static str>,
    },
    /// Two keys that exclude each other.
    #[error("{place} has both `{first}` and `{second}`")]
    Clash {
        /// The table.
        place: ConfigPlace,
        /// One key.
        first: &'static str,
        /// The other.
        second: &'static str,
    },
    /// A value that has no effect without another key.
    #[error("{place} needs `{key}`")]
    Needs {
        /// The value.
        place: ConfigPlace,
        /// The key.
        key: &'static str,
    },
    /// A number of periods for a motion that is not periodic.
    #[error("{place} is allowed only for periodic motions")]
    NoPeriod {
        /// The value.
        place: ConfigPlace,
    },
    /// A span without mass along its length, in a beam with other spans that have it.
    #[error("{place} has no mass along its length, but `{other}` has")]
    NoMassAlong {
        /// The span.
        place: ConfigPlace,
        /// A span that has mass along its length.
        other: String,
    },
    /// A list with too many entries.
    #[error("{place} has {found} entries with repetitions, but at most {most} are allowed")]
    TooMany {
        /// The list.
        place: ConfigPlace,
        /// The number of entries, with repetitions.
        found: usize,
        /// The largest number allowed.
        most: usize,
    },
    /// A key that is allowed only in the last entry of a list.
    #[error("{place} is allowed only in the last entry")]
    LastOnly {
        /// Place of the value.
        place: ConfigPlace,
    },
    /// A value of a wrong kind.
    #[error("{place} is {found}, where {expected} is expected")]
    Kind {
        /// Place of the value.
        place: ConfigPlace,
        /// The kind expected.
        expected: &'static str,
        /// The value found.
        found: String,
    },
    /// A quantity or unit that cannot be read.
    #[error("{place}: {source}")]
    Unit {
        /// Place of the value.
        place: ConfigPlace,
        /// The cause.
        source: Box<UnitError>,
    },
    /// A number outside its range.
    #[error("{place} is {found}, but must be {rule}")]
    Range {
        /// Place of the value.
        place: ConfigPlace,
        /// The value as written in the file.
        found: String,
        /// The rule for it.
        rule: Rule,
    },
    /// A word that is not one of the choices.
    #[error("{place} is \"{}\", but must be \"{}\"", excerpt(found), choices.join("\" or \""))]
    Choice {
        /// Place of the value.
        place: ConfigPlace,
        /// The word.
        found: String,
        /// The choices.
        choices: Vec<&'static str>,
    },
    /// An empty list.
    #[error("{place} is an empty list")]
    EmptyList {
        /// Place of the value.
        place: ConfigPlace,
    },
}

fn read_hint(source: &io::Error) -> &'static str {
    match source.kind() {
        io::ErrorKind::NotFound => "check the path; `lissom demo` writes an example",
        io::ErrorKind::InvalidData => "save the file as text in UTF-8",
        io::ErrorKind::IsADirectory => "give a file in this folder",
        _ => "check that it is a file and that you may read it",
    }
}

/// An example of the table of this key.
fn table_example(key: &str) -> &'static str {
    match key.rsplit('.').next() {
        Some("payload") => "{ mass = \"0.2 kg\", inertia = \"1e-4 kg*m^2\" }",
        Some("damping") => "{ ratio = 0.01 }",
        Some("section") => "{ round = \"0.8 mm\" }",
        Some(span) if span.starts_with("spans[") => "{ length = \"7 in\", mass = \"0.121 lb\" }",
        _ => "{ column = \"t\", unit = \"s\" }",
    }
}

impl ConfigError {
    /// Whether a unit has another dimension than expected.
    pub(crate) fn is_dimension(&self) -> bool {
        match self {
            Self::Unit { source, .. } => matches!(**source, UnitError::Dimension { .. }),
            _ => false,
        }
    }

    /// What the user can do.
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::UnknownKey {
                nearest: Some(key), ..
            } => Some(format!("did you mean `{key}`?")),
            Self::UnknownKey { known, .. } => {
                Some(format!("the known keys are `{}`", known.join("`, `")))
            }
            Self::MissingKey { key: "hold", .. } => Some(
                "write hold = \"sampled\" for a command that is held between samples, hold = \"measured\" for a measurement"
                    .to_owned(),
            ),
            Self::MissingKey { key: "runs", .. } | Self::EmptyList { .. } => {
                Some("add a table [[runs]] with `file = \"...\"` for each log".to_owned())
            }
            Self::MissingKey { place, key: "mass" } => Some(format!(
                "add `mass` to {}, or give the beam mass along its length: `mass_per_length`, or \
                 `density` with `section`",
                place.key
            )),
            Self::MissingKey { place, key } if place.key.is_empty() => {
                Some(format!("add the table [{key}]"))
            }
            Self::MissingKey { place, key } => Some(format!("add `{key}` to {}", place.key)),
            Self::NoneOf { .. } => Some("add one of them".to_owned()),
            Self::Clash { .. } => Some("give one of the two".to_owned()),
            Self::Unit { source, .. } => source.hint(),
            Self::Range {
                found,
                rule: Rule::Positive | Rule::NotNegative,
                ..
            } if found.trim_start_matches('"').starts_with('-') => {
                Some("check its sign".to_owned())
            }
            Self::Range { place, rule: Rule::WholeBetween(..), .. }
                if place.key.ends_with(".column") =>
            {
                Some("give the column's name in quotes, or its number from 1".to_owned())
            }
            Self::Range { rule: Rule::WholeBetween(..), .. } => {
                Some("give a whole number within these limits".to_owned())
            }
            Self::Range { .. } => Some("check the number and its unit".to_owned()),
            Self::Choice { found, choices, .. } => {
                Some(match nearest(found, choices.iter().copied()) {
                    Some(word) => format!("did you mean \"{word}\"?"),
                    None => "write one of these words".to_owned(),
                })
            }
            Self::Read { source, .. } => Some(read_hint(source).to_owned()),
            Self::Syntax { .. } => {
                Some("the file is TOML: `key = value` lines below [table] lines".to_owned())
            }
            Self::Kind { expected: "a number", .. } => {
                Some("write the number without unit and quotes".to_owned())
            }
            Self::Kind { expected: "text in quotes", .. } => Some("put it in quotes".to_owned()),
            Self::Kind { expected: "true or false", .. } => {
                Some("write true or false without quotes".to_owned())
            }
            Self::Kind { expected: "a table", place, .. } => {
                Some(format!("write it as in {}", table_example(&place.key)))
            }
            Self::Kind { expected: "a list of damping ratios", .. } => {
                Some("write them as in [0.01, 0.02]".to_owned())
            }
            Self::Kind { .. } => Some("`lissom demo` writes an example".to_owned()),
            Self::NoPeriod { .. } => {
                Some("give the time: record = \"20 s\"".to_owned())
            }
            Self::Needs { key, .. } if !matches!(*key, "section" | "young_modulus") => {
                Some(format!("add `{key}`"))
            }
            Self::Needs { .. } => Some(
                "give `section` and `young_modulus`, from which the area follows, or write \
                 `mass_per_length` instead of `density`"
                    .to_owned(),
            ),
            Self::NoMassAlong { .. } => Some(
                "give all spans a mass along their length (`mass_per_length`, or `density` with \
                 `section`), or none of them"
                    .to_owned(),
            ),
            Self::TooMany { .. } => Some("use a smaller `count`".to_owned()),
            Self::LastOnly { .. } => Some("move it to the last entry, or remove it".to_owned()),
        }
    }
}
