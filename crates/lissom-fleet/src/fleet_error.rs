//! The error type of the crate.

use std::io;
use std::path::PathBuf;

use thiserror::Error;

use crate::version::VERSION;

/// Why a fleet cannot be identified or summarised. What is wrong with one log is no error: its row says it.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum FleetError {
    /// A folder or file cannot be read.
    #[error("{}: cannot be read: {source}", path.display())]
    Read {
        /// The folder or file.
        path: PathBuf,
        /// The cause.
        source: io::Error,
    },
    /// A file cannot be written.
    #[error(transparent)]
    Write(#[from] lissom_io::WriteError),
    /// There are no logs.
    #[error("{place}: there are no logs")]
    NoLogs {
        /// Where they were looked for.
        place: String,
    },
    /// A table of logs cannot be used.
    #[error("{file}: {problem}")]
    Table {
        /// The table, with the row.
        file: String,
        /// What is wrong with it.
        problem: String,
    },
    /// The pattern of paths cannot be used.
    #[error("pattern \"{pattern}\": {problem}")]
    Pattern {
        /// The pattern.
        pattern: String,
        /// What is wrong with it.
        problem: String,
    },
    /// A path does not have the form that the pattern states.
    #[error("{log}: the path does not end like \"{pattern}\"")]
    NotLikePattern {
        /// The log.
        log: String,
        /// The pattern.
        pattern: String,
    },
    /// No file or folder has the form that the pattern states.
    #[error("{place}: none of {count} {kind} ends like \"{pattern}\"")]
    NoneLikePattern {
        /// Where they were looked for.
        place: String,
        /// Number of files or folders.
        count: usize,
        /// `files` or `folders`.
        kind: &'static str,
        /// The pattern.
        pattern: String,
    },
    /// A name is no Unicode text.
    #[error("{}: the name is no text", path.display())]
    Name {
        /// The file.
        path: PathBuf,
    },
    /// The campaign that describes every log cannot be used.
    #[error(transparent)]
    Campaign(Box<lissom_io::Error>),
    /// The files of the campaign's runs cannot be found in folders.
    #[error("{place}: {problem}")]
    Runs {
        /// The campaign, or where they were looked for.
        place: String,
        /// What is wrong.
        problem: String,
    },
    /// The rows would be written into a folder with logs.
    #[error("{}: the rows cannot be written into a folder with logs", folder.display())]
    LogsFolder {
        /// The folder.
        folder: PathBuf,
    },
    /// A time cannot be read.
    #[error("{log}: \"{text}\" is not a time")]
    Time {
        /// The log.
        log: String,
        /// The text.
        text: String,
    },
    /// No finding has this code.
    #[error("no finding has the code \"{code}\"")]
    FindingCode {
        /// The code.
        code: String,
    },
    /// A setting is out of its range.
    #[error("{setting} is {value}, but must be positive")]
    Setting {
        /// The setting.
        setting: &'static str,
        /// Its value.
        value: f64,
    },
    /// Another run writes into the folder.
    #[error("{}: another run writes into this folder", folder.display())]
    InUse {
        /// The folder.
        folder: PathBuf,
    },
    /// The folder has the results of another fleet.
    #[error("{}: it has results with another {what}", folder.display())]
    OtherSettings {
        /// The folder.
        folder: PathBuf,
        /// What differs.
        what: &'static str,
    },
    /// The folder has results already.
    #[error("{}: it has results already", folder.display())]
    NotEmpty {
        /// The folder.
        folder: PathBuf,
    },
    /// A part cannot be read.
    #[error("{}: cannot be read: {source}", path.display())]
    Part {
        /// The part.
        path: PathBuf,
        /// The cause.
        source: io::Error,
    },
    /// The folder has parts, and no manifest says whether they count.
    #[error("{}: it has parts of a fleet and no {}", folder.display(), crate::store::MANIFEST)]
    NoManifest {
        /// The folder.
        folder: PathBuf,
    },
    /// The folder is not one of a fleet.
    #[error("{}: there is no {} in it", folder.display(), crate::store::MANIFEST)]
    NoFleet {
        /// The folder.
        folder: PathBuf,
    },
    /// A file of the folder is damaged.
    #[error("{}: it is damaged: {problem}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        problem: String,
    },
    /// A worker process cannot be started.
    #[error("the worker process {} cannot be started: {source}", program.display())]
    Worker {
        /// The program.
        program: PathBuf,
        /// The cause.
        source: io::Error,
    },
    /// A worker has another version.
    #[error("a worker has version {worker} of lissom, and this is version {VERSION}")]
    Version {
        /// Version of the worker.
        worker: String,
    },
    /// Rows do not belong to a batch that is being worked on.
    #[error("batch {number} is not one that is being worked on")]
    NoBatch {
        /// Number of the batch.
        number: u64,
    },
    /// The work was stopped.
    #[error("the work was stopped")]
    Stopped,
}

impl FleetError {
    /// The error that no folder has files of the campaign's runs.
    pub fn no_folder(place: String, run_files: &[String]) -> Self {
        let files = run_files.join(", ");
        Self::Runs { place, problem: format!("no folder has files of the runs: {files}") }
    }

    /// What the user can do.
    pub fn hint(&self) -> Option<String> {
        let hint = match self {
            Self::Write(error) => return error.hint(),
            Self::Campaign(error) => return error.hint(),
            Self::Name { .. } => "rename the file",
            Self::Read { .. } => "check the name, and that you may read it",
            Self::NoLogs { .. } => "give a folder with logs, or the logs themselves",
            Self::Table { .. } => {
                "a table of logs is CSV with a header: a column `log`, and, if known, `machine` and `time`"
            }
            Self::Pattern { .. } | Self::NoneLikePattern { .. } => {
                "a pattern is the end of a path, as in {machine}/{time}.csv"
            }
            Self::NotLikePattern { .. } => {
                "correct the pattern, leave out this log, or give a table of logs"
            }
            Self::Runs { .. } => {
                "name the files of a log by the runs of the campaign, relative to its folder: file = \"slow.csv\""
            }
            Self::LogsFolder { .. } => "write them into another folder",
            Self::Time { .. } => {
                "times are as in 2026-11-27, 2026-11-27T08:15:00Z, 20261127_081500, or seconds since 1970"
            }
            Self::FindingCode { .. } => {
                "codes are those of the findings of a result, e.g. not-periodic"
            }
            Self::Setting { .. } => "give a positive number",
            Self::InUse { .. } => "wait until that run has ended, or write into another folder",
            Self::OtherSettings { .. } => {
                "write into another folder, or use the settings of the results"
            }
            Self::NotEmpty { .. } => "write into another folder, or let the run be resumed",
            Self::Part { .. } => "run the fleet again: logs whose rows are lost are done again",
            Self::NoFleet { .. } => "give the folder into which a fleet was written",
            Self::Damaged { path, .. } if path.extension().is_some_and(|end| end == "parquet") => {
                "delete this file and run the fleet again: its logs are then done again"
            }
            Self::NoManifest { .. } | Self::Damaged { .. } => "write into another folder",
            Self::Worker { .. } => "check the memory and the number of processes of this machine",
            Self::Version { .. } => "install the same version of lissom everywhere",
            Self::NoBatch { .. } | Self::Stopped => return None,
        };
        Some(hint.to_owned())
    }
}
