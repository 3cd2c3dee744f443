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
mod rest;
mod row;
mod rows;
mod stamp_pairs;
mod stamps;
mod table;
mod time_columns;
mod twincat;

#[cfg(feature = "xlsx")]
pub(crate) use find::find_in_tabs;
pub(crate) use time_columns::names_several_times;

use std::io::{BufRead, Read};

use crate::bytes::MOST_BYTES;
use crate::channel_ref::Wanted;
use crate::format_error::FormatError;
use crate::json;
use crate::log_data::LogData;
use crate::read_options::ReadOptions;
use decode::decoded;
use rest::{MOST_LINES, Rest};
use table::Table;

/// Bytes at the beginning of a text that show how it is written.
const HEAD_BYTES: u64 = 1 << 20;
/// A longer text is read line by line if so many lines are in its beginning.
const HEAD_LINES: usize = 1000;

/// Reads a text that contains a table, or JSON.
pub(crate) fn read(
    reader: &mut dyn BufRead,
    options: &ReadOptions,
    wanted: Wanted,
) -> Result<LogData, FormatError> {
    let mut bytes = Vec::new();
    reader.take(HEAD_BYTES).read_to_end(&mut bytes)?;
    if bytes.len() as u64 == HEAD_BYTES && !decode::is_utf16(&bytes) {
        reader.take(MOST_BYTES).read_until(b'\n', &mut bytes)?;
        let has_more = bytes.last() == Some(&b'\n');
        let head = decoded(&bytes)?;
        if let Some(table) = plain_table(&head, options).filter(|_| has_more) {
            let rest = Rest::new(reader, table.lines.len());
            return table.read(options.header_row, wanted, Some(rest));
        }
        drop(head);
    }
    reader.take(MOST_BYTES).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > MOST_BYTES {
        return Err(FormatError::TooLarge { most: MOST_BYTES });
    }
    let text = decoded(&bytes)?;
    let found = if is_json(&text) { json::read(&text)? } else { None };
    found.map_or_else(|| whole(&text, options, wanted), Ok)
}

fn is_json(text: &str) -> bool {
    text.trim_start().starts_with(['{', '['])
}

/// The table in the beginning of a text, if it is a plain one that reaches its end.
fn plain_table<'a>(head: &'a str, options: &ReadOptions) -> Option<Table<'a>> {
    if is_json(head)
        || codesys::read(head).is_some()
        || long_table::read(head, options).is_some()
        || labview::read(head, options).is_some()
    {
        return None;
    }
    let table = find::find(head, above(options), options.decimal_comma)?;
    let goes_on = table.end == table.lines.len() && table.end - table.first >= HEAD_LINES;
    (goes_on && twincat::read(&table).is_none()).then_some(table)
}

/// Lines above the table, as stated.
fn above(options: &ReadOptions) -> usize {
    options.skip_rows.max(options.header_row.unwrap_or(0))
}

/// Reads a whole text that contains a table.
fn whole(text: &str, options: &ReadOptions, wanted: Wanted) -> Result<LogData, FormatError> {
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
    let above = above(options);
    let table = find::find(text, above, options.decimal_comma).ok_or_else(|| match above {
        0 => FormatError::NoTable,
        row => FormatError::content(format!("row {row}"), "no table of numbers is below this row"),
    })?;
    if options.header_row.is_none()
        && let Some(found) = twincat::read(&table)
    {
        return Ok(found);
    }
    table.read(options.header_row, wanted, None)
}

#[cfg(test)]
mod tests {
    use std::fmt::Write;

    use super::*;
    use crate::channel_ref::ChannelRef;
    use crate::log_data::Channel;

    /// A table that is longer than the beginning of a text.
    fn long(row: impl Fn(usize) -> String) -> String {
        let mut text = String::from("made by a logger\ntime [s];q [deg];mode;i (A)\n");
        for k in 0..40_000 {
            let _ = writeln!(text, "{}", row(k));
        }
        assert!(text.len() as u64 > HEAD_BYTES);
        text
    }

    fn row(k: usize) -> String {
        let time = k as f64 * 1e-3;
        format!("{time:.3};{:.9};\"a;b\";{:.7}", time.sin(), time.cos()).replace('.', ",")
    }

    /// What is read line by line, after a comparison with what is read at once.
    fn both(text: &str, wanted: Wanted) -> Result<LogData, String> {
        let options = ReadOptions::default();
        let long = read(&mut text.as_bytes(), &options, wanted).map_err(|e| e.to_string());
        let at_once = whole(text, &options, wanted).map_err(|e| e.to_string());
        let [bits, bits_at_once] = [&long, &at_once].map(|found| {
            let channels = found.as_ref().map_or(&[][..], |found| &found.channels);
            let bits = |c: &Channel| c.values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
            channels.iter().map(bits).collect::<Vec<_>>()
        });
        let counts = |bits: &[Vec<u64>]| bits.iter().map(Vec::len).collect::<Vec<_>>();
        assert_eq!(counts(&bits), counts(&bits_at_once));
        assert!(bits == bits_at_once, "other values");
        let [rest, rest_at_once] = [&long, &at_once].map(|found| {
            let mut found = found.clone();
            if let Ok(found) = &mut found {
                found.channels.iter_mut().for_each(|c| c.values.clear());
            }
            found
        });
        assert_eq!(rest, rest_at_once);
        long
    }

    #[test]
    fn a_long_table_is_read_line_by_line_as_at_once() {
        let plain = long(row);
        let found = both(&plain, Wanted::ALL).unwrap();
        assert_eq!(found.channels[1].values.len(), 40_000);
        assert_eq!(found.channels[1].unit.as_deref(), Some("deg"));
        for end in ["EOF\n", "1,0;2", "1,0;2\n", "\n\n# end\n", "a;b;c;d\n", "1;2;3;4;5\n"] {
            both(&format!("{plain}{end}"), Wanted::ALL).unwrap();
        }
        let more = both(&format!("{plain}a\nb\nc\nd\ne\n"), Wanted::ALL).unwrap_err();
        assert!(more.contains("the table of numbers ends at \"a\""), "{more}");
        let gaps = long(|k| if k % 7 == 0 { format!("{k};;;1") } else { row(k) });
        both(&gaps, Wanted::ALL).unwrap();
        let words = long(|k| if k == 30_000 { "30;off;1;2".to_owned() } else { row(k) });
        let words = both(&words, Wanted::ALL).unwrap();
        assert_eq!(words.channels[1].not_a_number, Some((30_003, "off".to_owned())));
    }

    #[test]
    fn a_last_row_that_ends_the_beginning_of_a_text_is_incomplete() {
        let plain = long(row);
        let head = &plain[..HEAD_BYTES as usize];
        // The row that contains the last byte of the beginning, cut behind it.
        let start = head.rfind('\n').unwrap() + 1;
        for end in [HEAD_BYTES as usize, (HEAD_BYTES as usize + 5).min(start + 30)] {
            both(&plain[..end], Wanted::ALL).unwrap();
        }
    }

    #[test]
    fn what_is_not_asked_for_has_no_values() {
        let wanted = [ChannelRef::Name("i (A)".to_owned()), ChannelRef::Number(1)];
        let found = both(&long(row), Wanted::of(&wanted)).unwrap();
        let counts: Vec<usize> = found.channels.iter().map(|c| c.values.len()).collect();
        assert_eq!(counts, [40_000, 0, 0, 40_000]);
    }
}
