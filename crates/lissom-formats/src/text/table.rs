//! The table of numbers in a text: the first long block of rows with the same number of cells.

use super::cells::{Cell, Separator};
use super::header::Header;
use crate::format::Format;
use crate::format_error::FormatError;
use crate::log_data::{Channel, LogData};

/// A block of so many rows is a table; a shorter one only if there is no other.
const LONG: usize = 8;
/// Rows at the beginning of a block whose longest gives its width.
const FIRST_ROWS: usize = 100;
/// A table with at most so many rows, …
const FEW_ROWS: usize = 20;
/// … and at least so many columns has one row for each signal.
const MANY_COLUMNS: usize = 50;
/// Lines after the table that may contain something else.
const LAST_LINES: usize = 3;

/// A table in a text.
pub(crate) struct Table<'a> {
    pub(crate) lines: Vec<&'a str>,
    pub(crate) separator: Separator,
    pub(crate) decimal_comma: bool,
    /// First line of numbers, from 0.
    pub(crate) first: usize,
    /// One line after the last one of the block.
    pub(crate) end: usize,
    pub(crate) width: usize,
    ends_in_a_row: bool,
}

/// Finds the table.
pub(crate) fn find(text: &str) -> Option<Table<'_>> {
    let separators = Separator::ALL.into_iter().flat_map(|s| [(s, false), (s, true)]);
    find_separated(text, separators.filter(|found| *found != (Separator::Char(','), true)))
}

/// Finds the table in a text whose cells are separated by tabs.
#[cfg(feature = "xlsx")]
pub(crate) fn find_in_tabs(text: &str) -> Option<Table<'_>> {
    find_separated(text, std::iter::once((Separator::Char('\t'), false)))
}

/// Finds the table with one of these separators, with or without a decimal comma.
fn find_separated(
    text: &str,
    candidates: impl Iterator<Item = (Separator, bool)>,
) -> Option<Table<'_>> {
    let lines: Vec<&str> = text.lines().collect();
    let ends_in_a_row = !text.ends_with(['\n', '\r']);
    let mut best = None;
    let mut most = (false, 0);
    for (separator, decimal_comma) in candidates {
        let Some((first, end, width)) = block(&lines, separator, decimal_comma) else { continue };
        let rows = end - first;
        let rank = (rows >= LONG || width >= MANY_COLUMNS, width.min(2) * rows);
        if rank > most {
            most = rank;
            best = Some((separator, decimal_comma, first, end, width));
        }
    }
    let (separator, decimal_comma, first, end, width) = best?;
    Some(Table { lines, separator, decimal_comma, first, end, width, ends_in_a_row })
}

/// First line, end and width of the first long block of rows of numbers, else of the longest.
fn block(lines: &[&str], separator: Separator, comma: bool) -> Option<(usize, usize, usize)> {
    let mut best: Option<(usize, usize, usize)> = None;
    let mut at = 0;
    while at < lines.len() {
        if filled(lines[at], separator, comma).is_none_or(|width| width < 2) {
            at += 1;
            continue;
        }
        let first = at;
        let mut width = 0;
        while at < lines.len() {
            let line = lines[at];
            if !skipped(line) {
                let Some(cells) = filled(line, separator, comma) else { break };
                let grows = at < first + FIRST_ROWS;
                if cells > width && !grows {
                    break;
                }
                width = width.max(cells);
            }
            at += 1;
        }
        if best.is_none_or(|(f, e, _)| at - first > e - f) {
            best = Some((first, at, width));
        }
        if at - first >= LONG {
            break;
        }
    }
    best
}

fn skipped(line: &str) -> bool {
    let line = line.trim_start();
    line.is_empty() || line.starts_with(['#', '%'])
}

/// Number of cells up to the last filled one, if most of them are values.
fn filled(line: &str, separator: Separator, comma: bool) -> Option<usize> {
    let (mut values, mut words, mut last) = (0_usize, 0_usize, 0);
    for (k, cell) in separator.cells(line).enumerate() {
        match Cell::of(cell, comma) {
            Cell::Blank => continue,
            Cell::Words => words += 1,
            _ => values += 1,
        }
        last = k + 1;
    }
    (values > words).then_some(last)
}

impl Table<'_> {
    /// Its channels.
    pub(crate) fn read(&self) -> Result<LogData, FormatError> {
        let rows = (self.first..self.end).filter(|k| !skipped(self.lines[*k])).count();
        if (2..=FEW_ROWS).contains(&rows) && self.width >= MANY_COLUMNS && self.width > 4 * rows {
            return Ok(self.by_rows());
        }
        if rows < 2 {
            return Err(FormatError::NoTable);
        }
        let mut notes = Vec::new();
        let mut end = self.end;
        let last = self.lines.len() - 1;
        if end == last + 1 && self.ends_in_a_row && self.cells_in(last) < self.width {
            notes.push(format!("row {} is incomplete and left out", last + 1));
            end = last;
        }
        let after = (end..self.lines.len()).filter(|k| !skipped(self.lines[*k]));
        let after: Vec<usize> = after.filter(|k| *k != last || end > last).collect();
        if after.len() > LAST_LINES {
            let row = after[0];
            let text: String = self.lines[row].trim().chars().take(40).collect();
            let reason = format!("the table of numbers ends at \"{text}\", and more follows");
            return Err(FormatError::content(format!("row {}", row + 1), reason));
        }
        let header = Header::above(&self.lines, self.first, self.width, self.separator);
        if self.first > header.line.map_or(0, |line| line + 1) + 1 || header.line > Some(0) {
            let above = header.line.unwrap_or(self.first);
            notes.push(format!("{above} lines above the table are left out"));
        }
        let channels = self.columns(&header, end);
        Ok(LogData { format: Format::Text, channels, decimal_comma: self.decimal_comma, notes })
    }

    fn cells_in(&self, line: usize) -> usize {
        self.separator.cells(self.lines[line]).count()
    }

    /// The columns of the rows before `end`.
    pub(crate) fn columns(&self, header: &Header, end: usize) -> Vec<Channel> {
        let rows = end - self.first;
        let mut columns: Vec<Column> = (0..self.width).map(|_| Column::new(rows)).collect();
        for row in self.first..end {
            if skipped(self.lines[row]) {
                continue;
            }
            let mut cells = self.separator.cells(self.lines[row]);
            for column in &mut columns {
                column.take(cells.next().unwrap_or(""), self.decimal_comma, row + 1);
            }
        }
        let named = |(k, column): (usize, Column)| {
            let name = header.names.get(k).cloned().unwrap_or_default();
            column.channel(name, header.units.get(k).cloned().flatten())
        };
        columns.into_iter().enumerate().map(named).collect()
    }

    /// One row for each signal, with its name in the first cell or without a name.
    fn by_rows(&self) -> LogData {
        let rows = (self.first..self.end).filter(|k| !skipped(self.lines[*k]));
        let channel = |row: usize| {
            let cells: Vec<&str> = self.separator.cells(self.lines[row]).collect();
            let named =
                cells.first().is_some_and(|c| Cell::of(c, self.decimal_comma) == Cell::Words);
            let mut column = Column::new(cells.len());
            for cell in &cells[usize::from(named)..] {
                column.take(cell, self.decimal_comma, row + 1);
            }
            let name = if named { cells[0].to_owned() } else { String::new() };
            let unit = super::header::in_brackets(&name);
            column.channel(name, unit)
        };
        LogData {
            format: Format::TextByRow,
            channels: rows.map(channel).collect(),
            decimal_comma: self.decimal_comma,
            notes: Vec::new(),
        }
    }
}

/// A column that is being read.
pub(crate) struct Column {
    values: Vec<f64>,
    /// The first stamp, from which stamps are counted: so their decimals are kept.
    epoch_s: Option<f64>,
    last_s: f64,
    not_a_number: Option<(usize, String)>,
}

/// A time of day that goes back by more than this passed midnight.
const HALF_A_DAY_S: f64 = 43_200.0;

impl Column {
    pub(crate) fn new(rows: usize) -> Self {
        let values = Vec::with_capacity(rows);
        Self { values, epoch_s: None, last_s: 0.0, not_a_number: None }
    }

    pub(crate) fn take(&mut self, cell: &str, decimal_comma: bool, row: usize) {
        let value = match Cell::of(cell, decimal_comma) {
            Cell::Number(value) => value,
            Cell::Stamp(stamp_s) => {
                let epoch_s = *self.epoch_s.get_or_insert(stamp_s);
                let mut since_s = stamp_s - epoch_s;
                if stamp_s < 86_400.0 && self.last_s - since_s > HALF_A_DAY_S {
                    since_s += 86_400.0;
                }
                self.last_s = since_s;
                since_s
            }
            Cell::Blank => f64::NAN,
            Cell::Words => {
                self.not_a_number.get_or_insert_with(|| (row, cell.chars().take(40).collect()));
                f64::NAN
            }
        };
        self.values.push(value);
    }

    pub(crate) fn channel(self, name: String, unit: Option<String>) -> Channel {
        let unit = if self.epoch_s.is_some() { Some("s".to_owned()) } else { unit };
        let Self { values, not_a_number, .. } = self;
        Channel { unit, not_a_number, ..Channel::of(name, values) }
    }
}
