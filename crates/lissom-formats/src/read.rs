//! Reads a file of any format.

use std::io::{BufReader, Cursor, Read};
use std::path::Path;

use crate::bytes::{GZIP, Opened, ZSTD};
use crate::channel_ref::{ChannelRef, Wanted};
use crate::format::foreign;
use crate::format_error::FormatError;
use crate::log_data::LogData;
use crate::read_options::ReadOptions;
use crate::source::Source;
use crate::{binary, bytes, text};

/// Bytes at the beginning of a file that show its format.
const FIRST_BYTES: u64 = 4096;

/// Bytes at the beginning of a text that are searched for its header.
const TEXT_BYTES: usize = 1 << 14;
/// Bytes that are expanded at once.
const BLOCK_BYTES: usize = 1 << 16;

/// Reads all channels of a log file.
///
/// # Errors
/// [`FormatError`] if the file cannot be read, is of a format that is not read, or has no table of numbers.
pub fn read(path: &Path) -> Result<LogData, FormatError> {
    read_with(path, &ReadOptions::default())
}

/// Reads all channels of a log file; the options apply to tables in text.
///
/// # Errors
/// As [`read`], and [`FormatError::Content`] if there is no table where the options state it.
pub fn read_with(path: &Path, options: &ReadOptions) -> Result<LogData, FormatError> {
    of_opened(bytes::of_file(path)?, options, Wanted::ALL)
}

/// Reads some channels of a log file, and the time stamps that the file gives them. Of the others the values may be left
/// out, so that they take no memory.
///
/// # Errors
/// As [`read_with`].
pub fn read_channels(
    path: &Path,
    options: &ReadOptions,
    channels: &[ChannelRef],
) -> Result<LogData, FormatError> {
    of_opened(bytes::of_file(path)?, options, Wanted::of(channels))
}

/// Reads all channels of a log file that is in memory.
///
/// # Errors
/// As [`read`].
pub fn read_bytes(bytes: Vec<u8>) -> Result<LogData, FormatError> {
    of_opened(bytes::of_bytes(bytes)?, &ReadOptions::default(), Wanted::ALL)
}

fn of_opened(
    opened: Opened,
    options: &ReadOptions,
    wanted: Wanted,
) -> Result<LogData, FormatError> {
    let mut reader = match opened {
        Opened::Plain(source) => return of_source(&source, options, wanted),
        Opened::Compressed(reader) => reader,
    };
    let mut first = Vec::new();
    let damaged = |error: std::io::Error| FormatError::Damaged { reason: error.to_string() };
    reader.by_ref().take(FIRST_BYTES).read_to_end(&mut first).map_err(damaged)?;
    let is_binary = binary::is_recognised(&first) || foreign(&first).is_some();
    let whole = Cursor::new(first).chain(reader);
    if is_binary {
        return of_source(&bytes::expanded(whole)?, options, wanted);
    }
    text::read(&mut BufReader::with_capacity(BLOCK_BYTES, whole), options, wanted).map_err(
        |error| match error {
            FormatError::Read { source } => damaged(source),
            other => other,
        },
    )
}

fn of_source(
    source: &Source,
    options: &ReadOptions,
    wanted: Wanted,
) -> Result<LogData, FormatError> {
    let first = source.bytes(0..FIRST_BYTES)?;
    if let Some(found) = binary::read(source, &first, wanted)? {
        return Ok(found);
    }
    if let Some((what, way_out)) = foreign(&first) {
        return Err(FormatError::Foreign { what, way_out });
    }
    text::read(&mut source.stream(0), options, wanted)
}

/// Whether the first bytes of a file show that it is not a plain table: compressed, a trace of CODESYS, binary, with several
/// columns of time stamps, or a format that is recognised and not read.
pub fn is_no_plain_table(first: &[u8]) -> bool {
    let begins = [GZIP, ZSTD, b"[key]"];
    begins.iter().any(|begin| first.starts_with(begin))
        || binary::is_recognised(first)
        || foreign(first).is_some()
        || text::names_several_times(&String::from_utf8_lossy(
            &first[..first.len().min(TEXT_BYTES)],
        ))
}
