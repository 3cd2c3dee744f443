//! Traces of CODESYS: after `N.Variable; name` and `N.Data;` a row `; time in ms; value` for each sample.

use super::cells::{Cell, Decimal, Separator};
use super::column::{self, Column};
use crate::format::Format;
use crate::log_data::{Channel, LogData};

/// A trace names its first variable within so many rows.
const FIRST_ROWS: usize = 1000;

/// Reads a text if it is such a trace.
pub(crate) fn read(text: &str) -> Option<LogData> {
    let separator = Separator::Char(';');
    let mut channels: Vec<Channel> = Vec::new();
    let mut name = None;
    let mut data: Option<[Column; 2]> = None;
    for (row, line) in (1..).zip(text.lines()) {
        let mut cells = separator.cells(line);
        let key = cells.next().unwrap_or("");
        if let (true, Some([time, value])) = (key.is_empty(), &mut data) {
            let (stamp, cell) = (cells.next().unwrap_or(""), cells.next().unwrap_or(""));
            if Cell::of(stamp, Decimal::Comma).is_value() {
                time.take(stamp, Decimal::Comma, row);
                value.take(cell, Decimal::Comma, row);
            }
            continue;
        }
        match key.split_once('.').filter(|(number, _)| number.parse::<u32>().is_ok()) {
            Some((_, "Variable")) => {
                finish(data.take(), name.as_deref(), &mut channels);
                name = Some(cells.next().unwrap_or("").to_owned());
            }
            Some((_, "Data")) if name.is_some() => data = Some([Column::new(0), Column::new(0)]),
            _ => {}
        }
        if row > FIRST_ROWS && name.is_none() {
            return None;
        }
    }
    finish(data, name.as_deref(), &mut channels);
    let decimal_comma = false;
    let notes = Vec::new();
    (!channels.is_empty()).then_some(LogData {
        format: Format::Codesys,
        channels,
        decimal_comma,
        notes,
    })
}

fn finish(data: Option<[Column; 2]>, name: Option<&str>, channels: &mut Vec<Channel>) {
    let (Some([time, value]), Some(name)) = (data, name) else { return };
    column::push_timed(name, (time, Some("ms")), value, channels);
}
