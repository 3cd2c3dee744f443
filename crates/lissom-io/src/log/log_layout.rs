//! Separators of cells and names of columns in a log.

use std::collections::VecDeque;

use lissom_formats::PlainDecimal;

use super::log_columns::ColumnRef;
use super::log_error::LogError;
use crate::nearest::nearest;

/// Separator of cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Delimiter {
    Char(char),
    Blanks,
}

impl Delimiter {
    const ALL: [Self; 4] = [Self::Char('\t'), Self::Char(';'), Self::Char(','), Self::Blanks];

    /// The delimiter of a row: a tab if there is one, otherwise a semicolon, a comma, or blanks. A decimal comma does
    /// not separate cells.
    pub(crate) fn of(row: &str, decimal_comma: bool) -> Self {
        let row = row.trim_matches(' ');
        Self::ALL
            .into_iter()
            .filter(|&d| !(decimal_comma && d == Self::Char(',')))
            .find(|d| d.split(row).count() > 1)
            .unwrap_or(Self::Blanks)
    }

    /// The cells of a row, without blanks around them and without quotes. A delimiter at the end does not start a cell.
    pub(crate) fn split(self, row: &str) -> Cells<'_> {
        let rest = match self {
            Self::Char('\t') => row.trim_start_matches(' ').trim_end(),
            Self::Char(c) => {
                let row = row.trim();
                row.strip_suffix(c).unwrap_or(row)
            }
            Self::Blanks => row.trim(),
        };
        Cells { delimiter: self, rest: (!rest.is_empty()).then_some(rest) }
    }
}

/// The cells of a row.
pub(crate) struct Cells<'a> {
    delimiter: Delimiter,
    rest: Option<&'a str>,
}

impl<'a> Iterator for Cells<'a> {
    type Item = &'a str;

    fn next(&mut self) -> Option<&'a str> {
        let rest = self.rest?;
        if let Delimiter::Char(c) = self.delimiter {
            // Most cells have no quote.
            let end = rest.bytes().position(|b| b == c as u8 || b == b'"');
            if end.is_none_or(|at| rest.as_bytes()[at] != b'"') {
                self.rest = end.map(|at| &rest[at + 1..]);
                return Some(rest[..end.unwrap_or(rest.len())].trim());
            }
        }
        let opening = rest.trim_start_matches(' ');
        let from = rest.len() - opening.len();
        // A quoted cell ends at the next quote; text between it and the delimiter is dropped.
        let closing = opening.strip_prefix('"').and_then(|inner| inner.find('"'));
        let searched = closing.map_or(0, |closing| from + closing + 2);
        let end = match self.delimiter {
            Delimiter::Char(c) => rest[searched..].find(c).map(|at| (searched + at, c.len_utf8())),
            Delimiter::Blanks => {
                rest[searched..].find(char::is_whitespace).map(|at| (searched + at, 0))
            }
        };
        self.rest = end.map(|(at, width)| match self.delimiter {
            Delimiter::Char(_) => &rest[at + width..],
            Delimiter::Blanks => rest[at..].trim_start(),
        });
        let cell = &rest[..end.map_or(rest.len(), |(at, _)| at)];
        Some(unquoted(cell.trim()))
    }
}

/// A quote that is never closed is kept, so that the cell is not a number.
fn unquoted(cell: &str) -> &str {
    let inner = cell.strip_prefix('"').and_then(|inner| inner.split_once('"'));
    inner.map_or(cell, |(inner, _)| inner.trim())
}

/// A cell as a number, finite or not.
pub(crate) fn number(cell: &str, decimal_comma: bool) -> Option<f64> {
    if decimal_comma && cell.contains(',') {
        if cell.contains('.') {
            return None;
        }
        return cell.replacen(',', ".", 1).parse().ok();
    }
    PlainDecimal::value_of(cell, b'.').or_else(|| cell.parse().ok())
}

/// Whether most cells of the row are not numbers.
pub(crate) fn is_header(row: &str, delimiter: Delimiter, decimal_comma: bool) -> bool {
    let (mut words, mut numbers) = (0_usize, 0_usize);
    for cell in delimiter.split(row).filter(|cell| !cell.is_empty()) {
        if number(cell, decimal_comma).is_some() {
            numbers += 1;
        } else {
            words += 1;
        }
    }
    words > numbers
}

/// Whether a row has words and no number, as a row of units below the names.
pub(super) fn is_words(row: &str, delimiter: Delimiter, decimal_comma: bool) -> bool {
    let mut cells = delimiter.split(row).filter(|cell| !cell.is_empty()).peekable();
    cells.peek().is_some() && cells.all(|cell| number(cell, decimal_comma).is_none())
}

/// The comment line without its mark, if `line` is one.
pub(crate) fn comment(line: &str) -> Option<&str> {
    let line = line.trim_start();
    line.starts_with(['#', '%']).then(|| line.trim_start_matches(['#', '%']))
}

/// Names from the comment lines before the data, see the module's documentation.
pub(super) fn names_from_comments(
    comments: &VecDeque<String>,
    delimiter: Delimiter,
    columns: usize,
) -> Vec<String> {
    let split = |line: &str, d: Delimiter| d.split(line).map(str::to_owned).collect::<Vec<_>>();
    for line in comments.iter().rev() {
        // Names may be separated by commas and the columns by blanks, so blanks are tried last.
        let own_first = Some(delimiter).filter(|&d| d != Delimiter::Blanks);
        let own_first = own_first.into_iter().chain(Delimiter::ALL);
        for names in own_first.map(|d| split(line, d)) {
            if names.len() == columns {
                return names;
            }
        }
    }
    let enough = columns.div_ceil(2).max(2);
    let partial = comments.iter().rev().map(|line| split(line, delimiter));
    partial.into_iter().find(|names| names.len() >= enough).unwrap_or_default()
}

/// The index, from 0, of a column asked for.
pub(super) fn find_column(
    file: &str,
    wanted: &ColumnRef,
    names: &[String],
    columns: usize,
) -> Result<usize, LogError> {
    let file = || file.to_owned();
    match wanted {
        ColumnRef::Number(number) => {
            if (1..=columns).contains(number) {
                Ok(number - 1)
            } else {
                Err(LogError::ColumnNumber { file: file(), number: *number, columns })
            }
        }
        ColumnRef::Name(name) => {
            let column = name.trim().to_owned();
            let matches: Vec<usize> =
                (0..names.len()).filter(|&index| names[index] == column).collect();
            match matches[..] {
                [index] => Ok(index),
                [] if names.is_empty() => Err(LogError::NoHeader { file: file(), column, columns }),
                [] => {
                    let nearest = nearest(&column, names.iter().map(String::as_str));
                    Err(LogError::NoColumn { file: file(), column, names: names.to_vec(), nearest })
                }
                _ => Err(LogError::Ambiguous {
                    groups: Vec::new(),
                    file: file(),
                    column,
                    numbers: matches.iter().map(|index| index + 1).collect(),
                }),
            }
        }
    }
}
