//! One entry of a plan's `[[runs]]`.

use std::path::Path;

use lissom_core::record::Hold;
use lissom_core::rig::{
    Drive, Experiment, Multisine, Reference, RigError, Settle, Start, Sweep, Table as Rows,
    TableHold,
};

use super::plan_settle::settle;
use crate::arm_file::omega;
use crate::campaign::column;
use crate::config::{ConfigError, Table, Value};
use crate::io_error::Error;
use crate::log::{ColumnRef, LogColumn, LogOptions, read_log};
use crate::units::Dimension;

/// A run as an entry describes it.
#[derive(Debug, Clone)]
pub(super) struct Planned {
    pub(super) experiment: Experiment,
    pub(super) omega_rad_s: Option<f64>,
    /// Whether the entry gives only this run.
    pub(super) alone: bool,
}

/// Largest number of runs of a plan.
pub(super) const RUNS_MOST: usize = 10_000;
/// The kinds of experiment.
const KINDS: [&str; 7] = ["sine", "multisine", "square", "chirp", "table", "velocity", "release"];
/// Number of lines of a multisine without `to`.
const LINES: f64 = 20.0;

/// Reads all runs of an entry.
pub(super) fn read(
    table: &Table<'_>,
    common: Settle,
    seed: u64,
    folder: &Path,
) -> Result<Vec<Planned>, Error> {
    let own = "name drive record periods settle start repeat";
    table.only(&format!("{} {own}", KINDS.join(" ")))?;
    let Some((kind, value)) = table.one_of(&KINDS)? else {
        return Err(table.none_of(&KINDS).into());
    };
    let drive = table.optional("drive", |v| v.choice(&["angle", "current"]))?;
    // A release has no position control, unless `drive` asks for it.
    let current = drive.map_or(KINDS[kind] == "release", |choice| choice == 1);
    if current && KINDS[kind] == "velocity" {
        return Err(table.clash("velocity", "drive = \"current\"").into());
    }
    let unit = if current { Dimension::CURRENT } else { Dimension::NUMBER };
    let references = match KINDS[kind] {
        "sine" => sines(&value, unit, Reference::sine)?,
        "square" => sines(&value, unit, Reference::square)?,
        "multisine" => vec![multisine(&value, unit, seed)?],
        "chirp" => vec![chirp(&value, unit, record(table)?)?],
        "table" => vec![rows(&value, folder)?],
        "velocity" => velocities(&value)?,
        _ => vec![made(&value, Reference::hold(0.0))?],
    };
    let is_sine = KINDS[kind] == "sine";
    let alone = references.len() == 1 && table.get("repeat").is_none();
    let settle = table.get("settle").map_or(Ok(common), |v| settle(&v))?;
    let start = start(table, KINDS[kind], &value)?;
    let mut planned = Vec::with_capacity(references.len());
    for reference in references {
        let record_s = record_of(table, &reference)?;
        let omega_rad_s = reference.highest_rad_s().filter(|_| is_sine);
        let drive = if current { Drive::Current(reference) } else { Drive::Angle(reference) };
        let experiment =
            Experiment::new(drive, record_s).map_err(|e| experiment_error(&value, &e))?;
        let experiment = experiment.starting(start).settling(match KINDS[kind] {
            // The log begins when the tip is released.
            "release" => Settle::AtOnce,
            _ => settle,
        });
        planned.push(Planned { experiment, omega_rad_s, alone });
    }
    Ok(planned)
}

fn experiment_error(value: &Value<'_>, source: &RigError) -> Error {
    let hint = match source {
        RigError::AboveNyquist { .. } => "use lower frequencies, or sample faster",
        RigError::NoLines | RigError::Line { .. } => {
            "give a `to` of at least `frequency`: a multisine has odd multiples of `frequency` up to `to`"
        }
        _ => "check the numbers and their units",
    };
    value.error(format!(": {source}"), hint).into()
}

fn made<T>(value: &Value<'_>, outcome: Result<T, RigError>) -> Result<T, Error> {
    outcome.map_err(|source| experiment_error(value, &source))
}

/// Combines every frequency with every amplitude.
fn sines(
    value: &Value<'_>,
    unit: Dimension,
    make: fn(f64, f64) -> Result<Reference, RigError>,
) -> Result<Vec<Reference>, Error> {
    let table = value.table()?;
    table.only("frequency omega_rad_s amplitude")?;
    let frequencies: Vec<f64> = match table.one_of(&["frequency", "omega_rad_s"])? {
        Some((0, list)) => each(&list, |v| v.positive(Dimension::RATE))?,
        Some((_, list)) => each(&list, |v| v.positive(Dimension::NUMBER))?,
        None => vec![omega(&table)?],
    };
    let amplitudes = each(&table.need("amplitude")?, |v| v.positive(unit))?;
    let found = frequencies.len().saturating_mul(amplitudes.len());
    if found > RUNS_MOST {
        return Err(value.too_many(found, RUNS_MOST).into());
    }
    let mut references = Vec::with_capacity(found);
    for amplitude in &amplitudes {
        for frequency in &frequencies {
            references.push(made(value, make(*frequency, *amplitude))?);
        }
    }
    Ok(references)
}

fn each(
    value: &Value<'_>,
    read: impl Fn(&Value<'_>) -> Result<f64, ConfigError>,
) -> Result<Vec<f64>, ConfigError> {
    let all = value.one_or_list();
    if all.is_empty() {
        return Err(value.empty());
    }
    all.iter().map(read).collect()
}

fn multisine(value: &Value<'_>, unit: Dimension, seed: u64) -> Result<Reference, Error> {
    let table = value.table()?;
    table.only("frequency omega_rad_s to amplitude crest phases")?;
    let base = omega(&table)?;
    let to = table.positive("to", Dimension::RATE)?;
    let amplitude = table.need("amplitude")?.positive(unit)?;
    let own = table.optional("phases", |v| v.whole(0, i64::MAX))?;
    let seed = own.map_or(seed, i64::unsigned_abs);
    let top = to.unwrap_or((2.0 * LINES - 1.0) * base);
    let mut multisine = made(value, Multisine::odd(base, top, amplitude, seed))?;
    if let Some(goal) = table.get("crest") {
        multisine = made(&goal, multisine.with_crest(goal.positive(Dimension::NUMBER)?))?;
    }
    Ok(Reference::Multisine(multisine))
}

fn chirp(value: &Value<'_>, unit: Dimension, record_s: f64) -> Result<Reference, Error> {
    let table = value.table()?;
    table.only("from to amplitude sweep")?;
    let sweep = table.optional("sweep", |v| v.choice(&["logarithmic", "linear"]))?;
    let sweep = if sweep == Some(1) { Sweep::Linear } else { Sweep::Logarithmic };
    let span = (
        table.need("from")?.positive(Dimension::RATE)?,
        table.need("to")?.positive(Dimension::RATE)?,
    );
    let amplitude = table.need("amplitude")?.positive(unit)?;
    made(value, Reference::chirp(sweep, span, amplitude, record_s))
}

fn velocities(value: &Value<'_>) -> Result<Vec<Reference>, Error> {
    let rates = each(value, |v| v.quantity(Dimension::RATE))?;
    rates.into_iter().map(|rate| made(value, Reference::ramp(rate))).collect()
}

/// Reads a table of times and values from a file; its path starts from the folder of the plan.
fn rows(value: &Value<'_>, folder: &Path) -> Result<Reference, Error> {
    let table = value.table()?;
    table.only("file time time_unit value unit hold")?;
    let column = |key: &str, or: usize| {
        table.get(key).map_or(Ok(ColumnRef::Number(or)), |value| column(&value))
    };
    let scale = |key: &str| -> Result<f64, ConfigError> {
        table.get(key).map_or(Ok(1.0), |v| v.any_unit().map(|(size, _)| size))
    };
    let hold = table.optional("hold", |v| v.choice(&["lines", "steps"]))?;
    let hold = if hold == Some(1) { TableHold::Zero } else { TableHold::Linear };
    let path = folder.join(table.need("file")?.text()?);
    let (time, reading) = (column("time", 1)?, column("value", 2)?);
    let columns = [LogColumn { column: reading, hold: Hold::Measured }];
    let log = read_log(&path, Some(&time), &columns, &LogOptions::default())?;
    let (seconds, size) = (scale("time_unit")?, scale("unit")?);
    let times = log.time.unwrap_or_default();
    // The table begins at the start of the run.
    let first = times.first().copied().unwrap_or(0.0);
    let times = times.iter().map(|t| seconds * (t - first)).collect();
    let values = log.columns.into_iter().next().unwrap_or_default();
    let values = values.iter().map(|v| size * v).collect();
    Ok(Reference::Table(made(value, Rows::new(times, values, hold))?))
}

fn start(table: &Table<'_>, kind: &str, value: &Value<'_>) -> Result<Start, Error> {
    if kind == "release" {
        if table.get("start").is_some() {
            return Err(table.clash("release", "start").into());
        }
        return Ok(Start::Deflected { tip_force_n: value.quantity(Dimension::FORCE)? });
    }
    let Some(start) = table.optional("start", Value::table)? else { return Ok(Start::Rest) };
    start.only("tip_force")?;
    Ok(Start::Deflected { tip_force_n: start.need("tip_force")?.quantity(Dimension::FORCE)? })
}

fn record(table: &Table<'_>) -> Result<f64, Error> {
    Ok(table.need("record")?.positive(Dimension::TIME)?)
}

/// The logged time: `record` or whole `periods`, whichever is longer.
fn record_of(table: &Table<'_>, reference: &Reference) -> Result<f64, Error> {
    let least = table.positive("record", Dimension::TIME)?;
    let Some(periods) = table.get("periods") else {
        return match (least, reference) {
            (Some(least), _) => Ok(least),
            // A table has a length of its own.
            (None, Reference::Table(rows)) if rows.end_s() > 0.0 => Ok(rows.end_s()),
            (None, reference) if reference.period_s().is_some() => {
                Err(table.none_of(&["periods", "record"]).into())
            }
            (None, _) => record(table),
        };
    };
    let Some(period) = reference.period_s() else {
        let problem = " is allowed only for periodic motions";
        return Err(periods.error(problem, "give the time: record = \"20 s\"").into());
    };
    let time = periods.positive(Dimension::NUMBER)? * period;
    Ok(least.map_or(time, |least| time.max(least)))
}
