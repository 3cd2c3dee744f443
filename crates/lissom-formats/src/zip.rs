//! ZIP archives: entries that are stored or deflated, without encryption.

use std::io::{Read, Take};

use flate2::CrcReader;
use flate2::bufread::DeflateDecoder;

use crate::cursor::Cursor;
use crate::expanded::Expanded;
use crate::format_error::FormatError;
use crate::source::Source;
use crate::stream::{Input, Stream};

/// First bytes of an archive.
pub(crate) const ZIP: &[u8] = b"PK\x03\x04";

const LOCAL_HEADER: u32 = 0x0403_4b50;
const DIRECTORY_ENTRY: u32 = 0x0201_4b50;
const DIRECTORY_END: &[u8] = b"PK\x05\x06";
const DIRECTORY_END_64: u32 = 0x0606_4b50;
/// Bytes of the locator of the 64-bit end, which precedes the end.
const LOCATOR_BYTES: u64 = 20;
/// Bytes of the 64-bit end that are read.
const DIRECTORY_END_64_BYTES: u64 = 56;
/// Bytes of the header before the content of an entry, without its name.
const LOCAL_HEADER_BYTES: usize = 30;
/// Bytes of an entry of the directory, without its name.
const DIRECTORY_HEADER_BYTES: usize = 46;
/// Most bytes behind the directory: its end, and a comment.
const MOST_BEHIND: u64 = 22 + 0xffff;
/// The field that has sizes of 64 bits.
const SIZES_64: u16 = 1;

/// An entry of an archive.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Entry {
    pub(crate) name: String,
    method: u16,
    encrypted: bool,
    crc: u32,
    packed: u64,
    expanded: u64,
    offset: u64,
}

/// The entries of an archive, from its directory; `None` if the directory is damaged or missing.
pub(crate) fn entries(source: &Source) -> Result<Option<Vec<Entry>>, FormatError> {
    let tail = source.length().saturating_sub(MOST_BEHIND);
    let behind = source.bytes(tail..u64::MAX)?;
    let Some(end) = behind.windows(4).rposition(|window| window == DIRECTORY_END) else {
        return Ok(None);
    };
    let Some((mut count, mut offset)) = directory(behind.get(end..).unwrap_or_default()) else {
        return Ok(None);
    };
    let end = tail + end as u64;
    let locator = source.bytes(end.saturating_sub(LOCATOR_BYTES)..end)?;
    if let Some(place) = place_of_64(&locator) {
        let end = source.bytes(place..place.saturating_add(DIRECTORY_END_64_BYTES))?;
        (count, offset) = directory_64(&end).unwrap_or((count, offset));
    }
    let mut directory = source.stream(offset);
    let mut entries = Vec::new();
    for _ in 0..count {
        let Some(entry) = entry(&mut directory)? else { return Ok(None) };
        entries.push(entry);
    }
    Ok(Some(entries))
}

/// Number of entries and offset of the directory, from its end.
fn directory(end: &[u8]) -> Option<(u64, u64)> {
    let mut cursor = Cursor::new(end.get(10..)?, false);
    let count = u64::from(cursor.u16()?);
    cursor.take(4)?;
    Some((count, u64::from(cursor.u32()?)))
}

/// Place of the 64-bit end, if the archive has sizes of 64 bits.
fn place_of_64(locator: &[u8]) -> Option<u64> {
    let mut cursor = Cursor::new(locator.strip_prefix(b"PK\x06\x07")?, false);
    cursor.take(4)?;
    cursor.u64()
}

/// Number of entries and offset of the directory, from its 64-bit end.
fn directory_64(end: &[u8]) -> Option<(u64, u64)> {
    let mut cursor = Cursor::new(end, false);
    (cursor.u32()? == DIRECTORY_END_64).then_some(())?;
    cursor.take(28)?;
    let count = cursor.u64()?;
    cursor.take(8)?;
    Some((count, cursor.u64()?))
}

/// The next entry of the directory; `None` if it is damaged.
fn entry(directory: &mut Stream) -> Result<Option<Entry>, FormatError> {
    let header = directory.next_bytes(DIRECTORY_HEADER_BYTES)?;
    let Some((entry, lengths)) = header.and_then(header_of) else { return Ok(None) };
    let rest = directory.next_bytes(lengths.iter().sum())?;
    Ok(rest.and_then(|rest| entry.completed(rest, lengths)))
}

/// An entry without its name, and the lengths of name, extra fields and comment.
fn header_of(header: &[u8]) -> Option<(Entry, [usize; 3])> {
    let mut cursor = Cursor::new(header, false);
    (cursor.u32()? == DIRECTORY_ENTRY).then_some(())?;
    cursor.take(4)?;
    let encrypted = cursor.u16()? & 1 == 1;
    let method = cursor.u16()?;
    cursor.take(4)?;
    let crc = cursor.u32()?;
    let (packed, expanded) = (u64::from(cursor.u32()?), u64::from(cursor.u32()?));
    let lengths = [cursor.u16()?, cursor.u16()?, cursor.u16()?].map(usize::from);
    cursor.take(8)?;
    let offset = u64::from(cursor.u32()?);
    let name = String::new();
    Some((Entry { name, method, encrypted, crc, packed, expanded, offset }, lengths))
}

impl Entry {
    /// With the name, and the sizes of 64 bits in an extra field.
    fn completed(mut self, rest: &[u8], [name, extra, _]: [usize; 3]) -> Option<Self> {
        let mut cursor = Cursor::new(rest, false);
        self.name = String::from_utf8_lossy(cursor.take(name)?).into_owned();
        let mut extra = Cursor::new(cursor.take(extra)?, false);
        while let (Some(kind), Some(length)) = (extra.u16(), extra.u16()) {
            let Some(field) = extra.take(usize::from(length)) else { break };
            if kind != SIZES_64 {
                continue;
            }
            let mut field = Cursor::new(field, false);
            for size in [&mut self.expanded, &mut self.packed, &mut self.offset] {
                if *size == u64::from(u32::MAX) {
                    *size = field.u64()?;
                }
            }
        }
        Some(self)
    }

    /// Its bytes in memory after expansion, as the directory states them.
    pub(crate) fn expanded_bytes(&self) -> usize {
        usize::try_from(self.expanded).unwrap_or(usize::MAX)
    }

    /// Its content, which is expanded while it is read.
    pub(crate) fn content(&self, archive: &Source) -> Result<Content, FormatError> {
        let place = format!("entry {} of the archive: ", self.name);
        if self.encrypted {
            return Err(FormatError::content(&self.name, "the entry is encrypted"));
        }
        let Some(packed) = self.packed(archive)? else {
            return Err(FormatError::Damaged { reason: format!("{place}is cut off") });
        };
        let reader: Box<dyn Read> = match self.method {
            0 => Box::new(packed),
            8 => Box::new(DeflateDecoder::new(packed)),
            method => {
                let reason = format!("the entry is compressed with method {method}");
                return Err(FormatError::content(&self.name, reason));
            }
        };
        let reader = CrcReader::new(reader.take(self.expanded.saturating_add(1)));
        let (bytes, expanded) = (Expanded::new(reader, place), self.expanded);
        Ok(Content { bytes, crc: self.crc, expanded, left: expanded })
    }

    fn packed(&self, archive: &Source) -> Result<Option<Stream>, FormatError> {
        let mut stream = archive.stream(self.offset);
        let Some(header) = stream.next_bytes(LOCAL_HEADER_BYTES)? else { return Ok(None) };
        let mut cursor = Cursor::new(header, false);
        let is_header = cursor.u32() == Some(LOCAL_HEADER);
        cursor.take(22);
        let behind = [cursor.u16(), cursor.u16()].into_iter().flatten().map(u64::from).sum();
        let whole = stream.skip(behind)?.filter(|()| is_header && self.packed <= stream.left());
        let end = stream.place().saturating_add(self.packed);
        Ok(whole.map(|()| archive.part(stream.place()..end)))
    }
}

/// The content of an entry.
pub(crate) struct Content {
    bytes: Expanded<CrcReader<Take<Box<dyn Read>>>>,
    crc: u32,
    /// Number of bytes, as the directory states it.
    expanded: u64,
    /// Number of those that are not yet read.
    left: u64,
}

impl Content {
    /// Number of bytes that are not yet read.
    pub(crate) fn left(&self) -> u64 {
        self.left
    }

    /// Reads on to the end, and checks the checksum.
    pub(crate) fn finish(&mut self) -> Result<(), FormatError> {
        self.bytes.finish(self.expanded)?;
        let crc = self.bytes.decoder().crc();
        if crc.sum() != self.crc || crc.amount() != self.expanded as u32 {
            return Err(self.bytes.damaged("the checksum is wrong"));
        }
        Ok(())
    }
}

impl Input for Content {
    fn next_bytes(&mut self, count: usize) -> Result<Option<&[u8]>, FormatError> {
        let taken = self.bytes.next_bytes(count)?;
        self.left = self.left.saturating_sub(count as u64);
        Ok(taken)
    }

    fn skip(&mut self, count: u64) -> Result<Option<()>, FormatError> {
        self.left = self.left.saturating_sub(count);
        self.bytes.skip(count)
    }
}
