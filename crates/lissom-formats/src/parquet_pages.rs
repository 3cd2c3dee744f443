//! Parquet files for the library that reads them: a page is in memory, not the file.

use std::io::{self, Read};

use bytes::Bytes;
use parquet::errors::ParquetError;
use parquet::file::reader::{ChunkReader, Length};

use crate::source::Source;
use crate::stream::Stream;

/// Bytes that are read at once for the header of a page.
const HEADER_BYTES: usize = 4096;

/// A stream whose end is an error: behind the pages a file has a footer. The library that reads headers skips a list of
/// billions of values in a damaged one value by value, also when the file has no more.
pub(crate) struct BeforeFooter(Stream);

impl Read for BeforeFooter {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        match self.0.read(buffer)? {
            0 if !buffer.is_empty() => Err(io::ErrorKind::UnexpectedEof.into()),
            read => Ok(read),
        }
    }
}

/// A file whose pages are read one by one.
pub(crate) struct Pages(pub(crate) Source);

impl Length for Pages {
    fn len(&self) -> u64 {
        self.0.length()
    }
}

impl ChunkReader for Pages {
    type T = BeforeFooter;

    fn get_read(&self, start: u64) -> Result<Self::T, ParquetError> {
        if start > self.len() {
            let length = self.len();
            return Err(ParquetError::EOF(format!(
                "Expected to read at offset {start}, while file has length {length}"
            )));
        }
        Ok(BeforeFooter(self.0.stream(start).in_blocks_of(HEADER_BYTES)))
    }

    fn get_bytes(&self, start: u64, count: usize) -> Result<Bytes, ParquetError> {
        let end = start.saturating_add(count as u64);
        if end > self.len() {
            let length = self.len();
            return Err(ParquetError::EOF(format!(
                "Expected to read {count} bytes at offset {start}, while file has length {length}"
            )));
        }
        Ok(self.0.bytes(start..end)?.into_owned().into())
    }
}
