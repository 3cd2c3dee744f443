//! Universal files (`.uff`, `.unv`): time responses and functions of the frequency in datasets 58 and 58b.
//!
//! Of a frequency response, `NAME/real` and `NAME/imag` are channels, with the channel `frequency` for all functions with
//! the same frequencies.
//!
//! A channel is named after its response: entity, node and direction as in `arm/5+Z`; otherwise after the label of its axis
//! or the first line of the dataset.

mod fortran_number;
mod frequency;
mod header;
mod values;

use std::collections::HashMap;

use frequency::Frequencies;
use header::{Header, Lines};

use crate::channel_ref::Wanted;
use crate::collected::{Collected, LeftOut};
use crate::format::Format;
use crate::format_error::FormatError;
use crate::log_data::{Channel, Clock, LogData};
use crate::source::Source;

/// The line that begins and ends a dataset.
const MARK: &[u8] = b"-1";
/// Columns of the number of a dataset.
const NUMBER_COLUMNS: usize = 6;

const OTHERS: LeftOut = LeftOut {
    what: "functions of neither time nor frequency",
    way_out: "export time responses or frequency responses",
};
const COMPLEX: LeftOut =
    LeftOut { what: "complex numbers", way_out: "export the time responses as real numbers" };

/// Whether a file begins with a dataset; some programs write its first mark twice.
pub(crate) fn begins(bytes: &[u8]) -> bool {
    let mut lines = Lines::new(bytes);
    let is_marked = lines.next().is_some_and(|line| line.starts_with(b"    -1") && is_mark(line));
    is_marked && after_marks(&mut lines).and_then(dataset).is_some()
}

/// The next line that is no mark.
fn after_marks<'a>(lines: &mut Lines<'a>) -> Option<&'a [u8]> {
    let mut line = lines.next();
    while line.is_some_and(is_mark) {
        line = lines.next();
    }
    line
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
pub(crate) fn read(source: &Source, wanted: Wanted) -> Result<LogData, FormatError> {
    // The lines of a text are short, and the file is in memory.
    let bytes = source.all()?;
    let mut found = Collected::of(wanted);
    let mut names = HashMap::new();
    let mut frequencies = Frequencies::default();
    let mut lines = Lines::new(&bytes);
    while let Some(line) = lines.next() {
        if !is_mark(line) {
            continue;
        }
        // Of two marks the first one ended a dataset whose header is damaged.
        let Some(first) = after_marks(&mut lines) else { break };
        match dataset(first) {
            Some((58, is_binary)) => {
                function(&mut lines, first, is_binary, &mut names, &mut frequencies, &mut found)?;
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
    frequencies: &mut Frequencies,
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
    if header.is_time_response() && header.is_complex() {
        found.leave_out(&name, &COMPLEX);
    } else if !header.is_time_response() && !header.is_of_frequency() {
        found.leave_out(&name, &OTHERS);
    } else if let Some(mut values) = values {
        cut(&name, &mut values, &header, found);
        if header.is_time_response() {
            collect(name, values, &header, found);
        } else {
            frequencies.collect(&name, &values, &header, found);
        }
    }
    Ok(())
}

/// The name, with a number if it was used before.
fn unique(name: String, names: &mut HashMap<String, usize>) -> String {
    let count = names.entry(name.clone()).or_insert(0);
    *count += 1;
    if *count == 1 { name } else { format!("{name}[{count}]") }
}

/// Cuts values behind the stated number of points, and notes if there are fewer.
fn cut(name: &str, values: &mut Vec<f64>, header: &Header, found: &mut Collected) {
    let wanted = header.points.saturating_mul(header.numbers_of_point());
    if values.len() < wanted {
        let (has, points) = (values.len() / header.numbers_of_point(), header.points);
        found.note(format!("{name}: the dataset ends after {has} of {points} samples"));
    }
    values.truncate(wanted);
}

fn collect(name: String, mut values: Vec<f64>, header: &Header, found: &mut Collected) {
    let mut clock = match header.step_s() {
        Some(step_s) => Clock::Even { start_s: header.start_s(), step_s },
        None => Clock::Unstated,
    };
    if !header.is_even {
        let times = values.iter().step_by(2).copied().take(values.len() / 2).collect();
        values = values.into_iter().skip(1).step_by(2).collect();
        clock = Clock::Channel(found.channels.len());
        let mut time = Channel::of(format!("{name}/time"), times);
        time.unit = Some(header.abscissa_unit.clone().unwrap_or_else(|| "s".to_owned()));
        found.channels.push(time);
    }
    if values.is_empty() {
        if !header.is_even {
            found.channels.pop();
        }
        return;
    }
    let mut channel = Channel::of(name, values);
    channel.unit = header.unit();
    channel.clock = clock;
    found.channels.push(channel);
}
