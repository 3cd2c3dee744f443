//! The columns of a table while its rows are read.

use super::cells::{Decimal, Separator};
use super::column::Column;
use super::header::Header;
use super::row::Row;
use super::time_columns::is_named_time;
use crate::bytes::MOST_BYTES;
use crate::channel_ref::Wanted;
use crate::log_data::Channel;
use crate::unit::is_time;

/// The columns of a table.
pub(super) struct Rows {
    pub(super) separator: Separator,
    decimal: Decimal,
    columns: Vec<Column>,
    /// Whether a column is read.
    is_wanted: Vec<bool>,
}

impl Rows {
    pub(super) fn new(
        separator: Separator,
        decimal: Decimal,
        width: usize,
        header: &Header,
        wanted: Wanted,
    ) -> Self {
        let name = |k: usize| header.names.get(k).map_or("", String::as_str);
        let names: Vec<&str> = (0..width).map(name).collect();
        let has_unit =
            |k: usize| header.units.get(k).and_then(Option::as_deref).is_some_and(is_time);
        let is_clock = |(k, name): &(usize, &&str)| is_named_time(name) || has_unit(*k);
        let has_clocks = names.iter().enumerate().filter(is_clock).count() > 1;
        let wanted = if wanted.are_all_in(&names) && !has_clocks { wanted } else { Wanted::ALL };
        let is_wanted =
            names.iter().enumerate().map(|(k, name)| wanted.has_at(name, Some(k + 1))).collect();
        let columns = (0..width).map(|_| Column::new(0)).collect();
        Self { separator, decimal, columns, is_wanted }
    }

    /// Makes room for so many rows.
    pub(super) fn expect(&mut self, rows: usize) {
        for (column, _) in self.columns.iter_mut().zip(&self.is_wanted).filter(|(_, of)| **of) {
            column.expect(rows);
        }
    }

    pub(super) fn width(&self) -> usize {
        self.columns.len()
    }

    /// Appends a row.
    pub(super) fn take(&mut self, line: &str, row: usize) {
        let mut cells = self.separator.cells(line);
        for (column, is_wanted) in self.columns.iter_mut().zip(&self.is_wanted) {
            let cell = cells.next().unwrap_or("");
            if *is_wanted {
                column.take(cell, self.decimal, row);
            }
        }
    }

    /// Whether the values of so many rows take more memory than a file may.
    pub(super) fn are_too_many(&self, rows: usize) -> bool {
        let columns = self.is_wanted.iter().filter(|wanted| **wanted).count();
        rows.saturating_mul(columns).saturating_mul(size_of::<f64>()) as u64 > 2 * MOST_BYTES
    }

    /// Appends a line if it is a row of the table.
    pub(super) fn take_if_row(&mut self, line: &str, row: usize) -> bool {
        let fits = Row::of(line, self.separator, self.decimal)
            .is_some_and(|row| row.values_end <= self.width());
        if fits {
            self.take(line, row);
        }
        fits
    }

    pub(super) fn channels(self, header: &Header) -> Vec<Channel> {
        let mut channels = Vec::with_capacity(self.columns.len());
        for (k, column) in self.columns.into_iter().enumerate() {
            let name = header.names.get(k).cloned().unwrap_or_default();
            let unit = header.units.get(k).cloned().flatten();
            column.push_channels(name, unit, &mut channels);
        }
        channels
    }
}
