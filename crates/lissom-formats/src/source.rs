//! The bytes of a file, which are read in pieces.

use std::borrow::Cow;
use std::fs::File;
use std::io::{self, ErrorKind, Read as _, Seek as _, SeekFrom};
use std::ops::Range;
use std::sync::Arc;

/// The bytes of a file, on the disk or in memory.
#[derive(Debug, Clone)]
pub(crate) enum Source {
    File { file: Arc<File>, length: u64 },
    Memory(Arc<Vec<u8>>),
}

impl Source {
    pub(crate) fn in_memory(bytes: Vec<u8>) -> Self {
        Self::Memory(Arc::new(bytes))
    }

    /// Number of bytes.
    pub(crate) fn length(&self) -> u64 {
        match self {
            Self::File { length, .. } => *length,
            Self::Memory(bytes) => bytes.len() as u64,
        }
    }

    /// Reads the bytes from a place on; an error if there are fewer.
    pub(crate) fn read_at(&self, place: u64, out: &mut [u8]) -> io::Result<()> {
        match self {
            Self::File { file, .. } => {
                let mut file = &**file;
                file.seek(SeekFrom::Start(place))?;
                file.read_exact(out)
            }
            Self::Memory(bytes) => {
                let place = usize::try_from(place).unwrap_or(usize::MAX);
                let taken = bytes.get(place..).and_then(|bytes| bytes.get(..out.len()));
                out.copy_from_slice(taken.ok_or(ErrorKind::UnexpectedEof)?);
                Ok(())
            }
        }
    }

    /// Some of the bytes; fewer if the file ends.
    pub(crate) fn bytes(&self, range: Range<u64>) -> io::Result<Cow<'_, [u8]>> {
        let end = range.end.min(self.length());
        let start = range.start.min(end);
        match self {
            Self::File { .. } => {
                let mut bytes = vec![0; (end - start) as usize];
                self.read_at(start, &mut bytes)?;
                Ok(bytes.into())
            }
            Self::Memory(bytes) => {
                Ok(bytes.get(start as usize..end as usize).unwrap_or_default().into())
            }
        }
    }

    /// All bytes.
    pub(crate) fn all(&self) -> io::Result<Cow<'_, [u8]>> {
        self.bytes(0..u64::MAX)
    }
}
