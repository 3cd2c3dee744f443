//! Text: decoding, delimited tables, and the exports of two controllers.

mod cells;
mod codesys;
mod column;
mod decode;
mod find;
mod header;
mod labview;
mod long_table;
mod preamble;
mod stamp_pairs;
mod stamps;
mod table;
mod twincat;

pub(crate) use decode::decoded;
#[cfg(feature = "xlsx")]
pub(crate) use find::find_in_tabs;

use crate::format_error::FormatError;
use crate::log_data::LogData;
use crate::read_options::ReadOptions;

/// Reads a text that contains a table.
pub(crate) fn read(text: &str, options: &ReadOptions) -> Result<LogData, FormatError> {
    if let Some(found) = codesys::read(text) {
        return Ok(found);
    }
    if options.header_row.is_none()
        && let Some(found) = long_table::read(text).or_else(|| labview::read(text))
    {
        return found;
    }
    let ReadOptions { header_row, skip_rows, decimal_comma } = *options;
    let above = skip_rows.max(header_row.unwrap_or(0));
    let table = find::find(text, above, decimal_comma).ok_or_else(|| match above {
        0 => FormatError::NoTable,
        row => FormatError::content(format!("row {row}"), "no table of numbers is below this row"),
    })?;
    if header_row.is_none()
        && let Some(found) = twincat::read(&table)
    {
        return Ok(found);
    }
    table.read(header_row)
}
