//! The rows of numbers of a log.

use lissom_core::record::Hold;

use super::log_columns::{Log, LogOptions, TimeBack};
use super::log_error::LogError;
use super::log_layout::{self, Delimiter};
use super::plain_row::PlainRow;
use super::thinner::Thinner;

/// Largest number of places at which time may go back.
const MOST_TIME_BACK: usize = 1 << 16;

/// The rows of numbers.
pub(super) struct Body<'a> {
    pub(super) file: &'a str,
    pub(super) delimiter: Delimiter,
    pub(super) decimal_comma: bool,
    /// Number of columns.
    pub(super) columns: usize,
    /// Names of the columns wanted, for errors; time is first if it is wanted.
    pub(super) labels: Vec<String>,
    /// Their indices.
    pub(super) wanted: Vec<usize>,
    pub(super) plain: PlainRow,
    pub(super) has_time: bool,
    pub(super) values: Vec<f64>,
    /// Values of the row before.
    pub(super) last: Vec<f64>,
    pub(super) time_back: Vec<TimeBack>,
    pub(super) repeated: usize,
    /// Largest number of decimals of a stamp; `None` after a stamp with an exponent.
    pub(super) decimals: Option<usize>,
    pub(super) thinner: Thinner,
    pub(super) count: usize,
}

impl<'a> Body<'a> {
    /// A log of columns of the same length, which were read from another format; time is first if there is one.
    pub(super) fn of_columns(
        file: &'a str,
        labels: Vec<String>,
        has_time: bool,
        holds: Vec<Hold>,
        options: &LogOptions,
        columns: &[&[f64]],
    ) -> Result<Log, LogError> {
        let rows = columns.first().map_or(0, |column| column.len());
        let increases = || columns[0].windows(2).all(|pair| pair[0] < pair[1]);
        if (2..options.max_rows & !1).contains(&rows) && (!has_time || increases()) {
            return Ok(Log::complete(has_time, columns));
        }
        let mut body = Body {
            file,
            delimiter: Delimiter::Blanks,
            decimal_comma: false,
            columns: columns.len(),
            labels,
            wanted: Vec::new(),
            plain: PlainRow::new(Delimiter::Blanks, false, 0, &[]),
            has_time,
            values: Vec::new(),
            last: Vec::new(),
            time_back: Vec::new(),
            repeated: 0,
            decimals: None,
            thinner: Thinner::new(holds, options.max_rows),
            count: 0,
        };
        body.expect(rows);
        for row in 0..rows {
            body.values.clear();
            body.values.extend(columns.iter().map(|column| column[row]));
            body.push(row + 1)?;
        }
        body.finish(1)
    }

    pub(super) fn take(&mut self, line: &str, row: usize) -> Result<(), LogError> {
        self.values.fill(f64::NAN);
        let mut found = 0;
        for (index, cell) in self.delimiter.split(line).enumerate() {
            if index >= self.columns && !cell.is_empty() {
                // The cells before it may be below the wrong names.
                let (file, column, found) = (self.file.to_owned(), index + 1, cell.to_owned());
                return Err(LogError::ExtraCell {
                    file,
                    row,
                    column,
                    found,
                    columns: self.columns,
                });
            }
            for k in 0..self.wanted.len() {
                if self.wanted[k] == index {
                    self.values[k] = self.number(cell, row, k)?;
                    found += 1;
                    if k == 0 && self.has_time {
                        self.note_decimals(cell);
                    }
                }
            }
        }
        if found < self.wanted.len() {
            let missing = self.values.iter().position(|value| value.is_nan()).unwrap_or(0);
            return Err(self.missing(row, missing));
        }
        self.push(row)
    }

    /// Takes the rows of plain numbers at the beginning of a text, as most rows are, and gives the number of their bytes.
    pub(super) fn take_plain(&mut self, text: &[u8], row: &mut usize) -> Result<usize, LogError> {
        let mut taken = 0;
        while let Some(found) = self.plain.read(&text[taken..], &mut self.values) {
            if self.has_time {
                self.decimals = self.decimals.zip(found.decimals).map(|(a, b)| a.max(b));
            }
            taken += found.length;
            self.push(*row)?;
            *row += 1;
        }
        Ok(taken)
    }

    /// Makes room for so many rows.
    pub(super) fn expect(&mut self, rows: usize) {
        self.thinner.expect(rows);
    }

    /// Adds the row whose values were read.
    fn push(&mut self, row: usize) -> Result<(), LogError> {
        if self.has_time && self.is_repeated(row)? {
            self.repeated += 1;
            return Ok(());
        }
        self.count += 1;
        self.thinner.push(&self.values);
        Ok(())
    }

    fn number(&self, cell: &str, row: usize, k: usize) -> Result<f64, LogError> {
        let file = || self.file.to_owned();
        let column = || self.labels[k].clone();
        match log_layout::number(cell, self.decimal_comma) {
            Some(value) if value.is_finite() => Ok(value),
            _ if cell.is_empty() => Err(self.missing(row, k)),
            Some(_) => Err(LogError::NotFinite {
                file: file(),
                row,
                column: column(),
                found: cell.to_owned(),
            }),
            None => Err(LogError::NotANumber {
                file: file(),
                row,
                column: column(),
                found: cell.to_owned(),
            }),
        }
    }

    fn missing(&self, row: usize, k: usize) -> LogError {
        LogError::MissingCell { file: self.file.to_owned(), row, column: self.labels[k].clone() }
    }

    fn note_decimals(&mut self, cell: &str) {
        let decimals = match cell.find(['.', ',']) {
            _ if cell.contains(['e', 'E']) => None,
            Some(point) => Some(cell.len() - point - 1),
            None => Some(0),
        };
        self.decimals = self.decimals.zip(decimals).map(|(a, b)| a.max(b));
    }

    /// Whether the row repeats the one before. Notes where time goes back.
    fn is_repeated(&mut self, row: usize) -> Result<bool, LogError> {
        let after = self.values[0];
        if let Some(&before) = self.last.first()
            && after <= before
        {
            if self.values == self.last {
                return Ok(true);
            }
            if after >= before {
                let (file, column) = (self.file.to_owned(), self.labels[0].clone());
                return Err(LogError::TimeStill { file, row, column, stamp: after });
            }
            self.time_back.push(TimeBack { sample: self.count, row, before, after });
            if self.time_back.len() >= MOST_TIME_BACK {
                self.no_time_back()?;
            }
        }
        self.last.clone_from(&self.values);
        Ok(false)
    }

    fn no_time_back(&self) -> Result<(), LogError> {
        match self.time_back.first() {
            None => Ok(()),
            Some(first) => Err(LogError::time_back(self.file, &self.labels[0], first)),
        }
    }

    pub(super) fn finish(self, first_row: usize) -> Result<Log, LogError> {
        if self.count < 2 {
            return Err(LogError::OneRow { file: self.file.to_owned(), row: first_row });
        }
        if self.thinner.factor() > 1 {
            // A thinned sample may have rows of both sides.
            self.no_time_back()?;
        }
        let (mut columns, factor) = self.thinner.finish();
        let time = self.has_time.then(|| columns.remove(0));
        let time_step = match self.decimals {
            Some(decimals) if self.has_time => {
                0.1_f64.powi(i32::try_from(decimals.min(300)).unwrap_or(300))
            }
            _ => 0.0,
        };
        Ok(Log {
            time,
            columns,
            factor,
            time_step,
            time_back: self.time_back,
            repeated: self.repeated,
        })
    }
}
