//! Raw data of NI-DAQmx: rows of bytes, one buffer for each device, in which scalers state the places of the channels.

use super::raw_bytes::RawBytes;
use super::raw_index::{RawIndex, RawType};
use super::{Objects, SCALERS};
use crate::collected::Collected;
use crate::cursor::Cursor;
use crate::format_error::FormatError;
use crate::number::{Number, NumberType};

/// How the values of a channel are stored.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Daqmx {
    scalers: Vec<Scaler>,
    /// Size of a row of each buffer \[byte\].
    widths: Vec<usize>,
}

/// The place of a value in a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Scaler {
    /// `None` if values of the type are no numbers.
    kind: Option<NumberType>,
    buffer: usize,
    /// First byte of the value.
    offset: usize,
    /// The bit, if the value is a digital line.
    bit: Option<u32>,
}

/// Reads how the values of a channel are stored; `None` if that is damaged.
pub(super) fn index(cursor: &mut Cursor, is_digital: bool) -> Option<Daqmx> {
    let mut scalers = Vec::new();
    for _ in 0..cursor.u32()? {
        let kind = number_type(cursor.u32()?);
        let buffer = cursor.count_u32()?;
        let offset = cursor.u32()?;
        let (offset, bit) = if is_digital {
            cursor.u8()?;
            (offset / 8, Some(offset % 8))
        } else {
            cursor.u32()?;
            (offset, None)
        };
        let _scale = cursor.u32()?;
        scalers.push(Scaler { kind, buffer, offset: usize::try_from(offset).ok()?, bit });
    }
    let mut widths = Vec::new();
    for _ in 0..cursor.u32()? {
        widths.push(cursor.count_u32()?);
    }
    Some(Daqmx { scalers, widths })
}

fn number_type(code: u32) -> Option<NumberType> {
    Some(match code {
        0 => NumberType::U8,
        1 => NumberType::I8,
        2 => NumberType::U16,
        3 => NumberType::I16,
        4 => NumberType::U32,
        5 => NumberType::I32,
        6 => NumberType::U64,
        7 => NumberType::I64,
        8 => NumberType::F32,
        9 => NumberType::F64,
        _ => return None,
    })
}

/// A channel of a segment.
struct Place {
    object: usize,
    count: usize,
    scaler: Scaler,
    number: Number,
}

/// Appends the values in the raw data of a segment.
pub(super) fn append(
    objects: &mut Objects,
    stored: &[(usize, RawIndex)],
    mut data: RawBytes,
    big_endian: bool,
    found: &mut Collected,
) -> Result<(), FormatError> {
    let mut widths: Vec<usize> = Vec::new();
    let mut rows: Vec<usize> = Vec::new();
    let mut places = Vec::new();
    for (object, index) in stored {
        let Some(of) = objects.all.get(*object) else { continue };
        let (RawType::Daqmx, Some(daqmx)) = (index.of, &of.daqmx) else { continue };
        if widths.is_empty() {
            widths.clone_from(&daqmx.widths);
            rows = vec![0; widths.len()];
        }
        let count = usize::try_from(index.count).unwrap_or(usize::MAX);
        for scaler in &daqmx.scalers {
            if let Some(rows) = rows.get_mut(scaler.buffer) {
                *rows = count.max(*rows);
            }
        }
        match daqmx.scalers[..] {
            [scaler @ Scaler { kind: Some(kind), .. }] => {
                let number = Number::new(kind, big_endian);
                places.push(Place { object: *object, count, scaler, number });
            }
            _ => found.leave_out(&of.name(), &SCALERS),
        }
    }
    while data.left() > 0 {
        let before = data.left();
        for (buffer, (width, rows)) in widths.iter().zip(&rows).enumerate() {
            let bytes = (*width as u64).saturating_mul(*rows as u64).min(data.left());
            let behind = data.left() - bytes;
            if bytes > 0 {
                let places = places.iter().filter(|place| place.scaler.buffer == buffer);
                let places: Vec<&Place> = places.collect();
                values(objects, &places, (&mut data, bytes / *width as u64), *width, found)?;
            }
            data.skip(data.left() - behind)?;
        }
        if data.left() == before {
            return Ok(());
        }
    }
    Ok(())
}

/// Appends the values in the next rows, which are those of a buffer.
fn values(
    objects: &mut Objects,
    places: &[&Place],
    (data, rows): (&mut RawBytes, u64),
    width: usize,
    found: &mut Collected,
) -> Result<(), FormatError> {
    let mut is_wanted = false;
    let fits = |place: &&&Place| place.end() <= width;
    for place in places.iter().filter(fits) {
        let Some(object) = objects.all.get_mut(place.object) else { continue };
        let count = (place.count as u64).min(rows);
        object.count += count;
        is_wanted |= object.values.is_some();
        let count = if object.values.is_some() { count } else { 0 };
        let bytes = count.saturating_mul(size_of::<f64>() as u64);
        // Each visit of a piece of data counts.
        found.take_bytes(usize::try_from(bytes).unwrap_or(usize::MAX).max(1))?;
    }
    let mut row = 0;
    while is_wanted && row < rows {
        let (bytes, count) = data.rows(width, rows - row)?;
        if count == 0 {
            break;
        }
        for place in places.iter().filter(fits) {
            let Some(object) = objects.all.get_mut(place.object) else { continue };
            if let Some(values) = &mut object.values {
                let left = (place.count as u64).saturating_sub(row);
                place.append(values, bytes, width, left.min(count as u64) as usize);
            }
        }
        row += count as u64;
    }
    Ok(())
}

impl Place {
    /// Bytes of a row up to the end of the value.
    fn end(&self) -> usize {
        self.scaler.offset.saturating_add(self.number.kind.size())
    }

    /// Appends the values in rows.
    fn append(&self, values: &mut Vec<f64>, rows: &[u8], width: usize, count: usize) {
        let Scaler { offset, bit, .. } = self.scaler;
        let first = values.len();
        let bytes = rows.get(offset..).unwrap_or_default();
        self.number.append(values, bytes, width, count);
        if let Some(bit) = bit {
            for value in values.iter_mut().skip(first) {
                *value = f64::from(u8::from(*value as u64 >> bit & 1 == 1));
            }
        }
    }
}
