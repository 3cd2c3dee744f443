//! The source of the bytes of a file: the file itself, or its bytes in memory if it is compressed.

use std::fs::File;
use std::io::{BufReader, ErrorKind, Read, Seek as _};
use std::path::Path;
use std::sync::Arc;

use flate2::read::MultiGzDecoder;
use ruzstd::decoding::StreamingDecoder;

use crate::format_error::FormatError;
use crate::source::Source;

/// Largest number of bytes, after expansion.
pub(crate) const MOST_BYTES: u64 = 2 << 30;

/// First bytes of gzip and of zstd.
pub(crate) const GZIP: &[u8] = b"\x1f\x8b";
/// See [`GZIP`].
pub(crate) const ZSTD: &[u8] = b"\x28\xb5\x2f\xfd";

/// The bytes of a file. `.gz` and `.zst`, recognised by content, are expanded in memory.
pub(crate) fn of_file(path: &Path) -> Result<Source, FormatError> {
    let mut file = File::open(path)?;
    let metadata = file.metadata()?;
    if metadata.is_dir() {
        return Err(std::io::Error::from(ErrorKind::IsADirectory).into());
    }
    if metadata.len() > MOST_BYTES {
        return Err(FormatError::TooLarge { most: MOST_BYTES });
    }
    if !metadata.is_file() {
        // A pipe has no places.
        return of_bytes(limited(file)?);
    }
    let mut first = Vec::new();
    file.by_ref().take(ZSTD.len() as u64).read_to_end(&mut first)?;
    file.rewind()?;
    if let Some(expanded) = expanded(&first, BufReader::new(&file)) {
        return Ok(Source::in_memory(expanded?));
    }
    Ok(Source::File { file: Arc::new(file), length: metadata.len() })
}

/// Bytes in memory, expanded if they are compressed.
pub(crate) fn of_bytes(bytes: Vec<u8>) -> Result<Source, FormatError> {
    let expanded = expanded(&bytes, &bytes[..]).transpose()?;
    Ok(Source::in_memory(expanded.unwrap_or(bytes)))
}

/// Expands the bytes of a reader; `None` if the first ones are not those of a compressed file.
fn expanded(first: &[u8], reader: impl Read) -> Option<Result<Vec<u8>, FormatError>> {
    if first.starts_with(GZIP) {
        return Some(read_compressed(MultiGzDecoder::new(reader)));
    }
    first.starts_with(ZSTD).then(|| {
        let damaged = |reason: String| FormatError::Damaged { reason };
        read_compressed(StreamingDecoder::new(reader).map_err(|e| damaged(e.to_string()))?)
    })
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
