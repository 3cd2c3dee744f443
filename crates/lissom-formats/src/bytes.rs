//! The bytes of a file, expanded if they are compressed.

use std::fs::File;
use std::io::{ErrorKind, Read};
use std::path::Path;

use flate2::read::MultiGzDecoder;
use ruzstd::decoding::StreamingDecoder;

use crate::format_error::FormatError;

/// Largest number of bytes, after expansion.
pub(crate) const MOST_BYTES: u64 = 2 << 30;

/// First bytes of gzip and of zstd.
pub(crate) const GZIP: &[u8] = b"\x1f\x8b";
/// See [`GZIP`].
pub(crate) const ZSTD: &[u8] = b"\x28\xb5\x2f\xfd";

/// Reads a file and expands `.gz` and `.zst`, recognised by content.
pub(crate) fn of_file(path: &Path) -> Result<Vec<u8>, FormatError> {
    let file = File::open(path)?;
    let metadata = file.metadata()?;
    if metadata.is_dir() {
        return Err(std::io::Error::from(ErrorKind::IsADirectory).into());
    }
    if metadata.len() > MOST_BYTES {
        return Err(FormatError::TooLarge { most: MOST_BYTES });
    }
    expanded(limited(file)?)
}

/// Expands compressed bytes; others are returned as they are.
pub(crate) fn expanded(bytes: Vec<u8>) -> Result<Vec<u8>, FormatError> {
    let damaged = |reason: String| FormatError::Damaged { reason };
    if bytes.starts_with(GZIP) {
        return read_compressed(MultiGzDecoder::new(&bytes[..]));
    }
    if bytes.starts_with(ZSTD) {
        let decoder = StreamingDecoder::new(&bytes[..]).map_err(|e| damaged(e.to_string()))?;
        return read_compressed(decoder);
    }
    Ok(bytes)
}

fn read_compressed(reader: impl Read) -> Result<Vec<u8>, FormatError> {
    limited(reader).map_err(|error| match error {
        FormatError::Read { source } => FormatError::Damaged { reason: source.to_string() },
        other => other,
    })
}

fn limited(reader: impl Read) -> Result<Vec<u8>, FormatError> {
    let mut bytes = Vec::new();
    let read = reader.take(MOST_BYTES + 1).read_to_end(&mut bytes)?;
    if read as u64 > MOST_BYTES {
        return Err(FormatError::TooLarge { most: MOST_BYTES });
    }
    Ok(bytes)
}
