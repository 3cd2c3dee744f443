//! Columns of a log: which are asked for, how they are read, what they hold.

use std::fmt;

use lissom_core::record::Hold;

/// A column of a log.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ColumnRef {
    /// By its name in the header, trimmed and exact.
    Name(String),
    /// By its number, from 1.
    Number(usize),
}

impl fmt::Display for ColumnRef {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Name(name) => write!(f, "\"{name}\""),
            Self::Number(number) => write!(f, "{number}"),
        }
    }
}

/// A column to read, and how to thin it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LogColumn {
    /// Which one.
    pub column: ColumnRef,
    /// Thinning takes the mean of a held signal and every n-th sample of a measured one.
    pub hold: Hold,
}

/// How to read a log.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LogOptions {
    /// Most rows kept; a longer log is thinned by 2, 4, 8, ... while it is read. At least 4.
    pub max_rows: usize,
    /// Numbers have a decimal comma; cells are then separated by semicolons, tabs or blanks.
    pub decimal_comma: bool,
}

impl Default for LogOptions {
    fn default() -> Self {
        Self { max_rows: 1 << 22, decimal_comma: false }
    }
}

/// The columns of a log, in its own units.
#[derive(Debug, Clone, PartialEq)]
pub struct Log {
    /// Time stamps, increasing but for `time_back`; absent where none were asked for.
    pub time: Option<Vec<f64>>,
    /// The columns asked for, in that order.
    pub columns: Vec<Vec<f64>>,
    /// Rows of the file per sample; 1 unless the log was thinned.
    pub factor: usize,
    /// Step of the stamps' last decimal; 0 where it is unknown.
    pub time_step: f64,
    /// Where time goes back: empty with thinned logs, in which it is an error.
    pub time_back: Vec<TimeBack>,
    /// Rows that were passed over, since they repeat the stamp and all columns of the row above.
    pub repeated: usize,
}

/// A stamp before the one above it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimeBack {
    /// Sample of the later row, from 0.
    pub sample: usize,
    /// The later row, as a line of the file from 1.
    pub row: usize,
    /// Stamp of the row before.
    pub before: f64,
    /// Stamp of the later row.
    pub after: f64,
}
