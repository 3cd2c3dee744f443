//! Columns of a log: which to read, how to read them, and their values.

use lissom_core::record::Hold;
use lissom_formats::ReadOptions;

pub use lissom_formats::ChannelRef as ColumnRef;

/// A column to read, and how to thin it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LogColumn {
    /// The column.
    pub column: ColumnRef,
    /// Thinning takes the mean of a held signal and every n-th sample of a measured one.
    pub hold: Hold,
}

/// How to read a log.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LogOptions {
    /// Largest number of rows kept; a longer log is thinned by 2, 4, 8, ... while it is read. At least 4.
    pub max_rows: usize,
    /// Whether numbers have a decimal comma; cells are then separated by semicolons, tabs or blanks.
    pub decimal_comma: bool,
    /// Row with the names of the columns, from 1; found if absent.
    pub header_row: Option<usize>,
    /// Rows at the top that do not count.
    pub skip_rows: usize,
}

impl LogOptions {
    /// The options of the reader of other formats.
    pub(crate) fn of_text(&self) -> ReadOptions {
        ReadOptions {
            header_row: self.header_row,
            skip_rows: self.skip_rows,
            decimal_comma: self.decimal_comma.then_some(true),
        }
    }
}

impl Default for LogOptions {
    fn default() -> Self {
        Self { max_rows: 1 << 22, decimal_comma: false, header_row: None, skip_rows: 0 }
    }
}

/// The columns of a log, in its own units.
#[derive(Debug, Clone, PartialEq)]
pub struct Log {
    /// Time stamps, increasing except at `time_back`; absent if they were not asked for.
    pub time: Option<Vec<f64>>,
    /// The columns asked for, in that order.
    pub columns: Vec<Vec<f64>>,
    /// Rows of the file per sample; 1 unless the log was thinned.
    pub factor: usize,
    /// Size of the last decimal of the stamps; 0 if it is unknown.
    pub time_step: f64,
    /// Places at which time goes back; empty for thinned logs, in which this is an error.
    pub time_back: Vec<TimeBack>,
    /// Number of rows that were skipped, because they repeat the stamp and all columns of the row above.
    pub repeated: usize,
}

impl Log {
    /// Columns of the same length that are not thinned and have no repeated rows; time is first if there is one.
    pub(super) fn complete(has_time: bool, columns: &[&[f64]]) -> Self {
        let mut columns = columns.iter().map(|column| column.to_vec());
        Self {
            time: if has_time { columns.next() } else { None },
            columns: columns.collect(),
            factor: 1,
            time_step: 0.0,
            time_back: Vec::new(),
            repeated: 0,
        }
    }
}

/// A stamp that is earlier than the one above it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimeBack {
    /// Sample of the later row, from 0.
    pub sample: usize,
    /// Line of the later row in the file, from 1.
    pub row: usize,
    /// Stamp of the row before.
    pub before: f64,
    /// Stamp of the later row.
    pub after: f64,
}
