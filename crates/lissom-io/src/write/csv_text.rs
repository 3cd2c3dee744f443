//! Writes logs as comma-separated text.

use std::fmt::Write as _;
use std::io::{self, Write};
use std::path::Path;

use super::write_error::WriteError;
use super::write_whole::write_whole;

/// Numbers below this are written with an exponent, which is shorter than zeros.
const SMALL: f64 = 1e-4;
/// Numbers from here on are written with an exponent.
const LARGE: f64 = 1e15;

/// Writes columns as comma-separated text with a header, completely or not at all. Numbers have as many digits as are
/// needed to read the same number again.
///
/// # Errors
/// [`WriteError::Ragged`] for columns of different length, and as [`write_whole`].
pub fn write_csv(path: &Path, columns: &[(&str, &[f64])]) -> Result<(), WriteError> {
    check(columns)?;
    write_whole(path, |out| put(out, columns))
}

/// The same as text.
///
/// # Errors
/// [`WriteError::Ragged`] for columns of different length.
pub fn csv_text(columns: &[(&str, &[f64])]) -> Result<String, WriteError> {
    check(columns)?;
    let mut bytes = Vec::new();
    // Writing to memory does not fail, and the bytes are text.
    let _ = put(&mut bytes, columns);
    Ok(String::from_utf8(bytes).unwrap_or_default())
}

fn check(columns: &[(&str, &[f64])]) -> Result<(), WriteError> {
    let Some((first, expected)) = columns.first().map(|(name, values)| (*name, values.len()))
    else {
        return Ok(());
    };
    match columns.iter().find(|(_, values)| values.len() != expected) {
        None => Ok(()),
        Some((column, values)) => Err(WriteError::Ragged {
            column: (*column).to_owned(),
            found: values.len(),
            first: first.to_owned(),
            expected,
        }),
    }
}

fn put(out: &mut dyn Write, columns: &[(&str, &[f64])]) -> io::Result<()> {
    let names: Vec<String> = columns.iter().map(|(name, _)| quoted(name)).collect();
    writeln!(out, "{}", names.join(","))?;
    let rows = columns.first().map_or(0, |(_, values)| values.len());
    let mut line = String::new();
    for row in 0..rows {
        line.clear();
        for (index, (_, values)) in columns.iter().enumerate() {
            if index > 0 {
                line.push(',');
            }
            put_number(&mut line, values[row]);
        }
        line.push('\n');
        out.write_all(line.as_bytes())?;
    }
    Ok(())
}

fn put_number(line: &mut String, value: f64) {
    let size = value.abs();
    // Writing to a string does not fail.
    let _ = if size != 0.0 && !(SMALL..LARGE).contains(&size) {
        write!(line, "{value:e}")
    } else {
        write!(line, "{value}")
    };
}

fn quoted(name: &str) -> String {
    let plain = !name.contains([',', ';', '"', '\t', '\n', '\r']);
    if plain { name.to_owned() } else { format!("\"{}\"", name.replace(['"', '\n', '\r'], " ")) }
}
