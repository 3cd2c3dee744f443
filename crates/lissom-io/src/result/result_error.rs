//! Why a file gives no arm to predict with.

use std::io;

use thiserror::Error;

/// Why a file gives no arm to predict with.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ResultError {
    /// The file cannot be read.
    #[error("{file}: cannot be read: {source}")]
    Read {
        /// The file.
        file: String,
        /// Why.
        source: io::Error,
    },
    /// The file is no JSON.
    #[error("{file}: is no JSON: {source}")]
    Json {
        /// The file.
        file: String,
        /// What the reader says.
        source: serde_json::Error,
    },
    /// JSON, but no result of `lissom identify`.
    #[error("{file}: is no result of `lissom identify`: it has no `{key}`")]
    NoResult {
        /// The file.
        file: String,
        /// The key that is not there.
        key: &'static str,
    },
    /// The verdict left no arm.
    #[error("{file}: its figures make no arm to predict with: `arm` is null")]
    NoArm {
        /// The file.
        file: String,
    },
    /// A key that is missing, or not what it should be.
    #[error("{file}: `{key}` is not {expected}")]
    Key {
        /// The file.
        file: String,
        /// The key, dotted.
        key: String,
        /// What it should be.
        expected: &'static str,
    },
    /// A value of another type than the file should have there.
    #[error("{file}: `{key}` cannot be read: {source}")]
    Value {
        /// The file.
        file: String,
        /// The key, dotted, or the table that it is in.
        key: String,
        /// What was found and what is expected.
        source: serde_json::Error,
    },
    /// The log is of another kind of axis or command, or with another torque constant.
    #[error("{file}: it is from {of_result}, and the log is {of_log}")]
    OtherDrive {
        /// The file.
        file: String,
        /// What the result says.
        of_result: String,
        /// What the log says.
        of_log: String,
    },
    /// The log's tips are not those of the result.
    #[error("{file}: its tips are {of_result}, and those of the log {of_log}")]
    OtherTips {
        /// The file.
        file: String,
        /// Tips of the result.
        of_result: String,
        /// Tips of the log.
        of_log: String,
    },
}

impl ResultError {
    /// What to do about it.
    pub fn hint(&self) -> Option<String> {
        let hint = match self {
            Self::Read { .. } | Self::Json { .. } | Self::NoResult { .. } => {
                "RESULT comes first: the file that `lissom identify CAMPAIGN --json FILE` writes"
            }
            Self::NoArm { .. } => {
                "see its findings: a refused figure, tips without an angle, or no method that gives a \
                 whole arm"
            }
            Self::Key { .. } | Self::Value { .. } => {
                "write it anew with `lissom identify CAMPAIGN --json FILE`"
            }
            Self::OtherDrive { .. } | Self::OtherTips { .. } => {
                "describe the log as those that the result is from: the same [signals] and [drive]"
            }
        };
        Some(hint.to_owned())
    }
}
