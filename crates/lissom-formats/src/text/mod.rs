//! Text: decoding, delimited tables, and the exports of two controllers.

mod cells;
mod codesys;
mod decode;
mod header;
mod stamps;
mod table;
mod twincat;

pub(crate) use decode::decoded;
#[cfg(feature = "xlsx")]
pub(crate) use table::find_in_tabs;

use crate::format_error::FormatError;
use crate::log_data::LogData;

/// Reads a text that contains a table.
pub(crate) fn read(text: &str) -> Result<LogData, FormatError> {
    if let Some(found) = codesys::read(text) {
        return Ok(found);
    }
    let table = table::find(text).ok_or(FormatError::NoTable)?;
    twincat::read(&table).map_or_else(|| table.read(), Ok)
}
