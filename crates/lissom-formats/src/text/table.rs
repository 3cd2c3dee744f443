//! The table of numbers in a text, and its columns.

use super::cells::{Cell, Decimal, Separator};
use super::find::{MANY_COLUMNS, is_skipped};
use super::header::Header;
use super::stamps::{DAY_S, HALF_DAY_S, Stamp};
use crate::format::Format;
use crate::format_error::FormatError;
use crate::log_data::{Channel, LogData};

/// A table with at most so many rows may have one row for each signal.
const FEW_ROWS: usize = 20;
/// Lines after the table that may contain something else.
const LAST_LINES: usize = 3;

/// A table in a text.
pub(crate) struct Table<'a> {
    pub(crate) lines: Vec<&'a str>,
    pub(crate) separator: Separator,
    pub(crate) decimal: Decimal,
    /// First line of numbers, from 0.
    pub(crate) first: usize,
    /// One line after the last one of the block.
    pub(crate) end: usize,
    pub(crate) width: usize,
    pub(super) ends_in_a_row: bool,
}

impl Table<'_> {
    /// Its channels; the names are in the row `header_row`, if it is stated.
    pub(crate) fn read(&self, header_row: Option<usize>) -> Result<LogData, FormatError> {
        let rows = (self.first..self.end).filter(|k| !is_skipped(self.lines[*k])).count();
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
        let after = (end..self.lines.len()).filter(|k| !is_skipped(self.lines[*k]));
        let after: Vec<usize> = after.filter(|k| *k != last || end > last).collect();
        if after.len() > LAST_LINES {
            let row = after[0];
            let text: String = self.lines[row].trim().chars().take(40).collect();
            let reason = format!("the table of numbers ends at \"{text}\", and more follows");
            return Err(FormatError::content(format!("row {}", row + 1), reason));
        }
        let header = self.header(header_row)?;
        if self.first > header.line.map_or(0, |line| line + 1) + 1 || header.line > Some(0) {
            let above = header.line.unwrap_or(self.first);
            notes.push(format!("{above} lines above the table are left out"));
        }
        let channels = self.columns(&header, end);
        Ok(LogData {
            format: Format::Text,
            channels,
            decimal_comma: self.decimal == Decimal::Comma,
            notes,
        })
    }

    fn header(&self, row: Option<usize>) -> Result<Header, FormatError> {
        let Some(row) = row else {
            return Ok(Header::above(&self.lines, self.first, self.width, self.separator));
        };
        Header::stated(&self.lines, row, self.first, self.width, self.separator).map_err(|names| {
            let (first, width) = (self.first + 1, self.width);
            let reason = format!("has {names} names; the table in row {first} has {width} columns");
            FormatError::content(format!("row {row}"), reason)
        })
    }

    fn cells_in(&self, line: usize) -> usize {
        self.separator.cells(self.lines[line]).count()
    }

    /// The columns of the rows before `end`.
    pub(crate) fn columns(&self, header: &Header, end: usize) -> Vec<Channel> {
        let rows = end - self.first;
        let mut columns: Vec<Column> = (0..self.width).map(|_| Column::new(rows)).collect();
        for row in self.first..end {
            if is_skipped(self.lines[row]) {
                continue;
            }
            let mut cells = self.separator.cells(self.lines[row]);
            for column in &mut columns {
                column.take(cells.next().unwrap_or(""), self.decimal, row + 1);
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
        let rows = (self.first..self.end).filter(|k| !is_skipped(self.lines[*k]));
        let channel = |row: usize| {
            let cells: Vec<&str> = self.separator.cells(self.lines[row]).collect();
            let named = cells.first().is_some_and(|c| Cell::of(c, self.decimal) == Cell::Words);
            let mut column = Column::new(cells.len());
            for cell in &cells[usize::from(named)..] {
                column.take(cell, self.decimal, row + 1);
            }
            let name = if named { cells[0].to_owned() } else { String::new() };
            let unit = super::header::in_brackets(&name);
            column.channel(name, unit)
        };
        LogData {
            format: Format::TextByRow,
            channels: rows.map(channel).collect(),
            decimal_comma: self.decimal == Decimal::Comma,
            notes: Vec::new(),
        }
    }
}

/// A column that is being read.
pub(crate) struct Column {
    values: Vec<f64>,
    /// The first stamp, from which stamps are counted: so their decimals are kept.
    first: Option<Stamp>,
    /// A time of day that goes back by more than half a day passed midnight.
    last_s: f64,
    not_a_number: Option<(usize, String)>,
}

impl Column {
    pub(crate) fn new(rows: usize) -> Self {
        let values = Vec::with_capacity(rows);
        Self { values, first: None, last_s: 0.0, not_a_number: None }
    }

    pub(crate) fn take(&mut self, cell: &str, decimal: Decimal, row: usize) {
        let value = match Cell::of(cell, decimal) {
            Cell::Number(value) => value,
            Cell::Stamp(stamp) => {
                let mut since_s = stamp.since_s(*self.first.get_or_insert(stamp));
                if !stamp.has_date() && self.last_s - since_s > HALF_DAY_S {
                    since_s += DAY_S;
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
        let unit = if self.first.is_some() { Some("s".to_owned()) } else { unit };
        let Self { values, not_a_number, .. } = self;
        Channel { unit, not_a_number, ..Channel::of(name, values) }
    }
}
