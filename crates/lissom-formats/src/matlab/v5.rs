//! MATLAB files of versions 5, 6 and 7.

use super::elements::{self, COMPRESSED, Element, MATRIX};
use super::left_out::{FUNCTIONS, SPARSE, TOO_DEEP, object};
use super::value::{Struct, Value, collect};
use crate::array::{Array, axes, items};
use crate::collected::Collected;
use crate::cursor::Cursor;
use crate::format::Format;
use crate::format_error::FormatError;
use crate::log_data::LogData;
use crate::number::Number;

/// Bytes before the first element.
const HEADER_BYTES: usize = 128;
/// Deepest nesting of structs and cells.
const MOST_DEPTH: usize = 32;
/// Longest text that is kept: units are short.
const MOST_TEXT: usize = 256;

const CELL: u32 = 1;
const STRUCT: u32 = 2;
const OLD_OBJECT: u32 = 3;
const CHARACTERS: u32 = 4;
const SPARSE_MATRIX: u32 = 5;
const FUNCTION: u32 = 16;
const OBJECT: u32 = 17;
const COMPLEX_FLAG: u32 = 0x800;

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
pub(crate) fn read(bytes: &[u8]) -> Result<LogData, FormatError> {
    let header = || FormatError::content("header", "the header of the MATLAB file is damaged");
    let big_endian = byte_order(bytes).ok_or_else(header)?;
    let mut found = Collected::new();
    let mut cursor = Cursor::new(bytes.get(HEADER_BYTES..).unwrap_or_default(), big_endian);
    let mut number = 0;
    while !cursor.rest().is_empty() {
        number += 1;
        let Some(element) = elements::next(&mut cursor) else {
            found.note(format!("the file ends inside variable {number}, which is left out"));
            break;
        };
        match variable(element, big_endian, &mut found) {
            Ok(()) => {}
            Err(error @ FormatError::TooLarge { .. }) => return Err(error),
            Err(error) => found.note(format!("variable {number} is left out: {error}")),
        }
    }
    found.finish(Format::Matlab)
}

/// Appends the channels of a variable.
fn variable(element: Element, big_endian: bool, found: &mut Collected) -> Result<(), FormatError> {
    match element.kind {
        MATRIX => {
            let wrong = || FormatError::content("variable", "its content is damaged");
            let reader = Reader { big_endian };
            let (name, value) = reader.matrix(element.data, 0, found)?.ok_or_else(wrong)?;
            // The variable without a name is the workspace of functions and objects.
            if name.is_empty() { Ok(()) } else { collect(&name, &value, found) }
        }
        COMPRESSED => {
            let bytes = element.expanded(big_endian, found)?;
            let inner = elements::next(&mut Cursor::new(&bytes, big_endian));
            let damaged = || FormatError::Damaged { reason: "they end too early".to_owned() };
            let inner = inner.filter(|inner| inner.kind != COMPRESSED).ok_or_else(damaged)?;
            variable(inner, big_endian, found)?;
            found.release_bytes(bytes.len());
            Ok(())
        }
        // Other elements are no variables.
        _ => Ok(()),
    }
}

/// Reads the arrays of a file; `None` is damaged content.
#[derive(Clone, Copy)]
struct Reader {
    big_endian: bool,
}

type Found<T> = Result<Option<T>, FormatError>;

impl Reader {
    /// Name and value of an array.
    fn matrix<'a>(
        self,
        data: &'a [u8],
        depth: usize,
        found: &mut Collected,
    ) -> Found<(String, Value<'a>)> {
        found.take_bytes(size_of::<Value>())?;
        let mut cursor = Cursor::new(data, self.big_endian);
        let Some((class, is_complex)) = self.flags(&mut cursor) else { return Ok(None) };
        if class == OBJECT {
            return Ok(opaque(&mut cursor));
        }
        let Some((lengths, name)) = self.shape(&mut cursor) else { return Ok(None) };
        if depth >= MOST_DEPTH {
            return Ok(Some((name, Value::LeftOut(&TOO_DEEP))));
        }
        let value = match class {
            CELL => self.cells(&mut cursor, &lengths, depth, found)?,
            STRUCT => self.fields(&mut cursor, &lengths, depth, found)?,
            OLD_OBJECT => match elements::next(&mut cursor) {
                Some(_class) => self.fields(&mut cursor, &lengths, depth, found)?,
                None => None,
            },
            CHARACTERS => elements::next(&mut cursor).map(|text| self.text(text, &lengths)),
            SPARSE_MATRIX => Some(Value::LeftOut(&SPARSE)),
            FUNCTION => Some(Value::LeftOut(&FUNCTIONS)),
            _ => {
                let real = self.numbers(&mut cursor, &lengths);
                let imag = is_complex.then(|| self.numbers(&mut cursor, &lengths));
                match (real, imag) {
                    (Some(real), Some(imag)) => imag.map(|imag| Value::Complex([real, imag])),
                    (real, _) => real.map(Value::Numbers),
                }
            }
        };
        Ok(value.map(|value| (name, value)))
    }

    /// Class of an array, and whether it is complex.
    fn flags(self, cursor: &mut Cursor) -> Option<(u32, bool)> {
        let word = *elements::next(cursor)?.words(self.big_endian).first()?;
        Some((word & 0xff, word & COMPLEX_FLAG != 0))
    }

    /// Lengths of the axes, and the name.
    fn shape(self, cursor: &mut Cursor) -> Option<(Vec<usize>, String)> {
        let lengths = elements::next(cursor)?.words(self.big_endian);
        let lengths = lengths.into_iter().map(|length| usize::try_from(length).ok());
        Some((lengths.collect::<Option<_>>()?, elements::next(cursor)?.name()))
    }

    fn numbers<'a>(self, cursor: &mut Cursor<'a>, lengths: &[usize]) -> Option<Array<'a>> {
        let Element { kind, data } = elements::next(cursor)?;
        let kind = elements::number_type(kind)?;
        let number = Number::new(kind, self.big_endian);
        Some(Array { bytes: data.into(), number, axes: axes(lengths, kind.size(), true)? })
    }

    /// A text of one row; others are no units, and an empty text takes their place.
    fn text<'a>(self, element: Element<'a>, lengths: &[usize]) -> Value<'a> {
        let is_row = matches!(lengths, [1, length] if *length <= MOST_TEXT);
        let text = if is_row { element.text(self.big_endian) } else { String::new() };
        Value::Text(text.trim().to_owned())
    }

    /// The next value of a cell array or a struct; an empty value takes no space.
    fn inner<'a>(
        self,
        cursor: &mut Cursor<'a>,
        depth: usize,
        found: &mut Collected,
    ) -> Found<Value<'a>> {
        let Some(element) = elements::next(cursor).filter(|e| e.kind == MATRIX) else {
            return Ok(None);
        };
        if element.data.is_empty() {
            found.take_bytes(size_of::<Value>())?;
            return Ok(Some(Value::Text(String::new())));
        }
        Ok(self.matrix(element.data, depth + 1, found)?.map(|(_, value)| value))
    }

    fn cells<'a>(
        self,
        cursor: &mut Cursor<'a>,
        lengths: &[usize],
        depth: usize,
        found: &mut Collected,
    ) -> Found<Value<'a>> {
        let mut cells = Vec::new();
        let Some(count) = items(lengths) else { return Ok(None) };
        for _ in 0..count {
            let Some(cell) = self.inner(cursor, depth, found)? else { return Ok(None) };
            cells.push(cell);
        }
        Ok(Some(Value::Cells(cells)))
    }

    fn fields<'a>(
        self,
        cursor: &mut Cursor<'a>,
        lengths: &[usize],
        depth: usize,
        found: &mut Collected,
    ) -> Found<Value<'a>> {
        let Some(fields) = self.field_names(cursor) else { return Ok(None) };
        let Some(count) = items(lengths).and_then(|count| count.checked_mul(fields.len())) else {
            return Ok(None);
        };
        let mut values = Vec::new();
        for _ in 0..count {
            let Some(value) = self.inner(cursor, depth, found)? else { return Ok(None) };
            values.push(value);
        }
        Ok(Some(Value::Struct(Struct { fields, values })))
    }

    fn field_names(self, cursor: &mut Cursor) -> Option<Vec<String>> {
        let length = *elements::next(cursor)?.words(self.big_endian).first()? as usize;
        let names = elements::next(cursor)?;
        if length == 0 {
            return names.data.is_empty().then(Vec::new);
        }
        let name = |data| Element { data, ..names }.name();
        Some(names.data.chunks(length).map(name).collect())
    }
}

/// Name of an object of a class that is not decoded; the note about it names the class.
fn opaque<'a>(cursor: &mut Cursor) -> Option<(String, Value<'a>)> {
    let name = elements::next(cursor)?.name();
    let _system = elements::next(cursor)?;
    let class = elements::next(cursor)?.name();
    Some((name, Value::LeftOut(object(&class))))
}
