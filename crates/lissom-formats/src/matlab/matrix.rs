//! Arrays in MATLAB files of versions 5, 6 and 7, with the arrays inside them.

use super::elements::{self, Elements, MATRIX};
use super::left_out::{FUNCTIONS, SPARSE, TOO_DEEP, object};
use super::value::{Struct, Value};
use crate::array::{Array, axes, items};
use crate::collected::Collected;
use crate::columns::{Columns, read_values};
use crate::format_error::FormatError;
use crate::number::Number;
use crate::stream::Input;

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

/// `None` is damaged content.
type Found<T> = Result<Option<T>, FormatError>;

/// Reads the arrays of a variable. Places are counted from the beginning of its bytes.
pub(super) struct MatrixReader<'a> {
    elements: Elements<'a>,
    has_read: bool,
    has_skipped: bool,
}

impl<'a> MatrixReader<'a> {
    /// A reader of bytes, of which the first one has a place.
    pub(super) fn new(input: &'a mut dyn Input, at: u64, big_endian: bool) -> Self {
        let elements = Elements::new(input, at, big_endian);
        Self { elements, has_read: false, has_skipped: false }
    }

    /// Whether no channel of the variable is wanted.
    pub(super) fn is_unwanted(&self) -> bool {
        self.has_skipped && !self.has_read
    }

    /// Name and value of an array whose content ends at `end`. An array inside another one is at a path.
    pub(super) fn matrix(
        &mut self,
        end: u64,
        path: Option<&str>,
        depth: usize,
        found: &mut Collected,
    ) -> Found<(String, Value)> {
        found.take_bytes(size_of::<Value>())?;
        let Some((class, is_complex)) = self.flags(end)? else { return Ok(None) };
        if class == OBJECT {
            return self.opaque(end);
        }
        let Some((lengths, name)) = self.shape(end)? else { return Ok(None) };
        if depth >= MOST_DEPTH {
            return Ok(Some((name, Value::LeftOut(&TOO_DEEP))));
        }
        let path = path.unwrap_or(&name);
        let value = match class {
            CELL => self.cells(end, path, &lengths, depth, found)?,
            STRUCT => self.fields(end, path, &lengths, depth, found)?,
            OLD_OBJECT => match self.elements.next_data(end)? {
                Some(_class) => self.fields(end, path, &lengths, depth, found)?,
                None => None,
            },
            CHARACTERS => self.text(end, &lengths)?,
            SPARSE_MATRIX => Some(Value::LeftOut(&SPARSE)),
            FUNCTION => Some(Value::LeftOut(&FUNCTIONS)),
            _ => {
                let number = (depth == 0).then_some(found.channels.len() + 1);
                self.numbers(end, path, &lengths, is_complex, number, found)?
            }
        };
        Ok(value.map(|value| (name, value)))
    }

    /// Class of an array, and whether it is complex.
    fn flags(&mut self, end: u64) -> Found<(u32, bool)> {
        let data = self.elements.next_data(end)?;
        let word = data.and_then(|data| data.words().first().copied());
        Ok(word.map(|word| (word & 0xff, word & COMPLEX_FLAG != 0)))
    }

    /// Lengths of the axes, and the name.
    fn shape(&mut self, end: u64) -> Found<(Vec<usize>, String)> {
        let Some(lengths) = self.elements.next_data(end)? else { return Ok(None) };
        let Some(name) = self.elements.next_data(end)? else { return Ok(None) };
        Ok(Some((lengths.words().into_iter().map(|length| length as usize).collect(), name.name())))
    }

    /// Numbers, which are real or complex; the first channel has this number in the file, if it is known.
    fn numbers(
        &mut self,
        end: u64,
        path: &str,
        lengths: &[usize],
        is_complex: bool,
        number: Option<usize>,
        found: &mut Collected,
    ) -> Found<Value> {
        if !is_complex {
            let real = self.part(end, (path, ""), lengths, number, found)?;
            return Ok(real.map(|real| real.map_or(Value::TooLarge, Value::Numbers)));
        }
        let Some(real) = self.part(end, (path, "/real"), lengths, number, found)? else {
            return Ok(None);
        };
        let channels = real.as_ref().map_or(0, |real| real.all.len());
        let number = number.map(|number| number + channels);
        let imag = self.part(end, (path, "/imag"), lengths, number, found)?;
        Ok(imag.map(|imag| match (real, imag) {
            (Some(real), Some(imag)) => Value::Complex([real, imag]),
            _ => Value::TooLarge,
        }))
    }

    /// The real or the imaginary part of numbers; the inner `None` is an array that is larger than the file.
    fn part(
        &mut self,
        end: u64,
        (path, part): (&str, &'static str),
        lengths: &[usize],
        number: Option<usize>,
        found: &mut Collected,
    ) -> Found<Option<Columns>> {
        let Some(element) = self.elements.next(end)? else { return Ok(None) };
        let Some(kind) = elements::number_type(element.kind) else { return Ok(None) };
        let Some(axes) = axes(lengths, kind.size(), true) else { return Ok(None) };
        let array = Array { number: Number::new(kind, self.elements.big_endian), offset: 0, axes };
        let columns = array.columns(path, part, number, element.size as usize, found);
        let mut columns = match columns {
            Ok(columns) => columns,
            Err(error @ FormatError::TooLarge { .. }) => return Err(error),
            Err(_) => return Ok(self.elements.leave(&element)?.map(|()| None)),
        };
        if columns.length > 1 {
            self.has_read |= columns.next().is_some();
            self.has_skipped |= columns.all.iter().any(|column| column.values.is_none());
        }
        if let Some(small) = element.small() {
            columns.append(small, 0);
        } else {
            let arrays = std::slice::from_mut(&mut columns);
            let read = read_values(arrays, kind.size(), element.size, &mut self.elements)?;
            if read.is_none() {
                return Ok(None);
            }
        }
        // Behind a part that is not wanted the other part may be wanted.
        if part == "/real" && self.elements.leave(&element)?.is_none() {
            return Ok(None);
        }
        Ok(Some(Some(columns)))
    }

    /// A text of one row; others are no units, and an empty text takes their place.
    fn text(&mut self, end: u64, lengths: &[usize]) -> Found<Value> {
        if matches!(lengths, [1, length] if *length <= MOST_TEXT) {
            let data = self.elements.next_data(end)?;
            return Ok(data.map(|data| Value::Text(data.text().trim().to_owned())));
        }
        Ok(self.elements.next(end)?.map(|_| Value::Text(String::new())))
    }

    /// The next value of a cell array or a struct; an empty value takes no space.
    fn inner(&mut self, end: u64, path: &str, depth: usize, found: &mut Collected) -> Found<Value> {
        let Some(element) = self.elements.next(end)?.filter(|e| e.kind == MATRIX) else {
            return Ok(None);
        };
        if element.size == 0 {
            found.take_bytes(size_of::<Value>())?;
            return Ok(Some(Value::Text(String::new())));
        }
        let value = self.matrix(element.end, Some(path), depth + 1, found)?;
        let left = self.elements.leave(&element)?;
        Ok(value.filter(|_| left.is_some()).map(|(_, value)| value))
    }

    fn cells(
        &mut self,
        end: u64,
        path: &str,
        lengths: &[usize],
        depth: usize,
        found: &mut Collected,
    ) -> Found<Value> {
        let mut cells = Vec::new();
        let Some(count) = items(lengths) else { return Ok(None) };
        for k in 0..count {
            let path = format!("{path}[{}]", k + 1);
            let Some(cell) = self.inner(end, &path, depth, found)? else { return Ok(None) };
            cells.push(cell);
        }
        Ok(Some(Value::Cells(cells)))
    }

    fn fields(
        &mut self,
        end: u64,
        path: &str,
        lengths: &[usize],
        depth: usize,
        found: &mut Collected,
    ) -> Found<Value> {
        let Some(fields) = self.field_names(end)? else { return Ok(None) };
        let Some(elements) = items(lengths) else { return Ok(None) };
        if elements.checked_mul(fields.len()).is_none() {
            return Ok(None);
        }
        let mut of = Struct { fields, values: Vec::new() };
        if of.fields.is_empty() {
            return Ok(Some(Value::Struct(of)));
        }
        for k in 0..elements {
            let path = Struct::path(path, k, elements);
            for place in 0..of.fields.len() {
                let Some(field) = of.fields.get(place) else { continue };
                let path = format!("{path}/{field}");
                let all = of.is_clock(field).then(|| found.want_all());
                let value = self.inner(end, &path, depth, found);
                if let Some(wanted) = all {
                    found.wanted = wanted;
                }
                let Some(value) = value? else { return Ok(None) };
                of.values.push(value);
            }
        }
        Ok(Some(Value::Struct(of)))
    }

    fn field_names(&mut self, end: u64) -> Found<Vec<String>> {
        let Some(length) = self.elements.next_data(end)? else { return Ok(None) };
        let Some(length) = length.words().first().map(|length| *length as usize) else {
            return Ok(None);
        };
        let Some(names) = self.elements.next_data(end)? else { return Ok(None) };
        if length == 0 {
            return Ok(names.bytes.is_empty().then(Vec::new));
        }
        Ok(Some(names.bytes.chunks(length).map(elements::name).collect()))
    }

    /// Name of an object of a class that is not decoded; the note about it names the class.
    fn opaque(&mut self, end: u64) -> Found<(String, Value)> {
        let mut data = || self.elements.next_data(end);
        let (Some(name), Some(_system), Some(class)) = (data()?, data()?, data()?) else {
            return Ok(None);
        };
        Ok(Some((name.name(), Value::LeftOut(object(&class.name())))))
    }
}
