//! Arrays of NumPy: `.npy`, and `.npz` archives of them.
//!
//! A structured array has a channel for each field, nested fields with a path. Pickled objects are never loaded.

mod array_type;
mod literal;

use array_type::{ArrayType, Kind, OBJECTS};

use crate::array::{Array, Axis, axes, items};
use crate::channel_ref::Wanted;
use crate::collected::Collected;
use crate::columns::{Columns, read_values};
use crate::cursor::Cursor;
use crate::format::Format;
use crate::format_error::FormatError;
use crate::log_data::LogData;
use crate::number::{Number, NumberType};
use crate::source::Source;
use crate::stream::Input;
use crate::zip::Entry;
use literal::Literal;

/// First bytes of an array.
pub(crate) const NPY: &[u8] = b"\x93NUMPY";
/// Longest header that is read; NumPy refuses those of more than 10 000 bytes.
const MOST_HEADER: usize = 1 << 20;

/// Reads an array; its channels are `data`, or the fields.
pub(crate) fn read_npy(source: &Source, wanted: Wanted) -> Result<LogData, FormatError> {
    let mut found = Collected::of(wanted);
    collect("", &mut source.stream(0), source.length(), &mut found)?;
    found.finish(Format::Npy)
}

/// Whether an archive contains arrays.
pub(crate) fn is_npz(entries: &[Entry]) -> bool {
    entries.iter().any(|entry| entry.name.strip_suffix(".npy").is_some())
}

/// Reads an archive of arrays; the names of the arrays are the names of the channels.
pub(crate) fn read_npz(
    source: &Source,
    entries: &[Entry],
    wanted: Wanted,
) -> Result<LogData, FormatError> {
    let mut found = Collected::of(wanted);
    for entry in entries {
        let Some(name) = entry.name.strip_suffix(".npy") else { continue };
        found.take_bytes(entry.expanded_bytes())?;
        found.release_bytes(entry.expanded_bytes());
        let mut content = entry.content(source)?;
        let bytes = content.left();
        match collect(name, &mut content, bytes, &mut found) {
            // Nothing of the array is wanted: the rest of the entry is not expanded.
            Ok(false) => {}
            collected => {
                content.finish()?;
                collected?;
            }
        }
    }
    found.finish(Format::Npz)
}

/// Header of an array.
struct Header {
    of: ArrayType,
    first_is_fastest: bool,
    shape: Vec<usize>,
}

/// Appends the channels of an array of a number of bytes, with its header. False if no channel of it is wanted.
fn collect(
    name: &str,
    input: &mut dyn Input,
    bytes: u64,
    found: &mut Collected,
) -> Result<bool, FormatError> {
    let label = if name.is_empty() { "data" } else { name };
    let wrong = |reason: &str| FormatError::content(label, reason);
    let (header, header_bytes) =
        header(input)?.ok_or_else(|| wrong("the header of the array is damaged or unknown"))?;
    if header.of.has_objects() {
        found.leave_out(label, &OBJECTS);
        return Ok(true);
    }
    let bytes = usize::try_from(bytes).unwrap_or(usize::MAX).saturating_sub(header_bytes);
    let shape = header.kept(label, bytes, found)?;
    let size = header.of.size;
    let axes = axes(&shape, size, header.first_is_fastest)
        .ok_or_else(|| wrong("the array is larger than the file"))?;
    let mut fields = Fields { bytes, number: found.channels.len() + 1, all: Vec::new() };
    fields.add(name, &header.of, (0, axes), found)?;
    let (mut arrays, others): (Vec<_>, Vec<_>) =
        fields.all.into_iter().map(|field| (field.columns, (field.path, field.unit_s))).unzip();
    let is_read = arrays.iter().any(|array| array.next().is_some());
    let is_skipped = !is_read && arrays.iter().any(|array| !array.all.is_empty());
    read_values(&mut arrays, size, bytes as u64, input)?
        .ok_or_else(|| wrong("the file ends inside the array"))?;
    for (columns, (path, unit_s)) in arrays.into_iter().zip(others) {
        let first = found.channels.len();
        columns.push(&path, found);
        for channel in found.channels.iter_mut().skip(first) {
            if let Some(unit_s) = unit_s {
                channel.values.iter_mut().for_each(|value| *value *= unit_s);
                channel.unit = Some("s".to_owned());
            }
        }
    }
    Ok(!is_skipped)
}

/// The arrays of numbers in an array.
struct Fields {
    /// Number of bytes of the array.
    bytes: usize,
    /// Number in the file of the next channel.
    number: usize,
    all: Vec<Field>,
}

/// An array of numbers in an array.
struct Field {
    path: String,
    columns: Columns,
    /// The unit of times \[s\].
    unit_s: Option<f64>,
}

impl Fields {
    /// Adds the arrays of numbers of items of a type; the first item begins at an offset.
    fn add(
        &mut self,
        name: &str,
        of: &ArrayType,
        (offset, axes): (usize, Vec<Axis>),
        found: &mut Collected,
    ) -> Result<(), FormatError> {
        let label = if name.is_empty() { "data" } else { name };
        let axes = [axes, of.axes.clone()].concat();
        let array = |number: Number, offset: usize| Array { number, offset, axes: axes.clone() };
        match &of.kind {
            Kind::Number(number) => self.push(label, "", &array(*number, offset), None, found),
            Kind::Complex(number) => {
                self.push(label, "/real", &array(*number, offset), None, found)?;
                let imag = array(*number, offset + number.kind.size());
                self.push(label, "/imag", &imag, None, found)
            }
            Kind::Time { big_endian, unit_s, are_dates } => {
                let number = Number::new(NumberType::Ticks { origin: 0 }, *big_endian);
                self.push(label, "", &array(number, offset), Some(*unit_s), found)?;
                if let Some(field) = self.all.last_mut().filter(|_| *are_dates) {
                    field.columns.first_time = Some(offset);
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
                    let place = (offset + field.offset, axes.clone());
                    self.add(&path, &field.of, place, found)?;
                }
                Ok(())
            }
        }
    }

    fn push(
        &mut self,
        name: &str,
        part: &'static str,
        array: &Array,
        unit_s: Option<f64>,
        found: &mut Collected,
    ) -> Result<(), FormatError> {
        let columns = array.columns(name, part, Some(self.number), self.bytes, found)?;
        self.number += columns.all.len();
        self.all.push(Field { path: name.to_owned(), columns, unit_s });
        Ok(())
    }
}

/// Header of an array, and its number of bytes; `None` if it is damaged or unknown.
fn header(input: &mut dyn Input) -> Result<Option<(Header, usize)>, FormatError> {
    /// Bytes of mark and version.
    const BEGIN: usize = NPY.len() + 2;
    let version =
        input.next_bytes(BEGIN)?.and_then(|begin| begin.strip_prefix(NPY)?.first().copied());
    let Some(version) = version else { return Ok(None) };
    let size = if version == 1 { 2 } else { 4 };
    let Some(length) = input.next_bytes(size)? else { return Ok(None) };
    let mut cursor = Cursor::new(length, false);
    let length = if version == 1 { cursor.u16().map(usize::from) } else { cursor.count_u32() };
    let Some(length) = length.filter(|length| *length <= MOST_HEADER) else { return Ok(None) };
    let header = input.next_bytes(length)?.and_then(header_of);
    Ok(header.map(|header| (header, BEGIN + size + length)))
}

fn header_of(text: &[u8]) -> Option<Header> {
    let literal = literal::parsed(std::str::from_utf8(text).ok()?)?;
    let of = ArrayType::of(literal.entry("descr")?, 0)?;
    let Literal::Truth(first_is_fastest) = *literal.entry("fortran_order")? else { return None };
    let shape = literal.entry("shape")?.counts()?;
    Some(Header { of, first_is_fastest, shape })
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
