//! Why the application cannot start.

use std::io;
use std::path::PathBuf;

use thiserror::Error;

/// Why the application cannot start.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum StudioError {
    /// There is no place for the state.
    #[error("no folder is known for the state of the application")]
    NoFolder,
    /// The folder of the state cannot be used.
    #[error("{}: cannot be used as the folder of the state: {source}", .folder.display())]
    Folder {
        /// The folder.
        folder: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The folder has other files.
    #[error("{}: has files that are not those of lissom studio", .folder.display())]
    Foreign {
        /// The folder.
        folder: PathBuf,
    },
    /// Another process uses the folder.
    #[error("{}: another lissom studio uses this folder", .folder.display())]
    Locked {
        /// The folder.
        folder: PathBuf,
    },
    /// The state is no state of this version.
    #[error("{}: is no state of lissom studio: {reason}", .file.display())]
    State {
        /// The file.
        file: PathBuf,
        /// What is wrong.
        reason: String,
    },
    /// A log that is given cannot be found.
    #[error("{}: {source}", .file.display())]
    Log {
        /// The log.
        file: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The port cannot be used.
    #[error("port {port} cannot be used: {source}")]
    Port {
        /// The port.
        port: u16,
        /// What the system says.
        source: io::Error,
    },
    /// The system gives no random numbers.
    #[error("the system gives no random numbers")]
    NoRandom,
    /// Serving has ended.
    #[error("the application has ended: {0}")]
    Ended(io::Error),
}

impl StudioError {
    /// What the user can do.
    pub fn hint(&self) -> Option<&'static str> {
        match self {
            Self::NoFolder | Self::Folder { .. } | Self::Foreign { .. } | Self::Locked { .. } => {
                Some("give another folder for the state, one that is new or empty")
            }
            Self::State { .. } => Some("give another folder for the state, or delete this one"),
            Self::Port { .. } => Some("give another port, or none: a free one is then taken"),
            _ => None,
        }
    }
}
