//! Universal files (`.uff`, `.unv`): the time responses in datasets 58 and 58b.
//!
//! A channel is named after its response: entity, node and direction as in `arm/5+Z`; otherwise after the label of its axis
//! or the first line of the dataset.

mod fortran_number;
mod header;
mod values;

use std::collections::HashMap;

use header::{Header, Lines};

use crate::collected::{Collected, LeftOut};
use crate::format::Format;
use crate::format_error::FormatError;
use crate::log_data::{Channel, Clock, LogData};

/// The line that begins and ends a dataset.
const MARK: &[u8] = b"-1";
/// Columns of the number of a dataset.
const NUMBER_COLUMNS: usize = 6;

const SPECTRA: LeftOut = LeftOut {
    what: "frequency responses, spectra and other functions that are no time responses",
    way_out: "export the time responses",
};
const COMPLEX: LeftOut =
    LeftOut { what: "complex numbers", way_out: "export the time responses as real numbers" };

/// Whether a file begins with a dataset.
pub(crate) fn begins(bytes: &[u8]) -> bool {
    let mut lines = Lines::new(bytes);
    let is_mark = lines.next().is_some_and(|line| line.starts_with(b"    -1") && is_mark(line));
    is_mark && lines.next().and_then(dataset).is_some()
}

fn is_mark(line: &[u8]) -> bool {
    line.trim_ascii() == MARK
}

/// Number of a dataset, and whether it is binary, from its first line.
fn dataset(line: &[u8]) -> Option<(u32, bool)> {
    let (number, rest) = line.split_at_checked(NUMBER_COLUMNS.min(line.len()))?;
    let number = std::str::from_utf8(number.trim_ascii()).ok()?.parse().ok()?;
    Some((number, matches!(rest.first(), Some(b'b' | b'B'))))
}

/// Reads a file.
pub(crate) fn read(bytes: &[u8]) -> Result<LogData, FormatError> {
    let mut found = Collected::new();
    let mut names = HashMap::new();
    let mut lines = Lines::new(bytes);
    while let Some(line) = lines.next() {
        if !is_mark(line) {
            continue;
        }
        // Of two marks the first one ended a dataset whose header is damaged.
        let mut first = lines.next();
        while first.is_some_and(is_mark) {
            first = lines.next();
        }
        let Some(first) = first else { break };
        match dataset(first) {
            Some((58, is_binary)) => {
                function(&mut lines, first, is_binary, &mut names, &mut found)?;
            }
            // Other datasets are no functions.
            _ => while lines.next().is_some_and(|line| !is_mark(line)) {},
        }
    }
    found.finish(Format::Uff58)
}

/// Appends the channels of a dataset, and reads on to its end.
fn function(
    lines: &mut Lines,
    first: &[u8],
    is_binary: bool,
    names: &mut HashMap<String, usize>,
    found: &mut Collected,
) -> Result<(), FormatError> {
    let row = lines.row();
    let Some(header) = Header::of(lines) else {
        found.note(format!("the header of the dataset in row {row} is damaged: left out"));
        return Ok(());
    };
    let name = unique(header.name(), names);
    let values = if is_binary {
        Some(values::binary(lines, values::is_big_endian(first), &header, found)?)
    } else {
        values::text(lines, &header, &name, found)?
    };
    if !header.is_time_response() {
        found.leave_out(&name, &SPECTRA);
    } else if header.is_complex() {
        found.leave_out(&name, &COMPLEX);
    } else if let Some(values) = values {
        collect(name, values, &header, found);
    }
    Ok(())
}

/// The name, with a number if it was used before.
fn unique(name: String, names: &mut HashMap<String, usize>) -> String {
    let count = names.entry(name.clone()).or_insert(0);
    *count += 1;
    if *count == 1 { name } else { format!("{name}[{count}]") }
}

fn collect(name: String, mut values: Vec<f64>, header: &Header, found: &mut Collected) {
    let wanted = header.points.saturating_mul(header.numbers_of_point());
    if values.len() < wanted {
        let (has, points) = (values.len() / header.numbers_of_point(), header.points);
        found.note(format!("{name}: the dataset ends after {has} of {points} samples"));
    }
    values.truncate(wanted);
    let mut clock = match header.step_s() {
        Some(step_s) => Clock::Even { start_s: header.start_s(), step_s },
        None => Clock::Unstated,
    };
    if !header.is_even {
        let times = values.iter().step_by(2).copied().take(values.len() / 2).collect();
        values = values.into_iter().skip(1).step_by(2).collect();
        clock = Clock::Channel(found.channels.len());
        let mut time = Channel::of(format!("{name}/time"), times);
        time.unit = Some(header.time_unit.clone().unwrap_or_else(|| "s".to_owned()));
        found.channels.push(time);
    }
    if values.is_empty() {
        if !header.is_even {
            found.channels.pop();
        }
        return;
    }
    let mut channel = Channel::of(name, values);
    channel.unit.clone_from(&header.unit);
    channel.clock = clock;
    found.channels.push(channel);
}
