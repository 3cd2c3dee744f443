//! Errors of a table of responses.

use std::io;

use thiserror::Error;

use crate::excerpt::excerpt;

/// A quantity that must be greater than zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Positive {
    /// A frequency.
    Frequency,
    /// A standard error.
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
        /// The cause.
        source: io::Error,
    },
    /// The file is not text.
    #[error("{file}: is not a text file")]
    NotText {
        /// The file.
        file: String,
    },
    /// Text in another encoding than UTF-8.
    #[error("{file}: is encoded in {encoding}, not in UTF-8 (line {row})")]
    Encoding {
        /// The file.
        file: String,
        /// The encoding.
        encoding: &'static str,
        /// The first line that shows it.
        row: usize,
    },
    /// A file that is too large for a table.
    #[error("{file}: is too large, it has {most} bytes or more")]
    TooLarge {
        /// The file.
        file: String,
        /// Largest size of a table in bytes.
        most: u64,
    },
    /// There is no row of names.
    #[error("{file}: there is no header with the names of the columns")]
    NoHeader {
        /// The file.
        file: String,
    },
    /// There is no column of frequencies.
    #[error("{file}: no column is a frequency; the columns are {}", listed(names))]
    NoFrequency {
        /// The file.
        file: String,
        /// The names of the columns.
        names: Vec<String>,
        /// The name that was probably meant.
        nearest: Option<String>,
    },
    /// Two columns of frequencies.
    #[error("{file}: columns {} and {} are both frequencies", excerpt(first), excerpt(second))]
    TwoFrequencies {
        /// The file.
        file: String,
        /// The first one.
        first: String,
        /// The second one.
        second: String,
    },
    /// A column without a unit, which needs one.
    #[error("{file}, column {}: the header gives no unit", excerpt(column))]
    NoUnit {
        /// The file.
        file: String,
        /// The column.
        column: String,
    },
    /// A unit that is unknown, or of the wrong kind.
    #[error(
        "{file}, column {}: \"{}\" is not a valid unit for this column",
        excerpt(column),
        excerpt(unit)
    )]
    Unit {
        /// The file.
        file: String,
        /// The column.
        column: String,
        /// The unit.
        unit: String,
    },
    /// There are no columns of a response.
    #[error("{file}: no column is part of a response; the columns are {}", listed(names))]
    NoResponse {
        /// The file.
        file: String,
        /// The names of the columns.
        names: Vec<String>,
    },
    /// Only one part of a response.
    #[error("{file}: {} has the {has} but no {missing}", excerpt(output))]
    Half {
        /// The file.
        file: String,
        /// The output.
        output: String,
        /// The part that the table has.
        has: &'static str,
        /// The missing part.
        missing: &'static str,
    },
    /// Two columns with the same part of a response.
    #[error("{file}: {} has its {part} twice", excerpt(output))]
    Twice {
        /// The file.
        file: String,
        /// The output.
        output: String,
        /// The part that the table has twice.
        part: &'static str,
    },
    /// Two outputs with the same name.
    #[error("{file}: there is already a response {} in {other}", excerpt(output))]
    SameName {
        /// The file.
        file: String,
        /// The output.
        output: String,
        /// The other file with this output.
        other: String,
    },
    /// A response with a wrong dimension.
    #[error("{file}: {} is in {dimension}: {expected}", excerpt(output))]
    Kind {
        /// The file.
        file: String,
        /// The output.
        output: String,
        /// Its dimension.
        dimension: String,
        /// The dimension that it must have.
        expected: &'static str,
    },
    /// A cell that is not a finite number.
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
        /// The text of the cell.
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
        "{file}: row {row}, column {column}: \"{}\" is beyond the {names} columns of the header",
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
        /// Number of columns in the header.
        names: usize,
    },
    /// A frequency, standard error or magnitude that is not greater than zero.
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
        /// The kind of quantity.
        what: Positive,
    },
    /// A response of zero.
    #[error("{file}: row {row}: the response of {} is zero", excerpt(output))]
    ZeroResponse {
        /// The file.
        file: String,
        /// The row.
        row: usize,
        /// The output.
        output: String,
    },
    /// A magnitude that is too large for a number.
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
    /// A standard error that is so small that all other values would have no effect.
    #[error(
        "{file}: row {row}, column {}: the standard error is {found:e}, but the others are about {others:.1e}",
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
        /// Median of the column.
        others: f64,
    },
    /// Frequencies that are not ascending.
    #[error("{file}: row {row}, column {}: {after} comes after {before}", excerpt(column))]
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
    /// Other frequencies than in another file.
    #[error(
        "{file}: row {row}: {found_rad_s} rad/s, but {other} has {expected_rad_s} rad/s: all responses must \
         share their frequencies"
    )]
    Grid {
        /// The file.
        file: String,
        /// The row.
        row: usize,
        /// Its frequency \[rad/s\].
        found_rad_s: f64,
        /// The other file.
        other: String,
        /// Its frequency in the other file \[rad/s\].
        expected_rad_s: f64,
    },
    /// Another number of frequencies than in another file.
    #[error(
        "{file}: {found} frequencies, but {other} has {expected}: all responses must share their frequencies"
    )]
    GridLength {
        /// The file.
        file: String,
        /// The number of its frequencies.
        found: usize,
        /// The other file.
        other: String,
        /// The number of frequencies in the other file.
        expected: usize,
    },
    /// The motor's response only.
    #[error("{file}: there is only the response of the motor, and none of a point")]
    NoPoint {
        /// The file.
        file: String,
    },
}

impl ResponseError {
    /// What the user can do.
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
            Self::TooLarge { .. } => "give a table with one row for each frequency",
            Self::NoHeader { .. } => {
                "begin with a row of names, such as omega_rad_s,tip_re,tip_im or frequency_hz,tip_db,tip_deg"
            }
            Self::NoFrequency { nearest: Some(found), .. } => {
                return Some(format!(
                    "if the frequency is \"{found}\", rename it to omega_rad_s or frequency_hz"
                ));
            }
            Self::NoFrequency { .. } => {
                "give the column of frequencies the name omega_rad_s, frequency_hz or f [Hz]"
            }
            Self::TwoFrequencies { .. } => "remove one of them",
            Self::NoUnit { .. } | Self::Unit { .. } => {
                "give a frequency in rad/s or Hz (omega_rad_s, frequency_hz, f [Hz]), a phase in deg or rad \
                 (tip_deg, tip_phase [rad]), a magnitude in dB or without unit (tip_db, tip_mag); the motor's \
                 response may have a unit such as motor_re [rad/A]"
            }
            Self::NoResponse { .. } | Self::Half { .. } => {
                "give two columns for each response: tip_re and tip_im, or tip_db (or tip_mag) and tip_deg"
            }
            Self::Twice { .. } | Self::SameName { .. } => {
                "give each response its own name, as in tip_re, tip_im, elbow_re, elbow_im, or its own file"
            }
            Self::Kind { .. } => {
                "give the response of a point as angle per motor angle, and the response of the motor, with the \
                 name motor, as angle per current, voltage or command"
            }
            Self::NotANumber { .. } | Self::MissingCell { .. } | Self::ZeroResponse { .. } => {
                "leave out rows without a measurement"
            }
            Self::ExtraCell { .. } => {
                "give one cell for each name in the header; separate numbers with decimal commas by semicolons"
            }
            Self::NotPositive { what: Positive::Frequency, .. } => {
                "leave out rows with a frequency of zero or less"
            }
            Self::NotPositive { what: Positive::Deviation, .. } => {
                "give each value its standard error; if it is unknown, leave out the column, and the standard \
                 errors are estimated from the residual of the model"
            }
            Self::NotPositive { what: Positive::Magnitude, .. } => {
                "give a magnitude in dB the name tip_db; a number with a sign is a real part, tip_re; leave out rows \
                 without a measurement"
            }
            Self::TooLargeResponse { .. } => {
                "check the unit: a magnitude that is not in dB has the name tip_mag"
            }
            Self::TinyDeviation { .. } => {
                "correct the cell: otherwise the fit would ignore all other frequencies"
            }
            Self::NotAscending { .. } => "sort the rows by frequency, with one row for each",
            Self::NoRows { .. } => "add one row for each frequency below the header",
            Self::Grid { .. } | Self::GridLength { .. } => {
                "measure all points at the same frequencies, or keep those that are in all files"
            }
            Self::NoPoint { .. } => "add the response of a point of the beam per motor angle",
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
