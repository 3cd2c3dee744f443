//! What can be wrong with a log.

use std::f64::consts::TAU;
use std::io;

use thiserror::Error;

use super::log_columns::TimeBack;
use crate::excerpt::excerpt;

/// Why a log cannot be used. Rows are lines of the file, counted from 1 as an editor does.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum LogError {
    /// The file cannot be opened.
    #[error("{file}: cannot be opened: {source}")]
    Open {
        /// The file.
        file: String,
        /// Why.
        source: io::Error,
    },
    /// Reading broke off.
    #[error("{file}: reading failed at row {row}: {source}")]
    Read {
        /// The file.
        file: String,
        /// Row reached.
        row: usize,
        /// Why.
        source: io::Error,
    },
    /// Control characters: not a text file.
    #[error("{file}: row {row} is not text")]
    NotText {
        /// The file.
        file: String,
        /// The row.
        row: usize,
    },
    /// The byte order mark of UTF-16 or UTF-32.
    #[error("{file}: the text is in UTF-16 or UTF-32")]
    Utf16 {
        /// The file.
        file: String,
    },
    /// A row without end.
    #[error("{file}: row {row} is longer than {most} bytes")]
    LongRow {
        /// The file.
        file: String,
        /// The row.
        row: usize,
        /// Bytes it may have.
        most: u64,
    },
    /// Nothing but blank lines.
    #[error("{file}: the log is empty")]
    Empty {
        /// The file.
        file: String,
    },
    /// A header and no rows.
    #[error("{file}: the log has a header and no rows of numbers")]
    HeaderOnly {
        /// The file.
        file: String,
    },
    /// One row of numbers.
    #[error("{file}: the log has one row of numbers only, row {row}")]
    OneRow {
        /// The file.
        file: String,
        /// The row.
        row: usize,
    },
    /// No column has the name.
    #[error(
        "{file}: there is no column \"{}\"; the columns are {}",
        excerpt(column),
        listed(names)
    )]
    NoColumn {
        /// The file.
        file: String,
        /// Name wanted.
        column: String,
        /// Names there are.
        names: Vec<String>,
        /// The one that was probably meant.
        nearest: Option<String>,
    },
    /// A column by name from a log without names.
    #[error("{file}: there is no column \"{}\": the log has no header", excerpt(column))]
    NoHeader {
        /// The file.
        file: String,
        /// Name wanted.
        column: String,
        /// Number of columns.
        columns: usize,
    },
    /// Several columns have the name.
    #[error("{file}: {} columns are called \"{}\"", numbers.len(), excerpt(column))]
    Ambiguous {
        /// The file.
        file: String,
        /// Name wanted.
        column: String,
        /// Their numbers.
        numbers: Vec<usize>,
    },
    /// No column has the number.
    #[error("{file}: there is no column {number}; the log has {columns}")]
    ColumnNumber {
        /// The file.
        file: String,
        /// Number wanted, from 1.
        number: usize,
        /// Number of columns.
        columns: usize,
    },
    /// A cell that is no number.
    #[error(
        "{file}: row {row}, column {}: \"{}\" is not a number",
        excerpt(column),
        excerpt(found)
    )]
    NotANumber {
        /// The file.
        file: String,
        /// The row.
        row: usize,
        /// The column.
        column: String,
        /// What stands there.
        found: String,
    },
    /// A cell that is NaN or infinite.
    #[error(
        "{file}: row {row}, column {}: \"{}\" is not a finite number",
        excerpt(column),
        excerpt(found)
    )]
    NotFinite {
        /// The file.
        file: String,
        /// The row.
        row: usize,
        /// The column.
        column: String,
        /// What stands there.
        found: String,
    },
    /// An empty cell, or a row that ends before it.
    #[error("{file}: row {row}, column {}: the cell is missing", excerpt(column))]
    MissingCell {
        /// The file.
        file: String,
        /// The row.
        row: usize,
        /// The column.
        column: String,
    },
    /// More cells than there are columns.
    #[error(
        "{file}: row {row}, column {column}: \"{}\" stands beyond the {columns} columns of the log",
        excerpt(found)
    )]
    ExtraCell {
        /// The file.
        file: String,
        /// The row.
        row: usize,
        /// The column, from 1.
        column: usize,
        /// What stands there.
        found: String,
        /// Columns of the header, or of the first row where there is none.
        columns: usize,
    },
    /// A stamp before the one above it. Stamps as they stand in the file.
    #[error(
        "{file}: row {row}, column {}: time goes back from {before} to {after}",
        excerpt(column)
    )]
    TimeBack {
        /// The file.
        file: String,
        /// Row of the later stamp.
        row: usize,
        /// The column of the stamps.
        column: String,
        /// Stamp of the row before.
        before: f64,
        /// Stamp of this row.
        after: f64,
    },
    /// Two rows with one stamp.
    #[error("{file}: row {row}, column {}: time stands still at {stamp}", excerpt(column))]
    TimeStill {
        /// The file.
        file: String,
        /// Row of the second stamp.
        row: usize,
        /// The column of the stamps.
        column: String,
        /// The stamp.
        stamp: f64,
    },
    /// Gaps leave no piece that is long enough.
    #[error(
        "{file}: gaps in the time stamps ({gaps}) leave no piece of {least} samples; the longest has {longest}"
    )]
    AllPiecesShort {
        /// The file.
        file: String,
        /// Number of gaps.
        gaps: usize,
        /// Samples a piece must have.
        least: usize,
        /// Samples of the longest piece.
        longest: usize,
    },
    /// Fewer samples than anything can be said from.
    #[error("{file}: {found} samples; at least {least} are needed")]
    FewSamples {
        /// The file.
        file: String,
        /// Samples found.
        found: usize,
        /// Samples needed.
        least: usize,
    },
    /// Numbers that are too large in their unit.
    #[error("{file}: channel {}: sample {sample} is beyond {largest:e} in SI", excerpt(channel))]
    OutOfRange {
        /// The file.
        file: String,
        /// Name of the channel.
        channel: String,
        /// The sample, from 1.
        sample: usize,
        /// Largest magnitude there may be.
        largest: f64,
    },
    /// Stamps that give no sample time.
    #[error("{file}: the time stamps give a sample time of {found_s} s")]
    SampleTime {
        /// The file.
        file: String,
        /// The sample time \[s\].
        found_s: f64,
    },
    /// The head that is to be skipped leaves nothing.
    #[error("{file}: skipping {skip_s} s leaves {left} rows of a log of {length_s} s")]
    AllSkipped {
        /// The file.
        file: String,
        /// Time to skip \[s\].
        skip_s: f64,
        /// Length of the log \[s\].
        length_s: f64,
        /// Rows left.
        left: usize,
    },
    /// A speed that is not the angle's rate.
    #[error(
        "{file}: the speed contradicts the motor's angle: it is {ratio:.3} times the angle's rate (correlation {correlation:.2})"
    )]
    Speed {
        /// The file.
        file: String,
        /// Speed over the angle's rate, by least squares.
        ratio: f64,
        /// Correlation of both.
        correlation: f64,
    },
}

impl LogError {
    /// Time that goes back, and is no restart of the clock.
    pub(crate) fn time_back(file: &str, column: &str, found: &TimeBack) -> Self {
        let (file, column) = (file.to_owned(), column.to_owned());
        let TimeBack { row, before, after, .. } = *found;
        Self::TimeBack { file, row, column, before, after }
    }

    /// What to do about it.
    pub fn hint(&self) -> Option<String> {
        Some(match self {
            Self::Open { source, .. } if source.kind() == io::ErrorKind::NotFound => {
                "a run's file is looked for in the folder of its campaign.toml".to_owned()
            }
            Self::Open { source, .. } | Self::Read { source, .. }
                if source.kind() == io::ErrorKind::IsADirectory =>
            {
                "`file` names one log; give each log of a folder a [[runs]] of its own".to_owned()
            }
            Self::Open { .. } | Self::Read { .. } => {
                "check that it is a file that you may read".to_owned()
            }
            Self::Utf16 { .. } => "save the log as UTF-8".to_owned(),
            Self::LongRow { .. } => {
                "logs have one sample a row: check the line ends, or export fewer columns".to_owned()
            }
            Self::NotText { .. } => {
                "logs are text: comma, semicolon, tab or blank separated; export the file as CSV".to_owned()
            }
            Self::Empty { .. } | Self::HeaderOnly { .. } | Self::OneRow { .. } => {
                "check that the recording ran and that this is the right file".to_owned()
            }
            Self::NoColumn { nearest: Some(name), .. } => format!("did you mean \"{}\"?", excerpt(name)),
            Self::NoColumn { .. } => {
                "give one of these names as it stands in the log, or the column's number from 1".to_owned()
            }
            Self::NoHeader { columns, .. } => {
                format!("give the column's number, 1 to {columns}, as in `column = 1`")
            }
            Self::Ambiguous { numbers, .. } => {
                let numbers: Vec<String> =
                    numbers.iter().take(MOST_NAMES).map(ToString::to_string).collect();
                format!("give the column's number: {}", numbers.join(" or "))
            }
            Self::ColumnNumber { .. } => "columns are counted from 1".to_owned(),
            Self::NotANumber { found, .. } if found.contains(',') => {
                "where the decimal sign is a comma, say `decimal = \",\"` in [signals]".to_owned()
            }
            Self::ExtraCell { .. } => {
                "name every column in the header; where the decimal sign is a comma, say `decimal = \",\"` in [signals]".to_owned()
            }
            Self::NotANumber { .. } | Self::NotFinite { .. } | Self::MissingCell { .. } => {
                "repair the row or cut the log there: nothing is filled in silently".to_owned()
            }
            Self::TimeBack { .. } => {
                "cut the log there and give the two parts as two runs".to_owned()
            }
            Self::TimeStill { .. } => {
                "export the stamps with more digits, or give `sample_time` in place of `time` if the sampling is regular".to_owned()
            }
            Self::FewSamples { .. } => "record longer, or leave the run out".to_owned(),
            Self::OutOfRange { .. } => {
                "check the log at that sample, and `unit`, `scale` and `offset` of the channel".to_owned()
            }
            Self::SampleTime { .. } => "check the unit and scale of the time stamps".to_owned(),
            Self::AllPiecesShort { .. } => {
                "log without interruption; where the stamps are too coarse for the sampling, give `sample_time` in place of `time`".to_owned()
            }
            Self::AllSkipped { .. } => "give a smaller `skip`".to_owned(),
            Self::Speed { ratio, correlation, .. } => of_speed(*ratio, *correlation).to_owned(),
        })
    }
}

/// The way out for a speed that is `ratio` times the angle's rate.
fn of_speed(ratio: f64, correlation: f64) -> &'static str {
    let factors = [
        (-1.0, "its sign is reversed: add scale = -1 to one of both"),
        (9.549, "its numbers are in rpm: give unit = \"rpm\", or check the angle's unit"),
        (0.10472, "its numbers are in rad/s: give unit = \"rad/s\", or check the angle's unit"),
        (57.296, "speed and angle mix deg and rad: check both units"),
        (0.017_453, "speed and angle mix deg and rad: check both units"),
        (TAU, "speed and angle mix turns and rad: check both units"),
        (1.0 / TAU, "speed and angle mix turns and rad: check both units"),
    ];
    let near = |(factor, _): &&(f64, &str)| (ratio / factor - 1.0).abs() < 0.05;
    match factors.iter().find(near) {
        Some((_, hint)) if correlation.abs() > 0.9 => hint,
        _ => "check columns, units and signs of both, and whether a gear lies between them",
    }
}

/// Most names that an error lists.
const MOST_NAMES: usize = 40;

fn listed(names: &[String]) -> String {
    let quoted: Vec<String> =
        names.iter().take(MOST_NAMES).map(|name| format!("\"{}\"", excerpt(name))).collect();
    let listed = quoted.join(", ");
    match names.len().checked_sub(MOST_NAMES) {
        None | Some(0) => listed,
        Some(more) => format!("{listed} and {more} more"),
    }
}
