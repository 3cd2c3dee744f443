//! A log of a fleet, with its machine and time.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

/// A log of a fleet: a file, or a folder with the files of the campaign's runs.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct FleetLog {
    /// Its name, by which its row is found: its path or address.
    pub log: String,
    /// The file or folder to read, if it is not the name.
    pub file: Option<PathBuf>,
    /// The machine that it is from.
    pub machine: Option<String>,
    /// When it was recorded, in microseconds since 1970 UTC.
    pub time_us: Option<i64>,
}

impl FleetLog {
    /// A log about which nothing else is known.
    pub fn new(log: impl Into<String>) -> Self {
        Self { log: log.into(), file: None, machine: None, time_us: None }
    }

    /// The file or folder to read.
    pub fn path(&self) -> &Path {
        self.file.as_deref().unwrap_or_else(|| Path::new(&self.log))
    }
}
