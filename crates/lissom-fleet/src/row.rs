//! A row: what was found in a log, or why nothing was.

use std::path::Path;

use lissom::Found;
use lissom::identify::Severity;
use lissom_io::write::json_text;
use lissom_io::{EffortName, ParameterList, ResultFile};
use serde::{Deserialize, Serialize};

use crate::fleet_log::FleetLog;
use crate::version::VERSION;

/// What was found in a log, or why nothing was.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FleetRow {
    /// Name of the log.
    pub log: String,
    /// The machine that it is from.
    pub machine: Option<String>,
    /// When it was recorded, in microseconds since 1970 UTC.
    pub time_us: Option<i64>,
    /// SHA-256 of the file's bytes, in hexadecimal digits; none if it could not be read. Of a folder: of the files of the runs,
    /// one after the other.
    pub input_sha256: Option<String>,
    /// Time that the log took \[s\].
    pub seconds: f64,
    /// Version of lissom.
    pub version: String,
    /// What was found, or why nothing was.
    pub outcome: RowOutcome,
}

/// What was found in a log, or why nothing was.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RowOutcome {
    /// The log was identified.
    Identified(Box<RowResult>),
    /// It was not.
    Failed {
        /// What kind of failure.
        failure: Failure,
        /// What happened, with what to do about it.
        message: String,
    },
}

/// The estimates and findings of a log.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RowResult {
    /// The effort that gave them.
    pub effort: EffortName,
    /// Its estimates.
    pub estimates: Vec<RowEstimate>,
    /// Codes of its refusals.
    pub refusals: Vec<String>,
    /// Codes of its warnings.
    pub warnings: Vec<String>,
    /// Codes of its other findings.
    pub infos: Vec<String>,
    /// The content of its `result.json`, if it is kept.
    pub json: Option<String>,
}

impl RowResult {
    /// The estimates and findings of a result, and the whole result if it is kept.
    pub fn of(found: &Found, effort: EffortName, keep: bool) -> Self {
        let file: ResultFile = found.file();
        let parameters = ParameterList::of(&file).parameters;
        let estimates = parameters.into_iter().map(|parameter| RowEstimate {
            key: format!("{} [{}]", parameter.key, parameter.unit),
            value_std: parameter.estimate.map(|e| (e.value, e.std)),
        });
        let codes = |severity: Severity| {
            let mut codes: Vec<String> = Vec::new();
            for finding in file.findings.iter().filter(|f| f.severity == severity) {
                if !codes.contains(&finding.code) {
                    codes.push(finding.code.clone());
                }
            }
            codes
        };
        RowResult {
            effort,
            estimates: estimates.collect(),
            refusals: codes(Severity::Refusal),
            warnings: codes(Severity::Warning),
            infos: codes(Severity::Info),
            json: keep.then(|| json_text(Path::new("result"), &file).ok()).flatten(),
        }
    }
}

/// An estimate of a row.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RowEstimate {
    /// Key in `result.json`, with its unit in brackets.
    pub key: String,
    /// Value and standard error; none if it is refused.
    pub value_std: Option<(f64, f64)>,
}

/// Why a log has no result.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Failure {
    /// The log cannot be opened or fetched.
    Missing,
    /// The log cannot be used.
    Input,
    /// It took longer than the time limit.
    TimeLimit,
    /// The process that read it ended, every time.
    ProcessEnded,
    /// A defect of lissom.
    Internal,
}

impl Failure {
    /// All kinds.
    pub const ALL: [Self; 5] =
        [Self::Missing, Self::Input, Self::TimeLimit, Self::ProcessEnded, Self::Internal];

    /// The failure with this name.
    pub fn of(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|failure| failure.name() == name)
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Missing => "missing",
            Self::Input => "input",
            Self::TimeLimit => "time_limit",
            Self::ProcessEnded => "process_ended",
            Self::Internal => "internal",
        }
    }
}

impl FleetRow {
    /// The row of a log.
    pub(crate) fn new(log: &FleetLog, seconds: f64, outcome: RowOutcome) -> Self {
        Self {
            log: log.log.clone(),
            machine: log.machine.clone(),
            time_us: log.time_us,
            input_sha256: None,
            seconds,
            version: VERSION.to_owned(),
            outcome,
        }
    }

    /// The row of a log without a result.
    pub fn failed(log: &FleetLog, seconds: f64, failure: Failure, message: String) -> Self {
        Self::new(log, seconds, RowOutcome::Failed { failure, message })
    }

    /// Why it has no result, and what happened; none if it has one.
    pub fn failure(&self) -> Option<(Failure, &str)> {
        match &self.outcome {
            RowOutcome::Failed { failure, message } => Some((*failure, message)),
            RowOutcome::Identified(_) => None,
        }
    }
}
