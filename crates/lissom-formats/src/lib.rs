//! Reads log files of other programs.
//!
//! [`read`] recognises a format by the content of the file, not by its name, and returns all its channels as
//! [`LogData`]: names, units as the file states them, values, and the clock of each channel.
//!
//! | format | what is read |
//! |---|---|
//! | delimited text | preambles of any length, header, row of units, time stamps, blank cells, one row per signal |
//! | CSV of oscilloscopes | units and the time between two samples from the lines above the table |
//! | CSV of ROS | seconds and nanoseconds in two columns are a further channel `time` |
//! | long tables, AdvantageScope | rows of time, name and value: each name with its own clock |
//! | LabVIEW `.lvm` | all segments one after the other, units, and times from `X0` and `Delta_X` |
//! | TwinCAT Scope, CODESYS trace | each channel with its own clock |
//! | JSON | arrays, records, lines |
//! | MATLAB v4, v5, v6, v7 | matrices, structs, struct arrays, cells; a structure with time has its clock |
//! | NumPy `.npy`, `.npz` | numbers of all types, structured arrays by field |
//! | WPILib `.wpilog` | entries of numbers and of arrays of numbers, each with its own clock |
//! | TDMS | channels of numbers and time stamps, of NI-DAQmx too, linear and polynomial scales; waveforms have their clock |
//! | UFF, UNV | time responses in datasets 58 and 58b, each with its own clock; frequency responses with `frequency` |
//! | MATLAB v7.3 (feature `hdf5`) | as the earlier versions |
//! | HDF5 (feature `hdf5`) | datasets of numbers with the path of their groups, compound types by field, units in attributes |
//! | MCAP (feature `mcap`) | messages of ROS 2 and in JSON: each number of a topic, with its clock |
//! | Excel `.xlsx` (feature `xlsx`) | the sheet with the longest block of numbers, and those with the same columns; header and row of units |
//! | Parquet (feature `parquet`) | columns of numbers and of structs of numbers; times are seconds |
//!
//! Complex numbers are two channels, `NAME/real` and `NAME/imag`.
//!
//! The feature `full` has all formats. Without its feature, a format is recognised, and the error states the way out.
//!
//! Where a text does not show its header or its decimal sign, [`read_with`] takes them as [`ReadOptions`].
//!
//! [`read_channels`] reads some channels. A text or a binary file is then read in pieces, and values of other channels take no
//! memory; JSON, workbooks, universal files, text in UTF-16 and compressed binary files are in memory as a whole.
//!
//! Text may be UTF-8, UTF-16 or Windows-1252; `.gz` and `.zst` are expanded.

mod array;
mod binary;
mod bytes;
mod channel_ref;
mod collected;
mod columns;
mod cursor;
mod expanded;
mod format;
mod format_error;
#[cfg(any(feature = "hdf5", feature = "parquet", feature = "xlsx"))]
mod guard;
#[cfg(feature = "hdf5")]
mod hdf5;
mod json;
mod log_data;
mod matlab;
#[cfg(feature = "mcap")]
mod mcap;
mod number;
mod numpy;
#[cfg(feature = "parquet")]
mod parquet_file;
#[cfg(feature = "parquet")]
mod parquet_message;
#[cfg(feature = "parquet")]
mod parquet_pages;
mod parts;
mod plain_decimal;
mod read;
mod read_options;
mod source;
mod stream;
mod tdms;
mod text;
mod uff58;
mod unit;
mod words;
mod wpilog;
#[cfg(feature = "xlsx")]
mod xlsx;
mod zip;

pub use bytes::expands_beyond;
pub use channel_ref::{ChannelRef, bare_name};
pub use format::Format;
pub use format_error::FormatError;
pub use log_data::{Channel, Clock, LogData};
pub use plain_decimal::PlainDecimal;
pub use read::{is_no_plain_table, read, read_bytes, read_channels, read_with};
pub use read_options::ReadOptions;
pub use words::Words;
