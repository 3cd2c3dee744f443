//! Raw data of TDMS segments.

use super::raw_bytes::RawBytes;
use super::raw_index::{RawIndex, RawType};
use super::{COMPLEX, IS_BIG_ENDIAN, IS_INTERLEAVED, Object, Objects, Segment, daqmx};
use crate::collected::Collected;
use crate::format_error::FormatError;
use crate::number::Number;
use crate::stream::Stream;

/// Most pieces of raw data, one for each channel in each segment.
const MOST_VISITS: u64 = 1 << 31;
/// Fractions of a second in a time stamp.
const FRACTIONS_PER_S: f64 = 18_446_744_073_709_551_616.0;

/// Appends the values of a segment, whose raw data come next, to its objects.
pub(super) fn append(
    objects: &mut Objects,
    segment: &Segment,
    number: usize,
    stream: &mut Stream,
    found: &mut Collected,
) -> Result<(), FormatError> {
    if segment.raw_bytes == 0 {
        return Ok(());
    }
    objects.visited += objects.listed.len() as u64;
    if objects.visited > MOST_VISITS {
        let reason = format!("there are more than {MOST_VISITS} pieces of raw data");
        return Err(FormatError::content(format!("segment {number}"), reason));
    }
    let stored = |place: &usize| -> Option<(usize, RawIndex)> {
        let object = objects.all.get(*place)?;
        let index = object.index.filter(|_| object.has_data)?;
        (index.count > 0).then_some((*place, index))
    };
    let stored: Vec<(usize, RawIndex)> = objects.listed.iter().filter_map(stored).collect();
    let big_endian = segment.flags & IS_BIG_ENDIAN != 0;
    if stored.iter().any(|(_, index)| index.of == RawType::Daqmx) {
        let data = RawBytes::new(stream, segment.raw_bytes);
        return daqmx::append(objects, &stored, data, big_endian, found);
    }
    if stored.iter().any(|(_, index)| index.of == RawType::Unknown) {
        found.note(format!("the raw data of segment {number} are of an unknown type: left out"));
        return Ok(());
    }
    let data = RawBytes::new(stream, segment.raw_bytes);
    let mut chunks = Chunks { objects, data, big_endian, found };
    let texts = stored.iter().any(|(_, index)| index.of == RawType::Text);
    if segment.flags & IS_INTERLEAVED != 0 && !texts {
        chunks.interleaved(&stored)
    } else {
        chunks.contiguous(&stored, segment.is_complete)
    }
}

/// Appends chunks of raw data.
struct Chunks<'a, 'w> {
    objects: &'a mut Objects,
    data: RawBytes<'a>,
    big_endian: bool,
    found: &'a mut Collected<'w>,
}

impl Chunks<'_, '_> {
    /// Rows with a value of each object.
    fn interleaved(&mut self, stored: &[(usize, RawIndex)]) -> Result<(), FormatError> {
        let width = stored.iter().filter_map(|(_, index)| index.of.size()).sum::<usize>();
        let Some(rows) = self.data.left().checked_div(width as u64) else { return Ok(()) };
        let mut is_wanted = false;
        for (place, index) in stored {
            is_wanted |= self.count(*place, index.of, rows)?;
        }
        let mut left = if is_wanted { rows } else { 0 };
        while left > 0 {
            let (block, count) = self.data.rows(width, left)?;
            if count == 0 {
                break;
            }
            left -= count as u64;
            let mut offset = 0;
            for (place, index) in stored {
                let bytes = block.get(offset..).unwrap_or_default();
                if let Some(object) = self.objects.all.get_mut(*place) {
                    object.append(index.of, (bytes, width), count, self.big_endian);
                }
                offset += index.of.size().unwrap_or(0);
            }
        }
        Ok(())
    }

    /// Chunks in which the values of each object follow those of the object before.
    fn contiguous(
        &mut self,
        stored: &[(usize, RawIndex)],
        is_complete: bool,
    ) -> Result<(), FormatError> {
        let stored: Vec<_> = stored.iter().filter(|(_, index)| index.bytes > 0).collect();
        let bytes = |sum: u64, (_, index): &&(usize, RawIndex)| sum.saturating_add(index.bytes);
        let chunk = stored.iter().fold(0, bytes);
        while self.data.left() > 0 && chunk > 0 {
            let left = self.data.left();
            for (place, index) in &stored {
                // The last chunk of a complete segment may be shorter for all objects.
                let is_short = left < chunk && is_complete;
                let count = if is_short { share(index.count, left, chunk) } else { index.count };
                let size = index.of.size();
                let wanted = size.map_or(index.bytes, |size| count.saturating_mul(size as u64));
                let wanted = wanted.min(self.data.left());
                let behind = self.data.left() - wanted;
                if let Some(size) = size {
                    self.values(*place, index.of, size, wanted / size as u64)?;
                }
                self.data.skip(self.data.left() - behind)?;
            }
            if left < chunk {
                break;
            }
        }
        Ok(())
    }

    /// Appends the next values, which are of one object.
    fn values(
        &mut self,
        place: usize,
        of: RawType,
        size: usize,
        count: u64,
    ) -> Result<(), FormatError> {
        let mut left = if self.count(place, of, count)? { count } else { 0 };
        while left > 0 {
            let (bytes, count) = self.data.rows(size, left)?;
            if count == 0 {
                break;
            }
            left -= count as u64;
            if let Some(object) = self.objects.all.get_mut(place) {
                object.append(of, (bytes, size), count, self.big_endian);
            }
        }
        Ok(())
    }

    /// Counts values of an object before they are read; whether they are wanted.
    fn count(&mut self, place: usize, of: RawType, count: u64) -> Result<bool, FormatError> {
        let Some(object) = self.objects.all.get_mut(place) else { return Ok(false) };
        match of {
            RawType::Number(_) | RawType::TimeStamp => {
                object.count += count;
                object.has_stamps |= of == RawType::TimeStamp && count > 0;
                if let Some(values) = &mut object.values {
                    let count = usize::try_from(count).unwrap_or(usize::MAX);
                    self.found.take_bytes(count.saturating_mul(size_of::<f64>()))?;
                    values.reserve(count);
                }
                Ok(object.values.is_some())
            }
            RawType::Complex { .. } => {
                self.found.leave_out(&object.name(), &COMPLEX);
                Ok(false)
            }
            RawType::Text | RawType::Daqmx | RawType::Unknown => Ok(false),
        }
    }
}

impl Object {
    /// Appends values that begin every `stride` bytes.
    fn append(
        &mut self,
        of: RawType,
        (bytes, stride): (&[u8], usize),
        count: usize,
        big_endian: bool,
    ) {
        let Some(values) = &mut self.values else { return };
        match of {
            RawType::Number(kind) => {
                Number::new(kind, big_endian).append(values, bytes, stride, count);
            }
            RawType::TimeStamp => {
                let stamps = bytes.chunks(stride.max(1)).take(count);
                append_stamps(values, &mut self.first_stamp, stamps, big_endian);
            }
            RawType::Complex { .. } | RawType::Text | RawType::Daqmx | RawType::Unknown => {}
        }
    }
}

/// The share of a count in a chunk of which only a part is there.
fn share(count: u64, part: u64, whole: u64) -> u64 {
    let share = u128::from(count) * u128::from(part) / u128::from(whole.max(1));
    u64::try_from(share).unwrap_or(u64::MAX)
}

/// Appends time stamps, as seconds since the first one.
fn append_stamps<'b>(
    values: &mut Vec<f64>,
    first_stamp: &mut Option<(i64, u64)>,
    stamps: impl Iterator<Item = &'b [u8]>,
    big_endian: bool,
) {
    for stamp in stamps {
        let Some(bytes) = stamp.first_chunk::<16>() else { return };
        let value =
            if big_endian { u128::from_be_bytes(*bytes) } else { u128::from_le_bytes(*bytes) };
        // The upper half counts seconds, the lower half fractions of a second.
        let (seconds, fractions) = ((value >> 64) as i64, value as u64);
        let (first, first_fractions) = *first_stamp.get_or_insert((seconds, fractions));
        let fraction = (fractions as f64 - first_fractions as f64) / FRACTIONS_PER_S;
        values.push(seconds.wrapping_sub(first) as f64 + fraction);
    }
}
