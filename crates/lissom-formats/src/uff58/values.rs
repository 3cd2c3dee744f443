//! Values of a dataset 58, as text in fixed columns or as bytes.

use super::fortran_number::number;
use super::header::{Header, Lines};
use crate::collected::Collected;
use crate::format_error::FormatError;
use crate::number::{Number, NumberType};

/// Columns of a number of single and of double precision.
const SINGLE: usize = 13;
/// See [`SINGLE`].
const DOUBLE: usize = 20;

/// Whether the first line of a binary dataset states that its numbers are big endian.
pub(super) fn is_big_endian(first: &[u8]) -> bool {
    first.get(7..13).is_some_and(|order| order.trim_ascii() == b"2")
}

/// Reads binary values.
pub(super) fn binary(
    lines: &mut Lines,
    big_endian: bool,
    header: &Header,
    found: &mut Collected,
) -> Result<Vec<f64>, FormatError> {
    let kind = if header.is_double() { NumberType::F64 } else { NumberType::F32 };
    let count = header.points.saturating_mul(header.numbers_of_point());
    let bytes = lines.bytes(count.saturating_mul(kind.size()));
    found.take_bytes(bytes.len() / kind.size() * size_of::<f64>())?;
    let mut values = Vec::with_capacity(bytes.len() / kind.size());
    Number::new(kind, big_endian).append(&mut values, bytes, kind.size(), count);
    // The closing mark may follow the last byte, or be on a line of its own.
    lines.skip_line_ends();
    while lines.next().is_some_and(|line| !super::is_mark(line)) {}
    Ok(values)
}

/// Reads values in columns up to the closing mark; `None` if one is no number.
pub(super) fn text(
    lines: &mut Lines,
    header: &Header,
    name: &str,
    found: &mut Collected,
) -> Result<Option<Vec<f64>>, FormatError> {
    // Single precision: 6E13.5. Double precision: 4E20.12, or with an abscissa E13.5 before each sample.
    let widths: &[usize] = match (header.is_double(), header.is_even, header.is_complex()) {
        (false, ..) => &[SINGLE],
        (true, true, _) => &[DOUBLE],
        (true, false, false) => &[SINGLE, DOUBLE],
        (true, false, true) => &[SINGLE, DOUBLE, DOUBLE],
    };
    let mut values = Vec::new();
    let mut is_damaged = false;
    while let Some(line) = lines.next().filter(|line| !super::is_mark(line)) {
        let before = values.len();
        let mut rest = line;
        for width in widths.iter().cycle() {
            let (field, after) = rest.split_at((*width).min(rest.len()));
            // The last number of a file that is cut off is not whole.
            let is_cut = lines.is_open() && field.len() < *width;
            let field = field.trim_ascii();
            if field.is_empty() || is_cut || is_damaged {
                break;
            }
            let Some(value) = number(field) else {
                let (text, row) = (String::from_utf8_lossy(field), lines.row());
                found.note(format!("{name} is left out: {text:?} in row {row} is not a number"));
                is_damaged = true;
                break;
            };
            values.push(value);
            rest = after;
        }
        found.take_bytes((values.len() - before) * size_of::<f64>())?;
    }
    Ok((!is_damaged).then_some(values))
}
