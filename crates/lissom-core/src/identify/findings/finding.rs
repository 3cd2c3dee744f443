//! A finding: a statement about the logs or the estimates that the user should read before using an estimate.

use std::fmt;

use crate::identify::findings::finding_kind::FindingKind;
use crate::identify::findings::severity::Severity;

/// A statement about what the logs cannot show, what is wrong with them, or what to know before an estimate is used.
///
/// Its [`Display`](fmt::Display) is the message.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// What was found, with its numbers.
    pub kind: FindingKind,
    /// Name of the run concerned; `None` if the finding concerns the whole campaign.
    pub run: Option<String>,
}

impl Finding {
    /// Creates a finding about the whole campaign.
    pub fn new(kind: impl Into<FindingKind>) -> Self {
        Self { kind: kind.into(), run: None }
    }

    /// Creates a finding about one run.
    pub fn of_run(run: &str, kind: impl Into<FindingKind>) -> Self {
        Self { kind: kind.into(), run: Some(run.to_owned()) }
    }

    /// Stable name of its kind, e.g. `saturation`.
    pub fn code(&self) -> &'static str {
        self.kind.code()
    }

    /// How much it matters.
    pub fn severity(&self) -> Severity {
        self.kind.severity()
    }

    /// Result keys that it affects, without the suffix of their unit, e.g. `friction.viscous`.
    pub fn affects(&self) -> Vec<&'static str> {
        self.kind.affects()
    }

    /// What was found, with its numbers, and what it does to the results.
    pub fn message(&self) -> String {
        self.kind.to_string()
    }

    /// What to do about it; empty where there is nothing to do.
    pub fn hint(&self) -> &'static str {
        self.kind.hint()
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.kind.fmt(f)
    }
}
