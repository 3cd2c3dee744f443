//! Bytes in their order, of which only a block is in memory.

use std::io::{self, BufRead, Read};
use std::ops::Range;

use crate::format_error::FormatError;
use crate::source::Source;

/// Bytes that are usually read from the disk at once.
const BLOCK_BYTES: usize = 1 << 17;

/// Bytes that are read from the first to the last.
pub(crate) trait Input {
    /// The next bytes; `None` if there are fewer.
    fn next_bytes(&mut self, count: usize) -> Result<Option<&[u8]>, FormatError>;

    /// Skips bytes; `None` if there are fewer.
    fn skip(&mut self, count: u64) -> Result<Option<()>, FormatError>;
}

/// Bytes of a file.
#[derive(Debug)]
pub(crate) struct Stream {
    source: Source,
    /// Place of the next byte in the file.
    at: u64,
    end: u64,
    /// Bytes of the file, if it is on the disk.
    block: Vec<u8>,
    /// Place of the block in the file.
    block_at: u64,
    /// Bytes that are read from the disk at once.
    block_bytes: usize,
}

impl Source {
    /// The bytes from a place to the end of the file.
    pub(crate) fn stream(&self, from: u64) -> Stream {
        self.part(from..u64::MAX)
    }

    /// The bytes in a range, as far as the file has them.
    pub(crate) fn part(&self, range: Range<u64>) -> Stream {
        let end = range.end.min(self.length());
        let at = range.start.min(end);
        let (source, block) = (self.clone(), Vec::new());
        Stream { source, at, end, block, block_at: at, block_bytes: BLOCK_BYTES }
    }
}

impl Stream {
    /// The same, of which other numbers of bytes are read at once.
    #[cfg(any(feature = "parquet", test))]
    pub(crate) fn in_blocks_of(self, block_bytes: usize) -> Self {
        Self { block_bytes, ..self }
    }

    /// Place of the next byte in the file.
    pub(crate) fn place(&self) -> u64 {
        self.at
    }

    /// Number of bytes that are not yet read.
    pub(crate) fn left(&self) -> u64 {
        self.end - self.at
    }

    /// Reads a block that begins with the next bytes, unless they are in memory.
    fn load(&mut self, count: usize) -> io::Result<()> {
        if matches!(self.source, Source::Memory(_)) {
            return Ok(());
        }
        let loaded = self.block_at..self.block_at + self.block.len() as u64;
        if loaded.start <= self.at && self.at + count as u64 <= loaded.end {
            return Ok(());
        }
        // A block for a single long record is not kept.
        if self.block.len() > self.block_bytes {
            self.block = Vec::new();
        }
        let length = (count.max(self.block_bytes) as u64).min(self.left());
        self.block.resize(length as usize, 0);
        self.block_at = self.at;
        self.source.read_at(self.at, &mut self.block)
    }

    /// The bytes in memory that begin with the next one.
    fn loaded(&self) -> &[u8] {
        let (bytes, at) = match &self.source {
            Source::Memory(bytes) => (bytes.get(..self.end as usize).unwrap_or_default(), 0),
            Source::File { .. } => (&self.block[..], self.block_at),
        };
        bytes.get((self.at - at) as usize..).unwrap_or_default()
    }
}

impl Input for Stream {
    /// If there are fewer bytes, none is read.
    fn next_bytes(&mut self, count: usize) -> Result<Option<&[u8]>, FormatError> {
        if count as u64 > self.left() {
            return Ok(None);
        }
        self.load(count)?;
        self.at += count as u64;
        let (bytes, at) = match &self.source {
            Source::Memory(bytes) => (&bytes[..], 0),
            Source::File { .. } => (&self.block[..], self.block_at),
        };
        let end = (self.at - at) as usize;
        Ok(bytes.get(end - count..end))
    }

    /// If there are fewer bytes, none is skipped.
    fn skip(&mut self, count: u64) -> Result<Option<()>, FormatError> {
        Ok((count <= self.left()).then(|| self.at += count))
    }
}

impl BufRead for Stream {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        self.load(usize::from(self.left() > 0))?;
        Ok(self.loaded())
    }

    fn consume(&mut self, count: usize) {
        self.at = (self.at + count as u64).min(self.end);
    }
}

impl Read for Stream {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        let read = self.fill_buf()?.read(out)?;
        self.consume(read);
        Ok(read)
    }
}

#[cfg(test)]
mod tests {
    use std::io::{Seek, SeekFrom, Write};
    use std::sync::Arc;

    use super::*;

    /// The bytes 0 to 99, on the disk and in memory.
    fn sources() -> [Source; 2] {
        let bytes: Vec<u8> = (0..100).collect();
        let mut file = tempfile::tempfile().unwrap();
        file.write_all(&bytes).unwrap();
        file.seek(SeekFrom::Start(7)).unwrap();
        [Source::File { file: Arc::new(file), length: 100 }, Source::in_memory(bytes)]
    }

    #[test]
    fn bytes_are_read_and_skipped_in_any_blocks() {
        for source in sources() {
            for block_bytes in [1, 7, 64, 200] {
                let mut stream = source.part(10..90).in_blocks_of(block_bytes);
                assert_eq!(stream.next_bytes(3).unwrap().unwrap(), [10, 11, 12]);
                stream.skip(20).unwrap().unwrap();
                assert_eq!((stream.place(), stream.left()), (33, 57));
                let bytes = stream.next_bytes(30).unwrap().unwrap();
                assert!(bytes.iter().copied().eq(33..63));
                assert!(stream.next_bytes(28).unwrap().is_none());
                assert!(stream.skip(28).unwrap().is_none());
                let mut rest = Vec::new();
                stream.read_to_end(&mut rest).unwrap();
                assert!(rest.into_iter().eq(63..90));
                assert!(stream.next_bytes(0).unwrap().unwrap().is_empty());
                assert!(stream.next_bytes(1).unwrap().is_none());
            }
        }
    }

    #[test]
    fn a_range_outside_of_the_file_has_no_bytes() {
        for source in sources() {
            assert_eq!(source.part(200..300).left(), 0);
            assert_eq!(*source.bytes(98..300).unwrap(), [98, 99]);
            assert!(source.bytes(300..400).unwrap().is_empty());
            assert!(source.read_at(99, &mut [0; 2]).is_err());
        }
    }
}
