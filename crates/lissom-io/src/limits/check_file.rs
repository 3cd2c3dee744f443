//! A check of a log against limits, as `lissom check --json` writes it.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::limits_file::Limit;
use crate::result::ListedParameter;

/// What `lissom check --json` writes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct CheckFile {
    /// The log.
    pub log: String,
    /// What its path says, by the names of the pattern.
    pub path: BTreeMap<String, String>,
    /// The outcome of the whole check: that of the worst parameter.
    pub outcome: Outcome,
    /// Each parameter with its limits.
    pub parameters: Vec<CheckedParameterEntry>,
}

/// Outcome of a check.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// The 95 % interval is within the limits, and no warning affects the estimate.
    Pass,
    /// The interval contains a limit, or a warning affects the estimate, or it is refused: the log does not decide.
    Undecided,
    /// The interval is outside the limits.
    Fail,
}

/// A parameter with its limits.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct CheckedParameterEntry {
    /// Its key in `result.json`.
    pub parameter: String,
    /// Its unit.
    pub unit: String,
    /// The estimate; null if it is refused or the result has no such key.
    pub value: Option<f64>,
    /// Its standard error.
    pub std: Option<f64>,
    /// Smallest value allowed; null if there is none.
    pub min: Option<f64>,
    /// Largest value allowed; null if there is none.
    pub max: Option<f64>,
    /// Codes of the warnings that affect the estimate.
    pub warnings: Vec<String>,
    /// The outcome.
    pub outcome: Outcome,
}

impl CheckFile {
    /// Checks the parameters of a log.
    pub fn of(
        log: String,
        path: BTreeMap<String, String>,
        parameters: &[ListedParameter],
        limits: &[Limit],
    ) -> Self {
        let checked: Vec<_> = limits.iter().map(|limit| checked(parameters, limit)).collect();
        let outcome = checked.iter().map(|c| c.outcome).max().unwrap_or(Outcome::Undecided);
        Self { log, path, outcome, parameters: checked }
    }
}

fn checked(parameters: &[ListedParameter], limit: &Limit) -> CheckedParameterEntry {
    let listed = parameters.iter().find(|p| p.key == limit.parameter);
    let estimate = listed.and_then(|p| p.estimate.as_ref());
    let warnings = listed.map_or_else(Vec::new, |p| p.warnings.clone());
    let outcome = estimate.map_or(Outcome::Undecided, |e| {
        let [low, high] = e.ci95;
        let (min, max) =
            (limit.min.unwrap_or(f64::NEG_INFINITY), limit.max.unwrap_or(f64::INFINITY));
        if high < min || low > max {
            Outcome::Fail
        } else if low >= min && high <= max && warnings.is_empty() {
            Outcome::Pass
        } else {
            Outcome::Undecided
        }
    });
    CheckedParameterEntry {
        parameter: limit.parameter.clone(),
        unit: limit.unit.clone(),
        value: estimate.map(|e| e.value),
        std: estimate.map(|e| e.std),
        min: limit.min,
        max: limit.max,
        warnings,
        outcome,
    }
}
