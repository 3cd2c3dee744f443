//! Formats that are no tables of text, recognised by their first bytes.

use crate::channel_ref::Wanted;
#[cfg(not(feature = "xlsx"))]
use crate::format::WORKBOOK;
use crate::format_error::FormatError;
#[cfg(feature = "hdf5")]
use crate::hdf5;
use crate::log_data::LogData;
#[cfg(feature = "mcap")]
use crate::mcap;
#[cfg(feature = "parquet")]
use crate::parquet_file;
use crate::source::Source;
#[cfg(feature = "xlsx")]
use crate::xlsx;
use crate::{matlab, numpy, tdms, uff58, wpilog, zip};

/// A binary format.
struct Binary {
    /// Whether a file begins as this format does.
    begins: fn(&[u8]) -> bool,
    read: fn(&Source, Wanted) -> Result<LogData, FormatError>,
}

const BINARY: &[Binary] = &[
    Binary { begins: |bytes| bytes.starts_with(numpy::NPY), read: numpy::read_npy },
    Binary { begins: matlab::begins_v5, read: matlab::read_v5 },
    Binary { begins: |bytes| bytes.starts_with(wpilog::WPILOG), read: wpilog::read },
    Binary { begins: |bytes| bytes.starts_with(tdms::TDMS), read: tdms::read },
    Binary { begins: uff58::begins, read: uff58::read },
    #[cfg(feature = "hdf5")]
    Binary { begins: |bytes| bytes.starts_with(hdf5::HDF5), read: hdf5::read },
    #[cfg(feature = "hdf5")]
    Binary { begins: |bytes| bytes.starts_with(matlab::MATLAB_73), read: matlab::read_v73 },
    #[cfg(feature = "mcap")]
    Binary { begins: |bytes| bytes.starts_with(mcap::MCAP), read: mcap::read },
    #[cfg(feature = "parquet")]
    Binary { begins: |bytes| bytes.starts_with(parquet_file::PARQUET), read: parquet_file::read },
    Binary { begins: matlab::begins_v4, read: matlab::read_v4 },
];

fn of(bytes: &[u8]) -> Option<&'static Binary> {
    BINARY.iter().find(|format| (format.begins)(bytes))
}

/// Whether a file begins as a binary format that is read.
pub(crate) fn is_recognised(first: &[u8]) -> bool {
    of(first).is_some()
}

/// Reads a file with these first bytes; `None` if it is of none of the binary formats.
pub(crate) fn read(
    source: &Source,
    first: &[u8],
    wanted: Wanted,
) -> Result<Option<LogData>, FormatError> {
    if let Some(format) = of(first) {
        return (format.read)(source, wanted).map(Some);
    }
    if !first.starts_with(zip::ZIP) {
        return Ok(None);
    }
    // An archive is one of arrays or a workbook by its entries, not by its first bytes.
    let Some(entries) = zip::entries(source)? else {
        let reason = "the archive ends before its directory".to_owned();
        return Err(FormatError::Damaged { reason });
    };
    #[cfg(feature = "xlsx")]
    if xlsx::is_workbook(&entries) {
        return xlsx::read(source, &entries, wanted).map(Some);
    }
    #[cfg(not(feature = "xlsx"))]
    if entries.iter().any(|entry| entry.name == "xl/workbook.xml") {
        return Err(WORKBOOK);
    }
    numpy::is_npz(&entries).then(|| numpy::read_npz(source, &entries, wanted)).transpose()
}
