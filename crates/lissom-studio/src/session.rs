//! What is kept between two starts: `session.json`.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use lissom_io::inspect::{Description, Inspection};
use lissom_io::{CampaignReader, EffortName};
use serde::{Deserialize, Serialize};

use crate::problem::Problem;
use crate::setup::Setup;
use crate::uploads::plain_name;

/// Number of the format of `session.json`.
const FORMAT: u32 = 1;
/// Largest count, which a number of JSON holds exactly.
const COUNT_MOST: u64 = 1 << 53;

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

/// A file of the session, or one of its runs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct LogEntry {
    pub(crate) id: u64,
    /// Its name for people; that of an upload is its name in the folder of logs.
    pub(crate) name: String,
    /// Where it is, if it was given to the command; absent for an upload.
    pub(crate) path: Option<PathBuf>,
    pub(crate) kind: FileKind,
    /// Its run of the file, `COLUMN=VALUE` or a group of channels; absent for the whole file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) run: Option<String>,
}

impl LogEntry {
    /// The whole of a file.
    pub(crate) fn of_file(id: u64, name: String, path: Option<PathBuf>, kind: FileKind) -> Self {
        Self { id, name, path, kind, run: None }
    }

    /// Its path as a campaign in the folder of logs names it.
    pub(crate) fn address(&self) -> PathBuf {
        self.at(self.path.as_deref().unwrap_or_else(|| Path::new(&self.name)))
    }

    /// Its path, if its file is at this one.
    pub(crate) fn at(&self, file: &Path) -> PathBuf {
        let mut path = file.as_os_str().to_owned();
        if let Some(run) = &self.run {
            path.push("::");
            path.push(run);
        }
        path.into()
    }

    /// Its name for people, with its run.
    pub(crate) fn title(&self) -> String {
        self.run.as_ref().map_or_else(|| self.name.clone(), |run| format!("{}::{run}", self.name))
    }

    /// Whether both are of one file.
    pub(crate) fn shares_file(&self, other: &Self) -> bool {
        self.path == other.path && self.name == other.name
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
        session.check()?;
        Ok(session)
    }

    /// Says what another program has made of it that this one does not write.
    fn check(&self) -> Result<(), String> {
        let logs = self.logs.iter().map(|log| log.id);
        let results = self.results.iter().map(|result| result.id);
        for (what, next, ids) in [
            ("log", self.next_log, logs.collect::<Vec<u64>>()),
            ("result", self.next_result, results.collect()),
        ] {
            let distinct: BTreeSet<&u64> = ids.iter().collect();
            if distinct.len() < ids.len() || ids.iter().any(|id| *id >= next) {
                return Err(format!("the number of a {what} is not the only one of its kind"));
            }
        }
        if [self.revision, self.next_log, self.next_result].into_iter().any(|n| n > COUNT_MOST) {
            return Err("a number is too large".to_owned());
        }
        let sent = self.logs.iter().filter(|log| log.path.is_none());
        match sent.map(|log| &log.name).find(|name| plain_name(name) != **name) {
            Some(name) => Err(format!("{name:?} is no name of a file in the folder")),
            None => Ok(()),
        }
    }

    /// A copy for a page that knows it as it is.
    pub(crate) fn known(&self, revision: u64) -> Result<Self, Problem> {
        if self.revision == revision {
            return Ok(self.clone());
        }
        Err(Problem::conflict(
            "another page has changed this session meanwhile",
            "this page shows the session as it is now; make your change again",
        ))
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
        let said = self.setup.description(first, |id| Some(self.log(id)?.address()))?;
        // Logs that are single runs have no column of runs.
        let run = said.run.filter(|_| self.used_logs().any(|log| log.run.is_none()));
        Ok(Description { run, ..said })
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
