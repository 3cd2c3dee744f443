//! Long tables: each row has a time, the name of a signal and one value.

use std::collections::HashMap;

use super::cells::{Decimal, Separator};
use super::column::{self, Column};
use super::lines::is_skipped;
use crate::collected::{Collected, LeftOut};
use crate::format::Format;
use crate::format_error::FormatError;
use crate::log_data::LogData;
use crate::read_options::ReadOptions;
use crate::unit;

/// Names of the three columns, in small letters.
const TIMES: [&str; 4] = ["timestamp", "time", "t", "stamp"];
/// See [`TIMES`].
const NAMES: [&str; 9] =
    ["key", "name", "signal", "topic", "channel", "variable", "entry", "id", "parameter"];
/// See [`TIMES`].
const VALUES: [&str; 3] = ["value", "data", "val"];

/// The header that AdvantageScope writes; its times are in seconds.
const ADVANTAGE_SCOPE: &str = "Timestamp,Key,Value";

const WORDS: LeftOut =
    LeftOut { what: "signals with values that are no numbers", way_out: "export them as numbers" };

/// The places of the columns.
struct Places {
    separator: Separator,
    time: usize,
    name: usize,
    value: usize,
}

impl Places {
    /// The places in a header; `None` if it is none of a long table.
    fn of(header: &str) -> Option<Self> {
        Separator::ALL.into_iter().find_map(|separator| {
            let cells: Vec<String> = separator.cells(header).map(str::to_lowercase).collect();
            let is_of = |cell: &str, names: &[&str]| {
                cell.split(['(', '[']).next().is_some_and(|c| names.contains(&c.trim_end()))
            };
            let place = |names: &[&str]| cells.iter().position(|cell| is_of(cell, names));
            let (time, name, value) = (place(&TIMES)?, place(&NAMES)?, place(&VALUES)?);
            (cells.len() == 3).then_some(Self { separator, time, name, value })
        })
    }
}

/// Reads a text if it is such a table.
pub(crate) fn read(text: &str, options: &ReadOptions) -> Option<Result<LogData, FormatError>> {
    let mut lines = (1..).zip(text.lines()).filter(|(_, line)| !is_skipped(line));
    let header = lines.next()?.1;
    let places = Places::of(header)?;
    let unit = match header.trim() {
        ADVANTAGE_SCOPE => Some("s".to_owned()),
        _ => places.separator.cells(header).nth(places.time).and_then(unit::in_name),
    };
    let rows: Vec<(usize, [&str; 3])> = lines
        .filter_map(|(row, line)| {
            let cells: Vec<&str> = places.separator.cells(line).collect();
            Some((
                row,
                [*cells.get(places.time)?, cells.get(places.name)?, cells.get(places.value)?],
            ))
        })
        .collect();
    let decimal = decimal(
        places.separator,
        &rows.iter().map(|(_, [_, _, value])| *value),
        options.decimal_comma,
    );
    let mut times = Column::new(rows.len());
    for (row, [time, ..]) in &rows {
        times.take(time, decimal, *row);
    }
    let mut order = Vec::new();
    let mut signals: HashMap<&str, [Column; 2]> = HashMap::new();
    for ((row, [_, name, value]), time) in rows.iter().zip(times.values()) {
        let [stamps, values] = signals.entry(name).or_insert_with(|| {
            order.push(*name);
            [Column::new(0), Column::new(0)]
        });
        stamps.push(*time);
        values.take(value, decimal, *row);
    }
    let mut found = Collected::new();
    for name in order {
        let Some([stamps, values]) = signals.remove(name) else { continue };
        if values.values().iter().all(|value| value.is_nan()) {
            found.leave_out(name, &WORDS);
        } else {
            column::push_timed(name, (stamps, unit.as_deref()), values, &mut found.channels);
        }
    }
    let found = found.finish(Format::TextByValue);
    Some(found.map(|found| LogData { decimal_comma: decimal == Decimal::Comma, ..found }))
}

/// How these cells write decimals: the first way in which most of them are numbers, with a decimal comma or without one if
/// that is stated.
fn decimal<'a>(
    separator: Separator,
    cells: &(impl Iterator<Item = &'a str> + Clone),
    comma: Option<bool>,
) -> Decimal {
    let numbers = |decimal: Decimal| cells.clone().filter(|c| decimal.number(c).is_some()).count();
    let mut best = if comma == Some(true) { Decimal::Comma } else { Decimal::Point };
    for other in separator.decimals() {
        let is_stated = comma.is_none_or(|comma| comma == (other == Decimal::Comma));
        if is_stated && numbers(other) > numbers(best) {
            best = other;
        }
    }
    best
}
