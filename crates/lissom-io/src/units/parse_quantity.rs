//! Parses quantities and units to SI.

use super::dimension::Dimension;
use super::unit_error::UnitError;
use super::unit_expression::Parser;

/// Reads a number with its unit and gives it in SI.
///
/// ```
/// use lissom_io::units::{Dimension, parse_quantity};
/// let k = parse_quantity("2.184 lbf*in/A", Dimension::TORQUE_PER_CURRENT)?;
/// assert!((k - 0.246_759).abs() < 1e-6);
/// # Ok::<(), lissom_io::units::UnitError>(())
/// ```
///
/// # Errors
/// Any [`UnitError`]: no number, an unknown unit, or another dimension than `expected`.
pub fn parse_quantity(text: &str, expected: Dimension) -> Result<f64, UnitError> {
    let trimmed = text.trim();
    let length = number_length(trimmed);
    let number: f64 =
        trimmed[..length].parse().map_err(|_| UnitError::NoNumber { text: text.to_owned() })?;
    let unit = trimmed[length..].trim();
    let factor = if unit.is_empty() {
        if expected != Dimension::NUMBER {
            return Err(UnitError::NoUnit { text: text.to_owned(), expected });
        }
        1.0
    } else {
        factor(text, unit, expected)?
    };
    let value = number * factor;
    if value.is_finite() { Ok(value) } else { Err(UnitError::OutOfRange { text: text.to_owned() }) }
}

/// Reads a unit and gives its size in SI.
///
/// ```
/// use lissom_io::units::{Dimension, parse_unit};
/// assert_eq!(parse_unit("ms", Dimension::TIME)?, 1e-3);
/// # Ok::<(), lissom_io::units::UnitError>(())
/// ```
///
/// # Errors
/// Any [`UnitError`]: an unknown unit, or another dimension than `expected`.
pub fn parse_unit(text: &str, expected: Dimension) -> Result<f64, UnitError> {
    factor(text, text.trim(), expected)
}

/// Reads a unit of any dimension and gives its size in SI and its dimension.
///
/// # Errors
/// Any [`UnitError`] except [`UnitError::Dimension`].
pub fn parse_any_unit(text: &str) -> Result<(f64, Dimension), UnitError> {
    let unit = Parser::new(text, text.trim()).parse()?;
    if unit.factor.is_finite() && unit.factor > 0.0 {
        Ok((unit.factor, unit.dimension))
    } else {
        Err(UnitError::OutOfRange { text: text.to_owned() })
    }
}

fn factor(text: &str, unit: &str, expected: Dimension) -> Result<f64, UnitError> {
    let (factor, found) = parse_any_unit(unit).map_err(|e| e.within(text))?;
    if found == expected {
        Ok(factor)
    } else {
        Err(UnitError::Dimension { text: text.to_owned(), found, expected })
    }
}

/// Length in bytes of the decimal number at the beginning of `text`.
fn number_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let digits = |from: usize| bytes[from..].iter().take_while(|b| b.is_ascii_digit()).count();
    let sign = |at: usize| usize::from(matches!(bytes.get(at), Some(b'+' | b'-')));
    let mut end = sign(0);
    end += digits(end);
    if bytes.get(end) == Some(&b'.') {
        end += 1 + digits(end + 1);
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let first = end + 1 + sign(end + 1);
        let exponent = if first <= bytes.len() { digits(first) } else { 0 };
        if exponent > 0 {
            end = first + exponent;
        }
    }
    end
}
