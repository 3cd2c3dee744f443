//! Errors of a log.

use std::f64::consts::TAU;
use std::io;

use lissom_formats::FormatError;
use thiserror::Error;

use super::groups::beside;
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
        /// The cause.
        source: io::Error,
    },
    /// Reading failed.
    #[error("{file}: reading failed at row {row}: {source}")]
    Read {
        /// The file.
        file: String,
        /// The row reached.
        row: usize,
        /// The cause.
        source: io::Error,
    },
    /// Control characters, so it is not a text file.
    #[error("{file}: row {row} is not text")]
    NotText {
        /// The file.
        file: String,
        /// The row.
        row: usize,
    },
    /// A byte order mark of UTF-16 or UTF-32.
    #[error("{file}: the text is in UTF-16 or UTF-32")]
    Utf16 {
        /// The file.
        file: String,
    },
    /// A format that is recognised and not read.
    #[error("{file}: this is {what}, not a table that can be read")]
    Foreign {
        /// The file.
        file: String,
        /// What it is.
        what: &'static str,
        /// The way out.
        way_out: &'static str,
    },
    /// A file of another format that cannot be read.
    #[error("{file}: {source}")]
    Format {
        /// The file.
        file: String,
        /// The cause.
        source: FormatError,
    },
    /// Channels with different stamps that cannot be brought onto one clock.
    #[error(
        "{file}: the channels have different time stamps, and cannot be brought onto one clock"
    )]
    NoCommonTime {
        /// The file.
        file: String,
    },
    /// A row that is too long.
    #[error("{file}: row {row} is longer than {most} bytes")]
    LongRow {
        /// The file.
        file: String,
        /// The row.
        row: usize,
        /// Largest number of bytes of a row.
        most: u64,
    },
    /// A log with blank lines only.
    #[error("{file}: the log is empty")]
    Empty {
        /// The file.
        file: String,
    },
    /// A header without rows.
    #[error("{file}: the log has a header and no rows of numbers")]
    HeaderOnly {
        /// The file.
        file: String,
    },
    /// A log with only one row of numbers.
    #[error("{file}: the log has one row of numbers only, row {row}")]
    OneRow {
        /// The file.
        file: String,
        /// The row.
        row: usize,
    },
    /// No column has this name.
    #[error(
        "{file}: there is no column \"{}\"; the columns are {}",
        excerpt(column),
        listed(names)
    )]
    NoColumn {
        /// The file.
        file: String,
        /// The name wanted.
        column: String,
        /// The names of the columns.
        names: Vec<String>,
        /// The name that was probably meant.
        nearest: Option<String>,
    },
    /// A column by its name, in a log without names.
    #[error("{file}: there is no column \"{}\": the log has no header", excerpt(column))]
    NoHeader {
        /// The file.
        file: String,
        /// The name wanted.
        column: String,
        /// Number of columns.
        columns: usize,
    },
    /// Several columns have this name.
    #[error("{file}: {} columns are called \"{}\"", numbers.len(), excerpt(column))]
    Ambiguous {
        /// The file.
        file: String,
        /// The name wanted.
        column: String,
        /// Their numbers.
        numbers: Vec<usize>,
        /// The groups of channels in the file.
        groups: Vec<String>,
    },
    /// No group of channels fits.
    #[error("{file}: no group of channels is \"{group}\"; {}", of_groups(.groups))]
    NoGroup {
        /// The file.
        file: String,
        /// The group wanted.
        group: String,
        /// The groups of the file.
        groups: Vec<String>,
    },
    /// Several groups of channels fit where one is wanted.
    #[error("{file}: \"{group}\" fits several groups of channels")]
    SeveralGroups {
        /// The file.
        file: String,
        /// The group wanted.
        group: String,
    },
    /// Two logs of a run share no motion, so that the clock of one cannot be found.
    #[error(
        "{other}: {channel} does not show the motion of {file} at any shift of its clock (at most {:.0} % of it follows)",
        100.0 * .explained
    )]
    NoSharedMotion {
        /// The log of the run.
        file: String,
        /// The other log.
        other: String,
        /// The channel.
        channel: String,
        /// Largest share of the channel that follows the motion \[1\].
        explained: f64,
    },
    /// Time goes back in a log to which a signal of another one belongs.
    #[error("{file}: time goes back in this log, so that the clock of another log cannot be found")]
    RestartWithOtherLog {
        /// The log of the run.
        file: String,
    },
    /// Two logs of a run share no time.
    #[error("{file}: the log of a signal has no samples at the time of this log")]
    NoSharedTime {
        /// The log of the run.
        file: String,
    },
    /// A column that should name the runs has too many different values.
    #[error("{file}: column {column} has more than 10,000 different values: it does not name runs")]
    RunNumbers {
        /// The file.
        file: String,
        /// The column.
        column: String,
    },
    /// No column has this number.
    #[error("{file}: there is no column {number}; the log has {columns}")]
    ColumnNumber {
        /// The file.
        file: String,
        /// The number wanted, from 1.
        number: usize,
        /// Number of columns.
        columns: usize,
    },
    /// A cell that is not a number.
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
        /// The text of the cell.
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
        /// The text of the cell.
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
        "{file}: row {row}, column {column}: \"{}\" is beyond the {columns} columns of the log",
        excerpt(found)
    )]
    ExtraCell {
        /// The file.
        file: String,
        /// The row.
        row: usize,
        /// The column, from 1.
        column: usize,
        /// The text of the cell.
        found: String,
        /// Number of columns of the header, or of the first row if there is no header.
        columns: usize,
    },
    /// A stamp that is earlier than the one above it. Stamps are given as in the file.
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
    /// Two rows with the same stamp.
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
    /// No piece between gaps is long enough.
    #[error(
        "{file}: the log is cut at gaps in the time stamps ({gaps}), and no piece has {least} samples; the longest has {longest}"
    )]
    AllPiecesShort {
        /// The file.
        file: String,
        /// Number of gaps.
        gaps: usize,
        /// Smallest number of samples of a piece.
        least: usize,
        /// Samples of the longest piece.
        longest: usize,
    },
    /// Too few samples.
    #[error("{file}: {found} samples; at least {least} are needed")]
    FewSamples {
        /// The file.
        file: String,
        /// Samples found.
        found: usize,
        /// Samples needed.
        least: usize,
    },
    /// A sample that is too large in its unit.
    #[error(
        "{file}: channel {}: sample {sample} is larger than {largest:e} in SI units",
        excerpt(channel)
    )]
    OutOfRange {
        /// The file.
        file: String,
        /// Name of the channel.
        channel: String,
        /// The sample, from 1.
        sample: usize,
        /// Largest magnitude allowed.
        largest: f64,
    },
    /// Stamps that do not give a valid sample time.
    #[error("{file}: the time stamps give a sample time of {found_s} s")]
    SampleTime {
        /// The file.
        file: String,
        /// The sample time \[s\].
        found_s: f64,
    },
    /// Almost all samples are left out.
    #[error("{file}: leaving out what is asked for leaves {left} rows of a log of {length_s} s")]
    AllLeftOut {
        /// The file.
        file: String,
        /// Length of the log \[s\].
        length_s: f64,
        /// Rows that remain.
        left: usize,
    },
    /// A speed that is not the rate of the angle.
    #[error(
        "{file}: the speed contradicts the motor's angle: it is {ratio:.3} times the angle's rate (correlation {correlation:.2})"
    )]
    Speed {
        /// The file.
        file: String,
        /// Speed divided by the angle's rate, by least squares.
        ratio: f64,
        /// Correlation of both.
        correlation: f64,
    },
}

impl LogError {
    /// The error of a file that `lissom_formats` cannot read.
    pub(crate) fn of_format(file: String, source: FormatError) -> Self {
        match source {
            FormatError::Read { source } => Self::Open { file, source },
            FormatError::Foreign { what, way_out } => Self::Foreign { file, what, way_out },
            source => Self::Format { file, source },
        }
    }

    /// The error for time that goes back without a restart of the clock.
    pub(crate) fn time_back(file: &str, column: &str, found: &TimeBack) -> Self {
        let (file, column) = (file.to_owned(), column.to_owned());
        let TimeBack { row, before, after, .. } = *found;
        Self::TimeBack { file, row, column, before, after }
    }

    /// Whether the file may be of another format than plain text with a header.
    pub(super) fn may_be_another_format(&self) -> bool {
        matches!(
            self,
            Self::NotText { .. }
                | Self::Utf16 { .. }
                | Self::LongRow { .. }
                | Self::HeaderOnly { .. }
                | Self::NoColumn { .. }
                | Self::NoHeader { .. }
                | Self::ColumnNumber { .. }
                | Self::NotANumber { .. }
                | Self::NotFinite { .. }
                | Self::MissingCell { .. }
                | Self::ExtraCell { .. }
        )
    }

    /// What the user can do.
    pub fn hint(&self) -> Option<String> {
        Some(match self {
            Self::Open { source, .. } if source.kind() == io::ErrorKind::NotFound => {
                "check the name: a path in a campaign.toml starts from the folder of that file".to_owned()
            }
            Self::Open { source, .. } | Self::Read { source, .. }
                if source.kind() == io::ErrorKind::IsADirectory =>
            {
                "give one log as `file`, and a [[runs]] for each log of the folder".to_owned()
            }
            Self::Open { .. } | Self::Read { .. } => {
                "check that it is a file and that you may read it".to_owned()
            }
            Self::Foreign { way_out, .. } => (*way_out).to_owned(),
            Self::Format { source, .. } => source.hint().to_owned(),
            Self::NoCommonTime { .. } => {
                "choose channels that were recorded at the same time".to_owned()
            }
            Self::Utf16 { .. } => "save the log as UTF-8".to_owned(),
            Self::LongRow { .. } => {
                "a log has one sample in each row: check the line ends, or export fewer columns".to_owned()
            }
            Self::NotText { .. } => {
                "a log is text with commas, semicolons, tabs or blanks between the numbers: export the file as CSV".to_owned()
            }
            Self::Empty { .. } | Self::HeaderOnly { .. } | Self::OneRow { .. } => {
                "check that the recording ran and that this is the right file".to_owned()
            }
            // A TOML text in double quotes would take the backslash for an escape.
            Self::NoColumn { nearest: Some(name), .. } if name.contains('\\') => {
                format!("write the name in single quotes: column = '{}'", excerpt(name))
            }
            Self::NoColumn { nearest: Some(name), .. } => format!("did you mean \"{}\"?", excerpt(name)),
            Self::NoColumn { .. } => {
                "give one of these names exactly, or the column's number from 1".to_owned()
            }
            Self::NoHeader { columns, .. } => {
                format!("give the column's number, 1 to {columns}, as in `column = 1`")
            }
            Self::Ambiguous { numbers, groups, .. } => {
                let numbers: Vec<String> =
                    numbers.iter().take(MOST_NAMES).map(ToString::to_string).collect();
                let number = format!("give the column's number: {}", numbers.join(" or "));
                let Some(first) = groups.first().filter(|_| groups.len() > 1) else {
                    return Some(number);
                };
                format!(
                    "give the group after the file, as in \"FILE::{first}\", or \"FILE::{}\" if each group is a run; or {number}",
                    beside(first)
                )
            }
            Self::NoGroup { groups, .. } if groups.is_empty() => {
                "give the file alone: its channels are not in groups".to_owned()
            }
            Self::NoGroup { .. } | Self::SeveralGroups { .. } => {
                "give one of the groups after the file, as in FILE::run1; * stands for any text".to_owned()
            }
            Self::NoSharedMotion { .. } => {
                "check that both logs are of the same run; if both have the same clock, state it: clock = \"shared\"".to_owned()
            }
            Self::RestartWithOtherLog { .. } => "cut the log there, and give both parts as separate runs".to_owned(),
            Self::NoSharedTime { .. } => {
                "check that both logs are of the same run, and `clock`: \"shared\" needs stamps of the same clock".to_owned()
            }
            Self::RunNumbers { .. } => {
                "give the column with the number or the name of the run or trial, which is the same in many rows".to_owned()
            }
            Self::ColumnNumber { .. } => "columns are counted from 1".to_owned(),
            Self::NotANumber { found, .. } if found.contains(',') => {
                "if the numbers have a decimal comma, add `decimal = \",\"` to [signals]".to_owned()
            }
            Self::ExtraCell { .. } => {
                "name every column in the header; if the numbers have a decimal comma, add `decimal = \",\"` to [signals]".to_owned()
            }
            Self::NotANumber { .. } | Self::NotFinite { .. } | Self::MissingCell { .. } => {
                "repair the row, or cut the log there: missing values are not filled in".to_owned()
            }
            Self::TimeBack { .. } => {
                "cut the log there, and give both parts as separate runs".to_owned()
            }
            Self::TimeStill { .. } => {
                "export the stamps with more digits, or give `sample_time` instead of `time` if the sampling is regular".to_owned()
            }
            Self::FewSamples { .. } => "record longer, or leave the run out".to_owned(),
            Self::OutOfRange { .. } => {
                "check the log at that sample, and `unit`, `scale` and `offset` of the channel".to_owned()
            }
            Self::SampleTime { .. } => "check the unit and scale of the time stamps".to_owned(),
            Self::AllPiecesShort { .. } => {
                "log without interruption; if the stamps are too coarse for the sampling, give `sample_time` instead of `time`".to_owned()
            }
            Self::AllLeftOut { .. } => "leave out less: see `skip`, `until` and `leave_out`".to_owned(),
            Self::Speed { ratio, correlation, .. } => of_speed(*ratio, *correlation).to_owned(),
        })
    }
}

/// Hint for a speed that is `ratio` times the angle's rate.
fn of_speed(ratio: f64, correlation: f64) -> &'static str {
    let factors = [
        (-1.0, "the sign of one of them is reversed: add scale = -1 to it"),
        (
            9.549,
            "the speed seems to be in rpm: give unit = \"rpm\", or check the unit of the angle",
        ),
        (
            0.10472,
            "the speed seems to be in rad/s: give unit = \"rad/s\", or check the unit of the angle",
        ),
        (57.296, "one of them seems to be in deg, the other in rad: check both units"),
        (0.017_453, "one of them seems to be in deg, the other in rad: check both units"),
        (1e3, "the time stamps seem to be in ms: check their unit"),
        (1e6, "the time stamps seem to be in us: check their unit"),
        (TAU, "one of them seems to be in turns, the other in rad: check both units"),
        (1.0 / TAU, "one of them seems to be in turns, the other in rad: check both units"),
    ];
    let near = |(factor, _): &&(f64, &str)| (ratio / factor - 1.0).abs() < 0.05;
    match factors.iter().find(near) {
        Some((_, hint)) if correlation.abs() > 0.9 => hint,
        _ => {
            "check the unit of the time stamps, columns, units and signs of both, and whether there is a gear between them"
        }
    }
}

/// Largest number of names in an error.
const MOST_NAMES: usize = 40;

fn of_groups(groups: &[String]) -> String {
    match groups {
        [] => "the file has no groups".to_owned(),
        groups => format!("the groups are {}", listed(groups)),
    }
}

fn listed(names: &[String]) -> String {
    let quoted: Vec<String> =
        names.iter().take(MOST_NAMES).map(|name| format!("\"{}\"", excerpt(name))).collect();
    let listed = quoted.join(", ");
    match names.len().checked_sub(MOST_NAMES) {
        None | Some(0) => listed,
        Some(more) => format!("{listed} and {more} more"),
    }
}
