//! Checksums of logs and of parts.

use std::io::{self, Read};

use sha2::{Digest as _, Sha256};

/// Bytes that are read at once.
const CHUNK: usize = 1 << 16;

/// SHA-256 of all bytes that are added.
#[derive(Default)]
pub(crate) struct Checksum(Sha256);

impl Checksum {
    /// Adds what a reader gives.
    pub(crate) fn add(&mut self, mut reader: impl Read) -> io::Result<()> {
        let mut chunk = vec![0; CHUNK];
        loop {
            match reader.read(&mut chunk)? {
                0 => return Ok(()),
                count => self.0.update(&chunk[..count]),
            }
        }
    }

    /// The checksum in hexadecimal digits.
    pub(crate) fn text(self) -> String {
        let digit = |half: u8| char::from_digit(half.into(), 16).unwrap_or_default();
        let bytes = self.0.finalize().into_iter();
        bytes.flat_map(|byte| [digit(byte >> 4), digit(byte & 15)]).collect()
    }
}
