//! Raw data of TDMS segments.

use super::raw_index::{RawIndex, RawType};
use super::{COMPLEX, IS_BIG_ENDIAN, IS_INTERLEAVED, Object, Objects, Segment, daqmx};
use crate::collected::Collected;
use crate::format_error::FormatError;
use crate::number::Number;

/// Most pieces of raw data, one for each channel in each segment.
const MOST_VISITS: u64 = 1 << 31;
/// Fractions of a second in a time stamp.
const FRACTIONS_PER_S: f64 = 18_446_744_073_709_551_616.0;

/// Appends the values of a segment to its objects.
pub(super) fn append(
    objects: &mut Objects,
    segment: &Segment,
    number: usize,
    found: &mut Collected,
) -> Result<(), FormatError> {
    if segment.raw_data.is_empty() {
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
        return daqmx::append(objects, &stored, segment.raw_data, big_endian, found);
    }
    if stored.iter().any(|(_, index)| index.of == RawType::Unknown) {
        found.note(format!("the raw data of segment {number} are of an unknown type: left out"));
        return Ok(());
    }
    let mut chunks = Chunks { objects, big_endian, found };
    let texts = stored.iter().any(|(_, index)| index.of == RawType::Text);
    if segment.flags & IS_INTERLEAVED != 0 && !texts {
        chunks.interleaved(&stored, segment.raw_data)
    } else {
        chunks.contiguous(&stored, segment)
    }
}

/// Appends chunks of raw data.
struct Chunks<'a, 'w> {
    objects: &'a mut Objects,
    big_endian: bool,
    found: &'a mut Collected<'w>,
}

impl Chunks<'_, '_> {
    /// Rows with a value of each object.
    fn interleaved(
        &mut self,
        stored: &[(usize, RawIndex)],
        data: &[u8],
    ) -> Result<(), FormatError> {
        let width = stored.iter().filter_map(|(_, index)| index.of.size()).sum::<usize>();
        let Some(rows) = data.len().checked_div(width) else { return Ok(()) };
        let mut offset = 0;
        for (place, index) in stored {
            let bytes = data.get(offset..).unwrap_or_default();
            self.values(*place, index.of, bytes, width, rows)?;
            offset += index.of.size().unwrap_or(0);
        }
        Ok(())
    }

    /// Chunks in which the values of each object follow those of the object before.
    fn contiguous(
        &mut self,
        stored: &[(usize, RawIndex)],
        segment: &Segment,
    ) -> Result<(), FormatError> {
        let stored: Vec<_> = stored.iter().filter(|(_, index)| index.bytes > 0).collect();
        let bytes = |sum: u64, (_, index): &&(usize, RawIndex)| sum.saturating_add(index.bytes);
        let chunk = stored.iter().fold(0, bytes);
        let mut data = segment.raw_data;
        while !data.is_empty() && chunk > 0 {
            let left = data.len() as u64;
            for (place, index) in &stored {
                // The last chunk of a complete segment may be shorter for all objects.
                let is_short = left < chunk && segment.is_complete;
                let count = if is_short { share(index.count, left, chunk) } else { index.count };
                let size = index.of.size();
                let wanted = size.map_or(index.bytes, |size| count.saturating_mul(size as u64));
                let wanted = usize::try_from(wanted).unwrap_or(usize::MAX).min(data.len());
                let (bytes, rest) = data.split_at(wanted);
                data = rest;
                if let Some(size) = size {
                    self.values(*place, index.of, bytes, size, wanted / size)?;
                }
            }
            if left < chunk {
                break;
            }
        }
        Ok(())
    }

    /// Appends the values of an object that begin every `stride` bytes.
    fn values(
        &mut self,
        place: usize,
        of: RawType,
        bytes: &[u8],
        stride: usize,
        count: usize,
    ) -> Result<(), FormatError> {
        let Some(object) = self.objects.all.get_mut(place) else { return Ok(()) };
        match of {
            RawType::Number(kind) => {
                self.found.take_bytes(count.saturating_mul(size_of::<f64>()))?;
                Number::new(kind, self.big_endian).append(&mut object.values, bytes, stride, count);
            }
            RawType::TimeStamp => {
                self.found.take_bytes(count.saturating_mul(size_of::<f64>()))?;
                stamps(object, bytes, stride, count, self.big_endian);
            }
            RawType::Complex { .. } => self.found.leave_out(&object.name(), &COMPLEX),
            RawType::Text | RawType::Daqmx | RawType::Unknown => {}
        }
        Ok(())
    }
}

/// The share of a count in a chunk of which only a part is there.
fn share(count: u64, part: u64, whole: u64) -> u64 {
    let share = u128::from(count) * u128::from(part) / u128::from(whole.max(1));
    u64::try_from(share).unwrap_or(u64::MAX)
}

/// Appends time stamps, as seconds since the first one.
fn stamps(object: &mut Object, bytes: &[u8], stride: usize, count: usize, big_endian: bool) {
    for stamp in bytes.chunks(stride.max(1)).take(count) {
        let Some(bytes) = stamp.first_chunk::<16>() else { return };
        let value =
            if big_endian { u128::from_be_bytes(*bytes) } else { u128::from_le_bytes(*bytes) };
        // The upper half counts seconds, the lower half fractions of a second.
        let (seconds, fractions) = ((value >> 64) as i64, value as u64);
        let (first, first_fractions) = *object.first_stamp.get_or_insert((seconds, fractions));
        let fraction = (fractions as f64 - first_fractions as f64) / FRACTIONS_PER_S;
        object.values.push(seconds.wrapping_sub(first) as f64 + fraction);
    }
}
