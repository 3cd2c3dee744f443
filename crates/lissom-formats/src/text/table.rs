//! The table of numbers in a text, and its columns.

use super::cells::{Cell, Decimal, Separator};
use super::column::Column;
use super::header::Header;
use super::lines::{MANY_COLUMNS, is_skipped};
use super::preamble::Preamble;
use super::stamp_pairs;
use crate::channel_ref::Wanted;
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
    /// Whether its commas may be decimal or between thousands.
    pub(super) may_be_other: bool,
    /// First line of numbers, from 0.
    pub(crate) first: usize,
    /// One line after the last one of the block.
    pub(crate) end: usize,
    pub(crate) width: usize,
    pub(super) ends_in_a_row: bool,
}

impl Table<'_> {
    /// Its channels; the names are in the row `header_row`, if it is stated.
    pub(crate) fn read(
        &self,
        header_row: Option<usize>,
        wanted: Wanted,
    ) -> Result<LogData, FormatError> {
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
        let mut header = self.header(header_row)?;
        let preamble = Preamble::of(&self.lines[..self.first], self.separator, self.decimal);
        preamble.complete(&mut header, self.width);
        let above = header.line.unwrap_or(self.first);
        if above > 0 {
            notes.push(format!("{above} lines above the table are left out"));
        }
        if self.may_be_other {
            let read_as = if self.decimal == Decimal::Comma { "1.234" } else { "1234" };
            notes
                .push(format!("commas are ambiguous: numbers such as 1,234 are read as {read_as}"));
        }
        let mut channels = self.columns(&header, end, wanted);
        preamble.set_clock(&mut channels);
        stamp_pairs::append(&mut channels);
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
    pub(crate) fn columns(&self, header: &Header, end: usize, wanted: Wanted) -> Vec<Channel> {
        let rows = end - self.first;
        let name = |k: usize| header.names.get(k).map_or("", String::as_str);
        let wanted =
            if wanted.are_all_in((0..self.width).map(name)) { wanted } else { Wanted::ALL };
        let is_wanted: Vec<bool> =
            (0..self.width).map(|k| wanted.has_at(name(k), Some(k + 1))).collect();
        let rows_of = |k: usize| if is_wanted[k] { rows } else { 0 };
        let mut columns: Vec<Column> = (0..self.width).map(|k| Column::new(rows_of(k))).collect();
        for row in self.first..end {
            if is_skipped(self.lines[row]) {
                continue;
            }
            let mut cells = self.separator.cells(self.lines[row]);
            for (column, is_wanted) in columns.iter_mut().zip(&is_wanted) {
                let cell = cells.next().unwrap_or("");
                if *is_wanted {
                    column.take(cell, self.decimal, row + 1);
                }
            }
        }
        let mut channels = Vec::with_capacity(self.width);
        for (k, column) in columns.into_iter().enumerate() {
            let name = header.names.get(k).cloned().unwrap_or_default();
            let unit = header.units.get(k).cloned().flatten();
            column.push_channels(name, unit, &mut channels);
        }
        channels
    }

    /// One row for each signal, with its name in the first cell or without a name.
    fn by_rows(&self) -> LogData {
        let rows = (self.first..self.end).filter(|k| !is_skipped(self.lines[*k]));
        let mut channels = Vec::new();
        for row in rows {
            let cells: Vec<&str> = self.separator.cells(self.lines[row]).collect();
            let named = cells.first().is_some_and(|c| Cell::of(c, self.decimal) == Cell::Words);
            let mut column = Column::new(cells.len());
            for cell in &cells[usize::from(named)..] {
                column.take(cell, self.decimal, row + 1);
            }
            let name = if named { cells[0].to_owned() } else { String::new() };
            let unit = crate::unit::in_name(&name);
            column.push_channels(name, unit, &mut channels);
        }
        LogData {
            format: Format::TextByRow,
            channels,
            decimal_comma: self.decimal == Decimal::Comma,
            notes: Vec::new(),
        }
    }
}
