//! Findings in JSON.

use lissom_core::identify::{Finding, Severity};
use serde::{Deserialize, Serialize};

/// A finding: what the data do not determine, or what to know about an estimate.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FindingEntry {
    /// Stable name; the page Findings in the book lists all codes.
    pub code: String,
    /// How much it matters.
    pub severity: Severity,
    /// Name of the run that it is about; null if it is about all runs.
    pub run: Option<String>,
    /// Keys of the affected estimates, without the suffix of their unit.
    pub affects: Vec<String>,
    /// What was found.
    pub message: String,
    /// What to do about it.
    pub hint: String,
}

impl FindingEntry {
    /// The entry of a finding.
    pub fn of(f: &Finding) -> Self {
        Self {
            code: f.code().to_owned(),
            severity: f.severity(),
            run: f.run.clone(),
            affects: f.affects().iter().map(|key| (*key).to_owned()).collect(),
            message: f.message(),
            hint: f.hint().to_owned(),
        }
    }

    /// The entries of a list.
    pub(crate) fn list(all: &[Finding]) -> Vec<Self> {
        all.iter().map(Self::of).collect()
    }
}
