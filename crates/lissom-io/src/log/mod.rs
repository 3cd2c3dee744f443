//! Delimited text logs.
//!
//! A log is text with one sample in each row. Cells are separated by commas, semicolons or tabs, or by blanks if there
//! are none of these. Names are in a header row, or in a comment line (`#` or `%`) before the data. Of several comment
//! lines the last one with as many names as columns is used, otherwise the last one with at least half as many. Names
//! belong to columns by position. A column is selected by its exact name, without blanks around it, or by its number
//! from 1. A row of words below a header row is taken as units and skipped. Blank lines, comment lines between the
//! data, CRLF, a byte order mark and a delimiter at the end of a row are allowed.
//!
//! Only the selected columns are read as numbers. Memory is bounded: a log with more rows than [`LogOptions::max_rows`]
//! is thinned while it is read, a held command by its mean, a measured channel by leaving out samples, without a
//! filter. Rows are counted for this, not time: a missing row shifts the later ones, which is seen as jitter.
//!
//! A file that is not such a text is read by `lissom_formats`: text with a preamble, in UTF-16 or compressed, exports of
//! controllers, JSON, binary formats. `FILE::GROUP` is a group of channels in a file ([`LogPath`]). Channels with different stamps are then interpolated at the stamps of one of them.
//!
//! A row with the same stamp and the same values as the row above is skipped. Time that goes back is reported with the
//! log ([`Log::time_back`]). Two rows with the same stamp and different values are an error.

mod groups;
mod last_file;
mod log_body;
mod log_columns;
mod log_error;
mod log_layout;
mod log_path;
#[cfg(test)]
mod log_tests;
mod one_clock;
mod other_format;
#[cfg(test)]
mod other_format_tests;
mod plain_log;
mod plain_row;
mod read_log;
mod thinner;

pub(crate) use groups::{alike_groups, all_groups, beside};
pub use last_file::LastFile;
pub use log_columns::{ColumnRef, Log, LogColumn, LogOptions, TimeBack};
pub use log_error::LogError;
pub(crate) use log_layout::{Delimiter, comment, is_header, number};
pub(crate) use log_path::of_run;
pub use log_path::{LogPart, LogPath};
pub(crate) use one_clock::Series;
pub use plain_log::read_log_from;
pub use read_log::{read_log, read_part};
