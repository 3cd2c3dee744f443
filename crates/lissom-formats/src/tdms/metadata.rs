//! Metadata of TDMS segments: paths, properties, and how the raw data are stored.

use std::collections::HashMap;

use super::daqmx::{self, Daqmx};
use super::raw_index::{RawIndex, RawType};
use crate::cursor::Cursor;
use crate::number::{Number, NumberType};

/// The object has no raw data.
const NO_RAW_DATA: u32 = u32::MAX;
/// The raw data are stored as those before.
const AS_BEFORE: u32 = 0;
/// Raw data of NI-DAQmx: of analog channels, and of digital lines.
const DAQMX: [u32; 2] = [0x1269, 0x126a];

/// Type of a value, as the number in the file.
const TEXT: u32 = 0x20;
const TIME_STAMP: u32 = 0x44;

/// A property of an object.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Property {
    Number(f64),
    Text(String),
    /// A date; none is used.
    TimeStamp,
}

impl Property {
    pub(super) fn number(&self) -> Option<f64> {
        match self {
            Self::Number(number) => Some(*number),
            _ => None,
        }
    }
}

/// What a segment states about the raw data of an object.
pub(super) enum Index {
    None,
    AsBefore,
    New(RawIndex),
    Daqmx(RawIndex, Daqmx),
}

/// A text with its length before it.
pub(super) fn text(cursor: &mut Cursor) -> Option<String> {
    let length = cursor.count_u32()?;
    Some(String::from_utf8_lossy(cursor.take(length)?).into_owned())
}

/// The names in a path such as `/'group'/'channel'`; a quote in a name is doubled.
pub(super) fn names(path: &str) -> Vec<String> {
    let mut names = Vec::new();
    let mut characters = path.chars().peekable();
    while characters.next() == Some('/') && characters.next_if_eq(&'\'').is_some() {
        let mut name = String::new();
        while let Some(c) = characters.next() {
            if c == '\'' && characters.next_if_eq(&'\'').is_none() {
                break;
            }
            name.push(c);
        }
        names.push(name);
    }
    names
}

/// Reads how the raw data of an object are stored; `None` if that is damaged.
pub(super) fn raw_index(cursor: &mut Cursor) -> Option<Index> {
    let header = cursor.u32()?;
    if header == NO_RAW_DATA {
        return Some(Index::None);
    }
    if header == AS_BEFORE {
        return Some(Index::AsBefore);
    }
    let code = cursor.u32()?;
    let _dimension = cursor.u32()?;
    let count = cursor.u64()?;
    if DAQMX.contains(&header) {
        let daqmx = daqmx::index(cursor, header == DAQMX[1])?;
        return Some(Index::Daqmx(RawIndex { of: RawType::Daqmx, count, bytes: 0 }, daqmx));
    }
    let of = raw_type(code);
    let bytes = match of.size() {
        Some(size) => count.checked_mul(size as u64)?,
        None if of == RawType::Text => cursor.u64()?,
        None => 0,
    };
    Some(Index::New(RawIndex { of, count, bytes }))
}

fn raw_type(code: u32) -> RawType {
    match code {
        TEXT => RawType::Text,
        TIME_STAMP => RawType::TimeStamp,
        0x0008_000c => RawType::Complex { size: 8 },
        0x0010_000d => RawType::Complex { size: 16 },
        code => number_type(code).map_or(RawType::Unknown, RawType::Number),
    }
}

fn number_type(code: u32) -> Option<NumberType> {
    Some(match code {
        1 => NumberType::I8,
        2 => NumberType::I16,
        3 => NumberType::I32,
        4 => NumberType::I64,
        5 | 0x21 => NumberType::U8,
        6 => NumberType::U16,
        7 => NumberType::U32,
        8 => NumberType::U64,
        9 | 0x19 => NumberType::F32,
        10 | 0x1a => NumberType::F64,
        _ => return None,
    })
}

/// Reads the properties of an object; `None` if they are damaged.
pub(super) fn properties(
    cursor: &mut Cursor,
    properties: &mut HashMap<String, Property>,
) -> Option<()> {
    let count = cursor.u32()?;
    for _ in 0..count {
        let name = text(cursor)?;
        let value = match cursor.u32()? {
            TEXT => Property::Text(text(cursor)?),
            TIME_STAMP => {
                cursor.take(16)?;
                Property::TimeStamp
            }
            code => {
                let kind = number_type(code)?;
                let bytes = cursor.take(kind.size())?;
                let mut value = Vec::with_capacity(1);
                Number::new(kind, cursor.big_endian()).append(&mut value, bytes, kind.size(), 1);
                Property::Number(value.pop()?)
            }
        };
        properties.insert(name, value);
    }
    Some(())
}

#[cfg(test)]
mod tests {
    use super::names;

    #[test]
    fn a_quote_in_a_name_is_doubled() {
        assert_eq!(names("/'a/b'/'it''s'"), ["a/b", "it's"]);
        assert!(names("/").is_empty());
    }
}
