//! MATLAB files of versions 5, 6 and 7.
//!
//! The file is read, and a compressed variable expanded, in pieces: only the values of wanted channels are in memory.

use flate2::bufread::ZlibDecoder;

use super::elements::{COMPRESSED, Element, MATRIX, TAG_BYTES};
use super::matrix::MatrixReader;
use super::value::collect;
use crate::channel_ref::Wanted;
use crate::collected::Collected;
use crate::expanded::Expanded;
use crate::format::Format;
use crate::format_error::FormatError;
use crate::log_data::LogData;
use crate::source::Source;
use crate::stream::{Input, Stream};

/// Bytes before the first element.
const HEADER_BYTES: usize = 128;
/// Most bytes that deflate makes of one.
const LARGEST_RATIO: u64 = 1032;

/// Whether a file is big endian, if it begins as a MATLAB file of version 5 does.
fn byte_order(bytes: &[u8]) -> Option<bool> {
    match bytes.get(HEADER_BYTES - 4..HEADER_BYTES)? {
        [0, 1, b'I', b'M'] => Some(false),
        [1, 0, b'M', b'I'] => Some(true),
        _ => None,
    }
}

/// Whether a file begins as a MATLAB file of version 5 does.
pub(crate) fn begins(bytes: &[u8]) -> bool {
    bytes.starts_with(b"MATLAB 5.0 MAT-file") || byte_order(bytes).is_some()
}

/// Reads a file.
pub(crate) fn read(source: &Source, wanted: Wanted) -> Result<LogData, FormatError> {
    let header = || FormatError::content("header", "the header of the MATLAB file is damaged");
    let mut place = HEADER_BYTES as u64;
    let big_endian = byte_order(&source.bytes(0..place)?).ok_or_else(header)?;
    let mut found = Collected::of(wanted);
    let mut number = 0;
    while place < source.length() {
        number += 1;
        let begin = place + TAG_BYTES as u64;
        let tag = source.bytes(place..begin)?;
        let Some(element) = Element::of(&tag, place, source.length(), big_endian) else {
            found.note(format!("the file ends inside variable {number}, which is left out"));
            break;
        };
        place = element.next();
        let data = source.part(begin.min(element.end)..element.end);
        let read = match element.kind {
            MATRIX => matrix(data, &element, big_endian, &mut found),
            COMPRESSED => compressed(data, big_endian, &mut found),
            // Other elements are no variables.
            _ => Ok(()),
        };
        match read {
            Ok(()) => {}
            Err(error @ (FormatError::TooLarge { .. } | FormatError::Read { .. })) => {
                return Err(error);
            }
            Err(error) => found.note(format!("variable {number} is left out: {error}")),
        }
    }
    found.finish(Format::Matlab)
}

fn damaged_content() -> FormatError {
    FormatError::content("variable", "its content is damaged")
}

/// Appends the channels of a variable.
fn matrix(
    mut data: Stream,
    element: &Element,
    big_endian: bool,
    found: &mut Collected,
) -> Result<(), FormatError> {
    let mut reader = MatrixReader::new(&mut data, 0, big_endian);
    let (name, mut value) =
        reader.matrix(element.size, None, 0, found)?.ok_or_else(damaged_content)?;
    // The variable without a name is the workspace of functions and objects.
    if name.is_empty() { Ok(()) } else { collect(&name, &mut value, found) }
}

/// Appends the channels of a compressed variable.
fn compressed(data: Stream, big_endian: bool, found: &mut Collected) -> Result<(), FormatError> {
    let damaged = |reason: &str| FormatError::Damaged { reason: reason.to_owned() };
    let most = data.left().saturating_mul(LARGEST_RATIO).saturating_add(TAG_BYTES as u64);
    let mut expanded = Expanded::new(ZlibDecoder::new(data), String::new());
    let tag = expanded.next_bytes(TAG_BYTES)?.ok_or_else(|| damaged("they end too early"))?;
    let Some(element) = Element::of(tag, 0, most, big_endian) else {
        expanded.finish(most)?;
        return Err(damaged("they end too early"));
    };
    let mut read = None;
    let mut is_skipped = false;
    if element.kind == MATRIX {
        let mut reader = MatrixReader::new(&mut expanded, TAG_BYTES as u64, big_endian);
        read = reader.matrix(element.end, None, 0, found)?;
        is_skipped = read.is_some() && reader.is_unwanted();
    }
    if !is_skipped {
        // Reading on to the end checks the checksum.
        let bytes = expanded.finish(element.end)?;
        if element.kind == COMPRESSED || bytes < element.end {
            return Err(damaged("they end too early"));
        }
        if bytes > element.end {
            return Err(damaged("they are longer than stated"));
        }
    }
    match read {
        Some((name, mut value)) if !name.is_empty() => collect(&name, &mut value, found),
        None if element.kind == MATRIX => Err(damaged_content()),
        _ => Ok(()),
    }
}
