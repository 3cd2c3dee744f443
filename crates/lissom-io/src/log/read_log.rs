//! Reading a log row by row.

use std::borrow::Cow;
use std::collections::VecDeque;
use std::fs::File;
use std::io::{BufRead, BufReader, ErrorKind, Read};
use std::path::Path;

use lissom_core::record::Hold;

use super::log_columns::{ColumnRef, Log, LogColumn, LogOptions, TimeBack};
use super::log_error::LogError;
use super::log_layout::{self, Delimiter, PlainDecimal};
use super::other_format;
use super::thinner::Thinner;

/// Largest length of a row in bytes.
const LONGEST_ROW: u64 = 1 << 20;
/// Number of comment lines before the data in which names are searched for.
const LAST_COMMENTS: usize = 50;
/// Largest length of such a line in characters.
const LONGEST_COMMENT: usize = 1 << 16;

/// A log with at most so many rows may have a row for each signal in place of a column.
const FEW_ROWS: usize = 20;

/// Largest number of places at which time may go back.
const MOST_TIME_BACK: usize = 1 << 16;

/// Reads the columns of a log file, and its time stamps if `time` is given.
///
/// # Errors
/// Any [`LogError`] except those about pieces and skipping.
pub fn read_log(
    path: &Path,
    time: Option<&ColumnRef>,
    columns: &[LogColumn],
    options: &LogOptions,
) -> Result<Log, LogError> {
    let name = path.display().to_string();
    match File::open(path).and_then(only_file) {
        Ok(file) => {
            let mut reader = BufReader::with_capacity(1 << 16, file);
            let begins = reader
                .fill_buf()
                .map_err(|source| LogError::Open { file: name.clone(), source })?;
            if lissom_formats::is_no_plain_table(begins) {
                let no_text = LogError::NotText { file: name, row: 1 };
                return other_format::read(path, time, columns, options, no_text);
            }
            match read_log_from(reader, &name, time, columns, options) {
                Err(error) if error.may_be_another_format() => {
                    other_format::read(path, time, columns, options, error)
                }
                Ok(log) if log.columns.first().is_some_and(|c| c.len() <= FEW_ROWS) => {
                    // Or one row for each signal.
                    Ok(other_format::by_row(path, time, columns, options).unwrap_or(log))
                }
                found => found,
            }
        }
        Err(source) => Err(LogError::Open { file: name, source }),
    }
}

/// Refuses folders, which can be opened too.
fn only_file(file: File) -> std::io::Result<File> {
    if file.metadata()?.is_dir() { Err(ErrorKind::IsADirectory.into()) } else { Ok(file) }
}

/// Reads the columns of a log from any reader; `name` is used in errors.
///
/// # Errors
/// Any [`LogError`] except those about opening, pieces and skipping.
pub fn read_log_from(
    reader: impl BufRead,
    name: &str,
    time: Option<&ColumnRef>,
    columns: &[LogColumn],
    options: &LogOptions,
) -> Result<Log, LogError> {
    let mut rows = LogRows { reader, name, row: 0, bytes: Vec::new() };
    let Some(head) = Head::read(&mut rows, options)? else {
        return Err(LogError::Empty { file: name.to_owned() });
    };
    let refs: Vec<&ColumnRef> = time.into_iter().chain(columns.iter().map(|c| &c.column)).collect();
    // If all columns are given by number, the words above them may be a title.
    let by_name = refs.iter().any(|column| matches!(column, ColumnRef::Name(_)));
    let wanted = refs
        .iter()
        .map(|column| log_layout::find_column(name, column, &head.names, head.columns))
        .collect::<Result<Vec<_>, _>>()?;
    let holds = time.map(|_| Hold::Measured).into_iter().chain(columns.iter().map(|c| c.hold));
    let mut body = Body {
        file: name,
        delimiter: head.delimiter,
        decimal_comma: options.decimal_comma,
        columns: if by_name { head.most } else { head.columns },
        labels: refs.iter().map(ToString::to_string).collect(),
        wanted,
        has_time: time.is_some(),
        values: vec![f64::NAN; refs.len()],
        last: Vec::new(),
        time_back: Vec::new(),
        repeated: 0,
        decimals: Some(0),
        thinner: Thinner::new(holds.collect(), options.max_rows),
        count: 0,
    };
    let first_row = head.row;
    if let Some(first) = head.first {
        body.take(&first, first_row)?;
    }
    while let Some(row) = rows.advance()? {
        if rows.is_whole() && body.take_plain(&rows.bytes, row)? {
            continue;
        }
        let line = rows.line()?;
        if !line.trim().is_empty() && log_layout::comment(&line).is_none() {
            body.take(&line, row)?;
        }
    }
    body.finish(first_row)
}

/// Lines of a text file.
struct LogRows<'a, R> {
    reader: R,
    name: &'a str,
    row: usize,
    bytes: Vec<u8>,
}

impl<R: BufRead> LogRows<'_, R> {
    /// The next line, and its number from 1.
    fn next(&mut self) -> Result<Option<(usize, Cow<'_, str>)>, LogError> {
        match self.advance()? {
            None => Ok(None),
            Some(row) => Ok(Some((row, self.line()?))),
        }
    }

    /// Reads the next line, and gives its number from 1.
    fn advance(&mut self) -> Result<Option<usize>, LogError> {
        self.row += 1;
        let row = self.row;
        self.bytes.clear();
        let mut limited = (&mut self.reader).take(LONGEST_ROW);
        let length = limited
            .read_until(b'\n', &mut self.bytes)
            .map_err(|source| LogError::Read { file: self.name.to_owned(), row, source })?;
        Ok((length > 0).then_some(row))
    }

    /// Whether all of the line was read.
    fn is_whole(&self) -> bool {
        self.bytes.last() == Some(&b'\n') || (self.bytes.len() as u64) < LONGEST_ROW
    }

    /// The line that was read last.
    fn line(&self) -> Result<Cow<'_, str>, LogError> {
        let row = self.row;
        let file = || self.name.to_owned();
        let bytes = self.bytes.as_slice();
        if row == 1 && (bytes.starts_with(b"\xFF\xFE") || bytes.starts_with(b"\xFE\xFF")) {
            return Err(LogError::Utf16 { file: file() });
        }
        // Without an early exit, so that many bytes are compared at once.
        if bytes.iter().fold(false, |any, byte| any | is_control(*byte)) {
            return Err(LogError::NotText { file: file(), row });
        }
        if !self.is_whole() {
            return Err(LogError::LongRow { file: file(), row, most: LONGEST_ROW });
        }
        let bytes =
            if row == 1 { bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes) } else { bytes };
        Ok(match std::str::from_utf8(bytes) {
            Ok(line) => line.trim_end_matches(['\r', '\n']).into(),
            Err(_) => {
                String::from_utf8_lossy(bytes).trim_end_matches(['\r', '\n']).to_owned().into()
            }
        })
    }
}

/// Whether a byte does not occur in text.
fn is_control(byte: u8) -> bool {
    byte.is_ascii_control() && !matches!(byte, b'\t' | b'\r' | b'\n' | b'\x0C')
}

/// The text before the second row of numbers.
struct Head {
    delimiter: Delimiter,
    names: Vec<String>,
    /// Number of cells in the first row of numbers, or of names in a header without rows.
    columns: usize,
    /// Number of names in a header row, otherwise of cells in that row, because a comment may name only some columns.
    most: usize,
    /// First row of numbers.
    first: Option<String>,
    row: usize,
}

impl Head {
    fn read(
        rows: &mut LogRows<'_, impl BufRead>,
        options: &LogOptions,
    ) -> Result<Option<Self>, LogError> {
        let mut comments: VecDeque<String> = VecDeque::new();
        let mut names: Option<Vec<String>> = None;
        let mut units = false;
        while let Some((row, line)) = rows.next()? {
            if line.trim().is_empty() {
                continue;
            }
            if let Some(text) = log_layout::comment(&line) {
                if comments.len() == LAST_COMMENTS {
                    comments.pop_front();
                }
                comments.push_back(text.chars().take(LONGEST_COMMENT).collect());
                continue;
            }
            let decimal_comma = options.decimal_comma;
            let delimiter = Delimiter::of(&line, decimal_comma);
            if names.is_none() && log_layout::is_header(&line, delimiter, decimal_comma) {
                names = Some(delimiter.split(&line).map(str::to_owned).collect());
                continue;
            }
            if names.is_some() && !units && log_layout::is_words(&line, delimiter, decimal_comma) {
                units = true;
                continue;
            }
            let columns = delimiter.split(&line).count();
            let most = names.as_ref().map_or(columns, Vec::len);
            let names = names
                .unwrap_or_else(|| log_layout::names_from_comments(&comments, delimiter, columns));
            return Ok(Some(Self {
                delimiter,
                names,
                columns,
                most,
                first: Some(line.into_owned()),
                row,
            }));
        }
        if names.is_none() && comments.is_empty() {
            return Ok(None);
        }
        Err(LogError::HeaderOnly { file: rows.name.to_owned() })
    }
}

/// The rows of numbers.
pub(super) struct Body<'a> {
    file: &'a str,
    delimiter: Delimiter,
    decimal_comma: bool,
    /// Number of columns.
    columns: usize,
    /// Names of the columns wanted, for errors; time is first if it is wanted.
    labels: Vec<String>,
    /// Their indices.
    wanted: Vec<usize>,
    has_time: bool,
    values: Vec<f64>,
    /// Values of the row before.
    last: Vec<f64>,
    time_back: Vec<TimeBack>,
    repeated: usize,
    /// Largest number of decimals of a stamp; `None` after a stamp with an exponent.
    decimals: Option<usize>,
    thinner: Thinner,
    count: usize,
}

impl<'a> Body<'a> {
    /// A log of columns of the same length, which were read from another format; time is first if there is one.
    pub(super) fn of_columns(
        file: &'a str,
        labels: Vec<String>,
        has_time: bool,
        holds: Vec<Hold>,
        options: &LogOptions,
        columns: &[Vec<f64>],
    ) -> Result<Log, LogError> {
        let mut body = Body {
            file,
            delimiter: Delimiter::Blanks,
            decimal_comma: false,
            columns: columns.len(),
            labels,
            wanted: Vec::new(),
            has_time,
            values: Vec::new(),
            last: Vec::new(),
            time_back: Vec::new(),
            repeated: 0,
            decimals: None,
            thinner: Thinner::new(holds, options.max_rows),
            count: 0,
        };
        for row in 0..columns.first().map_or(0, Vec::len) {
            body.values.clear();
            body.values.extend(columns.iter().map(|column| column[row]));
            body.push(row + 1)?;
        }
        body.finish(1)
    }

    fn take(&mut self, line: &str, row: usize) -> Result<(), LogError> {
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

    /// Takes a row of plain decimals, as most rows are, in one pass. Returns `false` without taking anything for other
    /// rows.
    fn take_plain(&mut self, line: &[u8], row: usize) -> Result<bool, LogError> {
        let Delimiter::Char(delimiter) = self.delimiter else { return Ok(false) };
        let line = line.strip_suffix(b"\n").unwrap_or(line);
        let mut rest = line.strip_suffix(b"\r").unwrap_or(line);
        let (mut found, mut decimals) = (0, 0);
        for index in 0..self.columns {
            let Some(cell) = PlainDecimal::leading(rest) else { return Ok(false) };
            for k in 0..self.wanted.len() {
                if self.wanted[k] == index {
                    self.values[k] = cell.value;
                    found += 1;
                    if k == 0 {
                        decimals = cell.decimals;
                    }
                }
            }
            match rest[cell.length..].split_first() {
                Some((byte, others)) if char::from(*byte) == delimiter => rest = others,
                Some(_) => return Ok(false),
                None if found < self.wanted.len() => return Ok(false),
                None => {
                    if self.has_time {
                        self.decimals = self.decimals.map(|most| most.max(decimals));
                    }
                    return self.push(row).map(|()| true);
                }
            }
        }
        Ok(false)
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

    fn finish(self, first_row: usize) -> Result<Log, LogError> {
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
