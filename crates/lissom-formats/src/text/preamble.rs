//! What the lines above a table state about its columns: units, and the time between two rows.

use super::cells::{Decimal, Separator};
use super::header::Header;
use crate::log_data::{Channel, Clock};
use crate::unit;

/// First cells of a row of units.
const UNITS: [&str; 6] = ["y_unit_label", "vertical units", "vunit", "unit", "units", "einheit"];
/// Names of the time between two rows.
const STEP: [&str; 8] = [
    "sample interval",
    "sampling interval",
    "delta_x",
    "increment",
    "xincrement",
    "x increment",
    "tinc",
    "hresolution",
];
/// Names of the time of the first row.
const START: [&str; 5] = ["x0", "t0", "start", "xorigin", "x origin"];
/// Columns of time that may have no unit.
const TIMES: [&str; 5] = ["t", "time", "timestamp", "x_value", "zeit"];

/// What the lines above a table state.
#[derive(Debug, Default)]
pub(super) struct Preamble {
    /// Units of columns.
    units: Vec<(usize, String)>,
    start_s: Option<f64>,
    step_s: Option<f64>,
    /// Whether the rows are at other places than times.
    is_no_time: bool,
}

impl Preamble {
    pub(super) fn of(lines: &[&str], separator: Separator, decimal: Decimal) -> Self {
        let rows: Vec<Vec<&str>> =
            lines.iter().map(|line| separator.cells(line).collect()).collect();
        let mut found = Self::default();
        for (k, row) in rows.iter().enumerate() {
            found.take_units(row);
            let first = row.first().zip(row.iter().skip(1).find(|cell| !cell.is_empty()));
            let below = row.iter().zip(rows.get(k + 1).into_iter().flatten());
            let equal = row.iter().filter_map(|cell| cell.split_once('='));
            let pairs = first.into_iter().chain(below).map(|(key, value)| (*key, *value));
            for (key, value) in pairs.chain(equal) {
                let key = key.trim().trim_end_matches(':').to_lowercase();
                let place = if STEP.contains(&key.as_str()) {
                    &mut found.step_s
                } else if START.contains(&key.as_str()) {
                    &mut found.start_s
                } else {
                    continue;
                };
                *place = place.or_else(|| seconds(value.trim(), decimal));
            }
        }
        found
    }

    fn take_units(&mut self, row: &[&str]) {
        let Some((key, cells)) = row.split_first() else { return };
        let key = key.to_lowercase();
        let mut take = |column, unit: &str| {
            if unit::is_unit(unit) {
                self.units.push((column, unit::bare(unit).to_owned()));
            }
        };
        match (key.as_str(), cells.first()) {
            ("horizontal units" | "hunit", Some(unit)) => take(0, unit),
            ("x_dimension", Some(&"Time")) => take(0, "s"),
            ("x_dimension", Some(_)) => self.is_no_time = true,
            (key, _) if UNITS.contains(&key) => {
                // A unit may have the name of its channel before it: `CH1:V`.
                let unit = |cell: &&str| cell.rsplit(':').next().map(str::to_owned);
                for (column, unit) in (1..).zip(cells.iter().filter_map(unit)) {
                    take(column, &unit);
                }
            }
            _ => {}
        }
    }

    /// Gives the columns their units where the header has none.
    pub(super) fn complete(&self, header: &mut Header, width: usize) {
        header.units.resize(width, None);
        for (column, unit) in &self.units {
            if let Some(none @ None) = header.units.get_mut(*column) {
                *none = Some(unit.clone());
            }
        }
    }

    /// Gives the channels their clock if none is the time.
    pub(super) fn set_clock(&self, channels: &mut [Channel]) {
        let Some(step_s) = self.step_s.filter(|step_s| *step_s > 0.0 && step_s.is_finite()) else {
            return;
        };
        let is_time = |channel: &Channel| {
            let named = TIMES.contains(&channel.name.to_lowercase().as_str());
            (named || channel.unit.as_deref().is_some_and(unit::is_time))
                && channel.values.iter().any(|value| value.is_finite())
        };
        if self.is_no_time || channels.iter().any(is_time) {
            return;
        }
        let start_s = self.start_s.filter(|start_s| start_s.is_finite()).unwrap_or(0.0);
        for channel in channels {
            channel.clock = Clock::Even { start_s, step_s };
        }
    }
}

/// A time with or without a unit behind it.
fn seconds(text: &str, decimal: Decimal) -> Option<f64> {
    let number = text.trim_end_matches(|c: char| c.is_alphabetic());
    let scale = match text.get(number.len()..)? {
        "" | "s" | "S" => 1.0,
        "ms" => 1e-3,
        "us" | "µs" => 1e-6,
        "ns" => 1e-9,
        _ => return None,
    };
    decimal.number(number.trim()).map(|value| value * scale)
}
