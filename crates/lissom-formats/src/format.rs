//! Formats, recognised by the first bytes of a file.

#[cfg(not(feature = "xlsx"))]
use crate::format_error::FormatError;
use crate::zip::ZIP;

/// Format of a log file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Format {
    /// No file: columns in memory.
    Memory,
    /// Delimited text.
    Text,
    /// Text with one row for each signal.
    TextByRow,
    /// Text with one row for each value: its time, the name of its signal, and the value.
    TextByValue,
    /// LabVIEW measurement file of several segments.
    LabView,
    /// Export of TwinCAT Scope.
    TwinCat,
    /// Trace of CODESYS.
    Codesys,
    /// JSON: arrays, records, or a record on each line.
    Json,
    /// MATLAB file.
    Matlab,
    /// Array of NumPy.
    Npy,
    /// Archive of arrays of NumPy.
    Npz,
    /// Data log of WPILib.
    WpiLog,
    /// TDMS file of National Instruments.
    Tdms,
    /// Universal file with datasets 58.
    Uff58,
    /// HDF5 file.
    Hdf5,
    /// MCAP file.
    Mcap,
    /// Excel workbook.
    Xlsx,
    /// Parquet file.
    Parquet,
}

impl Format {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Memory => "table in memory",
            Self::Text => "delimited text",
            Self::TextByRow => "text with one row for each signal",
            Self::TextByValue => "text with one row for each value",
            Self::LabView => "LabVIEW measurement file",
            Self::TwinCat => "TwinCAT Scope export",
            Self::Codesys => "CODESYS trace",
            Self::Json => "JSON",
            Self::Matlab => "MATLAB file",
            Self::Npy => "NumPy array",
            Self::Tdms => "TDMS file",
            Self::Uff58 => "universal file",
            Self::Hdf5 => "HDF5 file",
            Self::Mcap => "MCAP file",
            Self::Xlsx => "Excel workbook",
            Self::Parquet => "Parquet file",
            Self::WpiLog => "WPILib log",
            Self::Npz => "NumPy archive",
        }
    }
}

/// The way out of a build that lacks the reader of a format.
macro_rules! full_or {
    ($format:literal, $way_out:literal) => {
        concat!(
            "this build of lissom has no reader for ",
            $format,
            ": install it with `--features full`, or ",
            $way_out
        )
    };
}

/// A workbook in a build without the feature `xlsx`.
#[cfg(not(feature = "xlsx"))]
pub(crate) const WORKBOOK: FormatError = FormatError::Foreign {
    what: "an Excel workbook",
    way_out: full_or!("Excel workbooks", "save the sheet as CSV"),
};

/// A format that is recognised and not read, with the way out.
pub(crate) fn foreign(bytes: &[u8]) -> Option<(&'static str, &'static str)> {
    /// First bytes, name, way out.
    const KNOWN: [(&[u8], &str, &str); 12] = [
        (b"%PDF", "a PDF document", NO_TABLE),
        (b"\x89PNG", "a picture", NO_TABLE),
        (b"\xFF\xD8\xFF", "a picture", NO_TABLE),
        (b"\x89HDF\r\n\x1a\n", "an HDF5 file (MATLAB v7.3 files are such files)", HDF5),
        (b"MATLAB 7.", "a MATLAB file of version 7.3 (HDF5)", MATLAB),
        (ZIP, "a ZIP archive without NumPy arrays", ARCHIVE),
        (b"\x89MCAP0\r\n", "an MCAP file", MCAP),
        (b"PAR1", "a Parquet file", PARQUET),
        (b"SQLite format 3\0", "an SQLite database (ROS 2 bags .db3 are such)", BAG),
        (
            b"#ROSBAG V2.0",
            "a ROS 1 bag",
            "export the topics as CSV: rostopic echo -b FILE -p TOPIC > log.csv",
        ),
        (b"\xD0\xCF\x11\xE0", "an old Excel or Office file", "save it as CSV"),
        (b"\x80", "a Python pickle", PICKLE),
    ];
    const NO_TABLE: &str = "give the table of numbers as text";
    const HDF5: &str = full_or!("HDF5 files", "export the channels as CSV");
    const MATLAB: &str =
        full_or!("HDF5 files", "in MATLAB: load(FILE); save(\"log.mat\", \"-v7\")");
    const PARQUET: &str =
        full_or!("Parquet files", "in Python: pandas.read_parquet(FILE).to_csv(\"log.csv\")");
    const MCAP: &str = full_or!("MCAP files", "export the topics as CSV");
    const ARCHIVE: &str = "unpack it, or save the table as CSV";
    const BAG: &str = "convert the bag to MCAP or export the topics as CSV";
    const PICKLE: &str = "pickles can run programs and are never loaded; in Python: \
                          pandas.DataFrame(DATA).to_csv(\"log.csv\")";
    KNOWN.into_iter().find(|(first, ..)| bytes.starts_with(first)).map(|(_, name, way)| (name, way))
}
