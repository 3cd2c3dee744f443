//! The lines of a long text behind its beginning, one after the other.

use std::borrow::Cow;
use std::io::{BufRead, Read};

use super::decode;
use crate::bytes::MOST_BYTES;
use crate::format_error::FormatError;

/// Longest line \[byte\].
const LONGEST_LINE: u64 = 1 << 26;
/// Most lines of a text.
pub(super) const MOST_LINES: usize = 1 << 27;

/// The lines of a text that were not read yet.
pub(crate) struct Rest<'a> {
    reader: &'a mut dyn BufRead,
    line: Vec<u8>,
    /// Row of the line that was read last, from 1.
    row: usize,
    left: u64,
}

impl<'a> Rest<'a> {
    /// The lines behind the first `rows` ones.
    pub(super) fn new(reader: &'a mut dyn BufRead, rows: usize) -> Self {
        Self { reader, line: Vec::new(), row: rows, left: MOST_BYTES }
    }

    /// The next line with its row, from 1, and whether it has an end; `None` at the end of the text.
    pub(super) fn next(&mut self) -> Result<Option<(usize, Cow<'_, str>, bool)>, FormatError> {
        self.line.clear();
        self.row += 1;
        let mut limited = (&mut self.reader).take(LONGEST_LINE + 1);
        let length = limited.read_until(b'\n', &mut self.line)? as u64;
        self.left =
            self.left.checked_sub(length).ok_or(FormatError::TooLarge { most: MOST_BYTES })?;
        if length == 0 {
            return Ok(None);
        }
        if self.row > MOST_LINES {
            return Err(FormatError::content(
                "text",
                format!("it has more than {MOST_LINES} lines"),
            ));
        }
        if length > LONGEST_LINE {
            let reason = format!("is longer than {LONGEST_LINE} bytes");
            return Err(FormatError::content(format!("row {}", self.row), reason));
        }
        if self.line.iter().fold(false, |any, byte| any | decode::is_control(*byte)) {
            return Err(FormatError::NotText { row: self.row });
        }
        let ends = self.line.last() == Some(&b'\n');
        let line = self.line.strip_suffix(b"\n").unwrap_or(&self.line);
        let line = line.strip_suffix(b"\r").unwrap_or(line);
        Ok(Some((self.row, decode::utf8_or_windows(line), ends)))
    }
}
