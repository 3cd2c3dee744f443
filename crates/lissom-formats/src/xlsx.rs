//! Excel workbooks (`.xlsx`, `.xlsm`): the sheet with the longest block of numbers, read as a table of text. If others have
//! the same columns, all of these are read, as `sheet/column`.
//!
//! Dates are seconds from the first one, blank cells and errors are NaN.

use std::collections::HashSet;
use std::fmt::Write as _;
use std::io::Cursor;

use calamine::{Cell, DataRef, DataType, ExcelDateTime, Reader, Xlsx};

use crate::channel_ref::Wanted;
use crate::collected::{Collected, drop_unwanted};
use crate::format::Format;
use crate::format_error::FormatError;
use crate::guard::guarded;
use crate::log_data::{Channel, Clock, LogData};
use crate::source::Source;
use crate::text::find_in_tabs;
use crate::zip::Entry;

/// Whether an archive is a workbook.
pub(crate) fn is_workbook(entries: &[Entry]) -> bool {
    entries.iter().any(|entry| entry.name == "xl/workbook.xml")
}

/// Reads a workbook.
pub(crate) fn read(
    source: &Source,
    entries: &[Entry],
    wanted: Wanted,
) -> Result<LogData, FormatError> {
    let mut found = Collected::of(wanted);
    for entry in entries {
        // The library does not limit the size of an entry: one that expands to more than is stated is an error here.
        found.take_bytes(entry.expanded_bytes())?;
        entry.content(source)?.finish()?;
    }
    let bytes = source.all()?;
    let mut data = guarded(Format::Xlsx, || of_sheets(&bytes, &mut found))?;
    drop_unwanted(&mut data.channels, wanted);
    Ok(data)
}

#[expect(clippy::needless_pass_by_value, reason = "for map_err")]
fn damaged(error: calamine::XlsxError) -> FormatError {
    FormatError::content("Excel workbook", error.to_string())
}

fn of_sheets(bytes: &[u8], found: &mut Collected) -> Result<LogData, FormatError> {
    let mut workbook = Xlsx::new(Cursor::new(bytes)).map_err(damaged)?;
    let mut tables: Vec<(usize, String, Result<LogData, FormatError>)> = Vec::new();
    let mut others = Vec::new();
    for name in workbook.sheet_names() {
        // Sheets of charts have no cells.
        let Some(sheet) = sheet(&mut workbook, &name, found)? else { continue };
        match find_in_tabs(&sheet.text).map_or(0, |table| table.end - table.first) {
            _ if sheet.text.is_empty() => {}
            0 => others.push(name),
            rows => tables.push((rows, name, sheet.read())),
        }
    }
    let longest = tables.iter().enumerate().rev().max_by_key(|(_, (rows, ..))| *rows);
    let longest = longest.map(|(k, _)| k).ok_or(FormatError::NoTable)?;
    let names = |found: &Result<LogData, FormatError>| -> Option<Vec<String>> {
        let names = found.as_ref().ok()?.channels.iter().map(|c| c.name.clone());
        Some(names.collect())
    };
    let of_longest = names(&tables[longest].2);
    // Sheets with the same columns are probably runs.
    let (alike, rest): (Vec<_>, Vec<_>) = tables
        .into_iter()
        .enumerate()
        .partition(|(k, (.., found))| *k == longest || names(found) == of_longest);
    others.extend(rest.into_iter().map(|(_, (_, name, _))| name));
    let mut all: Option<LogData> = None;
    let several = alike.len() > 1;
    for (_, (_, sheet, found)) in alike {
        let found = found?;
        if !several {
            let mut found = found;
            if !others.is_empty() {
                found.notes.push(format!(
                    "sheet {sheet} is read, with the longest block of numbers, and not {}",
                    others.join(", ")
                ));
            }
            return Ok(found);
        }
        let all = all.get_or_insert_with(|| LogData { channels: Vec::new(), ..found.clone() });
        append(&mut all.channels, &sheet, found.channels);
    }
    let mut all = all.ok_or(FormatError::NoTable)?;
    if !others.is_empty() {
        all.notes.push(format!("sheets that are left out: {}", others.join(", ")));
    }
    Ok(all)
}

/// Appends the channels of a sheet, with its name before theirs.
fn append(channels: &mut Vec<Channel>, sheet: &str, of_sheet: Vec<Channel>) {
    let before = channels.len();
    channels.extend(of_sheet.into_iter().map(|channel| Channel {
        name: format!("{sheet}/{}", channel.name),
        clock: match channel.clock {
            Clock::Channel(k) => Clock::Channel(before + k),
            clock => clock,
        },
        ..channel
    }));
}

/// The text with blank cells at the ends of rows, so that a header may lack the last names.
fn padded(text: &str, width: usize) -> String {
    let mut padded = String::with_capacity(text.len());
    for line in text.lines() {
        padded.push_str(line);
        let cells = line.matches('\t').count() + 1;
        if !line.is_empty() && 2 * cells >= width {
            padded.extend((cells..width).map(|_| '\t'));
        }
        padded.push('\n');
    }
    padded
}

/// A sheet as text.
struct Sheet {
    name: String,
    /// A line for each row, and a tab between two cells.
    text: String,
    /// The columns with dates, which have a resolution of a microsecond.
    dates: HashSet<usize>,
}

impl Sheet {
    /// Its channels.
    fn read(&self) -> Result<LogData, FormatError> {
        let text = padded(&self.text, find_in_tabs(&self.text).map_or(0, |table| table.width));
        let table = find_in_tabs(&text).ok_or(FormatError::NoTable)?;
        let mut data = table.read(None, Wanted::ALL, None).map_err(|error| match error {
            FormatError::Content { place, reason } => {
                FormatError::content(format!("sheet {}, {place}", self.name), reason)
            }
            other => other,
        })?;
        if data.format == Format::Text {
            data.format = Format::Xlsx;
            let columns = data.channels.iter_mut().enumerate();
            for (_, channel) in columns.filter(|(column, _)| self.dates.contains(column)) {
                round_dates(&mut channel.values);
            }
        }
        Ok(data)
    }
}

/// The cells of a sheet; `None` if it has none.
fn sheet(
    workbook: &mut Xlsx<Cursor<&[u8]>>,
    name: &str,
    found: &mut Collected,
) -> Result<Option<Sheet>, FormatError> {
    let mut cells = match workbook.worksheet_cells_reader(name) {
        Ok(cells) => cells,
        Err(calamine::XlsxError::NotAWorksheet(_)) => return Ok(None),
        Err(error) => return Err(damaged(error)),
    };
    let (mut text, mut row, mut column) = (String::new(), 0, 0);
    let mut dates = HashSet::new();
    while let Some(cell) = cells.next_cell().map_err(damaged)? {
        let (at_row, at_column) = cell.get_position();
        if cell.get_value().is_empty() || at_row < row || (at_row == row && at_column < column) {
            continue;
        }
        let before = text.len();
        if at_row > row {
            text.extend((row..at_row).map(|_| '\n'));
            (row, column) = (at_row, 0);
        }
        text.extend((column..at_column).map(|_| '\t'));
        column = at_column;
        if matches!(cell.get_value(), DataRef::DateTime(_)) {
            dates.insert(at_column as usize);
        }
        write_cell(&mut text, &cell);
        found.take_bytes(text.len() - before)?;
    }
    if !text.is_empty() {
        text.push('\n');
    }
    Ok(Some(Sheet { name: name.to_owned(), text, dates }))
}

fn write_cell(text: &mut String, cell: &Cell<DataRef>) {
    // Writing to a text does not fail.
    let _ = match cell.get_value() {
        DataRef::Int(value) => write!(text, "{value}"),
        DataRef::Float(value) => write!(text, "{value:e}"),
        DataRef::Bool(value) => write!(text, "{}", u8::from(*value)),
        DataRef::DateTime(value) => write_date(text, *value),
        DataRef::Error(_) => write!(text, "NA"),
        DataRef::SharedString(words) => write!(text, "{}", plain(words)),
        DataRef::String(words) | DataRef::DateTimeIso(words) | DataRef::DurationIso(words) => {
            write!(text, "{}", plain(words))
        }
        DataRef::Empty => Ok(()),
    };
}

/// Rounds dates in seconds to the resolution of a workbook, or to the coarser one in which all are written.
fn round_dates(values: &mut [f64]) {
    /// Steps in a second.
    const RESOLUTIONS: [f64; 3] = [1e3, 1e4, 1e6];
    /// Numbers of days have 53 bits: two dates of this century differ by no less than 0.6 µs.
    const ROUNDING_S: f64 = 1.5e-6;
    let rounded = |value: f64, steps: f64| (value * steps).round() / steps;
    let fits = |steps: &f64| {
        let near = |value: &f64| (value - rounded(*value, *steps)).abs() < ROUNDING_S;
        values.iter().filter(|value| value.is_finite()).all(near)
    };
    if let Some(steps) = RESOLUTIONS.into_iter().find(fits) {
        for value in values {
            *value = rounded(*value, steps);
        }
    }
}

/// Words without the characters that separate cells and lines.
fn plain(words: &str) -> String {
    let separates = |c: char| c.is_control() || c == '"';
    words.chars().map(|c| if separates(c) { ' ' } else { c }).collect()
}

/// Writes a date, or a time of day or a duration as `h:m:s`.
fn write_date(text: &mut String, date: ExcelDateTime) -> std::fmt::Result {
    const MICROSECONDS_PER_DAY: f64 = 86_400e6;
    let days = date.as_f64();
    let of_day = (days.rem_euclid(1.0) * MICROSECONDS_PER_DAY).round() as u64;
    let (mut day, mut of_day) = (days.floor(), of_day);
    if of_day >= MICROSECONDS_PER_DAY as u64 {
        (day, of_day) = (day + 1.0, 0);
    }
    let (seconds, microseconds) = (of_day / 1_000_000, of_day % 1_000_000);
    let (mut hours, minutes, seconds) = (seconds / 3600, seconds / 60 % 60, seconds % 60);
    if date.is_duration() || day < 1.0 {
        hours += 24 * day.max(0.0) as u64;
        return write!(text, "{hours}:{minutes:02}:{seconds:02}.{microseconds:06}");
    }
    let (year, month, day_of_month, ..) =
        ExcelDateTime::new(day, calamine::ExcelDateTimeType::DateTime, false).to_ymd_hms_milli();
    write!(text, "{year:04}-{month:02}-{day_of_month:02} ")?;
    write!(text, "{hours:02}:{minutes:02}:{seconds:02}.{microseconds:06}")
}
