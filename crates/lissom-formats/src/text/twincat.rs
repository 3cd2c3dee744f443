//! Exports of TwinCAT Scope: for each signal a column of times and a column of values.
//!
//! Above the numbers are rows of pairs, `Name⇥iq⇥Name⇥pos`, one pair for each signal.

use super::cells::{Decimal, Separator};
use super::header::Header;
use super::table::Table;
use crate::format::Format;
use crate::log_data::{Channel, Clock, LogData};

/// Reads a table if it is such an export.
pub(crate) fn read(table: &Table<'_>) -> Option<LogData> {
    if table.separator == Separator::Blanks || !table.width.is_multiple_of(2) {
        return None;
    }
    let above = &table.lines[..table.first];
    let pairs = |key: &str| {
        let mut rows = above.iter().rev().map(|line| table.separator.cells(line));
        let cells: Vec<&str> = rows.find(|cells| cells.clone().next() == Some(key))?.collect();
        Some(cells.chunks(2).map(|pair| pair.get(1).copied().unwrap_or("")).collect::<Vec<_>>())
    };
    let names = pairs("Name").filter(|names| names.len() >= table.width / 2)?;
    pairs("SampleTime[ms]").or_else(|| pairs("Data-Type"))?;
    let units = pairs("Unit").unwrap_or_default();
    let channel = |(k, column): (usize, Channel)| {
        let name = names[k / 2];
        if k % 2 == 0 {
            return Channel { name: format!("{name}/time"), unit: Some("ms".to_owned()), ..column };
        }
        let unit = units.get(k / 2).filter(|u| !u.is_empty()).map(|u| (*u).to_owned());
        Channel { name: name.to_owned(), unit, clock: Clock::Channel(k - 1), ..column }
    };
    let columns = table.columns(&Header::default(), table.end)?;
    if columns.len() != table.width {
        return None;
    }
    Some(LogData {
        format: Format::TwinCat,
        channels: columns.into_iter().enumerate().map(channel).collect(),
        decimal_comma: table.decimal == Decimal::Comma,
        notes: Vec::new(),
    })
}
