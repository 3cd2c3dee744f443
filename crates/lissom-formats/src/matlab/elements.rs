//! Data elements of MATLAB files of version 5: a type, a size, and the data.

use crate::cursor::Cursor;
use crate::format_error::FormatError;
use crate::number::NumberType;
use crate::stream::Input;

/// Type of an element that contains an array.
pub(super) const MATRIX: u32 = 14;
/// Type of an element that contains a compressed element.
pub(super) const COMPRESSED: u32 = 15;
/// Bytes of type and size.
pub(super) const TAG_BYTES: usize = 8;

/// Type and place of a data element.
#[derive(Debug, Clone, Copy)]
pub(super) struct Element {
    pub(super) kind: u32,
    /// Number of bytes of its data.
    pub(super) size: u64,
    /// Place behind its data.
    pub(super) end: u64,
    /// Place of the next element.
    next: u64,
    /// Data that are in place of the size.
    small: Option<[u8; 4]>,
}

impl Element {
    /// The element with this tag, which is at a place; `None` if bytes that end at `end` do not have all of it.
    pub(super) fn of(tag: &[u8], place: u64, end: u64, big_endian: bool) -> Option<Self> {
        let mut cursor = Cursor::new(tag, big_endian);
        let word = cursor.u32()?;
        let (small, kind) = (word >> 16, word & 0xffff);
        let behind = place.checked_add(TAG_BYTES as u64)?;
        if small != 0 {
            // Up to four bytes of data are in place of the size.
            let data = *cursor.take(4)?.first_chunk()?;
            let size = u64::from(small);
            return (size <= 4 && behind <= end).then_some(Self {
                kind,
                size,
                end: behind,
                next: behind,
                small: Some(data),
            });
        }
        let size = u64::from(cursor.u32()?);
        let data_end = behind.checked_add(size).filter(|place| *place <= end)?;
        let padding = if kind == COMPRESSED { 0 } else { size.next_multiple_of(8) - size };
        let next = data_end.saturating_add(padding).min(end);
        Some(Self { kind, size, end: data_end, next, small: None })
    }

    /// Place of the next element.
    pub(super) fn next(&self) -> u64 {
        self.next
    }

    /// Its data, if they are in place of its size.
    pub(super) fn small(&self) -> Option<&[u8]> {
        self.small.as_ref().and_then(|data| data.get(..self.size as usize))
    }
}

/// Type of the numbers of an element.
pub(super) fn number_type(kind: u32) -> Option<NumberType> {
    Some(match kind {
        1 => NumberType::I8,
        2 => NumberType::U8,
        3 => NumberType::I16,
        4 => NumberType::U16,
        5 => NumberType::I32,
        6 => NumberType::U32,
        7 => NumberType::F32,
        9 => NumberType::F64,
        12 => NumberType::I64,
        13 => NumberType::U64,
        _ => return None,
    })
}

/// Elements that follow each other, and elements inside them.
pub(super) struct Elements<'a> {
    input: &'a mut dyn Input,
    /// Place of the next byte.
    at: u64,
    pub(super) big_endian: bool,
}

impl<'a> Elements<'a> {
    /// The elements in bytes, of which the first one has a place.
    pub(super) fn new(input: &'a mut dyn Input, at: u64, big_endian: bool) -> Self {
        Self { input, at, big_endian }
    }

    /// The next element inside an element that ends at `end`; `None` if it is not there as a whole.
    pub(super) fn next(&mut self, end: u64) -> Result<Option<Element>, FormatError> {
        let (place, big_endian) = (self.at, self.big_endian);
        if place.saturating_add(TAG_BYTES as u64) > end {
            return Ok(None);
        }
        let tag = self.next_bytes(TAG_BYTES)?;
        Ok(tag.and_then(|tag| Element::of(tag, place, end, big_endian)))
    }

    /// The data of the next element in memory, with its type.
    pub(super) fn next_data(&mut self, end: u64) -> Result<Option<Data>, FormatError> {
        let Some(element) = self.next(end)? else { return Ok(None) };
        let (kind, big_endian) = (element.kind, self.big_endian);
        let bytes = match element.small() {
            Some(small) => small.to_vec(),
            None => match self.next_bytes(element.size as usize)? {
                Some(bytes) => bytes.to_vec(),
                None => return Ok(None),
            },
        };
        Ok(self.leave(&element)?.map(|()| Data { kind, bytes, big_endian }))
    }

    /// Goes on to the element behind this one; `None` if the bytes end before.
    pub(super) fn leave(&mut self, element: &Element) -> Result<Option<()>, FormatError> {
        self.skip(element.next.saturating_sub(self.at))
    }
}

impl Input for Elements<'_> {
    fn next_bytes(&mut self, count: usize) -> Result<Option<&[u8]>, FormatError> {
        self.at = self.at.saturating_add(count as u64);
        self.input.next_bytes(count)
    }

    fn skip(&mut self, count: u64) -> Result<Option<()>, FormatError> {
        self.at = self.at.saturating_add(count);
        self.input.skip(count)
    }
}

/// Data of an element.
pub(super) struct Data {
    kind: u32,
    pub(super) bytes: Vec<u8>,
    big_endian: bool,
}

impl Data {
    /// Its numbers as counts of 32 bits.
    pub(super) fn words(&self) -> Vec<u32> {
        let mut cursor = Cursor::new(&self.bytes, self.big_endian);
        std::iter::from_fn(|| cursor.u32()).collect()
    }

    /// Its bytes as a name.
    pub(super) fn name(&self) -> String {
        name(&self.bytes)
    }

    /// Its characters.
    pub(super) fn text(&self) -> String {
        match self.kind {
            // UTF-16, and Windows-1252 in 16 bits.
            3 | 4 | 17 => {
                let mut cursor = Cursor::new(&self.bytes, self.big_endian);
                let units: Vec<u16> = std::iter::from_fn(|| cursor.u16()).collect();
                String::from_utf16_lossy(&units)
            }
            16 => String::from_utf8_lossy(&self.bytes).into_owned(),
            _ => self.bytes.iter().map(|byte| char::from(*byte)).collect(),
        }
    }
}

/// Bytes up to a zero as a name.
pub(super) fn name(bytes: &[u8]) -> String {
    let end = bytes.iter().position(|byte| *byte == 0).unwrap_or(bytes.len());
    String::from_utf8_lossy(bytes.get(..end).unwrap_or_default()).into_owned()
}
