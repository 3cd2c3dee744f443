//! MATLAB files of version 4: a header of 20 bytes before each matrix.

use super::left_out::SPARSE;
use crate::array::{Array, axes};
use crate::collected::Collected;
use crate::cursor::Cursor;
use crate::format::Format;
use crate::format_error::FormatError;
use crate::log_data::LogData;
use crate::number::{Number, NumberType};

/// Longest name with its final zero; MATLAB's are shorter.
const MOST_NAME: usize = 256;

/// A matrix of a file.
struct Matrix<'a> {
    name: String,
    number: Number,
    class: u32,
    is_complex: bool,
    lengths: [usize; 2],
    /// The bytes behind the header.
    rest: Cursor<'a>,
}

/// Whether a file begins as a MATLAB file of version 4 does. There is no mark: the header must make sense.
pub(crate) fn begins(bytes: &[u8]) -> bool {
    header(bytes).is_some()
}

/// Reads a file.
pub(crate) fn read(bytes: &[u8]) -> Result<LogData, FormatError> {
    let mut found = Collected::new();
    let mut rest = bytes;
    while !rest.is_empty() {
        let Some(matrix) = header(rest) else {
            found.note("the file ends inside the header of a matrix, or is damaged there");
            break;
        };
        let Some(after) = collect(matrix, &mut found)? else { break };
        rest = after;
    }
    found.finish(Format::Matlab)
}

/// Appends the channels of a matrix, and returns the bytes behind it; `None` if the file ends inside it.
fn collect<'a>(
    mut matrix: Matrix<'a>,
    found: &mut Collected,
) -> Result<Option<&'a [u8]>, FormatError> {
    let [rows, columns] = matrix.lengths;
    let parts = if matrix.is_complex { 2 } else { 1 };
    let size = matrix.number.kind.size();
    let whole = rows.checked_mul(columns).and_then(|n| n.checked_mul(size * parts));
    let Some(bytes) = whole.and_then(|whole| matrix.rest.take(whole)) else {
        found.note(format!("the file ends inside {}, which is left out", matrix.name));
        return Ok(None);
    };
    let name = &matrix.name;
    match matrix.class {
        0 => {
            if let Some(axes) = axes(&matrix.lengths, size, true) {
                let number = matrix.number;
                let array =
                    |bytes: &'a [u8]| Array { bytes: bytes.into(), number, axes: axes.clone() };
                let (real, imag) = bytes.split_at(bytes.len() / parts);
                if matrix.is_complex {
                    Array::collect_complex([&array(real), &array(imag)], name, found)?;
                } else {
                    array(real).collect(name, found)?;
                }
            }
        }
        1 => {}
        _ => found.leave_out(name, &SPARSE),
    }
    Ok(Some(matrix.rest.rest()))
}

fn header(bytes: &[u8]) -> Option<Matrix<'_>> {
    [false, true].into_iter().find_map(|big_endian| header_of(bytes, big_endian))
}

/// The header of a matrix; `None` if the bytes are none.
fn header_of(bytes: &[u8], big_endian: bool) -> Option<Matrix<'_>> {
    let mut cursor = Cursor::new(bytes, big_endian);
    // Decimal digits: byte order, zero, type of the numbers, class of the matrix.
    let code = cursor.u32()?;
    let (order, class) = (code / 1000, code % 10);
    if order != u32::from(big_endian) || code / 100 % 10 != 0 || class > 2 {
        return None;
    }
    let kind = match code / 10 % 10 {
        0 => NumberType::F64,
        1 => NumberType::F32,
        2 => NumberType::I32,
        3 => NumberType::I16,
        4 => NumberType::U16,
        5 => NumberType::U8,
        _ => return None,
    };
    let lengths = [cursor.count_u32()?, cursor.count_u32()?];
    let is_complex = match cursor.u32()? {
        0 => false,
        1 => true,
        _ => return None,
    };
    let length = cursor.count_u32().filter(|length| (2..=MOST_NAME).contains(length))?;
    let name = cursor.take(length)?.strip_suffix(b"\0")?;
    let name = String::from_utf8(name.to_vec()).ok()?;
    let named = |c: char| c.is_ascii_alphanumeric() || c == '_';
    if !name.starts_with(|c: char| c.is_ascii_alphabetic()) || !name.chars().all(named) {
        return None;
    }
    let number = Number::new(kind, big_endian);
    Some(Matrix { name, number, class, is_complex, lengths, rest: cursor })
}
