//! Reading tables of responses.

use std::fs::File;
use std::io::{self, Read as _};
use std::path::Path;

use lissom_formats::Channel;
use num_complex::Complex64;

use super::response_columns::{Columns, ComplexPart, PartColumn};
use super::response_error::{Positive, ResponseError};
use crate::log::{Delimiter, comment, is_header, number};
use crate::units::Dimension;

/// Largest size of a table in bytes.
const MOST: u64 = 1 << 28;
/// Relative difference up to which frequencies of two tables are the same.
const SAME: f64 = 1e-6;
/// A standard error is a mistake if it is below this share of its response and below [`SMALLER`].
const TINY: f64 = 1e-9;
/// The share of the median of all standard errors below which one is a mistake, see [`TINY`].
const SMALLER: f64 = 1e-6;
/// Name of the motor's response.
const MOTOR: &str = "motor";

/// One frequency response.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredResponse {
    /// Name of the output: `motor`, or the name of a point.
    pub name: String,
    /// Output per input at each frequency, in SI.
    pub response: Vec<Complex64>,
    /// Standard errors `√E|Ĝ − G|²`, if the table has them.
    pub std: Option<Vec<f64>>,
    /// Dimension of the response, if the header gives a unit.
    pub dimension: Option<Dimension>,
}

impl MeasuredResponse {
    /// Number of zeros at the origin in addition to those of an angle, from the unit: one for a velocity per angle
    /// (1/s), two for an acceleration (1/s²). `None` for any other unit.
    pub fn zeros_at_origin(&self) -> Option<i32> {
        let per = |s: i32| Dimension::new(0, 0, -s, 0);
        let dimension = self.dimension.unwrap_or(Dimension::NUMBER);
        (0..=2).find(|zeros| dimension == per(*zeros))
    }
}

/// Frequency responses at the same frequencies.
#[derive(Debug, Clone, PartialEq)]
pub struct FrequencyResponses {
    /// Frequencies, ascending \[rad/s\].
    pub omega_rad_s: Vec<f64>,
    /// θ_i/θ_m of points of the beam.
    pub points: Vec<MeasuredResponse>,
    /// θ_m per command: the response with the name `motor`.
    pub motor: Option<MeasuredResponse>,
}

/// Reads tables of frequency responses at the same frequencies.
///
/// # Errors
/// [`ResponseError`], with file, row and column.
pub fn read_responses<P: AsRef<Path>>(files: &[P]) -> Result<FrequencyResponses, ResponseError> {
    let mut all: Option<(String, Table)> = None;
    let mut from: Vec<String> = Vec::new();
    for path in files {
        let path = path.as_ref();
        let table = read_table(path)?;
        let file = path.display().to_string();
        let count = table.responses.len();
        match &mut all {
            None => all = Some((file.clone(), table)),
            Some((other, whole)) => {
                same_grid(&file, &table, other, &whole.omega_rad_s)?;
                for found in table.responses {
                    if let Some(at) = whole.responses.iter().position(|r| r.name == found.name) {
                        let (output, other) = (found.name, from[at].clone());
                        return Err(ResponseError::SameName { file, output, other });
                    }
                    whole.responses.push(found);
                }
            }
        }
        from.extend(std::iter::repeat_n(file, count));
    }
    let Some((file, table)) = all else {
        return Err(ResponseError::NoRows { file: "no table".to_owned() });
    };
    let (motor, points): (Vec<_>, Vec<_>) =
        table.responses.into_iter().partition(|r| r.name.eq_ignore_ascii_case(MOTOR));
    let number = |r: &MeasuredResponse| r.dimension.is_none_or(|d| d == Dimension::NUMBER);
    if let Some(point) = points.iter().find(|r| r.zeros_at_origin().is_none()) {
        return Err(kind(
            &file,
            point,
            "the response of a point must be an angle, velocity or acceleration per angle",
        ));
    }
    let per =
        [Dimension::CURRENT, Dimension::VOLTAGE].map(|d| Dimension::new(-d.kg, -d.m, -d.s, -d.a));
    if let Some(odd) =
        motor.iter().find(|r| !number(r) && !per.iter().any(|d| Some(*d) == r.dimension))
    {
        return Err(kind(
            &file,
            odd,
            "the response of the motor must be an angle per current, voltage or command",
        ));
    }
    if points.is_empty() {
        return Err(ResponseError::NoPoint { file });
    }
    let motor = motor.into_iter().next();
    Ok(FrequencyResponses { omega_rad_s: table.omega_rad_s, points, motor })
}

fn kind(file: &str, response: &MeasuredResponse, expected: &'static str) -> ResponseError {
    ResponseError::Kind {
        file: file.to_owned(),
        output: response.name.clone(),
        dimension: response.dimension.map_or(String::new(), |d| d.to_string()),
        expected,
    }
}

struct Table {
    omega_rad_s: Vec<f64>,
    /// Line number of each row.
    rows: Vec<usize>,
    responses: Vec<MeasuredResponse>,
}

fn same_grid(file: &str, table: &Table, other: &str, grid: &[f64]) -> Result<(), ResponseError> {
    let (file, other) = (file.to_owned(), other.to_owned());
    if table.omega_rad_s.len() != grid.len() {
        let (found, expected) = (table.omega_rad_s.len(), grid.len());
        return Err(ResponseError::GridLength { file, found, other, expected });
    }
    let differs = |(a, b): (&f64, &f64)| (a / b - 1.0).abs() > SAME;
    match table.omega_rad_s.iter().zip(grid).position(differs) {
        Some(at) => Err(ResponseError::Grid {
            file,
            row: table.rows[at],
            found_rad_s: table.omega_rad_s[at],
            other,
            expected_rad_s: grid[at],
        }),
        None => Ok(()),
    }
}

fn text(path: &Path) -> Result<String, ResponseError> {
    let file = || path.display().to_string();
    let failed = |source| ResponseError::Read { file: file(), source };
    let opened = File::open(path).map_err(failed)?;
    if opened.metadata().map_err(failed)?.is_dir() {
        return Err(failed(io::ErrorKind::IsADirectory.into()));
    }
    let mut bytes = Vec::new();
    opened.take(MOST).read_to_end(&mut bytes).map_err(failed)?;
    if bytes.len() as u64 == MOST {
        return Err(ResponseError::TooLarge { file: file(), most: MOST });
    }
    if wide(&bytes) {
        return Err(ResponseError::Encoding { file: file(), encoding: "UTF-16", row: 1 });
    }
    let control = |b: &u8| b.is_ascii_control() && !matches!(b, b'\t' | b'\r' | b'\n' | b'\x0C');
    if bytes.iter().any(control) {
        return Err(ResponseError::NotText { file: file() });
    }
    String::from_utf8(bytes).map_err(|error| {
        let before = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let row = before.split(|b| *b == b'\n').count();
        ResponseError::Encoding { file: file(), encoding: "WINDOWS-1252 (or Latin-1)", row }
    })
}

/// Whether text has two bytes for each character: it has a byte order mark, or every second byte is zero.
fn wide(bytes: &[u8]) -> bool {
    let marked = bytes.starts_with(&[0xFF, 0xFE]) || bytes.starts_with(&[0xFE, 0xFF]);
    let zeros = |odd: usize| bytes.iter().skip(odd).step_by(2).filter(|b| **b == 0).count();
    let half = bytes.len() / 2;
    let (even, odd) = (zeros(0), zeros(1));
    marked || half > 4 && (even == 0 && 10 * odd > 9 * half || odd == 0 && 10 * even > 9 * half)
}

fn read_table(path: &Path) -> Result<Table, ResponseError> {
    let found = plain_cells(path).and_then(|cells| cells.table(path));
    match found {
        Err(
            ResponseError::NoHeader { .. }
            | ResponseError::NotText { .. }
            | ResponseError::Encoding { .. }
            | ResponseError::NoFrequency { .. }
            | ResponseError::NoResponse { .. },
        ) => other_cells(path).map_or(found, |cells| cells.table(path)),
        found => found,
    }
}

/// The cells of a table.
struct Cells {
    names: Vec<String>,
    columns: Columns,
    /// The values of each column; empty if they are not needed.
    values: Vec<Vec<f64>>,
    /// Line number of each row.
    rows: Vec<usize>,
}

/// The cells of a plain text.
fn plain_cells(path: &Path) -> Result<Cells, ResponseError> {
    let file = path.display().to_string();
    let text = text(path)?;
    let text = text.trim_start_matches('\u{feff}');
    let mut lines = text
        .lines()
        .enumerate()
        .map(|(i, line)| (i + 1, line))
        .filter(|(_, line)| !line.trim().is_empty() && comment(line).is_none());
    let header = lines.next().map(|(_, line)| line);
    let header = header.filter(|line| is_header(line, Delimiter::of(line, false), false));
    let Some(header) = header else { return Err(ResponseError::NoHeader { file }) };
    let delimiter = Delimiter::of(header, false);
    // If cells are separated by semicolons, a comma can only be the decimal sign.
    let decimal_comma = delimiter == Delimiter::Char(';');
    let names: Vec<String> = delimiter.split(header).map(str::to_owned).collect();
    let columns = Columns::of(&file, &names)?;
    if columns.parts.is_empty() {
        return Err(ResponseError::NoResponse { file, names });
    }
    let mut values: Vec<Vec<f64>> = vec![Vec::new(); names.len()];
    let mut rows = Vec::new();
    for (row, line) in lines {
        let cells: Vec<&str> = delimiter.split(line).collect();
        let beyond = cells.iter().enumerate().skip(names.len());
        if let Some((at, found)) = beyond.into_iter().find(|(_, cell)| !cell.is_empty()) {
            let (column, found, names) = (at + 1, (*found).to_owned(), names.len());
            return Err(ResponseError::ExtraCell { file, row, column, found, names });
        }
        for index in columns.wanted() {
            let column = || names[index].clone();
            let cell = cells.get(index).copied().unwrap_or("");
            if cell.is_empty() {
                return Err(ResponseError::MissingCell { file, row, column: column() });
            }
            let Some(value) = number(cell, decimal_comma).filter(|v| v.is_finite()) else {
                let (column, found) = (column(), cell.to_owned());
                return Err(ResponseError::NotANumber { file, row, column, found });
            };
            values[index].push(value);
        }
        rows.push(row);
    }
    Ok(Cells { names, columns, values, rows })
}

/// The cells of a file with a preamble or of another format; `None` if it has no frequency response.
fn other_cells(path: &Path) -> Option<Cells> {
    let data = lissom_formats::read(path).ok()?;
    let has_unit = |name: &str, unit: &str| {
        let name = name.trim_end_matches([']', ')', ' ']).to_lowercase();
        let before = name.strip_suffix(&unit.to_lowercase());
        before.is_some_and(|name| !name.ends_with(char::is_alphanumeric))
    };
    let with_unit = |channel: &Channel| match &channel.unit {
        Some(unit) if !has_unit(&channel.name, unit) => format!("{} [{unit}]", channel.name),
        _ => channel.name.clone(),
    };
    let names: Vec<String> = data.channels.iter().map(with_unit).collect();
    let columns = Columns::of("", &names).ok().filter(|columns| !columns.parts.is_empty())?;
    let count = data.channels[columns.frequency].values.len();
    let is_whole = |k: usize| {
        let values = &data.channels[k].values;
        values.len() == count && values.iter().all(|value| value.is_finite())
    };
    if !columns.wanted().all(is_whole) {
        return None;
    }
    let values = data.channels.into_iter().map(|channel| channel.values).collect();
    Some(Cells { names, columns, values, rows: (1..=count).collect() })
}

impl Cells {
    /// The responses in the table of a file.
    fn table(self, path: &Path) -> Result<Table, ResponseError> {
        let file = path.display().to_string();
        let Self { names, columns, values, rows } = self;
        let stem = path.file_stem().map_or_else(String::new, |s| s.to_string_lossy().into_owned());
        let frequency = &values[columns.frequency];
        let column = || names[columns.frequency].clone();
        for (at, (&found, &row)) in frequency.iter().zip(&rows).enumerate() {
            if found <= 0.0 {
                let what = Positive::Frequency;
                return Err(ResponseError::NotPositive {
                    file,
                    row,
                    column: column(),
                    found,
                    what,
                });
            }
            if let Some(before) = at.checked_sub(1).map(|i| frequency[i]).filter(|b| *b >= found) {
                let column = column();
                return Err(ResponseError::NotAscending {
                    file,
                    row,
                    column,
                    before,
                    after: found,
                });
            }
        }
        if rows.is_empty() {
            return Err(ResponseError::NoRows { file });
        }
        let outputs = outputs(&file, &names, &columns, &stem)?;
        let responses = outputs.iter().map(|output| output.response(&file, &names, &rows, &values));
        let responses = responses.collect::<Result<_, _>>()?;
        let omega_rad_s = frequency.iter().map(|f| f * columns.rad_s).collect();
        Ok(Table { omega_rad_s, rows, responses })
    }
}

/// The columns of an output.
struct Output<'a> {
    name: String,
    first: &'a PartColumn,
    second: &'a PartColumn,
    std: Option<&'a PartColumn>,
}

/// The outputs in the order of their columns.
fn outputs<'a>(
    file: &str,
    names: &[String],
    columns: &'a Columns,
    stem: &str,
) -> Result<Vec<Output<'a>>, ResponseError> {
    let file = || file.to_owned();
    let mut order: Vec<&str> = Vec::new();
    for part in &columns.parts {
        if !order.contains(&part.output.as_str()) {
            order.push(&part.output);
        }
    }
    if order.is_empty() {
        return Err(ResponseError::NoResponse { file: file(), names: names.to_vec() });
    }
    let output = |&own: &&str| {
        let output = || if own.is_empty() { stem.to_owned() } else { own.to_owned() };
        let find = |part: ComplexPart| -> Result<Option<&'a PartColumn>, ResponseError> {
            let mut found = columns.parts.iter().filter(|c| c.output == own && c.part == part);
            let first = found.next();
            match found.next() {
                Some(_) => {
                    let (file, output, part) = (file(), output(), part.name());
                    Err(ResponseError::Twice { file, output, part })
                }
                None => Ok(first),
            }
        };
        let half = |has: ComplexPart, missing: ComplexPart| ResponseError::Half {
            file: file(),
            output: output(),
            has: has.name(),
            missing: missing.name(),
        };
        let (re, im) = (find(ComplexPart::Real)?, find(ComplexPart::Imaginary)?);
        let (db, plain, phase) =
            (find(ComplexPart::Decibel)?, find(ComplexPart::Magnitude)?, find(ComplexPart::Phase)?);
        let (first, second) = match (re, im, db.or(plain), phase) {
            (Some(re), Some(im), _, _) => (re, im),
            (_, _, Some(size), Some(phase)) => (size, phase),
            (Some(_), None, _, _) => return Err(half(ComplexPart::Real, ComplexPart::Imaginary)),
            (None, Some(_), _, _) => return Err(half(ComplexPart::Imaginary, ComplexPart::Real)),
            (_, _, Some(size), None) => return Err(half(size.part, ComplexPart::Phase)),
            (_, _, None, Some(_)) => return Err(half(ComplexPart::Phase, ComplexPart::Magnitude)),
            (None, None, None, None) => {
                return Err(half(ComplexPart::Deviation, ComplexPart::Real));
            }
        };
        Ok(Output { name: output(), first, second, std: find(ComplexPart::Deviation)? })
    };
    order.iter().map(output).collect()
}

impl Output<'_> {
    fn response(
        &self,
        file: &str,
        names: &[String],
        rows: &[usize],
        values: &[Vec<f64>],
    ) -> Result<MeasuredResponse, ResponseError> {
        let at = |column: &PartColumn, i: usize| column.factor * values[column.index][i];
        let value = |i: usize| {
            let (a, b) = (at(self.first, i), at(self.second, i));
            match self.first.part {
                ComplexPart::Decibel => Complex64::from_polar(10f64.powf(a / 20.0), b),
                ComplexPart::Magnitude => Complex64::from_polar(a, b),
                _ => Complex64::new(a, b),
            }
        };
        let cell =
            |column: &PartColumn, i: usize| (file.to_owned(), rows[i], names[column.index].clone());
        let positive = |column: &PartColumn, found: f64, i: usize, what: Positive| {
            let (file, row, column) = cell(column, i);
            let error = ResponseError::NotPositive { file, row, column, found, what };
            if found > 0.0 { Ok(()) } else { Err(error) }
        };
        let response: Vec<Complex64> = (0..rows.len()).map(value).collect();
        for (i, value) in response.iter().enumerate() {
            if self.first.part == ComplexPart::Magnitude {
                positive(self.first, at(self.first, i), i, Positive::Magnitude)?;
            }
            let (file, row, column) = cell(self.first, i);
            if !value.norm().is_finite() {
                return Err(ResponseError::TooLargeResponse { file, row, column });
            }
            if value.norm() == 0.0 {
                let output = self.name.clone();
                return Err(ResponseError::ZeroResponse { file, row, output });
            }
        }
        let std = self.std.map(|column| {
            let all: Vec<f64> = (0..rows.len()).map(|i| at(column, i)).collect();
            let others = median(&all);
            for (i, &found) in all.iter().enumerate() {
                positive(column, found, i, Positive::Deviation)?;
                if found < TINY * response[i].norm() && found < SMALLER * others {
                    let (file, row, column) = cell(column, i);
                    return Err(ResponseError::TinyDeviation { file, row, column, found, others });
                }
            }
            Ok(all)
        });
        Ok(MeasuredResponse {
            name: self.name.clone(),
            response,
            std: std.transpose()?,
            dimension: self
                .first
                .dimension
                .or(self.second.dimension)
                .or(self.std.and_then(|s| s.dimension)),
        })
    }
}

fn median(of: &[f64]) -> f64 {
    let mut sorted = of.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or(0.0)
}
