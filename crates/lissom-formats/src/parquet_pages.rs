//! Parquet files for the library that reads them: a page is in memory, not the file.

use bytes::Bytes;
use parquet::errors::ParquetError;
use parquet::file::reader::{ChunkReader, Length};

use crate::format_error::FormatError;
use crate::parquet_message::check_message;
use crate::parquet_message::layout::{FILE_META_DATA, PAGE_HEADER};
use crate::source::Source;
use crate::stream::Stream;

/// Bytes that are read at once for the header of a page.
const HEADER_BYTES: usize = 4096;

/// Bytes at the end of a file: the length of the footer's message, and `PAR1`.
const TAIL_BYTES: u64 = 8;

/// A file whose pages are read one by one.
pub(crate) struct Pages(Source);

impl Pages {
    /// The pages of a file whose footer's message is right.
    pub(crate) fn of(source: &Source) -> Result<Self, FormatError> {
        let tail = source.length().saturating_sub(TAIL_BYTES);
        // The library says what is wrong with an end of another kind.
        if let [a, b, c, d, b'P', b'A', b'R', b'1'] = *source.bytes(tail..u64::MAX)? {
            let length = u32::from_le_bytes([a, b, c, d]);
            let begin = tail.saturating_sub(u64::from(length));
            check_message(&mut source.part(begin..tail), FILE_META_DATA)?;
        }
        Ok(Self(source.clone()))
    }

    /// Goes through the header of a page.
    fn check_header(&self, start: u64) -> Result<(), ParquetError> {
        let checked =
            check_message(&mut self.0.stream(start).in_blocks_of(HEADER_BYTES), PAGE_HEADER);
        checked.map_err(|error| ParquetError::General(error.to_string()))
    }
}

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
        // The library reads the end of the file, and headers of pages.
        if start + TAIL_BYTES < self.len() {
            self.check_header(start)?;
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
