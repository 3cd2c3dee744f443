//! Arrays of NumPy: `.npy`, and `.npz` archives of them.
//!
//! A structured array has a channel for each field, nested fields with a path. Pickled objects are never loaded.

mod array_type;
mod literal;

use array_type::{ArrayType, Kind, OBJECTS};

use crate::array::{Array, axes, items};
use crate::collected::Collected;
use crate::cursor::Cursor;
use crate::format::Format;
use crate::format_error::FormatError;
use crate::log_data::LogData;
use crate::number::{Number, NumberType};
use crate::zip::Entry;
use literal::Literal;

/// First bytes of an array.
pub(crate) const NPY: &[u8] = b"\x93NUMPY";
/// Longest header that is read; NumPy refuses those of more than 10 000 bytes.
const MOST_HEADER: usize = 1 << 20;

/// Reads an array; its channels are `data`, or the fields.
pub(crate) fn read_npy(bytes: &[u8]) -> Result<LogData, FormatError> {
    let mut found = Collected::new();
    collect("", bytes, &mut found)?;
    found.finish(Format::Npy)
}

/// Whether an archive contains arrays.
pub(crate) fn is_npz(entries: &[Entry]) -> bool {
    entries.iter().any(|entry| entry.name.strip_suffix(".npy").is_some())
}

/// Reads an archive of arrays; the names of the arrays are the names of the channels.
pub(crate) fn read_npz(bytes: &[u8], entries: &[Entry]) -> Result<LogData, FormatError> {
    let mut found = Collected::new();
    for entry in entries {
        let Some(name) = entry.name.strip_suffix(".npy") else { continue };
        found.take_bytes(entry.expanded_bytes())?;
        collect(name, &entry.content(bytes)?, &mut found)?;
        found.release_bytes(entry.expanded_bytes());
    }
    found.finish(Format::Npz)
}

/// Header of an array.
struct Header {
    of: ArrayType,
    first_is_fastest: bool,
    shape: Vec<usize>,
}

/// Appends the channels of an array.
fn collect(name: &str, bytes: &[u8], found: &mut Collected) -> Result<(), FormatError> {
    let label = if name.is_empty() { "data" } else { name };
    let wrong = |reason: &str| FormatError::content(label, reason);
    let (header, content) =
        header(bytes).ok_or_else(|| wrong("the header of the array is damaged or unknown"))?;
    if header.of.has_objects() {
        found.leave_out(label, &OBJECTS);
        return Ok(());
    }
    let shape = header.kept(label, content.len(), found)?;
    let size = header.of.size;
    let axes = axes(&shape, size, header.first_is_fastest)
        .ok_or_else(|| wrong("the array is larger than the file"))?;
    let array = Array { bytes: content.into(), number: Number::new(NumberType::U8, false), axes };
    fields(name, &header.of, &array, found)
}

/// Appends the channels of an array whose items are of a type; `array` has their places.
fn fields(
    name: &str,
    of: &ArrayType,
    array: &Array,
    found: &mut Collected,
) -> Result<(), FormatError> {
    let label = if name.is_empty() { "data" } else { name };
    let mut array = array.clone();
    array.axes.extend(&of.axes);
    match &of.kind {
        Kind::Number(number) => {
            array.number = *number;
            array.collect(label, found)
        }
        Kind::Complex(number) => {
            array.number = *number;
            let bytes = array.bytes.get(number.kind.size()..).unwrap_or_default().into();
            let imag = Array { bytes, number: *number, axes: array.axes.clone() };
            Array::collect_complex([&array, &imag], label, found)
        }
        Kind::Time { big_endian, unit_s, are_dates } => {
            let number = Number::new(NumberType::Ticks { origin: 0 }, *big_endian);
            array.number = if *are_dates { number.since_first(&array.bytes) } else { number };
            let first = found.channels.len();
            array.collect(label, found)?;
            for channel in found.channels.iter_mut().skip(first) {
                channel.values.iter_mut().for_each(|value| *value *= unit_s);
                channel.unit = Some("s".to_owned());
            }
            Ok(())
        }
        Kind::LeftOut(why) => {
            found.leave_out(label, why);
            Ok(())
        }
        Kind::Padding => Ok(()),
        Kind::Record(record) => {
            for field in record {
                let path = match name {
                    "" => field.name.clone(),
                    name => format!("{name}/{}", field.name),
                };
                let bytes = array.bytes.get(field.offset..).unwrap_or_default().into();
                let (number, axes) = (array.number, array.axes.clone());
                fields(&path, &field.of, &Array { bytes, number, axes }, found)?;
            }
            Ok(())
        }
    }
}

/// Header and content of an array.
fn header(bytes: &[u8]) -> Option<(Header, &[u8])> {
    let mut cursor = Cursor::new(bytes.strip_prefix(NPY)?, false);
    let version = cursor.u8()?;
    cursor.u8()?;
    let length = if version == 1 { usize::from(cursor.u16()?) } else { cursor.count_u32()? };
    let text = std::str::from_utf8(cursor.take(length).filter(|_| length <= MOST_HEADER)?).ok()?;
    let literal = literal::parsed(text)?;
    let of = ArrayType::of(literal.entry("descr")?, 0)?;
    let Literal::Truth(first_is_fastest) = *literal.entry("fortran_order")? else { return None };
    let shape = literal.entry("shape")?.counts()?;
    Some((Header { of, first_is_fastest, shape }, cursor.rest()))
}

impl Header {
    /// The shape, shortened if the file is cut off.
    fn kept(
        &self,
        name: &str,
        available: usize,
        found: &mut Collected,
    ) -> Result<Vec<usize>, FormatError> {
        let mut shape = self.shape.clone();
        let wanted = items(&shape).and_then(|count| count.checked_mul(self.of.size));
        if wanted.is_some_and(|wanted| wanted <= available) {
            return Ok(shape);
        }
        // A shorter log is left if the slowest axis counts the samples.
        let slowest = if self.first_is_fastest {
            shape.pop()
        } else {
            (!shape.is_empty()).then(|| shape.remove(0))
        };
        let row = items(&shape).and_then(|count| count.checked_mul(self.of.size));
        let rows = row.and_then(|row| available.checked_div(row)).unwrap_or(0);
        let others = shape.iter().copied().max().unwrap_or(1);
        let Some(all) = slowest.filter(|_| rows > others) else {
            return Err(FormatError::content(name, "the file ends inside the array"));
        };
        shape.insert(if self.first_is_fastest { shape.len() } else { 0 }, rows);
        found.note(format!("{name}: the file ends after {rows} of {all} samples"));
        Ok(shape)
    }
}
