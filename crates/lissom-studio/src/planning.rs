//! Plans the next experiment with the arm of a result, and tries it on the virtual rig.

use std::path::Path;

use lissom::plan::{Plan, Precision, Wishes, percent, plan};
use lissom::record::Campaign;
use lissom::rig::Rig;
use lissom_io::units::{Dimension, parse_quantity};
use lissom_io::{ArmFile, PlanFile, write};
use serde::{Deserialize, Serialize};

use crate::problem::Problem;

/// Name of the arm in messages.
const ARM: &str = "arm.toml";
/// Name of the plan in messages.
const PLAN: &str = "plan.toml";

/// What the user wants.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Wanted {
    /// The text of an arm.toml with [rig].
    arm: String,
    /// Relative standard error of all parameters, such as "1%"; the usual ones if empty.
    precision: String,
    /// Time of all runs, such as "5 min"; the usual one if empty.
    within: String,
}

/// Planned runs, with the rig that they are for.
#[derive(Debug, Clone)]
pub(crate) struct Planned {
    pub(crate) rig: Rig,
    /// The text of the plan.toml.
    pub(crate) text: String,
}

/// A plan as the page shows it.
#[derive(Debug, Serialize)]
pub(crate) struct PlanView {
    /// The text of the plan.toml.
    text: String,
    /// Time of all runs \[s\].
    time_s: f64,
    runs: Vec<String>,
    expected: Vec<ExpectedRow>,
    notes: Vec<String>,
}

/// The standard error that is expected of a parameter.
#[derive(Debug, Serialize)]
struct ExpectedRow {
    name: String,
    expected: String,
    wanted: String,
    reached: bool,
}

/// A precision from which on the number is probably meant in percent \[1\].
const LARGE: f64 = 0.2;

impl Wanted {
    /// Makes a plan.
    pub(crate) fn planned(&self) -> Result<(Planned, PlanView), Problem> {
        let file = ArmFile::from_text(Path::new(ARM), &self.arm)?;
        let rig = file.rig(Path::new(ARM)).map_err(lissom_io::Error::from)?;
        if !file.has_controller() {
            let hint =
                "add controller = { proportional = \"8 A/rad\", derivative = \"0.2 A*s/rad\" }";
            return Err(Problem::input("[rig] has no controller", Some(hint.to_owned())));
        }
        let made = plan(&rig, &self.wishes()?, |_, _| ()).map_err(|error| {
            Problem::input(error.to_string(), Some("change [rig], or allow more time".to_owned()))
        })?;
        let text = write::plan_text(&made);
        let view = PlanView::of(&made, text.clone());
        Ok((Planned { rig, text }, view))
    }

    fn wishes(&self) -> Result<Wishes, Problem> {
        let none = Wishes::default();
        let number = |what: &str, text: &str, dimension| -> Result<Option<f64>, Problem> {
            if text.trim().is_empty() {
                return Ok(None);
            }
            match parse_quantity(text, dimension) {
                Ok(value) if value > 0.0 => Ok(Some(value)),
                Ok(_) => Err(Problem::input(format!("{what} must be greater than zero"), None)),
                Err(error) => Err(Problem::input(format!("{what}: {error}"), error.hint())),
            }
        };
        let precision = number("the precision", &self.precision, Dimension::NUMBER)?;
        if precision.is_some_and(|share| share >= LARGE && !self.precision.contains('%')) {
            let error =
                format!("the precision {} is more than a few percent", self.precision.trim());
            return Err(Problem::input(
                error,
                Some("write it in percent, as in \"1%\"".to_owned()),
            ));
        }
        let within = number("the time", &self.within, Dimension::TIME)?;
        Ok(Wishes {
            precision: precision.map_or(none.precision, Precision::all),
            within_s: within.unwrap_or(none.within_s),
            ..none
        })
    }
}

impl PlanView {
    fn of(plan: &Plan, text: String) -> Self {
        let expected = plan.expected.iter().map(|e| ExpectedRow {
            name: e.parameter.name(),
            expected: if e.std < 1.0 { percent(e.std) } else { "not identified".to_owned() },
            wanted: percent(e.wanted),
            reached: e.std <= e.wanted,
        });
        Self {
            text,
            time_s: plan.time_s,
            runs: plan
                .runs
                .iter()
                .map(|run| format!("{}: {}", run.motion, run.in_words()))
                .collect(),
            expected: expected.collect(),
            notes: plan.notes.iter().map(ToString::to_string).collect(),
        }
    }
}

impl Planned {
    /// The logs of the planned runs.
    pub(crate) fn simulated(&self) -> Result<Campaign, Problem> {
        let file = PlanFile::from_text(Path::new(PLAN), &self.text)?;
        let experiments = file.runs.into_iter().map(|run| run.experiment);
        let logs = self.rig.campaign(experiments);
        Ok(logs.map_err(|error| Problem::input(error.to_string(), None))?.campaign)
    }
}
