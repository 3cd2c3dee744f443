//! MATLAB files of version 4: a header of 20 bytes before each matrix.

use super::left_out::SPARSE;
use crate::array::{Array, axes};
use crate::channel_ref::Wanted;
use crate::collected::Collected;
use crate::columns::read_values;
use crate::cursor::Cursor;
use crate::format::Format;
use crate::format_error::FormatError;
use crate::log_data::LogData;
use crate::number::{Number, NumberType};
use crate::source::Source;
use crate::stream::Stream;

/// Longest name with its final zero; MATLAB's are shorter.
const MOST_NAME: usize = 256;
/// Bytes of a header with the longest name.
const MOST_HEADER: u64 = 20 + MOST_NAME as u64;

/// A matrix of a file.
struct Matrix {
    name: String,
    number: Number,
    class: u32,
    is_complex: bool,
    lengths: [usize; 2],
    /// Bytes of the header.
    header_bytes: usize,
}

/// Whether a file begins as a MATLAB file of version 4 does. There is no mark: the header must make sense.
pub(crate) fn begins(bytes: &[u8]) -> bool {
    header(bytes).is_some()
}

/// Reads a file.
pub(crate) fn read(source: &Source, wanted: Wanted) -> Result<LogData, FormatError> {
    let mut found = Collected::of(wanted);
    let mut place = 0;
    while place < source.length() {
        let bytes = source.bytes(place..place + MOST_HEADER)?;
        let Some(matrix) = header(&bytes) else {
            found.note("the file ends inside the header of a matrix, or is damaged there");
            break;
        };
        let begin = place + matrix.header_bytes as u64;
        let Some(bytes) = matrix.bytes().filter(|bytes| *bytes as u64 <= source.length() - begin)
        else {
            found.note(format!("the file ends inside {}, which is left out", matrix.name));
            break;
        };
        place = begin + bytes as u64;
        matrix.collect(bytes, source.part(begin..place), &mut found)?;
    }
    found.finish(Format::Matlab)
}

impl Matrix {
    /// Its number of bytes; `None` if it is too large for this computer.
    fn bytes(&self) -> Option<usize> {
        let [rows, columns] = self.lengths;
        let size = self.number.kind.size() * if self.is_complex { 2 } else { 1 };
        rows.checked_mul(columns)?.checked_mul(size)
    }

    /// Appends its channels.
    fn collect(
        &self,
        bytes: usize,
        mut content: Stream,
        found: &mut Collected,
    ) -> Result<(), FormatError> {
        let (name, number) = (&self.name, self.number);
        let size = number.kind.size();
        match self.class {
            0 => {}
            1 => return Ok(()),
            _ => {
                found.leave_out(name, &SPARSE);
                return Ok(());
            }
        }
        let Some(axes) = axes(&self.lengths, size, true) else { return Ok(()) };
        let mut arrays = Vec::new();
        let mut first = found.channels.len() + 1;
        let parts: &[&str] = if self.is_complex { &["/real", "/imag"] } else { &[""] };
        for (k, part) in parts.iter().enumerate() {
            let offset = k * bytes / 2;
            let array = Array { number, offset, axes: axes.clone() };
            let columns = array.columns(name, part, Some(first), bytes, found)?;
            first += columns.all.len();
            arrays.push(columns);
        }
        read_values(&mut arrays, size, bytes as u64, &mut content)?;
        for columns in arrays {
            columns.push(name, found);
        }
        Ok(())
    }
}

fn header(bytes: &[u8]) -> Option<Matrix> {
    [false, true].into_iter().find_map(|big_endian| header_of(bytes, big_endian))
}

/// The header of a matrix; `None` if the bytes are none.
fn header_of(bytes: &[u8], big_endian: bool) -> Option<Matrix> {
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
    let header_bytes = bytes.len() - cursor.rest().len();
    Some(Matrix { name, number, class, is_complex, lengths, header_bytes })
}
