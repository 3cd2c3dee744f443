//! Errors of a result that is read.

use std::io;

use thiserror::Error;

/// Why a result, or the arm in it, cannot be used.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ResultError {
    /// The file cannot be read.
    #[error("{file}: cannot be read: {source}")]
    Read {
        /// The file.
        file: String,
        /// The cause.
        source: io::Error,
    },
    /// The file is not JSON.
    #[error("{file}: is not JSON: {source}")]
    Json {
        /// The file.
        file: String,
        /// Message of the reader.
        source: serde_json::Error,
    },
    /// JSON that is not a result of `lissom identify`.
    #[error("{file}: is not a result of `lissom identify`: it has no `{key}`")]
    NoResult {
        /// The file.
        file: String,
        /// The missing key.
        key: &'static str,
    },
    /// The result has no arm.
    #[error("{file}: the result has no arm to predict with: `arm` is null")]
    NoArm {
        /// The file.
        file: String,
    },
    /// A key that is missing or has a wrong value.
    #[error("{file}: `{key}` is not {expected}")]
    Key {
        /// The file.
        file: String,
        /// The key, with dots.
        key: String,
        /// What it must be.
        expected: String,
    },
    /// A value of a wrong type.
    #[error("{file}: `{key}` cannot be read: {source}")]
    Value {
        /// The file.
        file: String,
        /// The key with dots, or its table.
        key: String,
        /// What was found and what is expected.
        source: serde_json::Error,
    },
    /// The log has another kind of axis or command, or another torque constant.
    #[error("{file}: the result has {of_result}, but the log {of_log}")]
    OtherDrive {
        /// The file.
        file: String,
        /// Axis and torque constant of the result.
        of_result: String,
        /// Axis and torque constant of the log.
        of_log: String,
    },
    /// The tips of the log are not those of the result.
    #[error("{file}: the result has these tips: {of_result}; but the log has: {of_log}")]
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
    /// What the user can do.
    pub fn hint(&self) -> Option<String> {
        let hint = match self {
            Self::Read { .. } | Self::Json { .. } | Self::NoResult { .. } => {
                "give first the result: the file that `lissom identify CAMPAIGN --json FILE` writes"
            }
            Self::NoArm { .. } => {
                "read its findings: a parameter is refused, tips have no angle, or no method gives a whole \
                 arm"
            }
            Self::Key { .. } | Self::Value { .. } => {
                "write it again with `lissom identify CAMPAIGN --json FILE`"
            }
            Self::OtherDrive { .. } | Self::OtherTips { .. } => {
                "describe the log as the logs of the result, with the same [signals] and [drive]"
            }
        };
        Some(hint.to_owned())
    }
}
