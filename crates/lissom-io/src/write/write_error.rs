//! What can go wrong in writing.

use std::io;

use thiserror::Error;

/// Why a file was not written. It then has its former content or does not exist.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum WriteError {
    /// The file cannot be written.
    #[error("{file}: cannot be written: {source}")]
    File {
        /// The file.
        file: String,
        /// Why.
        source: io::Error,
    },
    /// A value that JSON cannot hold.
    #[error("{file}: cannot be written as JSON: {source}")]
    Json {
        /// The file.
        file: String,
        /// Why.
        source: serde_json::Error,
    },
    /// Columns of different length.
    #[error("column \"{column}\" has {found} rows where \"{first}\" has {expected}")]
    Ragged {
        /// Name of the column.
        column: String,
        /// Its rows.
        found: usize,
        /// Name of the first column.
        first: String,
        /// Rows of the first column.
        expected: usize,
    },
}

impl WriteError {
    /// What to do about it.
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::File { source, .. } if source.kind() == io::ErrorKind::NotFound => {
                Some("create the folder first".to_owned())
            }
            Self::File { source, .. } => Some(
                match source.kind() {
                    io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => {
                        "choose a folder that you may write to"
                    }
                    io::ErrorKind::IsADirectory => "give a file name, not a folder",
                    io::ErrorKind::NotADirectory | io::ErrorKind::AlreadyExists => {
                        "a file of that name stands where a folder is needed"
                    }
                    io::ErrorKind::StorageFull => "make room on the disk",
                    _ => "check the path",
                }
                .to_owned(),
            ),
            Self::Json { .. } | Self::Ragged { .. } => None,
        }
    }
}
