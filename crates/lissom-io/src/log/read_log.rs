//! Reads a log file of any format.

use std::fs::File;
use std::io::{BufRead, BufReader, ErrorKind};
use std::path::Path;

use super::log_columns::{ColumnRef, Log, LogColumn, LogOptions};
use super::log_error::LogError;
use super::log_path::{LogPart, LogPath};
use super::other_format;
use super::plain_log::read_rows;

/// Bytes that are read at once.
const BUFFER_BYTES: usize = 1 << 18;
/// A log with at most so many rows may have a row for each signal in place of a column.
const FEW_ROWS: usize = 20;

/// Reads the columns of a log, `FILE` or `FILE::GROUP`, and its time stamps if `time` is given.
///
/// # Errors
/// Any [`LogError`] except those about pieces and skipping.
pub fn read_log(
    path: &Path,
    time: Option<&ColumnRef>,
    columns: &[LogColumn],
    options: &LogOptions,
) -> Result<Log, LogError> {
    let at = LogPath::of(path);
    if let Some(group) = &at.group {
        let Ok([part]) = <[LogPart; 1]>::try_from(at.parts(&options.of_text())?) else {
            let (file, group) = (at.file.display().to_string(), group.clone());
            return Err(LogError::SeveralGroups { file, group });
        };
        return read_part(&part, time, columns, options);
    }
    let name = path.display().to_string();
    match File::open(path).and_then(only_file) {
        Ok(file) => {
            let bytes = file.metadata().ok().map(|of| of.len());
            let mut reader = BufReader::with_capacity(BUFFER_BYTES, file);
            let begins = reader
                .fill_buf()
                .map_err(|source| LogError::Open { file: name.clone(), source })?;
            let stated = options.header_row.is_some() || options.skip_rows > 0;
            if stated || lissom_formats::is_no_plain_table(begins) {
                return other_format::read(path, time, columns, options, None);
            }
            match read_rows(reader, bytes, &name, time, columns, options) {
                Err(error) if error.may_be_another_format() => {
                    other_format::read(path, time, columns, options, Some(error))
                }
                Ok(log) if log.columns.first().is_some_and(|c| c.len() <= FEW_ROWS) => {
                    // Or one row for each signal.
                    Ok(other_format::by_row(path, time, columns, options).unwrap_or(log))
                }
                found => found,
            }
        }
        Err(source) => Err(LogError::Open { file: name, source }),
    }
}

/// The columns of a part of a file, and its time stamps if `time` is given.
///
/// # Errors
/// As [`read_log`].
pub fn read_part(
    part: &LogPart,
    time: Option<&ColumnRef>,
    columns: &[LogColumn],
    options: &LogOptions,
) -> Result<Log, LogError> {
    other_format::of_data(&part.label, &part.data, time, columns, options, None)
}

/// Refuses folders, which can be opened too.
fn only_file(file: File) -> std::io::Result<File> {
    if file.metadata()?.is_dir() { Err(ErrorKind::IsADirectory.into()) } else { Ok(file) }
}
