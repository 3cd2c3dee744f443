//! Parquet files for the library that reads them: a page is in memory, not the file.

use bytes::Bytes;
use parquet::errors::ParquetError;
use parquet::file::reader::{ChunkReader, Length};

use crate::source::Source;
use crate::stream::Stream;

/// Bytes that are read at once for the header of a page.
const HEADER_BYTES: usize = 4096;

/// A file whose pages are read one by one.
pub(crate) struct Pages(pub(crate) Source);

impl Length for Pages {
    fn len(&self) -> u64 {
        self.0.length()
    }
}

impl ChunkReader for Pages {
    type T = Stream;

    fn get_read(&self, start: u64) -> Result<Self::T, ParquetError> {
        if start > self.len() {
            let length = self.len();
            return Err(ParquetError::EOF(format!(
                "Expected to read at offset {start}, while file has length {length}"
            )));
        }
        Ok(self.0.stream(start).in_blocks_of(HEADER_BYTES))
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
