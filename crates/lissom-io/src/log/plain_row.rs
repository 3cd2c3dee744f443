//! A row of plain numbers, read in one pass: most rows are such. Others are read cell by cell.

use lissom_formats::PlainDecimal;

use super::log_layout::Delimiter;

/// How the rows of a log are written, and which columns are read.
pub(super) struct PlainRow {
    delimiter: Delimiter,
    /// The decimal sign.
    point: u8,
    /// For each column the place of its value, if it is read.
    places: Vec<Option<usize>>,
    /// Values that are those of another place.
    same: Vec<(usize, usize)>,
    /// Least number of cells.
    least: usize,
}

/// A row that was read.
pub(super) struct Read {
    /// Its length with the end of the line \[byte\].
    pub(super) length: usize,
    /// Decimals of the first column wanted; `None` if it has an exponent.
    pub(super) decimals: Option<usize>,
}

impl PlainRow {
    /// Rows of so many columns, of which those with the indices `wanted` are read.
    pub(super) fn new(
        delimiter: Delimiter,
        decimal_comma: bool,
        columns: usize,
        wanted: &[usize],
    ) -> Self {
        let mut places = vec![None; columns];
        let mut same = Vec::new();
        for (k, index) in wanted.iter().enumerate() {
            match places.get(*index) {
                Some(Some(first)) => same.push((k, *first)),
                Some(None) => places[*index] = Some(k),
                None => {}
            }
        }
        let least = wanted.iter().max().map_or(0, |last| last + 1);
        Self { delimiter, point: if decimal_comma { b',' } else { b'.' }, places, same, least }
    }

    /// The values of the row at the beginning of a text; `None` if it is another one, or not whole.
    pub(super) fn read(&self, text: &[u8], values: &mut [f64]) -> Option<Read> {
        let delimiter = match self.delimiter {
            Delimiter::Char(delimiter) => delimiter as u8,
            Delimiter::Blanks => b' ',
        };
        if matches!(text.get(blanks(text)), Some(b'#' | b'%')) {
            return None;
        }
        let (mut at, mut decimals) = (0, None);
        for (index, place) in self.places.iter().enumerate() {
            at += blanks(&text[at..]);
            if let Some(place) = place {
                let (value, its_decimals, length) = self.number(&text[at..], delimiter)?;
                *values.get_mut(*place)? = value;
                if *place == 0 {
                    decimals = its_decimals;
                }
                at += length;
            } else {
                at += Self::unread(&text[at..], delimiter)?;
            }
            let spaces = blanks(&text[at..]);
            at += spaces;
            match *text.get(at)? {
                b'\n' | b'\r' if index + 1 < self.least => return None,
                b'\n' | b'\r' => break,
                _ if self.delimiter == Delimiter::Blanks && spaces > 0 => {}
                byte if byte == delimiter => at += 1,
                _ => return None,
            }
        }
        for (place, first) in &self.same {
            values[*place] = values[*first];
        }
        // Behind a delimiter at the end of the row as well.
        let length = at + line_end(&text[at..])?;
        Some(Read { length, decimals })
    }

    /// A number, its decimals, and the length of its cell.
    fn number(&self, text: &[u8], delimiter: u8) -> Option<(f64, Option<usize>, usize)> {
        if let Some(PlainDecimal { value, decimals, length }) =
            PlainDecimal::leading(text, self.point)
            && is_end(*text.get(length)?, delimiter)
        {
            return Some((value, Some(decimals), length));
        }
        if self.point != b'.' {
            return None;
        }
        let length = text.iter().position(|byte| is_end(*byte, delimiter))?;
        let cell = std::str::from_utf8(&text[..length]).ok()?;
        let value: f64 = cell.parse().ok().filter(|value: &f64| value.is_finite())?;
        let decimals = match cell.find('.') {
            _ if cell.contains(['e', 'E']) => None,
            point => Some(point.map_or(0, |at| length - at - 1)),
        };
        Some((value, decimals, length))
    }

    /// The length of a cell that is not read; `None` if it is quoted or has what no plain text has.
    fn unread(text: &[u8], delimiter: u8) -> Option<usize> {
        let is_end = |byte: &u8| *byte == delimiter || *byte < b' ' || *byte == b'"';
        let length = text.iter().position(is_end)?;
        (text[length] == delimiter || matches!(text[length], b'\n' | b'\r')).then_some(length)
    }
}

/// Number of blanks at the beginning.
fn blanks(text: &[u8]) -> usize {
    text.iter().take_while(|byte| **byte == b' ').count()
}

/// The length of the end of a line; `None` if it is none.
fn line_end(text: &[u8]) -> Option<usize> {
    match text {
        [b'\n', ..] => Some(1),
        [b'\r', b'\n', ..] => Some(2),
        _ => None,
    }
}

fn is_end(byte: u8, delimiter: u8) -> bool {
    byte == delimiter || matches!(byte, b' ' | b'\n' | b'\r')
}
