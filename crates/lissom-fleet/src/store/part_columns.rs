//! The columns of a part: a row for each log.

use std::collections::HashMap;

use crate::row::{FleetRow, RowOutcome, RowResult};

/// Column of the logs' names.
pub(crate) const LOG: &str = "log";
/// Column of the machines' names.
pub(crate) const MACHINE: &str = "machine";
/// Column of the times.
pub(crate) const TIME: &str = "time";
/// Column of the kinds of failures.
pub(crate) const FAILURE: &str = "failure";
/// Name of the column of an estimate's standard errors: of `friction.coulomb [N·m]` it is `friction.coulomb.std [N·m]`.
pub(crate) fn std_of(name: &str) -> String {
    let (key, unit) = name.split_once(" [").unwrap_or((name, "1]"));
    format!("{key}.std [{unit}")
}

/// Values of a column; a missing one is none.
#[derive(Debug, Clone, PartialEq)]
pub enum Values {
    /// Texts.
    Text(Vec<Option<String>>),
    /// Numbers.
    Number(Vec<Option<f64>>),
    /// Microseconds since 1970 UTC.
    Time(Vec<Option<i64>>),
}

impl Values {
    /// Number of rows.
    pub fn len(&self) -> usize {
        match self {
            Self::Text(values) => values.len(),
            Self::Number(values) => values.len(),
            Self::Time(values) => values.len(),
        }
    }

    /// Values of the same kind that are all missing.
    pub(super) fn missing(&self, rows: usize) -> Self {
        match self {
            Self::Text(_) => Self::Text(vec![None; rows]),
            Self::Number(_) => Self::Number(vec![None; rows]),
            Self::Time(_) => Self::Time(vec![None; rows]),
        }
    }

    /// The rows for which `kept` is true.
    pub(super) fn only(self, kept: &[bool]) -> Self {
        fn only<T>(values: Vec<T>, kept: &[bool]) -> Vec<T> {
            values
                .into_iter()
                .zip(kept)
                .filter(|(_, kept)| **kept)
                .map(|(value, _)| value)
                .collect()
        }
        match self {
            Self::Text(values) => Self::Text(only(values, kept)),
            Self::Number(values) => Self::Number(only(values, kept)),
            Self::Time(values) => Self::Time(only(values, kept)),
        }
    }

    /// Whether there are no rows.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// The columns of rows: names and values, in the order in which they are written.
pub(super) fn columns(rows: &[FleetRow]) -> Vec<(String, Values)> {
    let text =
        |of: &dyn Fn(&FleetRow) -> Option<String>| Values::Text(rows.iter().map(of).collect());
    let found = |of: &dyn Fn(&RowResult) -> Option<String>| {
        text(&|row| match &row.outcome {
            RowOutcome::Identified(found) => of(found),
            RowOutcome::Failed { .. } => None,
        })
    };
    let failed = |of: &dyn Fn(&str, &str) -> String| {
        text(&|row| match &row.outcome {
            RowOutcome::Identified(_) => None,
            RowOutcome::Failed { failure, message } => Some(of(failure.name(), message)),
        })
    };
    let mut columns = vec![
        (LOG, text(&|row| Some(row.log.clone()))),
        (MACHINE, text(&|row| row.machine.clone())),
        (TIME, Values::Time(rows.iter().map(|row| row.time_us).collect())),
        (FAILURE, failed(&|failure, _| failure.to_owned())),
        ("message", failed(&|_, message| message.to_owned())),
        ("effort", found(&|found| Some(found.effort.name().to_owned()))),
        ("refusals", found(&|found| Some(found.refusals.join(" ")))),
        ("warnings", found(&|found| Some(found.warnings.join(" ")))),
        ("infos", found(&|found| Some(found.infos.join(" ")))),
        ("seconds", Values::Number(rows.iter().map(|row| Some(row.seconds)).collect())),
        ("version", text(&|row| Some(row.version.clone()))),
        ("input_sha256", text(&|row| row.input_sha256.clone())),
    ];
    if rows.iter().any(|row| matches!(&row.outcome, RowOutcome::Identified(f) if f.json.is_some()))
    {
        columns.push(("result", found(&|found| found.json.clone())));
    }
    let mut columns: Vec<_> = columns.into_iter().map(|(name, v)| (name.to_owned(), v)).collect();
    columns.extend(estimates(rows));
    columns
}

/// Two columns for each estimate that a row has: value and standard error.
fn estimates(rows: &[FleetRow]) -> Vec<(String, Values)> {
    let mut keys: Vec<&str> = Vec::new();
    let mut places: HashMap<&str, usize> = HashMap::new();
    let mut numbers: Vec<[Vec<Option<f64>>; 2]> = Vec::new();
    for (k, row) in rows.iter().enumerate() {
        let RowOutcome::Identified(found) = &row.outcome else { continue };
        for estimate in &found.estimates {
            let at = *places.entry(&estimate.key).or_insert_with(|| {
                keys.push(&estimate.key);
                numbers.push([vec![None; rows.len()], vec![None; rows.len()]]);
                keys.len() - 1
            });
            let [value, std] = &mut numbers[at];
            (value[k], std[k]) = estimate.value_std.unzip();
        }
    }
    let named = keys.into_iter().zip(numbers);
    let pair = |(key, [value, std]): (&str, [Vec<Option<f64>>; 2])| {
        [(key.to_owned(), Values::Number(value)), (std_of(key), Values::Number(std))]
    };
    named.flat_map(pair).collect()
}
