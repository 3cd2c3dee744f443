//! What can be wrong with a table of responses.

use std::io;

use thiserror::Error;

use crate::excerpt::excerpt;

/// What must be greater than zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Positive {
    /// A frequency.
    Frequency,
    /// A deviation.
    Deviation,
    /// A magnitude.
    Magnitude,
}

/// Why tables of frequency responses cannot be used. Rows are lines of the file, from 1.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ResponseError {
    /// The file cannot be read.
    #[error("{file}: cannot be read: {source}")]
    Read {
        /// The file.
        file: String,
        /// Why.
        source: io::Error,
    },
    /// Not a text file.
    #[error("{file}: is no text")]
    NotText {
        /// The file.
        file: String,
    },
    /// Text in another encoding than UTF-8.
    #[error("{file}: is text in {encoding}, and not in UTF-8 (line {row})")]
    Encoding {
        /// The file.
        file: String,
        /// The encoding.
        encoding: &'static str,
        /// The first line that shows it.
        row: usize,
    },
    /// A size that no table has.
    #[error("{file}: has {most} bytes or more")]
    TooLarge {
        /// The file.
        file: String,
        /// Bytes that a table may have.
        most: u64,
    },
    /// No row of names.
    #[error("{file}: there is no header that names the columns")]
    NoHeader {
        /// The file.
        file: String,
    },
    /// No column of frequencies.
    #[error("{file}: no column is a frequency; the columns are {}", listed(names))]
    NoFrequency {
        /// The file.
        file: String,
        /// Names there are.
        names: Vec<String>,
        /// The one that was probably meant.
        nearest: Option<String>,
    },
    /// Two columns of frequencies.
    #[error("{file}: columns {} and {} are both frequencies", excerpt(first), excerpt(second))]
    TwoFrequencies {
        /// The file.
        file: String,
        /// One.
        first: String,
        /// The other.
        second: String,
    },
    /// A column whose unit must be said.
    #[error("{file}, column {}: the header says no unit", excerpt(column))]
    NoUnit {
        /// The file.
        file: String,
        /// The column.
        column: String,
    },
    /// A unit that is unknown, or of the wrong kind.
    #[error("{file}, column {}: \"{}\" is no unit for it", excerpt(column), excerpt(unit))]
    Unit {
        /// The file.
        file: String,
        /// The column.
        column: String,
        /// The unit.
        unit: String,
    },
    /// No columns of a response.
    #[error("{file}: no column is part of a response; the columns are {}", listed(names))]
    NoResponse {
        /// The file.
        file: String,
        /// Names there are.
        names: Vec<String>,
    },
    /// One half of a response.
    #[error("{file}: {} has the {has} and no {missing}", excerpt(output))]
    Half {
        /// The file.
        file: String,
        /// The output.
        output: String,
        /// What there is.
        has: &'static str,
        /// What there should be.
        missing: &'static str,
    },
    /// Columns that say the same.
    #[error("{file}: {} has its {part} twice", excerpt(output))]
    Twice {
        /// The file.
        file: String,
        /// The output.
        output: String,
        /// What there is twice.
        part: &'static str,
    },
    /// Two outputs of one name.
    #[error("{file}: there is a response called {} already, in {other}", excerpt(output))]
    SameName {
        /// The file.
        file: String,
        /// The output.
        output: String,
        /// The file that has it.
        other: String,
    },
    /// Numbers that say a response is of no kind.
    #[error("{file}: {} is in {dimension}: {expected}", excerpt(output))]
    Kind {
        /// The file.
        file: String,
        /// The output.
        output: String,
        /// Its dimension.
        dimension: String,
        /// What it should be.
        expected: &'static str,
    },
    /// A cell that is no number, or none that is finite.
    #[error(
        "{file}: row {row}, column {}: \"{}\" is not a finite number",
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
    /// A row that is too short, or an empty cell.
    #[error("{file}: row {row}, column {}: the cell is missing", excerpt(column))]
    MissingCell {
        /// The file.
        file: String,
        /// The row.
        row: usize,
        /// The column.
        column: String,
    },
    /// More cells than the header has names.
    #[error(
        "{file}: row {row}, column {column}: \"{}\" stands beyond the {names} columns of the header",
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
        /// Columns that the header names.
        names: usize,
    },
    /// A frequency, deviation or magnitude that is none.
    #[error("{file}: row {row}, column {}: {found} must be greater than zero", excerpt(column))]
    NotPositive {
        /// The file.
        file: String,
        /// The row.
        row: usize,
        /// The column.
        column: String,
        /// The number.
        found: f64,
        /// What it is.
        what: Positive,
    },
    /// A response of nothing.
    #[error("{file}: row {row}: the response of {} is zero", excerpt(output))]
    ZeroResponse {
        /// The file.
        file: String,
        /// The row.
        row: usize,
        /// The output.
        output: String,
    },
    /// A magnitude beyond all numbers.
    #[error(
        "{file}: row {row}, column {}: the response is too large for a number",
        excerpt(column)
    )]
    TooLargeResponse {
        /// The file.
        file: String,
        /// The row.
        row: usize,
        /// The column.
        column: String,
    },
    /// A deviation beside which all others count nothing.
    #[error(
        "{file}: row {row}, column {}: a deviation of {found:e}, where the others are about {others:.1e}",
        excerpt(column)
    )]
    TinyDeviation {
        /// The file.
        file: String,
        /// The row.
        row: usize,
        /// The column.
        column: String,
        /// The number.
        found: f64,
        /// Median of all in the column.
        others: f64,
    },
    /// Frequencies that do not rise.
    #[error("{file}: row {row}, column {}: {after} follows {before}", excerpt(column))]
    NotAscending {
        /// The file.
        file: String,
        /// The row.
        row: usize,
        /// The column.
        column: String,
        /// The frequency before.
        before: f64,
        /// This one.
        after: f64,
    },
    /// A header and no rows.
    #[error("{file}: the table has no rows of numbers")]
    NoRows {
        /// The file.
        file: String,
    },
    /// Another grid of frequencies.
    #[error(
        "{file}: row {row}: {found_rad_s} rad/s, where {other} has {expected_rad_s} rad/s: all responses must \
         share their frequencies"
    )]
    Grid {
        /// The file.
        file: String,
        /// The row.
        row: usize,
        /// Its frequency \[rad/s\].
        found_rad_s: f64,
        /// The file that has others.
        other: String,
        /// Its frequency there \[rad/s\].
        expected_rad_s: f64,
    },
    /// More or fewer frequencies than another.
    #[error(
        "{file}: {found} frequencies, where {other} has {expected}: all responses must share their frequencies"
    )]
    GridLength {
        /// The file.
        file: String,
        /// Frequencies it has.
        found: usize,
        /// The file that has another number.
        other: String,
        /// How many.
        expected: usize,
    },
    /// The motor's response and no other.
    #[error("{file}: there is the motor's response and none of a point")]
    NoPoint {
        /// The file.
        file: String,
    },
}

impl ResponseError {
    /// What to do about it.
    pub fn hint(&self) -> Option<String> {
        let hint = match self {
            Self::Read { .. } => "give a campaign.toml, or tables of frequency responses",
            Self::NotText { .. } => "save the table as comma-separated text in UTF-8",
            Self::Encoding { encoding, .. } => {
                let name = encoding.split(' ').next().unwrap_or(encoding);
                return Some(format!(
                    "save it as \"CSV UTF-8\", or: iconv -f {name} -t UTF-8 FILE > NEW"
                ));
            }
            Self::TooLarge { .. } => "give a table with one row a frequency",
            Self::NoHeader { .. } => {
                "begin with a row of names, such as omega_rad_s,tip_re,tip_im or frequency_hz,tip_db,tip_deg"
            }
            Self::NoFrequency { nearest: Some(found), .. } => {
                return Some(format!("was \"{found}\" meant? Call it omega_rad_s or frequency_hz"));
            }
            Self::NoFrequency { .. } => "call the column omega_rad_s or frequency_hz, or f [Hz]",
            Self::TwoFrequencies { .. } => "keep one of them",
            Self::NoUnit { .. } | Self::Unit { .. } => {
                "a frequency is in rad/s or Hz (omega_rad_s, frequency_hz, f [Hz]), a phase in deg or rad \
                 (tip_deg, tip_phase [rad]), a magnitude in dB or none (tip_db, tip_mag); the motor's response \
                 may have one such as motor_re [rad/A]"
            }
            Self::NoResponse { .. } | Self::Half { .. } => {
                "a response is two columns: tip_re and tip_im, or tip_db (tip_mag) and tip_deg"
            }
            Self::Twice { .. } | Self::SameName { .. } => {
                "each response needs a name of its own: tip_re, tip_im, elbow_re, elbow_im, or a file of its own"
            }
            Self::Kind { .. } => {
                "a point's response is an angle per angle of the motor; the motor's, called motor, an angle per \
                 current, voltage or command"
            }
            Self::NotANumber { .. } | Self::MissingCell { .. } | Self::ZeroResponse { .. } => {
                "leave the row out where nothing was measured"
            }
            Self::ExtraCell { .. } => {
                "one cell for each name in the header; numbers with decimal commas need semicolons between them"
            }
            Self::NotPositive { what: Positive::Frequency, .. } => {
                "leave the row out: a response at rest has no place among frequencies"
            }
            Self::NotPositive { what: Positive::Deviation, .. } => {
                "give each response the deviation that it has; where none is known leave the column out, and what \
                 the model leaves says how large errors are"
            }
            Self::NotPositive { what: Positive::Magnitude, .. } => {
                "a magnitude in dB is called so: tip_db; one below zero with its sign is a real part; leave the row \
                 out where nothing was measured"
            }
            Self::TooLargeResponse { .. } => {
                "check the unit: a magnitude that is not in dB is called tip_mag"
            }
            Self::TinyDeviation { .. } => {
                "correct the cell: with it the fit would heed no other frequency"
            }
            Self::NotAscending { .. } => "sort the rows by frequency, one row each",
            Self::NoRows { .. } => "below the header, one row for each frequency",
            Self::Grid { .. } | Self::GridLength { .. } => {
                "measure all points at the same frequencies, or keep those that are in all files"
            }
            Self::NoPoint { .. } => "add the response of a point of the beam to the motor's angle",
        };
        Some(hint.to_owned())
    }
}

fn listed(names: &[String]) -> String {
    const SHOWN: usize = 12;
    let shown: Vec<String> = names.iter().take(SHOWN).map(|n| excerpt(n)).collect();
    let more = if names.len() > SHOWN { ", …" } else { "" };
    format!("{}{more}", shown.join(", "))
}
