//! Messages of a Parquet file, in Thrift's compact protocol: <https://github.com/apache/thrift/blob/master/doc/specs/thrift-compact-protocol.md>.
//!
//! The library that reads them skips a list of billions of truth values, which take no bytes, value by value, and lists inside of such
//! lists; and it reads a known field without a look at the kind that the message gives. A message is therefore first gone through here.

pub(crate) mod layout;

use crate::format_error::FormatError;
use crate::stream::Input;
use layout::{Fields, Is};

/// Most truth values in lists and maps of one message; a file of a known writer has none.
const MOST_TRUTH_VALUES: u64 = 1000;
/// Most levels of structs, lists and maps, as many as the library reads.
const LEVELS: u32 = 64;

/// Goes through a message: it must end in the input, and its fields must be of the kinds of the layout.
pub(crate) fn check_message(input: &mut impl Input, fields: Fields) -> Result<(), FormatError> {
    Message { input, truth_values: 0 }.value(STRUCT, Is::Struct(fields), LEVELS)
}

/// Kinds of values.
const STOP: u8 = 0;
const TRUE: u8 = 1;
const FALSE: u8 = 2;
const BYTE: u8 = 3;
const I16: u8 = 4;
const I32: u8 = 5;
const I64: u8 = 6;
const DOUBLE: u8 = 7;
const BINARY: u8 = 8;
const LIST: u8 = 9;
const SET: u8 = 10;
const MAP: u8 = 11;
const STRUCT: u8 = 12;
const UUID: u8 = 13;

impl Is {
    fn allows(self, kind: u8) -> bool {
        match self {
            Self::Truth => matches!(kind, TRUE | FALSE),
            Self::Byte => kind == BYTE,
            Self::I16 => kind == I16,
            Self::I32 => kind == I32,
            Self::I64 => kind == I64,
            Self::Double => kind == DOUBLE,
            Self::Bytes => kind == BINARY,
            Self::List(_) => kind == LIST,
            Self::Struct(_) => kind == STRUCT,
            Self::Unknown => true,
        }
    }
}

struct Message<'a, I> {
    input: &'a mut I,
    truth_values: u64,
}

impl<I: Input> Message<'_, I> {
    fn value(&mut self, kind: u8, is: Is, levels: u32) -> Result<(), FormatError> {
        if !is.allows(kind) {
            return Err(damaged("a message has a value of another kind than the format"));
        }
        let Some(levels) = levels.checked_sub(1) else {
            return Err(damaged("a message has too many levels"));
        };
        match kind {
            TRUE | FALSE => Ok(()),
            BYTE => self.skip(1),
            I16 | I32 | I64 => self.number().map(|_| ()),
            DOUBLE => self.skip(8),
            UUID => self.skip(16),
            BINARY => {
                let bytes = self.number()?;
                self.skip(bytes)
            }
            LIST | SET => {
                let head = self.byte()?;
                let count = if head >> 4 == 15 { self.number()? } else { u64::from(head >> 4) };
                let element = if let Is::List(element) = is { *element } else { Is::Unknown };
                self.values(count, &[head & 15], element, levels)
            }
            MAP => {
                let count = self.number()?;
                let kinds = if count > 0 { self.byte()? } else { 0 };
                self.values(count, &[kinds >> 4, kinds & 15], Is::Unknown, levels)
            }
            STRUCT => self.fields(if let Is::Struct(fields) = is { fields } else { &[] }, levels),
            _ => Err(damaged("a message has a value of an unknown kind")),
        }
    }

    /// Fields of a struct to its end.
    fn fields(&mut self, fields: Fields, levels: u32) -> Result<(), FormatError> {
        let mut number = 0_i16;
        loop {
            let head = self.byte()?;
            let kind = head & 15;
            if kind == STOP {
                return Ok(());
            }
            number = match head >> 4 {
                // The number of the field follows, of 16 bits; odd ones are negative.
                0 => {
                    let follows = self.number()?;
                    ((follows >> 1).cast_signed() ^ -(follows & 1).cast_signed()) as i16
                }
                step => number.wrapping_add(i16::from(step)),
            };
            let known = fields.iter().find(|(of, _)| *of == number);
            self.value(kind, known.map_or(Is::Unknown, |(_, is)| *is), levels)?;
        }
    }

    /// Values of a list or a map, whose kinds take turns.
    fn values(&mut self, count: u64, kinds: &[u8], is: Is, levels: u32) -> Result<(), FormatError> {
        for _ in 0..count {
            for &kind in kinds {
                self.truth_values += u64::from(matches!(kind, TRUE | FALSE));
                self.value(kind, is, levels)?;
            }
            if self.truth_values > MOST_TRUTH_VALUES {
                return Err(damaged("a message has a list that cannot be right"));
            }
        }
        Ok(())
    }

    /// A number of seven bits a byte, the lowest first.
    fn number(&mut self) -> Result<u64, FormatError> {
        let mut number = 0;
        for place in 0..10 {
            let byte = self.byte()?;
            number |= u64::from(byte & 0x7f).wrapping_shl(7 * place);
            if byte & 0x80 == 0 {
                return Ok(number);
            }
        }
        Err(damaged("a message has a number of more than ten bytes"))
    }

    fn byte(&mut self) -> Result<u8, FormatError> {
        let byte = self.input.next_bytes(1)?.and_then(|bytes| bytes.first());
        byte.copied().ok_or_else(ends)
    }

    fn skip(&mut self, bytes: u64) -> Result<(), FormatError> {
        self.input.skip(bytes)?.ok_or_else(ends)
    }
}

fn ends() -> FormatError {
    damaged("the file ends in a message")
}

fn damaged(what: &str) -> FormatError {
    FormatError::content("Parquet file", what.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::Source;

    fn check(bytes: &[u8]) -> Result<(), FormatError> {
        check_message(&mut Source::in_memory(bytes.to_vec()).stream(0), &[(1, Is::Byte)])
    }

    #[test]
    fn a_message_of_all_kinds_is_right_and_no_beginning_of_it_is() {
        let message = [
            0x13, 5, 0x11, 0x15, 0x80, 1, 0x17, 1, 2, 3, 4, 5, 6, 7, 8, 0x18, 3, b'a', b'b', b'c',
            0x19, 0x21, 0x1b, 1, 0x53, 9, 7, 0x1c, 0x12, 0, 0x0a, 30, 0x13, 7, 0,
        ];
        check(&message).unwrap();
        for end in 0..message.len() {
            assert!(check(&message[..end]).is_err(), "{end}");
        }
    }

    #[test]
    fn lists_of_more_truth_values_than_a_file_has_are_refused() {
        let billion = [0x80, 0x80, 0x80, 0x80, 4];
        let list = |head: u8, kind: &[u8]| [&[head][..], kind, &billion, &[0]].concat();
        assert!(check(&list(0x29, &[0xf1])).is_err());
        assert!(check(&list(0x2a, &[0xf2])).is_err());
        let map = [&[0x2b][..], &billion, &[0x11, 0]].concat();
        assert!(check(&map).is_err());
        // Ten thousand lists of 14 truth values each.
        let lists = [&[0x29, 0xf9, 0x90, 0x4e][..], &[0xe1; 10_000], &[0]].concat();
        assert!(check(&lists).is_err());
        check(&[0x29, 0xe1, 0]).unwrap();
    }

    #[test]
    fn fields_are_of_the_kinds_of_the_layout() {
        check(&[0x13, 5, 0]).unwrap();
        assert!(check(&[0x15, 5, 0]).is_err());
        // The number of the field follows its kind: 1, and 2, which is in no layout.
        assert!(check(&[0x05, 2, 5, 0]).is_err());
        check(&[0x05, 4, 5, 0]).unwrap();
        check(&[0x25, 5, 0]).unwrap();
    }

    #[test]
    fn levels_are_limited() {
        let deep = |levels: usize| [vec![0x2c; levels], vec![0; levels + 1]].concat();
        check(&deep(60)).unwrap();
        assert!(check(&deep(100_000)).is_err());
    }
}
