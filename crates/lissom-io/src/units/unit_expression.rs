//! The grammar: `product := power (('*' | '·' | '/') power)*`,
//! `power := atom ('^' integer | '²' | '³')?`, `atom := name | '1' | '(' product ')'`.

use super::dimension::Dimension;
use super::unit_error::UnitError;
use super::unit_table::{self, Unit};
use crate::nearest::nearest;

/// Deepest nesting of parentheses.
const DEEPEST: usize = 16;
/// Largest exponent.
const LARGEST_POWER: i32 = 9;

pub(super) struct Parser<'a> {
    text: &'a str,
    rest: std::iter::Peekable<std::str::CharIndices<'a>>,
    unit: &'a str,
}

impl<'a> Parser<'a> {
    /// Reads `unit`, which is a part of `text`.
    pub(super) fn new(text: &'a str, unit: &'a str) -> Self {
        Self { text, rest: unit.char_indices().peekable(), unit }
    }

    pub(super) fn parse(mut self) -> Result<Unit, UnitError> {
        let unit = self.product(0)?;
        match self.peek() {
            None => Ok(unit),
            Some(_) => Err(self.unexpected()),
        }
    }

    fn product(&mut self, depth: usize) -> Result<Unit, UnitError> {
        let mut unit = self.power(depth)?;
        while let Some(operator @ ('*' | '·' | '⋅' | '/')) = self.peek() {
            self.rest.next();
            let next = self.power(depth)?;
            let sign = if operator == '/' { -1 } else { 1 };
            unit.factor *= next.factor.powi(sign);
            unit.dimension = unit.dimension.times(next.dimension, sign);
        }
        Ok(unit)
    }

    fn power(&mut self, depth: usize) -> Result<Unit, UnitError> {
        let unit = self.atom(depth)?;
        let power = match self.peek() {
            Some('^') => {
                self.rest.next();
                self.exponent()?
            }
            Some('²') => {
                self.rest.next();
                2
            }
            Some('³') => {
                self.rest.next();
                3
            }
            _ => return Ok(unit),
        };
        Ok(Unit {
            factor: unit.factor.powi(power),
            dimension: Dimension::NUMBER.times(unit.dimension, power),
        })
    }

    fn exponent(&mut self) -> Result<i32, UnitError> {
        let sign = match self.peek() {
            Some('-') => {
                self.rest.next();
                -1
            }
            _ => 1,
        };
        let digit = self.peek().and_then(|c| c.to_digit(10)).and_then(|d| i32::try_from(d).ok());
        let Some(digit) = digit else {
            return Err(self.unexpected());
        };
        self.rest.next();
        if self.rest.peek().is_some_and(|(_, c)| c.is_ascii_digit()) {
            return Err(UnitError::Power { text: self.text.to_owned(), largest: LARGEST_POWER });
        }
        Ok(sign * digit)
    }

    fn atom(&mut self, depth: usize) -> Result<Unit, UnitError> {
        match self.peek() {
            Some('(') if depth < DEEPEST => {
                self.rest.next();
                let unit = self.product(depth + 1)?;
                match self.peek() {
                    Some(')') => {
                        self.rest.next();
                        Ok(unit)
                    }
                    _ => Err(self.unexpected()),
                }
            }
            Some('1') => {
                self.rest.next();
                Ok(Unit { factor: 1.0, dimension: Dimension::NUMBER })
            }
            Some(c) if in_name(c) => {
                let name = self.name();
                unit_table::find(name).ok_or_else(|| UnitError::Unknown {
                    text: self.text.to_owned(),
                    unit: name.to_owned(),
                    nearest: unit_table::of_other_case(name)
                        .or_else(|| nearest(name, unit_table::names())),
                })
            }
            _ => Err(self.unexpected()),
        }
    }

    fn name(&mut self) -> &'a str {
        let start = self.position();
        while self.rest.peek().is_some_and(|&(_, c)| in_name(c)) {
            self.rest.next();
        }
        &self.unit[start..self.position()]
    }

    fn position(&mut self) -> usize {
        self.rest.peek().map_or(self.unit.len(), |&(at, _)| at)
    }

    /// The next character that is not blank.
    fn peek(&mut self) -> Option<char> {
        while self.rest.peek().is_some_and(|(_, c)| c.is_whitespace()) {
            self.rest.next();
        }
        self.rest.peek().map(|&(_, c)| c)
    }

    fn unexpected(&mut self) -> UnitError {
        UnitError::Syntax { text: self.text.to_owned(), found: self.peek() }
    }
}

fn in_name(c: char) -> bool {
    c.is_alphabetic() || matches!(c, '%' | '°' | '_' | 'µ')
}
