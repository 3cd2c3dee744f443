//! Tables and values, each with its place in the file.

use std::path::{Path, PathBuf};

use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

use super::config_error::{ConfigError, ConfigPlace, Rule};
use crate::excerpt::excerpt;
use crate::nearest::nearest;
use crate::read_text::read_text;
use crate::units::{Dimension, UnitError, parse_any_unit, parse_quantity, parse_unit};

/// Smallest and largest magnitude of a number in SI. It is far beyond the numbers of any machine, and products and
/// quotients of such numbers stay finite.
pub(crate) const MAGNITUDE: (f64, f64) = (1e-100, 1e100);

/// A file and its text.
#[derive(Debug)]
pub(crate) struct Source {
    path: PathBuf,
    text: String,
}

impl Source {
    pub(crate) fn read(path: &Path) -> Result<Self, ConfigError> {
        match read_text(path) {
            Ok(text) => Ok(Self::new(path, text)),
            Err(source) => Err(ConfigError::Read { file: path.display().to_string(), source }),
        }
    }

    pub(crate) fn new(path: &Path, text: String) -> Self {
        let text = match text.strip_prefix('\u{feff}') {
            Some(rest) => rest.to_owned(),
            None => text,
        };
        Self { path: path.to_owned(), text }
    }

    /// The folder that relative paths in the file start from.
    pub(crate) fn folder(&self) -> &Path {
        self.path.parent().unwrap_or(Path::new(""))
    }

    pub(crate) fn parse(&self) -> Result<Spanned<DeTable<'_>>, ConfigError> {
        DeTable::parse(&self.text).map_err(|error| {
            let at = error.span().map_or(0, |span| span.start);
            let before = self.before(at);
            let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
            ConfigError::Syntax {
                file: self.name(),
                line: self.line(at),
                column: before[line_start..].chars().count() + 1,
                message: error.message().trim().to_owned(),
            }
        })
    }

    /// The whole file as a table.
    pub(crate) fn root<'a>(&'a self, table: &'a Spanned<DeTable<'a>>) -> Table<'a> {
        Table { source: self, key: String::new(), at: 0, entries: table.get_ref() }
    }

    fn name(&self) -> String {
        self.path.display().to_string()
    }

    fn before(&self, at: usize) -> &str {
        self.text.get(..at).unwrap_or(&self.text)
    }

    fn line(&self, at: usize) -> usize {
        self.before(at).matches('\n').count() + 1
    }

    fn place(&self, key: &str, at: usize) -> ConfigPlace {
        ConfigPlace { file: self.name(), line: self.line(at), key: key.to_owned() }
    }
}

/// A table and its place in the file.
#[derive(Debug, Clone)]
pub(crate) struct Table<'a> {
    source: &'a Source,
    key: String,
    at: usize,
    entries: &'a DeTable<'a>,
}

impl<'a> Table<'a> {
    pub(crate) fn place(&self) -> ConfigPlace {
        self.source.place(&self.key, self.at)
    }

    /// Refuses keys that are not among `known`.
    pub(crate) fn only(&self, known: &[&'static str]) -> Result<(), ConfigError> {
        for (key, _) in self.entries {
            let name: &str = key.get_ref();
            if !known.contains(&name) {
                return Err(ConfigError::UnknownKey {
                    place: self.source.place(&self.join(name), key.span().start),
                    known: known.to_vec(),
                    nearest: nearest(name, known.iter().copied()),
                });
            }
        }
        Ok(())
    }

    pub(crate) fn get(&self, key: &str) -> Option<Value<'a>> {
        let value = self.entries.get(key)?;
        Some(Value {
            source: self.source,
            key: self.join(key),
            at: value.span().start,
            content: value.get_ref(),
        })
    }

    pub(crate) fn need(&self, key: &'static str) -> Result<Value<'a>, ConfigError> {
        self.get(key).ok_or_else(|| ConfigError::MissingKey { place: self.place(), key })
    }

    /// The one of `keys` that the table has, with its index; an error if it has two.
    pub(crate) fn one_of(
        &self,
        keys: &[&'static str],
    ) -> Result<Option<(usize, Value<'a>)>, ConfigError> {
        let mut found: Option<(usize, Value<'a>)> = None;
        for (index, key) in keys.iter().enumerate() {
            let Some(value) = self.get(key) else { continue };
            if let Some((first, _)) = found {
                let (first, second) = (keys[first], *key);
                return Err(ConfigError::Clash { place: self.place(), first, second });
            }
            found = Some((index, value));
        }
        Ok(found)
    }

    fn join(&self, key: &str) -> String {
        if self.key.is_empty() { key.to_owned() } else { format!("{}.{key}", self.key) }
    }
}

/// A value and its place in the file.
#[derive(Debug, Clone)]
pub(crate) struct Value<'a> {
    source: &'a Source,
    key: String,
    at: usize,
    content: &'a DeValue<'a>,
}

impl<'a> Value<'a> {
    pub(crate) fn place(&self) -> ConfigPlace {
        self.source.place(&self.key, self.at)
    }

    pub(crate) fn table(&self) -> Result<Table<'a>, ConfigError> {
        match self.content {
            DeValue::Table(entries) => {
                Ok(Table { source: self.source, key: self.key.clone(), at: self.at, entries })
            }
            _ => Err(self.kind("a table")),
        }
    }

    pub(crate) fn list(&self, expected: &'static str) -> Result<Vec<Value<'a>>, ConfigError> {
        match self.content {
            DeValue::Array(items) => Ok(self.items(items)),
            _ => Err(self.kind(expected)),
        }
    }

    /// The values of an array, or the single value.
    pub(crate) fn one_or_list(&self) -> Vec<Value<'a>> {
        match self.content {
            DeValue::Array(items) => self.items(items),
            _ => vec![self.clone()],
        }
    }

    fn items(&self, items: &'a DeArray<'a>) -> Vec<Value<'a>> {
        let value = |(index, item): (usize, &'a Spanned<DeValue<'a>>)| Value {
            source: self.source,
            key: format!("{}[{}]", self.key, index + 1),
            at: item.span().start,
            content: item.get_ref(),
        };
        items.iter().enumerate().map(value).collect()
    }

    pub(crate) fn text(&self) -> Result<&'a str, ConfigError> {
        self.as_text().ok_or_else(|| self.kind("text in quotes"))
    }

    pub(crate) fn as_text(&self) -> Option<&'a str> {
        self.content.as_str()
    }

    pub(crate) fn as_table(&self) -> Option<Table<'a>> {
        self.table().ok()
    }

    /// `true` or `false`.
    pub(crate) fn truth(&self) -> Result<bool, ConfigError> {
        self.content.as_bool().ok_or_else(|| self.kind("true or false"))
    }

    /// A number without unit.
    pub(crate) fn number(&self) -> Result<f64, ConfigError> {
        self.in_range(self.as_number().ok_or_else(|| self.kind("a number"))?)
    }

    /// A finite number without unit, if it is one.
    fn as_number(&self) -> Option<f64> {
        let number = match self.content {
            DeValue::Float(float) => float.as_str().parse().ok()?,
            DeValue::Integer(_) => self.as_integer()? as f64,
            _ => return None,
        };
        f64::is_finite(number).then_some(number)
    }

    fn as_integer(&self) -> Option<i64> {
        let integer = self.content.as_integer()?;
        i64::from_str_radix(integer.as_str(), integer.radix()).ok()
    }

    /// A whole number from `least` to `most`.
    pub(crate) fn whole(&self, least: i64, most: i64) -> Result<i64, ConfigError> {
        match self.as_integer() {
            Some(number) if (least..=most).contains(&number) => Ok(number),
            _ => Err(self.range(Rule::WholeBetween(least, most))),
        }
    }

    /// Reads text with a unit, or a number in SI.
    pub(crate) fn quantity(&self, expected: Dimension) -> Result<f64, ConfigError> {
        let value = match self.as_text() {
            Some(text) => parse_quantity(text, expected).map_err(|source| self.unit_error(source)),
            None => self.as_number().ok_or_else(|| self.kind("text with a unit or an SI number")),
        };
        self.in_range(value?)
    }

    fn in_range(&self, value: f64) -> Result<f64, ConfigError> {
        let (least, most) = MAGNITUDE;
        if value == 0.0 || (least..=most).contains(&value.abs()) {
            Ok(value)
        } else {
            Err(self.range(Rule::Magnitude(least, most)))
        }
    }

    /// Reads text with a unit of one of several dimensions, or a number in SI of the first dimension. Also gives the
    /// index of the dimension.
    pub(crate) fn quantity_of(&self, expected: &[Dimension]) -> Result<(usize, f64), ConfigError> {
        let mut first = None;
        for (index, &dimension) in expected.iter().enumerate() {
            match self.quantity(dimension) {
                Ok(value) => return Ok((index, value)),
                Err(error) if error.is_dimension() => {
                    first.get_or_insert(error);
                }
                Err(error) => return Err(error),
            }
        }
        Err(first.unwrap_or_else(|| self.kind("text with a unit")))
    }

    pub(crate) fn positive(&self, expected: Dimension) -> Result<f64, ConfigError> {
        let value = self.quantity(expected)?;
        if value > 0.0 { Ok(value) } else { Err(self.range(Rule::Positive)) }
    }

    pub(crate) fn not_negative(&self, expected: Dimension) -> Result<f64, ConfigError> {
        let value = self.quantity(expected)?;
        if value >= 0.0 { Ok(value) } else { Err(self.range(Rule::NotNegative)) }
    }

    /// The size of a unit in SI.
    pub(crate) fn unit(&self, expected: Dimension) -> Result<f64, ConfigError> {
        parse_unit(self.text()?, expected).map_err(|source| self.unit_error(source))
    }

    /// The size of a unit in SI and its dimension.
    pub(crate) fn any_unit(&self) -> Result<(f64, Dimension), ConfigError> {
        parse_any_unit(self.text()?).map_err(|source| self.unit_error(source))
    }

    /// The index of the word among `choices`.
    pub(crate) fn choice(&self, choices: &[&'static str]) -> Result<usize, ConfigError> {
        let text = self.text()?;
        choices.iter().position(|choice| *choice == text).ok_or_else(|| ConfigError::Choice {
            place: self.place(),
            found: text.to_owned(),
            choices: choices.to_vec(),
        })
    }

    pub(crate) fn unit_error(&self, source: UnitError) -> ConfigError {
        ConfigError::Unit { place: self.place(), source: Box::new(source) }
    }

    pub(crate) fn range(&self, rule: Rule) -> ConfigError {
        ConfigError::Range { place: self.place(), found: self.shown(), rule }
    }

    pub(crate) fn empty(&self) -> ConfigError {
        ConfigError::EmptyList { place: self.place() }
    }

    pub(crate) fn kind(&self, expected: &'static str) -> ConfigError {
        ConfigError::Kind { place: self.place(), expected, found: self.shown() }
    }

    /// The value as shown in an error.
    fn shown(&self) -> String {
        match self.content {
            DeValue::String(text) => format!("\"{}\"", excerpt(text)),
            DeValue::Integer(number) => excerpt(&number.to_string()),
            DeValue::Float(number) => excerpt(&number.to_string()),
            DeValue::Boolean(value) => value.to_string(),
            DeValue::Datetime(value) => value.to_string(),
            DeValue::Array(_) => "a list".to_owned(),
            DeValue::Table(_) => "a table".to_owned(),
        }
    }
}
