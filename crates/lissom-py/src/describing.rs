//! A campaign.toml made of a log and of what the user says about it.

use std::collections::HashMap;
use std::path::PathBuf;

use lissom::DescribedLogs;
use lissom::io::inspect::{Choice, CommandKey, Description};
use lissom::io::units::{Dimension, parse_any_unit};
use pyo3::prelude::*;

use crate::worker;

/// The text of a campaign.toml, and what was taken from the log. `said` has channels by their roles as `COLUMN:UNIT`, and
/// other texts; `drive` the keys of `[drive]`.
#[pyfunction]
#[pyo3(signature = (logs, said, tips, drive, gravity, header_row=None, skip_rows=0))]
#[expect(clippy::too_many_arguments, reason = "options of a Python function")]
pub(crate) fn describe(
    py: Python<'_>,
    logs: Vec<PathBuf>,
    said: HashMap<String, String>,
    tips: Vec<String>,
    drive: Vec<(String, String)>,
    gravity: bool,
    header_row: Option<usize>,
    skip_rows: usize,
) -> PyResult<(String, Vec<String>)> {
    let work = move || -> Result<_, lissom::Error> {
        let choice = |text: &String| Choice::parse(text);
        let role = |name: &str| said.get(name).map(choice).transpose();
        let text = |name: &str| said.get(name).cloned();
        let inputs = [
            (CommandKey::Current, role("current")?),
            (CommandKey::Voltage, role("voltage")?),
            (CommandKey::Torque, role("command")?),
            (CommandKey::Goal, role("goal")?),
        ];
        let description = Description {
            time: role("time")?,
            sample_time: text("sample_time"),
            run: text("run"),
            command: inputs.into_iter().find_map(|(key, said)| Some((key, said?))),
            motor: role("motor")?,
            speed: role("speed")?,
            tips: tips.iter().map(choice).collect::<Result<_, _>>()?,
            header_row,
            skip_rows,
            hold: text("hold"),
            drive,
            gravity,
            mgl: text("mgl"),
            skip: text("skip"),
            window: text("window"),
            ..Description::default()
        };
        let found = DescribedLogs::new(&logs, &description)?;
        let taken = found.draft.taken().map(|(line, why)| format!("{line}: {why}"));
        let notes = found.log.notes.iter().cloned().chain(taken).collect();
        Ok((found.draft.text()?, notes))
    };
    worker::wait(py, work)
}

/// Whether a unit of the motor is one of a linear axis: of length or velocity. Not for an unknown unit.
#[pyfunction]
pub(crate) fn is_linear(unit: &str) -> bool {
    let linear = |(_, dimension)| [Dimension::LENGTH, Dimension::VELOCITY].contains(&dimension);
    parse_any_unit(unit).is_ok_and(linear)
}
