//! The bytes of the raw data of a segment, which are read in blocks.

use crate::format_error::FormatError;
use crate::stream::{Input, Stream};

/// Bytes that are read at once.
const BLOCK_BYTES: usize = 1 << 15;

/// Bytes of raw data that come next in a file.
pub(super) struct RawBytes<'a> {
    stream: &'a mut Stream,
    /// Number of bytes that are not yet read.
    left: u64,
}

impl<'a> RawBytes<'a> {
    pub(super) fn new(stream: &'a mut Stream, left: u64) -> Self {
        Self { stream, left }
    }

    pub(super) fn left(&self) -> u64 {
        self.left
    }

    pub(super) fn skip(&mut self, bytes: u64) -> Result<(), FormatError> {
        let bytes = bytes.min(self.left);
        self.left -= bytes;
        self.stream.skip(bytes)?;
        Ok(())
    }

    /// The next rows of a size, at most `most` and not more than are read at once.
    pub(super) fn rows(&mut self, size: usize, most: u64) -> Result<(&[u8], usize), FormatError> {
        let size = size.max(1);
        let rows = most.min(self.left / size as u64).min((BLOCK_BYTES / size).max(1) as u64);
        let bytes = rows * size as u64;
        self.left -= bytes;
        let bytes = self.stream.next_bytes(bytes as usize)?.unwrap_or_default();
        Ok((bytes, rows as usize))
    }
}
