//! Errors in writing files.

use std::io;

use thiserror::Error;

/// Why a file was not written. The file then has its former content or does not exist.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum WriteError {
    /// The file cannot be written.
    #[error("{file}: cannot be written: {source}")]
    File {
        /// The file.
        file: String,
        /// The cause.
        source: io::Error,
    },
    /// A value that JSON cannot hold.
    #[error("{file}: cannot be written as JSON: {source}")]
    Json {
        /// The file.
        file: String,
        /// The cause.
        source: serde_json::Error,
    },
    /// Columns of different length.
    #[error("column \"{column}\" has {found} rows, but \"{first}\" has {expected}")]
    Ragged {
        /// Name of the column.
        column: String,
        /// Number of its rows.
        found: usize,
        /// Name of the first column.
        first: String,
        /// Number of rows of the first column.
        expected: usize,
    },
}

impl WriteError {
    /// What the user can do.
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::File { source, .. } if source.kind() == io::ErrorKind::NotFound => {
                Some("create the folder first".to_owned())
            }
            Self::File { source, .. } => Some(
                match source.kind() {
                    io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => {
                        "choose a folder to which you may write"
                    }
                    io::ErrorKind::IsADirectory => "give a file name, not a folder",
                    io::ErrorKind::NotADirectory | io::ErrorKind::AlreadyExists => {
                        "give another path: a file has the name of the folder"
                    }
                    io::ErrorKind::StorageFull => "free some space on the disk",
                    _ => "check the path",
                }
                .to_owned(),
            ),
            Self::Json { .. } | Self::Ragged { .. } => None,
        }
    }
}
