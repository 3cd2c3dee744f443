//! ZIP archives: entries that are stored or deflated, without encryption.

use std::borrow::Cow;
use std::io::Read;

use flate2::Crc;
use flate2::read::DeflateDecoder;

use crate::cursor::Cursor;
use crate::format_error::FormatError;

/// First bytes of an archive.
pub(crate) const ZIP: &[u8] = b"PK\x03\x04";

const LOCAL_HEADER: u32 = 0x0403_4b50;
const DIRECTORY_ENTRY: u32 = 0x0201_4b50;
const DIRECTORY_END: &[u8] = b"PK\x05\x06";
const DIRECTORY_END_64: u32 = 0x0606_4b50;
/// Bytes of the locator of the 64-bit end, which precedes the end.
const LOCATOR_BYTES: usize = 20;
/// Most bytes behind the directory: its end, and a comment.
const MOST_BEHIND: usize = 22 + 0xffff;
/// The field that has sizes of 64 bits.
const SIZES_64: u16 = 1;
/// Most bytes that deflate makes of one.
const LARGEST_RATIO: u64 = 1032;

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
pub(crate) fn entries(bytes: &[u8]) -> Option<Vec<Entry>> {
    let tail = bytes.len().saturating_sub(MOST_BEHIND);
    let behind = bytes.get(tail..)?;
    let end = tail + behind.windows(4).rposition(|window| window == DIRECTORY_END)?;
    let mut cursor = Cursor::new(bytes.get(end + 10..)?, false);
    let mut count = u64::from(cursor.u16()?);
    cursor.take(4)?;
    let mut offset = u64::from(cursor.u32()?);
    if let Some((count_64, offset_64)) = directory_64(bytes, end) {
        (count, offset) = (count_64, offset_64);
    }
    let mut cursor = Cursor::new(bytes.get(usize::try_from(offset).ok()?..)?, false);
    let mut entries = Vec::new();
    for _ in 0..count {
        entries.push(entry(&mut cursor)?);
    }
    Some(entries)
}

/// Number of entries and offset of the directory, if the archive has sizes of 64 bits.
fn directory_64(bytes: &[u8], end: usize) -> Option<(u64, u64)> {
    let locator = bytes.get(end.checked_sub(LOCATOR_BYTES)?..end)?;
    let mut cursor = Cursor::new(locator.strip_prefix(b"PK\x06\x07")?, false);
    cursor.take(4)?;
    let place = usize::try_from(cursor.u64()?).ok()?;
    let mut cursor = Cursor::new(bytes.get(place..)?, false);
    (cursor.u32()? == DIRECTORY_END_64).then_some(())?;
    cursor.take(28)?;
    let count = cursor.u64()?;
    cursor.take(8)?;
    Some((count, cursor.u64()?))
}

fn entry(cursor: &mut Cursor) -> Option<Entry> {
    (cursor.u32()? == DIRECTORY_ENTRY).then_some(())?;
    cursor.take(4)?;
    let encrypted = cursor.u16()? & 1 == 1;
    let method = cursor.u16()?;
    cursor.take(4)?;
    let crc = cursor.u32()?;
    let (mut packed, mut expanded) = (u64::from(cursor.u32()?), u64::from(cursor.u32()?));
    let [name, extra, comment] = [cursor.u16()?, cursor.u16()?, cursor.u16()?].map(usize::from);
    cursor.take(8)?;
    let mut offset = u64::from(cursor.u32()?);
    let name = String::from_utf8_lossy(cursor.take(name)?).into_owned();
    let mut extra = Cursor::new(cursor.take(extra)?, false);
    cursor.take(comment)?;
    while let (Some(kind), Some(length)) = (extra.u16(), extra.u16()) {
        let Some(field) = extra.take(usize::from(length)) else { break };
        if kind != SIZES_64 {
            continue;
        }
        let mut field = Cursor::new(field, false);
        for size in [&mut expanded, &mut packed, &mut offset] {
            if *size == u64::from(u32::MAX) {
                *size = field.u64()?;
            }
        }
    }
    Some(Entry { name, method, encrypted, crc, packed, expanded, offset })
}

impl Entry {
    /// Its bytes in memory after expansion, as the directory states them.
    pub(crate) fn expanded_bytes(&self) -> usize {
        usize::try_from(self.expanded).unwrap_or(usize::MAX)
    }

    /// Its content.
    pub(crate) fn content<'a>(&self, archive: &'a [u8]) -> Result<Cow<'a, [u8]>, FormatError> {
        let damaged = |what: &str| FormatError::Damaged {
            reason: format!("entry {} of the archive: {what}", self.name),
        };
        if self.encrypted {
            return Err(FormatError::content(&self.name, "the entry is encrypted"));
        }
        let packed = self.packed(archive).ok_or_else(|| damaged("is cut off"))?;
        let content = match self.method {
            0 => Cow::Borrowed(packed),
            8 => {
                let most = self.expanded.min((packed.len() as u64).saturating_mul(LARGEST_RATIO));
                let mut content = Vec::with_capacity(usize::try_from(most).unwrap_or(0));
                let decoder = DeflateDecoder::new(packed);
                decoder
                    .take(self.expanded.saturating_add(1))
                    .read_to_end(&mut content)
                    .map_err(|error| damaged(&error.to_string()))?;
                Cow::Owned(content)
            }
            method => {
                let reason = format!("the entry is compressed with method {method}");
                return Err(FormatError::content(&self.name, reason));
            }
        };
        let mut crc = Crc::new();
        crc.update(&content);
        if crc.sum() != self.crc || content.len() as u64 != self.expanded {
            return Err(damaged("the checksum is wrong"));
        }
        Ok(content)
    }

    fn packed<'a>(&self, archive: &'a [u8]) -> Option<&'a [u8]> {
        let mut cursor = Cursor::new(archive.get(usize::try_from(self.offset).ok()?..)?, false);
        (cursor.u32()? == LOCAL_HEADER).then_some(())?;
        cursor.take(22)?;
        let [name, extra] = [cursor.u16()?, cursor.u16()?].map(usize::from);
        cursor.take(name)?;
        cursor.take(extra)?;
        cursor.take(usize::try_from(self.packed).ok()?)
    }
}
