//! What is kept between two starts: `session.json`.

use std::path::{Path, PathBuf};

use lissom_io::inspect::{Description, Inspection};
use lissom_io::{CampaignReader, EffortName};
use serde::{Deserialize, Serialize};

use crate::problem::Problem;
use crate::setup::Setup;

/// Number of the format of `session.json`.
const FORMAT: u32 = 1;

/// Logs, what is said about them, and results.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Session {
    format: u32,
    /// Grows with every change of logs and setup: a page that knows an older number may not change them.
    pub(crate) revision: u64,
    /// The number that the next log gets.
    next_log: u64,
    /// The number that the next result gets.
    next_result: u64,
    pub(crate) logs: Vec<LogEntry>,
    pub(crate) setup: Setup,
    pub(crate) results: Vec<ResultEntry>,
}

/// A file of the session.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct LogEntry {
    pub(crate) id: u64,
    /// Its name for people; that of an upload is its name in the folder of logs.
    pub(crate) name: String,
    /// Where it is, if it was given to the command; absent for an upload.
    pub(crate) path: Option<PathBuf>,
    pub(crate) kind: FileKind,
}

impl LogEntry {
    /// Its path as a campaign in the folder of logs names it.
    pub(crate) fn file(&self) -> PathBuf {
        self.path.clone().unwrap_or_else(|| PathBuf::from(&self.name))
    }
}

/// What a file is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum FileKind {
    /// A log.
    Log,
    /// A campaign.toml, which describes the logs.
    Campaign,
    /// Another file, which a campaign may need.
    Other,
}

/// A result.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ResultEntry {
    pub(crate) id: u64,
    /// Its name for people.
    pub(crate) name: String,
    /// When it was made, in seconds since 1970.
    pub(crate) made_s: u64,
    pub(crate) effort: EffortName,
    pub(crate) runs: usize,
    pub(crate) warnings: usize,
    pub(crate) refusals: usize,
    /// Whether the search was ended early.
    pub(crate) interrupted: bool,
    /// Whether the logs are planned runs on the virtual rig: the result then has a plan.toml in place of a campaign.toml.
    #[serde(default)]
    pub(crate) planned: bool,
    /// The setup that it was made with.
    pub(crate) setup: Setup,
}

impl FileKind {
    /// What a file is, by its content. A campaign with a mistake is still one: the mistake is reported when it is read.
    pub(crate) fn of(path: &Path) -> Self {
        if !path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml")) {
            return Self::Log;
        }
        let describes = || lissom_io::read_text(path).is_ok_and(|text| text.contains("[signals]"));
        let is_campaign = CampaignReader::of_file(path).run_files().is_ok() || describes();
        if is_campaign { Self::Campaign } else { Self::Other }
    }
}

impl Default for Session {
    fn default() -> Self {
        let (logs, results) = (Vec::new(), Vec::new());
        let setup = Setup::default();
        Self { format: FORMAT, revision: 0, next_log: 1, next_result: 1, logs, setup, results }
    }
}

impl Session {
    /// Reads the text of a `session.json`, or says why it is none.
    pub(crate) fn of_text(text: &str) -> Result<Self, String> {
        let session: Self = serde_json::from_str(text).map_err(|error| error.to_string())?;
        if session.format != FORMAT {
            return Err(format!(
                "its format is {}, and this program knows {FORMAT}",
                session.format
            ));
        }
        Ok(session)
    }

    /// A number that no log has had.
    pub(crate) fn new_log(&mut self) -> u64 {
        self.next_log += 1;
        self.next_log - 1
    }

    /// A number that no result has had.
    pub(crate) fn new_result(&mut self) -> u64 {
        self.next_result += 1;
        self.next_result - 1
    }

    /// The file with this number.
    pub(crate) fn log(&self, id: u64) -> Option<&LogEntry> {
        self.logs.iter().find(|log| log.id == id)
    }

    /// The result with this number.
    pub(crate) fn result(&self, id: u64) -> Option<&ResultEntry> {
        self.results.iter().find(|result| result.id == id)
    }

    /// What is said about the logs, of which `first` is the first.
    pub(crate) fn description(&self, first: &Inspection) -> Result<Description, Problem> {
        self.setup.description(first, |id| Some(self.log(id)?.file()))
    }

    /// The campaign.toml, if there is one.
    pub(crate) fn campaign(&self) -> Option<&LogEntry> {
        self.logs.iter().find(|log| log.kind == FileKind::Campaign)
    }

    /// The logs that are used.
    pub(crate) fn used_logs(&self) -> impl Iterator<Item = &LogEntry> {
        let used = |log: &&LogEntry| !self.setup.left_out.contains(&log.id);
        self.logs.iter().filter(|log| log.kind == FileKind::Log).filter(used)
    }
}
