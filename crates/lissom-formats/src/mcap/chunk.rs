//! Chunks of MCAP files: records that are compressed together.

use std::borrow::Cow;
use std::io::Read;

use flate2::Crc;
use lz4_flex::frame::FrameDecoder;
use ruzstd::decoding::StreamingDecoder;

use crate::collected::Collected;
use crate::cursor::Cursor;
use crate::format_error::FormatError;

/// A chunk.
struct Chunk<'a> {
    size: u64,
    crc: u32,
    compression: &'a [u8],
    /// The compressed records, as far as the file has them.
    packed: &'a [u8],
    is_whole: bool,
}

/// The chunk with this content; `None` if its header is cut off.
fn chunk(content: &[u8]) -> Option<Chunk<'_>> {
    let mut cursor = Cursor::new(content, false);
    cursor.take(16)?;
    let (size, crc) = (cursor.u64()?, cursor.u32()?);
    let length = cursor.count_u32()?;
    let compression = cursor.take(length)?;
    let length = cursor.u64()?;
    let rest = cursor.rest();
    let packed = usize::try_from(length).ok().and_then(|length| rest.get(..length));
    Some(Chunk {
        size,
        crc,
        compression,
        packed: packed.unwrap_or(rest),
        is_whole: packed.is_some(),
    })
}

/// The records in a chunk; their bytes are counted as taken.
pub(super) fn records<'a>(
    content: &'a [u8],
    found: &mut Collected,
) -> Result<Cow<'a, [u8]>, FormatError> {
    let damaged = |reason: &str| FormatError::Damaged { reason: reason.to_owned() };
    let chunk = chunk(content).filter(|c| c.is_whole).ok_or_else(|| damaged("they are cut off"))?;
    chunk.take(found)?;
    let records = if chunk.compression.is_empty() {
        Cow::Borrowed(chunk.packed)
    } else {
        let mut records = Vec::new();
        let mut decoder = chunk.decoder()?;
        let read = decoder.by_ref().take(chunk.size.saturating_add(1)).read_to_end(&mut records);
        read.map_err(|error| damaged(&error.to_string()))?;
        Cow::Owned(records)
    };
    let mut crc = Crc::new();
    crc.update(&records);
    if records.len() as u64 != chunk.size || (chunk.crc != 0 && crc.sum() != chunk.crc) {
        found.release_bytes(usize::try_from(chunk.size).unwrap_or(0));
        return Err(damaged("the checksum is wrong"));
    }
    Ok(records)
}

/// The records at the beginning of a chunk that is cut off.
pub(super) fn first_records(
    content: &[u8],
    found: &mut Collected,
) -> Result<Option<Vec<u8>>, FormatError> {
    let Some(chunk) = chunk(content) else { return Ok(None) };
    let Ok(mut decoder) = chunk.decoder() else { return Ok(None) };
    chunk.take(found)?;
    let mut records = Vec::new();
    // The error is the end of the file.
    let _ = decoder.by_ref().take(chunk.size).read_to_end(&mut records);
    found.release_bytes(usize::try_from(chunk.size).unwrap_or(0).saturating_sub(records.len()));
    Ok(Some(records))
}

impl<'a> Chunk<'a> {
    fn take(&self, found: &mut Collected) -> Result<(), FormatError> {
        found.take_bytes(usize::try_from(self.size).unwrap_or(usize::MAX))
    }

    fn decoder(&self) -> Result<Box<dyn Read + 'a>, FormatError> {
        match self.compression {
            b"" => Ok(Box::new(self.packed)),
            b"lz4" => Ok(Box::new(FrameDecoder::new(self.packed))),
            b"zstd" => match StreamingDecoder::new(self.packed) {
                Ok(decoder) => Ok(Box::new(decoder)),
                Err(error) => Err(FormatError::Damaged { reason: error.to_string() }),
            },
            other => {
                let reason = format!("compression {} is unknown", String::from_utf8_lossy(other));
                Err(FormatError::Damaged { reason })
            }
        }
    }
}
