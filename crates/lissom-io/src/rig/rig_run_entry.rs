//! A run of a virtual campaign in JSON.

use lissom_core::rig::{Logged, RigFinding};
use serde::{Deserialize, Serialize};

use crate::plan::PlanRun;
use crate::result::finite;

/// A run of a virtual campaign.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RigRunEntry {
    /// File name of the log.
    pub file: String,
    /// Rows of the log.
    pub samples: usize,
    /// Time from one row to the next.
    pub sample_time_s: f64,
    /// Frequency of a sine; null for other motions.
    pub omega_rad_s: Option<f64>,
    /// Seed of the sensor noise, a whole number.
    pub seed: String,
    /// Time before the log, in which the transient decays.
    pub waited_s: f64,
    /// Upper bound of the remaining transient when the log begins; null if it was not checked or has no bound.
    pub transient_left_rad: Option<f64>,
    /// The allowed transient; null if it was not checked.
    pub transient_allowed_rad: Option<f64>,
    /// Share of the record in which the joint sticks, 0 to 1.
    pub stuck_share: f64,
    /// Findings about the simulated run.
    pub findings: Vec<RigFindingEntry>,
}

/// A finding about a simulated run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RigFindingEntry {
    /// What the finding is about; the page plan.toml in the book lists all codes.
    pub code: String,
    /// The finding in words, with numbers.
    pub message: String,
}

impl RigRunEntry {
    /// The entry of a run that was simulated.
    pub fn of(run: &PlanRun, logged: &Logged) -> Self {
        Self {
            file: format!("{}.csv", run.name),
            samples: logged.run.len(),
            sample_time_s: logged.run.sample_time_s(),
            omega_rad_s: run.omega_rad_s,
            seed: run.seed.to_string(),
            waited_s: logged.settled.waited_s,
            transient_left_rad: logged.settled.left_rad.and_then(finite),
            transient_allowed_rad: logged.settled.tolerance_rad.and_then(finite),
            stuck_share: logged.stuck_share,
            findings: logged.findings.iter().map(RigFindingEntry::of).collect(),
        }
    }
}

impl RigFindingEntry {
    fn of(finding: &RigFinding) -> Self {
        Self { code: finding.code().to_owned(), message: finding.to_string() }
    }
}
