//! Data elements of MATLAB files of version 5: a type, a size, and the data.

use std::io::Read;

use flate2::read::ZlibDecoder;

use crate::collected::Collected;
use crate::cursor::Cursor;
use crate::format_error::FormatError;
use crate::number::NumberType;

/// Type of an element that contains an array.
pub(super) const MATRIX: u32 = 14;
/// Type of an element that contains a compressed element.
pub(super) const COMPRESSED: u32 = 15;
/// Bytes of type and size.
const TAG_BYTES: usize = 8;
/// Most bytes that deflate makes of one.
const LARGEST_RATIO: usize = 1032;

/// A data element.
#[derive(Debug, Clone, Copy)]
pub(super) struct Element<'a> {
    pub(super) kind: u32,
    pub(super) data: &'a [u8],
}

/// The next element; `None` if the bytes end before its end.
pub(super) fn next<'a>(cursor: &mut Cursor<'a>) -> Option<Element<'a>> {
    let word = cursor.u32()?;
    let (small, kind) = (word >> 16, word & 0xffff);
    if small != 0 {
        // Up to four bytes of data are in place of the size.
        let data = cursor.take(4)?.get(..small as usize)?;
        return Some(Element { kind, data });
    }
    let size = cursor.count_u32()?;
    let data = cursor.take(size)?;
    if kind != COMPRESSED {
        let padding = size.next_multiple_of(8) - size;
        cursor.take(padding.min(cursor.rest().len()));
    }
    Some(Element { kind, data })
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

impl Element<'_> {
    /// Its numbers as counts of 32 bits.
    pub(super) fn words(self, big_endian: bool) -> Vec<u32> {
        let mut cursor = Cursor::new(self.data, big_endian);
        std::iter::from_fn(|| cursor.u32()).collect()
    }

    /// Its bytes as a name.
    pub(super) fn name(self) -> String {
        let end = self.data.iter().position(|byte| *byte == 0).unwrap_or(self.data.len());
        String::from_utf8_lossy(self.data.get(..end).unwrap_or_default()).into_owned()
    }

    /// Its characters.
    pub(super) fn text(self, big_endian: bool) -> String {
        match self.kind {
            // UTF-16, and Windows-1252 in 16 bits.
            3 | 4 | 17 => {
                let mut cursor = Cursor::new(self.data, big_endian);
                let units: Vec<u16> = std::iter::from_fn(|| cursor.u16()).collect();
                String::from_utf16_lossy(&units)
            }
            16 => String::from_utf8_lossy(self.data).into_owned(),
            _ => self.data.iter().map(|byte| char::from(*byte)).collect(),
        }
    }

    /// The bytes of the element in this compressed one, with its tag.
    pub(super) fn expanded(
        self,
        big_endian: bool,
        found: &mut Collected,
    ) -> Result<Vec<u8>, FormatError> {
        let damaged = |error: std::io::Error| FormatError::Damaged { reason: error.to_string() };
        let mut decoder = ZlibDecoder::new(self.data);
        let mut bytes = vec![0; TAG_BYTES];
        decoder.read_exact(&mut bytes).map_err(damaged)?;
        let size = Cursor::new(bytes.get(4..).unwrap_or_default(), big_endian).count_u32();
        let size = size.unwrap_or(0).min(self.data.len().saturating_mul(LARGEST_RATIO));
        found.take_bytes(size)?;
        bytes.reserve_exact(size);
        decoder.by_ref().take(size as u64).read_to_end(&mut bytes).map_err(damaged)?;
        // Reading on to the end checks the checksum.
        match decoder.read(&mut [0]).map_err(damaged)? {
            0 => Ok(bytes),
            _ => Err(FormatError::Damaged { reason: "they are longer than stated".to_owned() }),
        }
    }
}
