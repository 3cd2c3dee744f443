//! The table of numbers in a text, and its columns.

use super::cells::{Cell, Decimal, Separator};
use super::column::Column;
use super::header::Header;
use super::lines::{MANY_COLUMNS, is_skipped};
use super::preamble::Preamble;
use super::rest::Rest;
use super::rows::Rows;
use super::stamp_pairs;
use super::time_columns;
use crate::bytes::MOST_BYTES;
use crate::channel_ref::Wanted;
use crate::format::Format;
use crate::format_error::FormatError;
use crate::log_data::{Channel, LogData};

/// A table with at most so many rows may have one row for each signal.
const FEW_ROWS: usize = 20;
/// Lines after the table that may contain something else.
const LAST_LINES: usize = 4;

/// A table in a text.
pub(crate) struct Table<'a> {
    pub(crate) lines: Vec<&'a str>,
    /// Names and units above it, which are left out where they are repeated.
    pub(super) header: Vec<&'a str>,
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
    /// Its channels; the names are in the row `header_row`, if it is stated. The table may go on in the rest of the text.
    pub(crate) fn read(
        &self,
        header_row: Option<usize>,
        wanted: Wanted,
        rest: Option<Rest>,
    ) -> Result<LogData, FormatError> {
        let rows = (self.first..self.end).filter(|k| !self.skips(self.lines[*k])).count();
        if (2..=FEW_ROWS).contains(&rows) && self.width >= MANY_COLUMNS && self.width > 4 * rows {
            return Ok(self.by_rows());
        }
        if rows < 2 {
            return Err(FormatError::NoTable);
        }
        let (mut notes, mut at_end) = (Vec::new(), None);
        let mut end = self.end;
        let last = self.lines.len() - 1;
        let is_last = rest.is_none() && end == last + 1 && self.ends_in_a_row;
        if is_last && self.cells_in(last) < self.width {
            at_end = Some(incomplete(last + 1));
            end = last;
        }
        let after = (self.end..self.lines.len()).filter(|k| !is_skipped(self.lines[*k]));
        let after: Vec<usize> = after.collect();
        if after.len() > LAST_LINES {
            return Err(more_follows(after[0] + 1, self.lines[after[0]]));
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
        let mut rows = self.rows(&header, end, wanted)?;
        if let Some(rest) = rest {
            at_end = self.go_on(&mut rows, rest)?;
        }
        notes.extend(at_end);
        let mut channels = rows.channels(&header);
        preamble.set_clock(&mut channels);
        time_columns::set_clocks(&mut channels);
        stamp_pairs::append(&mut channels);
        Ok(LogData {
            format: Format::Text,
            channels,
            decimal_comma: self.decimal == Decimal::Comma,
            notes,
        })
    }

    /// Whether a line between its rows is none.
    fn skips(&self, line: &str) -> bool {
        is_skipped(line) || self.header.contains(&line.trim())
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

    /// Reads its further rows, and gives a note about an incomplete last one.
    fn go_on(&self, rows: &mut Rows, mut rest: Rest) -> Result<Option<String>, FormatError> {
        // The first line that is no row, and those from it on.
        let mut after: Option<(usize, String)> = None;
        let mut lines_after = 0;
        while let Some((row, line, ends)) = rest.next()? {
            if self.skips(&line) {
                continue;
            }
            if after.is_none() {
                if !ends && rows.separator.cells(&line).count() < rows.width() {
                    return Ok(Some(incomplete(row)));
                }
                if rows.take_if_row(&line, row) {
                    if rows.are_too_many(row - self.first) {
                        return Err(FormatError::TooLarge { most: MOST_BYTES });
                    }
                    continue;
                }
                after = Some((row, line.into_owned()));
            }
            lines_after += 1;
            if lines_after > LAST_LINES
                && let Some((row, line)) = &after
            {
                return Err(more_follows(*row, line));
            }
        }
        Ok(None)
    }

    /// The columns of the rows before `end`.
    pub(crate) fn columns(&self, header: &Header, end: usize) -> Option<Vec<Channel>> {
        Some(self.rows(header, end, Wanted::ALL).ok()?.channels(header))
    }

    /// The rows before `end`.
    fn rows(&self, header: &Header, end: usize, wanted: Wanted) -> Result<Rows, FormatError> {
        let mut rows = Rows::new(self.separator, self.decimal, self.width, header, wanted);
        if rows.are_too_many(end - self.first) {
            return Err(FormatError::TooLarge { most: MOST_BYTES });
        }
        rows.expect(end - self.first);
        for row in (self.first..end).filter(|row| !self.skips(self.lines[*row])) {
            rows.take(self.lines[row], row + 1);
        }
        Ok(rows)
    }

    /// One row for each signal, with its name in the first cell or without a name.
    fn by_rows(&self) -> LogData {
        let rows = (self.first..self.end).filter(|k| !self.skips(self.lines[*k]));
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

fn incomplete(row: usize) -> String {
    format!("row {row} is incomplete and left out")
}

fn more_follows(row: usize, line: &str) -> FormatError {
    let text: String = line.trim().chars().take(40).collect();
    let reason = format!("the table of numbers ends at \"{text}\", and more follows");
    FormatError::content(format!("row {row}"), reason)
}
