//! Common data representation (CDR), in which ROS 2 serialises its messages.

use crate::number::{Number, NumberType};

/// The bytes of a message, and the place that is read.
pub(super) struct Cdr<'a> {
    /// The bytes behind the header of four bytes; places are counted from them.
    bytes: &'a [u8],
    at: usize,
    big_endian: bool,
    /// Numbers begin at a multiple of their size, at most of this one.
    most_alignment: usize,
}

impl<'a> Cdr<'a> {
    /// A message; `None` if it is in a representation that is not read.
    pub(super) fn new(message: &'a [u8]) -> Option<Self> {
        let (header, bytes) = message.split_first_chunk::<4>()?;
        let (big_endian, most_alignment) = match header {
            [0, 0, ..] => (true, 8),
            [0, 1, ..] => (false, 8),
            [0, 6, ..] => (true, 4),
            [0, 7, ..] => (false, 4),
            _ => return None,
        };
        Some(Self { bytes, at: 0, big_endian, most_alignment })
    }

    /// Number of bytes that are not yet read.
    pub(super) fn left(&self) -> usize {
        self.bytes.len().saturating_sub(self.at)
    }

    /// Goes on to the next multiple of a size.
    fn align(&mut self, size: usize) {
        self.at = self.at.next_multiple_of(size.min(self.most_alignment));
    }

    fn take(&mut self, count: usize) -> Option<&'a [u8]> {
        let taken = self.bytes.get(self.at..)?.get(..count)?;
        self.at += count;
        Some(taken)
    }

    pub(super) fn u32(&mut self) -> Option<u32> {
        self.align(4);
        let bytes = *self.take(4)?.first_chunk()?;
        Some(if self.big_endian { u32::from_be_bytes(bytes) } else { u32::from_le_bytes(bytes) })
    }

    /// The length of a sequence or a text.
    pub(super) fn length(&mut self) -> Option<usize> {
        let length = self.u32()? as usize;
        (length <= self.left()).then_some(length)
    }

    pub(super) fn number(&mut self, kind: NumberType) -> Option<f64> {
        self.align(kind.size());
        let bytes = self.take(kind.size())?;
        Number::new(kind, self.big_endian).value(bytes)
    }

    /// Skips numbers.
    pub(super) fn skip(&mut self, kind: NumberType, count: usize) -> Option<()> {
        if count > 0 {
            self.align(kind.size());
            self.take(count.checked_mul(kind.size())?)?;
        }
        Some(())
    }

    pub(super) fn text(&mut self) -> Option<&'a str> {
        let length = self.length()?;
        let bytes = self.take(length)?;
        std::str::from_utf8(bytes.strip_suffix(b"\0").unwrap_or(bytes)).ok()
    }
}
