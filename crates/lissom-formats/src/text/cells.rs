//! Cells of a row, and what they contain.

use super::stamps::Stamp;
use crate::plain_decimal::PlainDecimal;

/// What separates the cells of a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Separator {
    Char(char),
    /// Commas, but not that before three digits behind a time of day: `10:00:00,125`.
    CommaAfterStamp,
    Blanks,
}

impl Separator {
    pub(crate) const ALL: [Self; 4] =
        [Self::Char('\t'), Self::Char(';'), Self::Char(','), Self::Blanks];

    /// How the numbers between such separators may write decimals, the most usual way first. Where a comma separates cells,
    /// a comma in quotes is more often between thousands.
    pub(crate) fn decimals(self) -> [Decimal; 3] {
        match self {
            Self::Char(',') => [Decimal::Point, Decimal::Grouped, Decimal::Comma],
            _ => [Decimal::Point, Decimal::Comma, Decimal::Grouped],
        }
    }

    /// The cells of a row, without blanks and quotes around them. Separators in quotes do not count.
    pub(crate) fn cells(self, row: &str) -> impl Iterator<Item = &str> + Clone {
        let mut rest = Some(row.trim_matches(|c| c == ' ' || c == '\r'));
        if self == Self::Blanks {
            rest = Some(row.trim());
        }
        // Most rows have no quote, and one byte between two cells.
        let plain = match self {
            Self::Char(separator) if separator.is_ascii() && !row.contains('"') => {
                Some(separator as u8)
            }
            _ => None,
        };
        std::iter::from_fn(move || {
            let row = rest?;
            if let Some(separator) = plain {
                let end = row.bytes().position(|byte| byte == separator);
                rest = end.map(|at| &row[at + 1..]);
                return Some(row[..end.unwrap_or(row.len())].trim());
            }
            let mut quoted = false;
            let ends = |(at, c): &(usize, char)| {
                quoted ^= *c == '"';
                !quoted
                    && match self {
                        Self::Char(separator) => *c == separator,
                        Self::CommaAfterStamp => *c == ',' && !is_in_stamp(row, *at),
                        Self::Blanks => c.is_whitespace(),
                    }
            };
            let end = row.char_indices().find(ends).map(|(at, _)| at);
            let cell = &row[..end.unwrap_or(row.len())];
            rest = end.map(|at| match self {
                Self::Char(separator) => &row[at + separator.len_utf8()..],
                Self::CommaAfterStamp => &row[at + 1..],
                Self::Blanks => row[at..].trim_start(),
            });
            Some(cell.trim().trim_matches('"').trim())
        })
    }
}

/// Whether a comma is in a time of day: behind `:00`, and before three digits.
fn is_in_stamp(row: &str, comma: usize) -> bool {
    let (before, after) = (row.as_bytes().get(..comma), row.as_bytes().get(comma + 1..));
    let is_time =
        matches!(before, Some([.., b':', a, b]) if a.is_ascii_digit() && b.is_ascii_digit());
    let digits = after.unwrap_or_default().iter().take_while(|byte| byte.is_ascii_digit()).count();
    is_time && digits == 3
}

/// How a text writes decimals.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Decimal {
    Point,
    Comma,
    /// A point, and commas between thousands: `1,234.5`.
    Grouped,
}

impl Decimal {
    /// Reads a number.
    pub(super) fn number(self, text: &str) -> Option<f64> {
        let plain = PlainDecimal::value_of(text, b'.').or_else(|| text.parse().ok());
        if plain.is_some() {
            return plain;
        }
        match self {
            Self::Point => None,
            Self::Comma => {
                let (whole, decimals) = text.split_once(',')?;
                decimals.starts_with(|c: char| c.is_ascii_digit()).then_some(())?;
                if let Some(value) = PlainDecimal::value_of(text, b',') {
                    return Some(value);
                }
                match grouped(whole, '.') {
                    Some(whole) => format!("{whole}.{decimals}").parse().ok(),
                    None if whole.contains('.') => None,
                    None => text.replacen(',', ".", 1).parse().ok(),
                }
            }
            Self::Grouped => {
                let (whole, decimals) = text.split_at(text.find('.').unwrap_or(text.len()));
                format!("{}{decimals}", grouped(whole, ',')?).parse().ok()
            }
        }
    }
}

/// A whole number without the signs between its thousands; `None` if it has none.
fn grouped(text: &str, sign: char) -> Option<String> {
    if !text.contains(sign) {
        return None;
    }
    let mut groups = text.split(sign);
    let first = groups.next()?.trim_start_matches(['-', '+']);
    let are_digits = |group: &str| group.bytes().all(|byte| byte.is_ascii_digit());
    let is_first = (1..=3).contains(&first.len()) && !first.starts_with('0') && are_digits(first);
    let others = groups.clone().count();
    let fits = is_first && others > 0 && groups.all(|g| g.len() == 3 && are_digits(g));
    fits.then(|| text.replace(sign, ""))
}

/// What a cell contains.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Cell {
    Blank,
    Number(f64),
    /// A complex number: its real and its imaginary part.
    Complex([f64; 2]),
    /// A date or a time of day.
    Stamp(Stamp),
    Words,
}

impl Cell {
    /// Reads a cell. A number may be in square brackets, as NumPy and ROS print arrays of one.
    pub(crate) fn of(cell: &str, decimal: Decimal) -> Self {
        if cell.is_empty() {
            return Self::Blank;
        }
        let inner =
            cell.strip_prefix('[').and_then(|c| c.strip_suffix(']')).map_or(cell, str::trim);
        if let Some(value) = decimal.number(inner) {
            return Self::Number(value);
        }
        if let Some(parts) = complex(inner, decimal) {
            return Self::Complex(parts);
        }
        match inner {
            "true" | "True" | "TRUE" => Self::Number(1.0),
            "false" | "False" | "FALSE" => Self::Number(0.0),
            "NA" | "N/A" | "null" | "None" | "-" | "<NA>" => Self::Blank,
            _ => Stamp::of(inner).map_or(Self::Words, Self::Stamp),
        }
    }

    pub(crate) fn is_value(self) -> bool {
        matches!(self, Self::Number(_) | Self::Complex(_) | Self::Stamp(_))
    }
}

/// Real and imaginary part of a number such as `1.2-0.3j`, `(1.2e-3 + 4i)` or `0.3j`.
fn complex(cell: &str, decimal: Decimal) -> Option<[f64; 2]> {
    let bare = cell.strip_prefix('(').and_then(|c| c.strip_suffix(')')).unwrap_or(cell);
    let parts = bare.strip_suffix(['i', 'j'])?.trim_end_matches('*');
    if !parts.contains(|c: char| c.is_ascii_digit()) {
        return None;
    }
    let is_sign = |(at, _): &(usize, &str)| !parts[..*at].trim_end().ends_with(['e', 'E']);
    let sign = parts.rmatch_indices(['+', '-']).find(is_sign).map_or(0, |(at, _)| at);
    let (real, imag) = parts.split_at(sign);
    let number = |part: &str| decimal.number(&part.replace(' ', ""));
    let real = if real.trim().is_empty() { Some(0.0) } else { number(real) };
    Some([real?, number(imag)?])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_of_rows() {
        let of = |s: Separator, row| s.cells(row).collect::<Vec<_>>();
        assert_eq!(of(Separator::Char(','), "1, \"a, b\" ,,3"), ["1", "a, b", "", "3"]);
        assert_eq!(of(Separator::Char('\t'), "1\t\t3\t"), ["1", "", "3", ""]);
        assert_eq!(of(Separator::Blanks, "  1   2\t3 "), ["1", "2", "3"]);
    }

    #[test]
    fn complex_numbers() {
        let cases = [
            ("1.5-0.25j", [1.5, -0.25]),
            ("(1.5e-3+2e+2j)", [1.5e-3, 200.0]),
            ("-1.5 - 0.5i", [-1.5, -0.5]),
            ("0.5j", [0.0, 0.5]),
            ("-2e-1*i", [0.0, -0.2]),
        ];
        for (cell, parts) in cases {
            assert_eq!(Cell::of(cell, Decimal::Point), Cell::Complex(parts), "{cell}");
        }
        assert_eq!(Cell::of("1,5+2,5j", Decimal::Comma), Cell::Complex([1.5, 2.5]));
        for other in ["j", "i", "+j", "joint_i", "1+j", "1.5+0.5k", "(deg)"] {
            assert_eq!(Cell::of(other, Decimal::Point), Cell::Words, "{other}");
        }
    }

    #[test]
    fn contents_of_cells() {
        assert_eq!(Cell::of("1,5", Decimal::Comma), Cell::Number(1.5));
        assert_eq!(Cell::of("1,5", Decimal::Point), Cell::Words);
        assert_eq!(Cell::of("[0.25]", Decimal::Point), Cell::Number(0.25));
        assert!(matches!(Cell::of("00:00:01.5", Decimal::Point), Cell::Stamp(_)));
        assert_eq!(Cell::of("1.234,5", Decimal::Comma), Cell::Number(1234.5));
        assert_eq!(Cell::of("-1,234.5", Decimal::Grouped), Cell::Number(-1234.5));
        for other in ["0,125", "1,5", "1234,567", ",123"] {
            assert_eq!(Cell::of(other, Decimal::Grouped), Cell::Words, "{other}");
        }
        assert_eq!(Cell::of("", Decimal::Point), Cell::Blank);
        assert!(matches!(Cell::of("NaN", Decimal::Point), Cell::Number(v) if v.is_nan()));
    }
}
