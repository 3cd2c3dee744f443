//! The error of a file with keys and values.

use std::fmt;
use std::io;
use std::path::Path;

use thiserror::Error;

use crate::excerpt::excerpt;

/// A key in a file.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
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

/// Why an `arm.toml`, a `campaign.toml` or another file of keys and values cannot be used.
#[derive(Debug, Error)]
#[error("{place}{problem}")]
#[non_exhaustive]
pub struct ConfigError {
    /// Where it is wrong.
    pub place: ConfigPlace,
    /// What is wrong, in words that follow the place.
    pub problem: String,
    /// What the user can do.
    pub hint: String,
    /// Why the file cannot be read.
    pub(crate) source: Option<io::Error>,
}

impl ConfigError {
    pub(crate) fn new(
        place: ConfigPlace,
        problem: impl Into<String>,
        hint: impl Into<String>,
    ) -> Self {
        Self { place, problem: problem.into(), hint: hint.into(), source: None }
    }

    /// A file that cannot be used as a whole.
    pub(crate) fn of_file(
        file: &Path,
        problem: impl fmt::Display,
        hint: impl Into<String>,
    ) -> Self {
        let place = ConfigPlace { file: file.display().to_string(), line: 1, key: String::new() };
        Self::new(place, format!(": {problem}"), hint)
    }

    /// A file that cannot be read.
    pub fn unread(file: &Path, source: io::Error) -> Self {
        let hint = match source.kind() {
            io::ErrorKind::NotFound => "check the path; `lissom demo` writes an example",
            io::ErrorKind::InvalidData => "save the file as text in UTF-8",
            io::ErrorKind::IsADirectory => "give a file in this folder",
            _ => "check that it is a file and that you may read it",
        };
        let problem = format!("cannot be read: {source}");
        Self { source: Some(source), ..Self::of_file(file, problem, hint) }
    }

    /// What the user can do.
    pub fn hint(&self) -> Option<String> {
        Some(self.hint.clone()).filter(|hint| !hint.is_empty())
    }
}
