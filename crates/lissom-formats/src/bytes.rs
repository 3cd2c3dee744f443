//! Opens a file, and expands it if it is compressed.

use std::fs::File;
use std::io::{BufReader, Cursor, ErrorKind, Read, Seek as _};
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

/// The bytes of a file that is opened.
pub(crate) enum Opened {
    Plain(Source),
    /// The expanded bytes of `.gz` or `.zst`, recognised by content.
    Compressed(Box<dyn Read>),
}

/// Opens a file.
pub(crate) fn of_file(path: &Path) -> Result<Opened, FormatError> {
    let mut file = File::open(path)?;
    let metadata = file.metadata()?;
    if metadata.is_dir() {
        return Err(std::io::Error::from(ErrorKind::IsADirectory).into());
    }
    if metadata.len() > MOST_BYTES {
        return Err(FormatError::TooLarge { most: MOST_BYTES });
    }
    if !metadata.is_file() || metadata.len() == 0 {
        // A pipe is read once, from its beginning.
        return of_bytes(limited(file)?);
    }
    let mut first = Vec::new();
    file.by_ref().take(ZSTD.len() as u64).read_to_end(&mut first)?;
    file.rewind()?;
    if is_compressed(&first) {
        return decoder(&first, BufReader::new(file)).map(Opened::Compressed);
    }
    Ok(Opened::Plain(Source::File { file: Arc::new(file), length: metadata.len() }))
}

/// Whether a compressed file expands to more than so many bytes. It is expanded as a stream: that takes no memory. A damaged
/// one is reported when it is read.
///
/// # Errors
/// If the file cannot be read.
pub fn expands_beyond(path: &Path, most_bytes: u64) -> std::io::Result<bool> {
    let Ok(Opened::Compressed(expanded)) = of_file(path) else { return Ok(false) };
    let counted =
        std::io::copy(&mut expanded.take(most_bytes.saturating_add(1)), &mut std::io::sink());
    Ok(counted.is_ok_and(|bytes| bytes > most_bytes))
}

/// Bytes in memory.
pub(crate) fn of_bytes(bytes: Vec<u8>) -> Result<Opened, FormatError> {
    if !is_compressed(&bytes) {
        return Ok(Opened::Plain(Source::in_memory(bytes)));
    }
    let first: Vec<u8> = bytes.iter().take(ZSTD.len()).copied().collect();
    decoder(&first, Cursor::new(bytes)).map(Opened::Compressed)
}

fn is_compressed(first: &[u8]) -> bool {
    first.starts_with(GZIP) || first.starts_with(ZSTD)
}

/// The expanded bytes of a reader with these first bytes.
fn decoder(first: &[u8], reader: impl Read + 'static) -> Result<Box<dyn Read>, FormatError> {
    if first.starts_with(GZIP) {
        return Ok(Box::new(MultiGzDecoder::new(reader)));
    }
    let damaged = |reason: String| FormatError::Damaged { reason };
    let decoder = StreamingDecoder::new(reader).map_err(|e| damaged(e.to_string()))?;
    Ok(Box::new(decoder))
}

/// Expands all bytes.
pub(crate) fn expanded(reader: impl Read) -> Result<Source, FormatError> {
    read_compressed(reader).map(Source::in_memory)
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
