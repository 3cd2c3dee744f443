//! Compressed bytes, which are expanded while they are read.

use std::io::{self, Read};

use crate::format_error::FormatError;
use crate::stream::Input;

/// Most bytes for which memory is taken before they are there.
const MOST_RESERVED: usize = 1 << 16;

/// Bytes that a decoder makes of others.
pub(crate) struct Expanded<R> {
    decoder: R,
    block: Vec<u8>,
    /// What precedes the reason of an error.
    place: String,
    /// Number of bytes that were read.
    read: u64,
}

impl<R: Read> Expanded<R> {
    pub(crate) fn new(decoder: R, place: String) -> Self {
        Self { decoder, block: Vec::new(), place, read: 0 }
    }

    pub(crate) fn decoder(&self) -> &R {
        &self.decoder
    }

    pub(crate) fn damaged(&self, reason: impl std::fmt::Display) -> FormatError {
        FormatError::Damaged { reason: format!("{}{reason}", self.place) }
    }

    /// Reads on to the end, at most one byte further than a place. Returns the number of all bytes.
    ///
    /// At the end the decoder checks the checksum, if it knows one.
    pub(crate) fn finish(&mut self, place: u64) -> Result<u64, FormatError> {
        self.skip(place.saturating_sub(self.read))?;
        self.skip(1)?;
        Ok(self.read)
    }
}

impl<R: Read> Input for Expanded<R> {
    fn next_bytes(&mut self, count: usize) -> Result<Option<&[u8]>, FormatError> {
        self.block.clear();
        self.block.reserve_exact(count.min(MOST_RESERVED));
        let read = self.decoder.by_ref().take(count as u64).read_to_end(&mut self.block);
        let read = read.map_err(|error| self.damaged(error))?;
        self.read += read as u64;
        Ok((read == count).then_some(&self.block[..]))
    }

    fn skip(&mut self, count: u64) -> Result<Option<()>, FormatError> {
        let skipped = io::copy(&mut self.decoder.by_ref().take(count), &mut io::sink());
        let skipped = skipped.map_err(|error| self.damaged(error))?;
        self.read += skipped;
        Ok((skipped == count).then_some(()))
    }
}
