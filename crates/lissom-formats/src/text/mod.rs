//! Text: decoding, delimited tables, and the exports of two controllers.

mod cells;
mod codesys;
mod column;
mod decode;
mod find;
mod header;
mod labview;
mod lines;
mod long_table;
mod preamble;
mod stamp_pairs;
mod stamps;
mod table;
mod twincat;

pub(crate) use decode::decoded;
#[cfg(feature = "xlsx")]
pub(crate) use find::find_in_tabs;

use crate::channel_ref::Wanted;
use crate::format_error::FormatError;
use crate::log_data::LogData;
use crate::read_options::ReadOptions;

/// Most lines of a text, which take 2 GiB of memory in addition to it.
const MOST_LINES: usize = 1 << 27;

/// Reads a text that contains a table.
pub(crate) fn read(
    text: &str,
    options: &ReadOptions,
    wanted: Wanted,
) -> Result<LogData, FormatError> {
    if text.bytes().filter(|byte| *byte == b'\n').count() > MOST_LINES {
        let reason = format!("it has more than {MOST_LINES} lines");
        return Err(FormatError::content("text", reason));
    }
    if let Some(found) = codesys::read(text) {
        return Ok(found);
    }
    if options.header_row.is_none()
        && let Some(found) =
            long_table::read(text, options).or_else(|| labview::read(text, options))
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
    table.read(header_row, wanted)
}
