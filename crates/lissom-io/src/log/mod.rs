//! Delimited text logs.
//!
//! A log is text with one sample a row. Cells are separated by commas, semicolons, tabs or, where
//! there is none of these, by runs of blanks. Names stand in a plain header row or in a comment
//! line (`#` or `%`) before the data; of several such lines the last counts that has as many
//! names as the data have columns, else the last with at least half as many. Names belong to
//! columns by position. A column is asked for by its name, trimmed and exact, or by its number
//! from 1. One row of words below a header row holds units and is passed over. Blank lines, comment lines among the data, CRLF, a byte order mark and a delimiter at
//! the end of a row are allowed.
//!
//! Only the columns asked for are read as numbers. A log is read in bounded memory: one with more
//! rows than [`LogOptions::max_rows`] is thinned while it is read: a held command by its mean, a
//! measured channel by leaving samples out, without a filter. Rows are counted for this, not
//! time: a row lost within a sample shifts the later ones, which shows as jitter.
//!
//! A row whose stamp and columns are all those of the row above is a repeated row, and is passed over. Time that goes back is
//! reported with the log ([`Log::time_back`]); two rows with one stamp and other values are an error.

mod log_columns;
mod log_error;
mod log_layout;
#[cfg(test)]
mod log_tests;
mod read_log;
mod thinner;

pub use log_columns::{ColumnRef, Log, LogColumn, LogOptions, TimeBack};
pub use log_error::LogError;
pub(crate) use log_layout::{Delimiter, comment, is_header, number};
pub use read_log::{read_log, read_log_from};
