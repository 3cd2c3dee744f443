//! Datasets of HDF5 files: their shape, their type, and their bytes.

use hdf5_pure::{Dataset, Datatype, DatatypeByteOrder, Error};

use crate::array::items;
use crate::bytes::MOST_BYTES;
use crate::collected::Collected;
use crate::columns::Columns;
use crate::format_error::FormatError;
use crate::number::{Number, NumberType};

/// Most bytes that deflate makes of one, rounded up.
const LARGEST_RATIO: u64 = 1100;

/// Bytes that are read at once, if they are of contiguous data or of small chunks.
const BLOCK_BYTES: usize = 1 << 18;
/// Most bytes that are read at once, if the wanted values are fewer: chunks that span more than that are expanded again
/// for each part.
const MOST_AT_ONCE: usize = 1 << 26;

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

/// Number of bytes of the items of a dataset in a file of a number of bytes.
pub(crate) fn byte_count(
    dataset: &Dataset,
    file_bytes: u64,
    found: &mut Collected,
) -> Result<usize, FormatError> {
    let size = item_size(dataset)?;
    let of = |lengths: &[usize]| items(lengths).and_then(|count| count.checked_mul(size));
    let count = of(&shape(dataset)?).ok_or_else(too_large)?;
    let mut stored = count as u64;
    if let Some(lengths) = dataset.chunk_shape().map_err(damaged)? {
        // A chunk is in memory with its whole size.
        let lengths: Vec<usize> = lengths.into_iter().map(|length| length as usize).collect();
        let chunks = dataset.chunks().map_err(damaged)?;
        let expanded = of(&lengths).and_then(|chunk| chunk.checked_mul(chunks.len()));
        let expanded = expanded.ok_or_else(too_large)?;
        found.take_bytes(expanded)?;
        found.release_bytes(expanded);
        // The library takes memory for a chunk before it reads it.
        if chunks.iter().any(|chunk| chunk.storage_size > file_bytes) {
            return Err(FormatError::content("its data", "a chunk is larger than the file"));
        }
        stored = chunks.iter().fold(0, |sum, chunk| chunk.storage_size.saturating_add(sum));
    }
    if count as u64 > stored.saturating_mul(LARGEST_RATIO) {
        let reason = format!("{count} bytes are stated, and {stored} are in the file");
        return Err(FormatError::content("its data", reason));
    }
    Ok(count)
}

/// All items of a dataset; their bytes are counted as taken.
pub(crate) fn bytes(
    dataset: &Dataset,
    file_bytes: u64,
    found: &mut Collected,
) -> Result<Vec<u8>, FormatError> {
    let count = byte_count(dataset, file_bytes, found)?;
    found.take_bytes(count)?;
    dataset.read_raw().map_err(damaged)
}

/// Reads the wanted values of the arrays in a dataset.
pub(crate) fn read_values(dataset: &Dataset, arrays: &mut [Columns]) -> Result<(), FormatError> {
    let lengths = shape(dataset)?;
    let row_bytes = items(lengths.get(1..).unwrap_or_default());
    let row_bytes = row_bytes.and_then(|items| items.checked_mul(item_size(dataset).ok()?));
    let row_bytes = row_bytes.ok_or_else(too_large)?.max(1);
    let rows = rows_at_once(dataset, row_bytes, arrays)?;
    let mut before = None;
    while let Some(next) = arrays.iter().filter_map(Columns::next).min() {
        if before.replace(next) == Some(next) {
            return Err(FormatError::content("its data", "a number is not inside its item"));
        }
        let first = next / row_bytes / rows * rows;
        let bytes = dataset.read_raw_rows(first as u64, rows as u64).map_err(damaged)?;
        for array in arrays.iter_mut() {
            array.append(&bytes, first * row_bytes);
        }
    }
    if before.is_none() {
        // A dataset that cannot be read is left out, whether it is wanted or not.
        dataset.read_raw_rows(0, 1).map_err(damaged)?;
    }
    Ok(())
}

/// Number of rows that are read at once: whole chunks, so that each is expanded once.
fn rows_at_once(
    dataset: &Dataset,
    row_bytes: usize,
    arrays: &[Columns],
) -> Result<usize, FormatError> {
    let chunk = dataset.chunk_shape().map_err(damaged)?;
    let chunk = chunk.and_then(|lengths| lengths.first().copied()).unwrap_or(1).max(1);
    let chunk = usize::try_from(chunk).map_err(|_| too_large())?;
    let chunk_bytes = chunk.saturating_mul(row_bytes);
    let most = arrays.iter().map(Columns::wanted_bytes).sum::<usize>().max(MOST_AT_ONCE);
    Ok(if chunk_bytes <= most {
        chunk * (BLOCK_BYTES / chunk_bytes).max(1)
    } else {
        (most / row_bytes).max(1)
    })
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
