//! Logs that are not plain text with a header: read by `lissom_formats`, and brought onto one clock.

use std::borrow::Cow;
use std::path::Path;

use lissom_core::record::Hold;
use lissom_formats::{Clock, Format, FormatError, LogData, bare_name};

use super::groups::groups;
use super::log_body::Body;
use super::log_columns::{ColumnRef, Log, LogColumn, LogOptions};
use super::log_error::LogError;
use super::one_clock::{Series, on_one_clock};
use crate::nearest::nearest;

/// Rows in which a cell is missing are left out up to this share of all; with more a channel has stamps of its own.
const MISSING_MOST: f64 = 0.02;

/// Reads a log that the reader of plain text could not read, with the error `first` if it tried. That error is returned
/// if the file is plain text after all.
pub(super) fn read(
    path: &Path,
    time: Option<&ColumnRef>,
    columns: &[LogColumn],
    options: &LogOptions,
    first: Option<LogError>,
) -> Result<Log, LogError> {
    let file = path.display().to_string();
    let wanted: Vec<ColumnRef> =
        time.into_iter().chain(columns.iter().map(|c| &c.column)).cloned().collect();
    let read = lissom_formats::read_channels(path, &options.of_text(), &wanted);
    let (data, first) = match (read, first) {
        (Ok(data), first) => (data.with_time_stamps(), first),
        // What is wrong with the text is known better from its first reading.
        (
            Err(FormatError::NoTable | FormatError::NotText { .. } | FormatError::Content { .. }),
            Some(first),
        ) => return Err(first),
        (Err(source), _) => return Err(LogError::of_format(file, source)),
    };
    of_data(&file, &data, time, columns, options, first)
}

/// Reads a log with a row for each signal; `None` if it is another one.
pub(super) fn by_row(
    path: &Path,
    time: Option<&ColumnRef>,
    columns: &[LogColumn],
    options: &LogOptions,
) -> Option<Log> {
    let file = path.display().to_string();
    let data = lissom_formats::read(path).ok().filter(|d| d.format == Format::TextByRow)?;
    of_data(&file, &data, time, columns, options, None).ok()
}

/// The columns asked for. `first` is the error of a reader that tried before; of plain text it is the error.
pub(super) fn of_data(
    file: &str,
    data: &LogData,
    time: Option<&ColumnRef>,
    columns: &[LogColumn],
    options: &LogOptions,
    first: Option<LogError>,
) -> Result<Log, LogError> {
    let first = first.filter(|_| matches!(data.format, Format::Text));
    let wanted: Vec<&ColumnRef> =
        time.into_iter().chain(columns.iter().map(|c| &c.column)).collect();
    let places =
        wanted.iter().map(|column| place(file, column, data)).collect::<Result<Vec<_>, _>>();
    let places = match places {
        Ok(places) => places,
        // Of two headers without the column, that of the table below a preamble is the right one.
        Err(error @ LogError::NoColumn { .. })
            if matches!(first, Some(LogError::NoColumn { .. })) =>
        {
            return Err(error);
        }
        Err(error) => return Err(first.unwrap_or(error)),
    };
    for (place, column) in places.iter().zip(&wanted) {
        if let Some((row, found)) = &data.channels[*place].not_a_number {
            let (file, row, column) = (file.to_owned(), *row, column.to_string());
            return Err(LogError::NotANumber { file, row, column, found: found.clone() });
        }
        // A missing value is NaN; an infinite one is no value.
        if let Some(index) = data.channels[*place].values.iter().position(|v| v.is_infinite()) {
            let found = data.channels[*place].values[index].to_string();
            let (file, column) = (file.to_owned(), column.to_string());
            let error = LogError::NotFinite { file, row: index + 1, column, found };
            return Err(first.unwrap_or(error));
        }
    }
    let holds: Vec<Hold> = columns.iter().map(|c| c.hold).collect();
    let (stamps, signals) = places.split_at(usize::from(time.is_some()));
    let Some(rows) = rows(data, stamps.first().copied(), signals, &holds) else {
        return Err(first.unwrap_or_else(|| LogError::NoCommonTime { file: file.to_owned() }));
    };
    let labels = wanted.iter().map(ToString::to_string).collect();
    let holds = time.map(|_| Hold::Measured).into_iter().chain(holds).collect();
    let columns: Vec<&[f64]> = rows.iter().map(|column| &column[..]).collect();
    Body::of_columns(file, labels, time.is_some(), holds, options, &columns)
}

/// The index of the channel asked for: by its name, by the end of its path, or by its number.
pub(super) fn place(file: &str, wanted: &ColumnRef, data: &LogData) -> Result<usize, LogError> {
    let file = || file.to_owned();
    let name = match wanted {
        ColumnRef::Number(number) if (1..=data.channels.len()).contains(number) => {
            return Ok(number - 1);
        }
        ColumnRef::Number(number) => {
            let columns = data.channels.len();
            return Err(LogError::ColumnNumber { file: file(), number: *number, columns });
        }
        ColumnRef::Name(name) => bare_name(name),
    };
    let of = |is: &dyn Fn(&str) -> bool| {
        let channels = data.channels.iter().enumerate();
        channels.filter(|(_, c)| is(bare_name(&c.name))).map(|(k, _)| k).collect::<Vec<_>>()
    };
    let mut found = of(&|channel| channel == name);
    if found.is_empty() {
        found = of(&|channel| channel.rsplit('/').next() == Some(name));
    }
    let names = || data.channels.iter().map(|c| c.name.clone()).collect::<Vec<_>>();
    match found[..] {
        [index] => Ok(index),
        [] => {
            let nearest = nearest(name, data.channels.iter().map(|c| c.name.as_str()));
            Err(LogError::NoColumn {
                file: file(),
                column: name.to_owned(),
                names: names(),
                nearest,
            })
        }
        _ => {
            let numbers = found.iter().map(|index| index + 1).collect();
            let column = name.to_owned();
            Err(LogError::Ambiguous { file: file(), column, numbers, groups: groups(data) })
        }
    }
}

/// The columns with the same rows, time first if it is asked for; `None` if they cannot be brought onto one clock.
fn rows<'a>(
    data: &'a LogData,
    time: Option<usize>,
    places: &[usize],
    holds: &[Hold],
) -> Option<Vec<Cow<'a, [f64]>>> {
    let values = |k: usize| &data.channels[k].values[..];
    let borrowed = |columns: Vec<&'a [f64]>| columns.into_iter().map(Cow::Borrowed).collect();
    let Some(time) = time else {
        return leading_cut(places.iter().map(|k| values(*k)).collect()).map(borrowed);
    };
    let stamps = |k: usize| -> Option<&'a [f64]> {
        match data.channels[k].clock {
            Clock::Channel(k) => Some(values(k)),
            Clock::Unstated => Some(values(time)),
            Clock::Even { .. } => None,
        }
        .filter(|stamps| stamps.len() == values(k).len())
    };
    let series: Vec<(&[f64], &[f64])> =
        places.iter().map(|k| Some((stamps(*k)?, values(*k)))).collect::<Option<_>>()?;
    let first = series.first()?.0;
    if series.iter().all(|(stamps, _)| std::ptr::eq(*stamps, first) || *stamps == first) {
        let all = std::iter::once(first).chain(series.iter().map(|(_, values)| *values));
        let all: Vec<&[f64]> = all.collect();
        if let Some(rows) = leading_cut(all.clone()) {
            return Some(borrowed(rows));
        }
        if let Some(rows) = without_gaps(&all) {
            return Some(rows.into_iter().map(Cow::Owned).collect());
        }
    }
    let series: Vec<Series> =
        series.into_iter().zip(holds).map(|((t, v), hold)| Series::of(t, v, *hold)).collect();
    on_one_clock(&series).map(|columns| columns.into_iter().map(Cow::Owned).collect())
}

/// Cuts the leading rows in which a value is missing; `None` if values are missing later.
fn leading_cut(columns: Vec<&[f64]>) -> Option<Vec<&[f64]>> {
    let rows = columns.first()?.len();
    if columns.iter().any(|c| c.len() != rows) {
        return None;
    }
    let missing = |column: &&[f64]| column.iter().take_while(|v| v.is_nan()).count();
    let first = columns.iter().map(missing).max()?;
    let cut: Vec<&[f64]> = columns.into_iter().map(|c| &c[first..]).collect();
    cut.iter().all(|column| column.iter().all(|v| v.is_finite())).then_some(cut)
}

/// Without the rows in which a value is missing, if these are few: then they are gaps in time, as rows that were not logged
/// are.
fn without_gaps(columns: &[&[f64]]) -> Option<Vec<Vec<f64>>> {
    let rows = columns.first()?.len();
    let kept: Vec<usize> =
        (0..rows).filter(|row| columns.iter().all(|column| !column[*row].is_nan())).collect();
    let few = rows as f64 * MISSING_MOST;
    let kept_of = |column: &&[f64]| kept.iter().map(|row| column[*row]).collect();
    let are_numbers = columns.iter().all(|column| !column.iter().any(|value| value.is_infinite()));
    ((rows - kept.len()) as f64 <= few && are_numbers)
        .then(|| columns.iter().map(kept_of).collect())
}
