//! The runs of a plan and their expected precision as a type: filled from a plan, written and read.

use lissom_core::plan::{
    Expected, Plan, PlannedMotion, PlannedParameter, PlannedRun, PlannedUnknown, Wishes,
};
use serde::{Deserialize, Serialize};

use super::plan_note_entry::PlanNoteEntry;
use crate::result::{MotionKindName, finite};

/// The runs of a plan and their expected precision. SI units and rad/s; std is an expected standard error.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PlannedFile {
    /// Version of lissom that wrote the file.
    pub lissom: String,
    /// Time of all runs, including waiting and 5 s before each run.
    pub time_s: f64,
    /// Allowed time of all runs.
    pub within_s: f64,
    /// Longest time that a run waits for its transient to decay.
    pub longest_wait_s: f64,
    /// The runs in the order of the plan.toml.
    pub runs: Vec<PlannedRunEntry>,
    /// Expected precision from all runs, one entry for each parameter whose precision can be chosen.
    pub expected: Vec<ExpectedEntry>,
    /// All parameters that an identification has to find.
    pub parameters: Vec<PlannedParameterEntry>,
    /// Notes for the user.
    pub notes: Vec<PlanNoteEntry>,
}

/// A run of a plan.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PlannedRunEntry {
    /// Kind of motion.
    pub kind: MotionKindName,
    /// Frequency of a sine, lowest line of a multisine, start of a chirp.
    pub from_rad_s: f64,
    /// Frequency of a sine, upper limit of a multisine's lines, end of a chirp.
    pub to_rad_s: f64,
    /// Seed of a multisine's phases; null for other motions.
    pub phases: Option<u64>,
    /// Amplitude of the reference; peak of a multisine.
    pub amplitude_rad: f64,
    /// Periods logged; null for a chirp.
    pub periods: Option<usize>,
    /// Time logged.
    pub record_s: f64,
    /// Time before the log, in which the transient decays.
    pub waited_s: f64,
    /// Largest expected current.
    pub peak_current_a: f64,
    /// Half of the range that the motor's angle covers.
    pub moved_rad: f64,
    /// Share of the record in which the joint sticks, 0 to 1.
    pub stuck_share: f64,
    /// Whether the run is one of a pair: a sine, or the sine at three times its frequency.
    pub paired: bool,
    /// What would be lost without the run (without both runs of a pair); null if every wanted precision would be
    /// reached without it.
    pub without: Option<WithoutRunEntry>,
}

/// The parameter that would miss its wanted precision by most without a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct WithoutRunEntry {
    /// Name of the parameter.
    pub parameter: String,
    /// Its relative standard error without the run; null if it is unbounded.
    pub relative_std: Option<f64>,
}

/// Expected precision of one parameter from all runs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ExpectedEntry {
    /// Name of the parameter.
    pub parameter: String,
    /// Its value, computed from the arm.toml: N*m, N*m*s/rad, kg*m^2, N*m/rad, rad/s; damping 2*zeta*omega in 1/s.
    pub value: f64,
    /// Expected relative standard error; null if it is unbounded.
    pub relative_std: Option<f64>,
    /// Wanted relative standard error.
    pub wanted: f64,
}

/// A parameter that an identification has to find.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PlannedParameterEntry {
    /// Its name, as in methods.output_error of result.json; gravity-sine and gravity-cosine are g_s and g_c.
    pub name: String,
    /// Its value, computed from the arm.toml.
    pub value: f64,
    /// Expected standard error, in the unit of the value; null if no run shows the parameter.
    pub std: Option<f64>,
}

impl PlannedFile {
    /// The content that `lissom plan` writes.
    pub fn of(wishes: &Wishes, plan: &Plan) -> Self {
        Self {
            lissom: env!("CARGO_PKG_VERSION").to_owned(),
            time_s: plan.time_s,
            within_s: wishes.within_s,
            longest_wait_s: plan.longest_wait_s,
            runs: plan.runs.iter().map(PlannedRunEntry::of).collect(),
            expected: plan.expected.iter().map(ExpectedEntry::of).collect(),
            parameters: plan.parameters.iter().map(PlannedParameterEntry::of).collect(),
            notes: plan.notes.iter().map(PlanNoteEntry::of).collect(),
        }
    }
}

impl PlannedRunEntry {
    fn of(run: &PlannedRun) -> Self {
        let (kind, from_rad_s, to_rad_s, phases) = match run.motion {
            PlannedMotion::Sine { omega_rad_s } => {
                (MotionKindName::Sine, omega_rad_s, omega_rad_s, None)
            }
            PlannedMotion::Multisine { omega_rad_s, to_rad_s, phases } => {
                (MotionKindName::Multisine, omega_rad_s, to_rad_s, Some(phases))
            }
            PlannedMotion::Chirp { from_rad_s, to_rad_s, .. } => {
                (MotionKindName::Chirp, from_rad_s, to_rad_s, None)
            }
        };
        Self {
            kind,
            from_rad_s,
            to_rad_s,
            phases,
            amplitude_rad: run.amplitude_rad,
            periods: run.motion.periods(run.record_s),
            record_s: run.record_s,
            waited_s: run.waited_s,
            peak_current_a: run.peak_current_a,
            moved_rad: run.moved_rad,
            stuck_share: run.stuck_share,
            paired: run.paired,
            without: run.without.map(WithoutRunEntry::of),
        }
    }
}

impl WithoutRunEntry {
    fn of((parameter, relative_std): (PlannedParameter, f64)) -> Self {
        Self { parameter: parameter.name(), relative_std: finite(relative_std) }
    }
}

impl ExpectedEntry {
    fn of(expected: &Expected) -> Self {
        Self {
            parameter: expected.parameter.name(),
            value: expected.value,
            relative_std: finite(expected.std),
            wanted: expected.wanted,
        }
    }
}

impl PlannedParameterEntry {
    fn of((parameter, value, std): &(PlannedUnknown, f64, f64)) -> Self {
        Self { name: parameter.name(), value: *value, std: finite(*std) }
    }
}
