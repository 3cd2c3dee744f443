//! Reads plain text with a header, row by row.

use std::borrow::Cow;
use std::collections::VecDeque;
use std::io::{BufRead, Read};

use lissom_core::record::Hold;

use super::log_body::Body;
use super::log_columns::{ColumnRef, Log, LogColumn, LogOptions};
use super::log_error::LogError;
use super::log_layout::{self, Delimiter};
use super::plain_row::PlainRow;
use super::thinner::Thinner;

/// Largest length of a row in bytes.
const LONGEST_ROW: u64 = 1 << 20;
/// Number of comment lines before the data in which names are searched for.
const LAST_COMMENTS: usize = 50;
/// Largest length of such a line in characters.
const LONGEST_COMMENT: usize = 1 << 16;

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
    read_rows(reader, None, name, time, columns, options)
}

/// Reads a log, of so many bytes if that is known.
pub(super) fn read_rows(
    reader: impl BufRead,
    bytes: Option<u64>,
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
    let all = if by_name { head.most } else { head.columns };
    let mut body = Body {
        file: name,
        delimiter: head.delimiter,
        decimal_comma: options.decimal_comma,
        columns: all,
        labels: refs.iter().map(ToString::to_string).collect(),
        plain: PlainRow::new(head.delimiter, options.decimal_comma, all, &wanted),
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
    let before = rows.row;
    let first = rows.take_plain(&mut body)?;
    if let (Some(bytes), 1..) = (bytes, first) {
        // About as many rows in the rest of the file.
        body.expect((rows.row - before) * (bytes as usize).div_ceil(first));
    }
    loop {
        rows.take_plain(&mut body)?;
        let Some((row, line)) = rows.next()? else { break };
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
    /// Takes the next rows as far as they are in the buffer, if they are plain numbers, and gives the number of their bytes.
    fn take_plain(&mut self, body: &mut Body) -> Result<usize, LogError> {
        let (file, row) = (|| self.name.to_owned(), self.row + 1);
        let buffer = self.reader.fill_buf();
        let buffer = buffer.map_err(|source| LogError::Read { file: file(), row, source })?;
        let mut next = row;
        let taken = body.take_plain(buffer, &mut next)?;
        self.reader.consume(taken);
        self.row = next - 1;
        Ok(taken)
    }

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
