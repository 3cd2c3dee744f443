//! Datasets of HDF5 files: their shape, their type, and their bytes.

use hdf5_pure::{Dataset, Datatype, DatatypeByteOrder, Error, File};

use crate::array::{Array, Axis, items};
use crate::bytes::MOST_BYTES;
use crate::collected::Collected;
use crate::format_error::FormatError;
use crate::number::{Number, NumberType};

/// Most bytes that deflate makes of one, rounded up.
const LARGEST_RATIO: u64 = 1100;

/// The file in these bytes.
pub(crate) fn opened(bytes: &[u8]) -> Result<File, FormatError> {
    let mut bytes = bytes.to_vec();
    remove_soft_links(&mut bytes);
    File::from_bytes(bytes).map_err(damaged)
}

/// Removes soft links from groups of the older kind: the library takes them for damage and reads none of the group.
///
/// # Source
/// HDF5 file format specification 3.0, III.B and III.C: nodes and entries of symbol tables.
fn remove_soft_links(bytes: &mut [u8]) {
    const NODE: &[u8] = b"SNOD\x01\x00";
    /// Header of a node; an entry with addresses of 64 bits.
    const SIZES: (usize, usize) = (8, 40);
    let mut place = 0;
    while let Some(next) = position(bytes.get(place..).unwrap_or_default(), NODE) {
        let node = place + next;
        place = node + SIZES.0;
        let Some(count) = bytes.get(node + 6..place).and_then(|b| b.first_chunk::<2>()) else {
            return;
        };
        let count = usize::from(u16::from_le_bytes(*count));
        let Some(entries) = bytes.get_mut(place..place + count * SIZES.1) else { continue };
        let mut kept = 0;
        for k in 0..count {
            let entry = entries.get(k * SIZES.1..(k + 1) * SIZES.1).unwrap_or_default();
            // No address of an object, and the type of a soft link.
            let is_soft = entry.get(8..20) == Some(b"\xff\xff\xff\xff\xff\xff\xff\xff\x02\0\0\0");
            if !is_soft {
                entries.copy_within(k * SIZES.1..(k + 1) * SIZES.1, kept * SIZES.1);
                kept += 1;
            }
        }
        if let Some(stated) = bytes.get_mut(node + 6..place) {
            stated.copy_from_slice(&(kept as u16).to_le_bytes());
        }
    }
}

fn position(bytes: &[u8], of: &[u8]) -> Option<usize> {
    bytes.windows(of.len()).position(|window| window == of)
}

/// The error of the library as one of the file.
#[expect(clippy::needless_pass_by_value, reason = "for map_err")]
pub(crate) fn damaged(error: Error) -> FormatError {
    FormatError::content("HDF5 file", error.to_string())
}

pub(crate) fn too_large() -> FormatError {
    FormatError::TooLarge { most: MOST_BYTES }
}

/// The lengths of the axes.
pub(crate) fn shape(dataset: &Dataset) -> Result<Vec<usize>, FormatError> {
    let lengths = dataset.shape().map_err(damaged)?;
    let lengths = lengths.into_iter().map(|length| usize::try_from(length).ok());
    lengths.collect::<Option<_>>().ok_or_else(too_large)
}

/// Size of an item \[byte\].
pub(crate) fn item_size(dataset: &Dataset) -> Result<usize, FormatError> {
    let size = dataset.element_size().map_err(damaged)?;
    usize::try_from(size).map_err(|_| too_large())
}

/// The items of a dataset; their bytes are counted as taken.
pub(crate) fn bytes(dataset: &Dataset, found: &mut Collected) -> Result<Vec<u8>, FormatError> {
    let size = item_size(dataset)?;
    let of = |lengths: &[usize]| items(lengths).and_then(|count| count.checked_mul(size));
    let count = of(&shape(dataset)?).ok_or_else(too_large)?;
    found.take_bytes(count)?;
    let mut stored = count as u64;
    if let Some(lengths) = dataset.chunk_shape().map_err(damaged)? {
        // All chunks are in memory at once, each with its whole size.
        let lengths: Vec<usize> = lengths.into_iter().map(|length| length as usize).collect();
        let chunks = dataset.chunks().map_err(damaged)?;
        let expanded = of(&lengths).and_then(|chunk| chunk.checked_mul(chunks.len()));
        let expanded = expanded.ok_or_else(too_large)?;
        found.take_bytes(expanded)?;
        found.release_bytes(expanded);
        stored = chunks.iter().fold(0, |sum, chunk| chunk.storage_size.saturating_add(sum));
    }
    if count as u64 > stored.saturating_mul(LARGEST_RATIO) {
        let reason = format!("{count} bytes are stated, and {stored} are in the file");
        return Err(FormatError::content("its data", reason));
    }
    dataset.read_raw().map_err(damaged)
}

/// The numbers of the two parts of a complex number, and the offset of the second one in the item, if a type is one: of
/// h5py the parts are `r` and `i`, of MATLAB `real` and `imag`.
pub(crate) fn complex(of: &Datatype) -> Option<([Number; 2], usize)> {
    let Datatype::Compound { members, .. } = of else { return None };
    let [real, imag] = &members[..] else { return None };
    let names = (real.name.as_str(), imag.name.as_str());
    let is_complex = matches!(names, ("r", "i") | ("real", "imag")) && real.byte_offset == 0;
    let offset = usize::try_from(imag.byte_offset).ok().filter(|_| is_complex)?;
    Some(([number(&real.datatype)?, number(&imag.datatype)?], offset))
}

/// Two arrays of the parts of complex numbers.
pub(crate) fn parts<'a>(
    bytes: &'a [u8],
    ([real, imag], offset): ([Number; 2], usize),
    axes: &[Axis],
) -> [Array<'a>; 2] {
    let array =
        |bytes: &'a [u8], number| Array { bytes: bytes.into(), number, axes: axes.to_vec() };
    [array(bytes, real), array(bytes.get(offset..).unwrap_or_default(), imag)]
}

/// Whether items of a type are texts.
pub(crate) fn is_text(of: &Datatype) -> bool {
    matches!(of, Datatype::String { .. } | Datatype::VariableLength { .. })
}

/// The numbers of a type; those of an enumeration are its values. `None` if it has none of a usual size.
pub(crate) fn number(of: &Datatype) -> Option<Number> {
    let (kind, order) = match of {
        Datatype::FixedPoint { size, byte_order, layout } => {
            let whole = layout.bit_offset == 0
                && size.checked_mul(8) == Some(u32::from(layout.bit_precision));
            (integer(*size, layout.signed).filter(|_| whole)?, byte_order)
        }
        Datatype::BitField { size, byte_order, .. } => (integer(*size, false)?, byte_order),
        Datatype::FloatingPoint { size, byte_order, layout } => {
            // Sizes of number, exponent and fraction.
            let kind = match (size, layout.exponent_size, layout.mantissa_size) {
                (2, 5, 10) => NumberType::F16,
                (4, 8, 23) => NumberType::F32,
                (8, 11, 52) => NumberType::F64,
                _ => return None,
            };
            (kind, byte_order)
        }
        Datatype::Enumeration { base_type, .. } => return number(base_type),
        _ => return None,
    };
    match order {
        DatatypeByteOrder::LittleEndian => Some(Number::new(kind, false)),
        DatatypeByteOrder::BigEndian => Some(Number::new(kind, true)),
        DatatypeByteOrder::Vax => None,
    }
}

fn integer(size: u32, signed: bool) -> Option<NumberType> {
    Some(match (size, signed) {
        (1, true) => NumberType::I8,
        (2, true) => NumberType::I16,
        (4, true) => NumberType::I32,
        (8, true) => NumberType::I64,
        (1, false) => NumberType::U8,
        (2, false) => NumberType::U16,
        (4, false) => NumberType::U32,
        (8, false) => NumberType::U64,
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use hdf5_pure::FixedPointLayout;

    use super::*;

    #[test]
    fn a_damaged_size_is_no_number() {
        let layout = FixedPointLayout { signed: true, bit_offset: 0, bit_precision: 32 };
        let of = |size| {
            let byte_order = DatatypeByteOrder::LittleEndian;
            number(&Datatype::FixedPoint { size, byte_order, layout })
        };
        assert_eq!(of(4), Some(Number::new(NumberType::I32, false)));
        // Eight times this size is 32 in 32 bits.
        assert_eq!(of((1 << 29) + 4), None);
    }
}
