//! What can be wrong with a file of keys and values.

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
    /// The key with the tables around it; empty for the whole file.
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

/// What a number must be.
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
        /// Why.
        source: io::Error,
    },
    /// It is not TOML.
    #[error("{file}, line {line}, column {column}: {message}")]
    Syntax {
        /// The file.
        file: String,
        /// The line, from 1.
        line: usize,
        /// The character in the line, from 1.
        column: usize,
        /// What the TOML reader says.
        message: String,
    },
    /// A key that means nothing here.
    #[error("{place} is not a key that is known here")]
    UnknownKey {
        /// Where.
        place: ConfigPlace,
        /// The keys that are.
        known: Vec<&'static str>,
        /// The one that was probably meant.
        nearest: Option<String>,
    },
    /// A key that must be there.
    #[error("{place} has no `{key}`")]
    MissingKey {
        /// The table.
        place: ConfigPlace,
        /// The key.
        key: &'static str,
    },
    /// None of several keys of which one must be there.
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
    /// A value that means nothing without another key.
    #[error("{place} needs `{key}`")]
    Needs {
        /// The value.
        place: ConfigPlace,
        /// The key.
        key: &'static str,
    },
    /// Periods of what has none.
    #[error("{place} is for what repeats itself")]
    NoPeriod {
        /// The value.
        place: ConfigPlace,
    },
    /// A span without mass along it in a beam that has spans with one.
    #[error("{place} has no mass along its length, but `{other}` has")]
    NoMassAlong {
        /// The span.
        place: ConfigPlace,
        /// A span that has one.
        other: String,
    },
    /// A list that stands for too many entries.
    #[error("{place} stands for {found} entries, but {most} is the most")]
    TooMany {
        /// The list.
        place: ConfigPlace,
        /// Its entries, each as often as it is repeated.
        found: usize,
        /// The most there may be.
        most: usize,
    },
    /// A key that only the last entry of a list may have.
    #[error("{place} may stand in the last entry alone")]
    LastOnly {
        /// Where.
        place: ConfigPlace,
    },
    /// A value of another kind.
    #[error("{place} is {found}, where {expected} is expected")]
    Kind {
        /// Where.
        place: ConfigPlace,
        /// What is expected.
        expected: &'static str,
        /// What stands there.
        found: String,
    },
    /// A quantity or unit that cannot be read.
    #[error("{place}: {source}")]
    Unit {
        /// Where.
        place: ConfigPlace,
        /// What is wrong with it.
        source: Box<UnitError>,
    },
    /// A number outside its range.
    #[error("{place} is {found}, but must be {rule}")]
    Range {
        /// Where.
        place: ConfigPlace,
        /// The value as it stands in the file.
        found: String,
        /// What it must be.
        rule: Rule,
    },
    /// A word that is none of the choices.
    #[error("{place} is \"{}\", but must be \"{}\"", excerpt(found), choices.join("\" or \""))]
    Choice {
        /// Where.
        place: ConfigPlace,
        /// The word.
        found: String,
        /// The choices.
        choices: Vec<&'static str>,
    },
    /// A list with nothing in it.
    #[error("{place} is an empty list")]
    EmptyList {
        /// Where.
        place: ConfigPlace,
    },
}

fn read_hint(source: &io::Error) -> &'static str {
    match source.kind() {
        io::ErrorKind::NotFound => "check the path; `lissom demo` writes an example",
        io::ErrorKind::InvalidData => "the file is text in UTF-8: save it so",
        io::ErrorKind::IsADirectory => "name the file in it",
        _ => "check that it is a file that you may read",
    }
}

/// How the table of this key may be written.
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

    /// What to do about it.
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::UnknownKey {
                nearest: Some(key), ..
            } => Some(format!("did you mean `{key}`?")),
            Self::UnknownKey { known, .. } => {
                Some(format!("the keys here are `{}`", known.join("`, `")))
            }
            Self::MissingKey { key: "hold", .. } => Some(
                "\"sampled\" for a command that is held between samples, \"measured\" for a measurement"
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
                Some("columns go by name in quotes or by number from 1".to_owned())
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
                Some("write it without unit and quotes".to_owned())
            }
            Self::Kind { expected: "text in quotes", .. } => Some("put it in quotes".to_owned()),
            Self::Kind { expected: "true or false", .. } => {
                Some("write it without quotes".to_owned())
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
                "the area comes from `section`, beside `young_modulus`; or write `mass_per_length` \
                 in place of `density`"
                    .to_owned(),
            ),
            Self::NoMassAlong { .. } => Some(
                "give every span a mass along its length (`mass_per_length`, or `density` with \
                 `section`), or none of them"
                    .to_owned(),
            ),
            Self::TooMany { .. } => Some("lower a `count`".to_owned()),
            Self::LastOnly { .. } => Some("move it there, or leave it out".to_owned()),
        }
    }
}
