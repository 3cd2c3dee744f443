//! Why a log file cannot be read.

use std::io;

use thiserror::Error;

/// Why a log file cannot be read.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum FormatError {
    /// The file cannot be opened or read.
    #[error("cannot be read: {source}")]
    Read {
        /// The cause.
        #[from]
        source: io::Error,
    },
    /// The file is larger than is read at once.
    #[error("is larger than {most} bytes")]
    TooLarge {
        /// Largest number of bytes.
        most: u64,
    },
    /// The compressed data are damaged.
    #[error("the compressed data are damaged: {reason}")]
    Damaged {
        /// The reason.
        reason: String,
    },
    /// The format is recognised, and not read.
    #[error("is {what}, not a table that can be read")]
    Foreign {
        /// What it is.
        what: &'static str,
        /// The way out.
        way_out: &'static str,
    },
    /// The format is read, but not what this file contains.
    #[error("has no channel that can be read: it contains {what}")]
    LeftOut {
        /// What it contains.
        what: String,
        /// The way out.
        way_out: &'static str,
    },
    /// No table of numbers was found.
    #[error("there is no table of numbers in the file")]
    NoTable,
    /// Bytes that no text has.
    #[error("row {row} is not text")]
    NotText {
        /// The row, from 1.
        row: usize,
    },
    /// JSON with an error.
    #[error("this is not valid JSON: {reason}")]
    Json {
        /// What is wrong, with line and column.
        reason: String,
    },
    /// Damaged or unexpected content.
    #[error("{place}: {reason}")]
    Content {
        /// Where: a row, or a path inside the file.
        place: String,
        /// What is wrong.
        reason: String,
    },
}

impl FormatError {
    /// What to do about it.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Read { .. } => "check the path and the permissions",
            Self::TooLarge { .. } => "split the log, or leave out channels",
            Self::Damaged { .. } => "copy the file again",
            Self::Foreign { way_out, .. } | Self::LeftOut { way_out, .. } => way_out,
            Self::NotText { .. } => "export the log as CSV",
            Self::Json { .. } => "export the log again: the file may be cut off",
            Self::NoTable => "a log has one row for each sample and one column for each channel",
            Self::Content { .. } => "export the log again, or as CSV with a header",
        }
    }

    pub(crate) fn content(place: impl Into<String>, reason: impl Into<String>) -> Self {
        Self::Content { place: place.into(), reason: reason.into() }
    }
}
