//! Tables and values, each with its place in the file.

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

use super::config_error::{ConfigError, ConfigPlace};
use crate::excerpt::excerpt;
use crate::nearest::nearest;
use crate::read_text::read_text;
use crate::units::{Dimension, UnitError, parse_any_unit, parse_quantity, parse_unit};

/// Smallest and largest magnitude of a number in SI. It is far beyond the numbers of any machine, and products and
/// quotients of such numbers stay finite.
pub(crate) const MAGNITUDE: (f64, f64) = (1e-100, 1e100);

const ADD_RUNS: &str = "add a table [[runs]] with `file = \"...\"` for each log";

/// A file and its text.
#[derive(Debug)]
pub(crate) struct Source {
    path: PathBuf,
    text: String,
}

impl Source {
    pub(crate) fn read(path: &Path) -> Result<Self, ConfigError> {
        let text = read_text(path).map_err(|source| ConfigError::unread(path, source))?;
        Ok(Self::new(path, text))
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
            let (line, column) = (self.line(at), before[line_start..].chars().count() + 1);
            let problem = format!(", line {line}, column {column}: {}", error.message().trim());
            let hint = "the file is TOML: `key = value` lines below [table] lines";
            ConfigError::new(self.place("", at), problem, hint)
        })
    }

    /// The whole file as a table.
    pub(crate) fn root<'a>(&'a self, table: &'a Spanned<DeTable<'a>>) -> Table<'a> {
        Table { source: self, key: String::new(), at: 0, entries: table.get_ref() }
    }

    fn before(&self, at: usize) -> &str {
        self.text.get(..at).unwrap_or(&self.text)
    }

    fn line(&self, at: usize) -> usize {
        self.before(at).matches('\n').count() + 1
    }

    fn place(&self, key: &str, at: usize) -> ConfigPlace {
        ConfigPlace {
            file: self.path.display().to_string(),
            line: self.line(at),
            key: key.to_owned(),
        }
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

    pub(crate) fn error(&self, problem: impl Into<String>, hint: impl Into<String>) -> ConfigError {
        ConfigError::new(self.place(), problem, hint)
    }

    /// Refuses keys that are not among `known`, which are separated by spaces.
    pub(crate) fn only(&self, known: &str) -> Result<(), ConfigError> {
        let known = || known.split_whitespace();
        let is_unknown = |key: &&Spanned<Cow<'_, str>>| known().all(|k| k != key.get_ref());
        let Some(key) = self.entries.keys().find(is_unknown) else { return Ok(()) };
        let place = self.source.place(&self.join(key.get_ref()), key.span().start);
        let hint = match nearest(key.get_ref(), known()) {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("the known keys are `{}`", known().collect::<Vec<_>>().join("`, `")),
        };
        Err(ConfigError::new(place, " is not a known key", hint))
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

    pub(crate) fn need(&self, key: &str) -> Result<Value<'a>, ConfigError> {
        self.get(key).ok_or_else(|| self.lacks(key))
    }

    /// The error of a key that is not there.
    pub(crate) fn lacks(&self, key: &str) -> ConfigError {
        let hint = match key {
            "hold" => {
                "write hold = \"sampled\" for a command that is held between samples, hold = \"measured\" for a measurement"
                    .to_owned()
            }
            "runs" => ADD_RUNS.to_owned(),
            "mass" => format!(
                "add `mass` to {}, or give the beam mass along its length: `mass_per_length`, or \
                 `density` with `section`",
                self.key
            ),
            _ if self.key.is_empty() => format!("add the table [{key}]"),
            _ => format!("add `{key}` to {}", self.key),
        };
        self.error(format!(" has no `{key}`"), hint)
    }

    /// The error of a table that has none of some keys.
    pub(crate) fn none_of(&self, keys: &[&str]) -> ConfigError {
        self.error(format!(" has none of `{}`", keys.join("`, `")), "add one of them")
    }

    /// The error of two keys that exclude each other.
    pub(crate) fn clash(&self, first: &str, second: &str) -> ConfigError {
        self.error(format!(" has both `{first}` and `{second}`"), "give one of the two")
    }

    /// Reads the value of a key, if the table has it.
    pub(crate) fn optional<T, E>(
        &self,
        key: &str,
        read: impl FnOnce(&Value<'a>) -> Result<T, E>,
    ) -> Result<Option<T>, E> {
        self.get(key).as_ref().map(read).transpose()
    }

    /// A quantity, if the table has it.
    pub(crate) fn any(&self, key: &str, expected: Dimension) -> Result<Option<f64>, ConfigError> {
        self.optional(key, |value| value.quantity(expected))
    }

    /// A quantity of zero or more, if the table has it.
    pub(crate) fn not_negative(
        &self,
        key: &str,
        expected: Dimension,
    ) -> Result<Option<f64>, ConfigError> {
        self.optional(key, |value| value.not_negative(expected))
    }

    /// A positive quantity, if the table has it.
    pub(crate) fn positive(
        &self,
        key: &str,
        expected: Dimension,
    ) -> Result<Option<f64>, ConfigError> {
        self.optional(key, |value| value.positive(expected))
    }

    /// The items of a list, none if the table has no such key.
    pub(crate) fn items<T, E: From<ConfigError>>(
        &self,
        key: &str,
        expected: &str,
        read: impl FnMut(&Value<'a>) -> Result<T, E>,
    ) -> Result<Vec<T>, E> {
        let items = self.optional(key, |value| value.list(expected))?.unwrap_or_default();
        items.iter().map(read).collect()
    }

    /// The one of `keys` that the table has, with its index; an error if it has two.
    pub(crate) fn one_of(&self, keys: &[&str]) -> Result<Option<(usize, Value<'a>)>, ConfigError> {
        let mut given = keys.iter().enumerate().filter_map(|(k, key)| Some((k, self.get(key)?)));
        match (given.next(), given.next()) {
            (Some((first, _)), Some((second, _))) => Err(self.clash(keys[first], keys[second])),
            (found, _) => Ok(found),
        }
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

    pub(crate) fn list(&self, expected: &str) -> Result<Vec<Value<'a>>, ConfigError> {
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
            _ => {
                let hint = if self.key.ends_with(".column") {
                    "give the column's name in quotes, or its number from 1"
                } else {
                    "give a whole number within these limits"
                };
                let rule = format!("a whole number from {least} to {most}");
                Err(ConfigError { hint: hint.to_owned(), ..self.range(&rule) })
            }
        }
    }

    /// Reads text with a unit, or a number in SI.
    pub(crate) fn quantity(&self, expected: Dimension) -> Result<f64, ConfigError> {
        let value = match self.as_text() {
            Some(text) => parse_quantity(text, expected).map_err(|source| self.unit_error(&source)),
            None => self.as_number().ok_or_else(|| self.kind("text with a unit or an SI number")),
        };
        self.in_range(value?)
    }

    fn in_range(&self, value: f64) -> Result<f64, ConfigError> {
        let (least, most) = MAGNITUDE;
        if value == 0.0 || (least..=most).contains(&value.abs()) {
            Ok(value)
        } else {
            Err(self.range(&format!("of a magnitude from {least:e} to {most:e} in SI")))
        }
    }

    /// Reads text with a unit of one of several dimensions, or a number in SI of the first dimension. Also gives the
    /// index of the dimension.
    pub(crate) fn quantity_of(&self, expected: &[Dimension]) -> Result<(usize, f64), ConfigError> {
        let fits = |text: &str, dimension: Dimension| {
            !matches!(parse_quantity(text, dimension), Err(UnitError::Dimension { .. }))
        };
        // The error of a text that fits none is that of the first.
        let index = self.as_text().and_then(|text| expected.iter().position(|d| fits(text, *d)));
        let index = index.unwrap_or(0);
        Ok((index, self.quantity(expected[index])?))
    }

    pub(crate) fn positive(&self, expected: Dimension) -> Result<f64, ConfigError> {
        let value = self.quantity(expected)?;
        if value > 0.0 { Ok(value) } else { Err(self.range("greater than zero")) }
    }

    pub(crate) fn not_negative(&self, expected: Dimension) -> Result<f64, ConfigError> {
        let value = self.quantity(expected)?;
        if value >= 0.0 { Ok(value) } else { Err(self.range("zero or greater")) }
    }

    /// The size of a unit in SI.
    pub(crate) fn unit(&self, expected: Dimension) -> Result<f64, ConfigError> {
        parse_unit(self.text()?, expected).map_err(|source| self.unit_error(&source))
    }

    /// The size of a unit in SI and its dimension.
    pub(crate) fn any_unit(&self) -> Result<(f64, Dimension), ConfigError> {
        parse_any_unit(self.text()?).map_err(|source| self.unit_error(&source))
    }

    /// The index of the word among `choices`.
    pub(crate) fn choice(&self, choices: &[&str]) -> Result<usize, ConfigError> {
        let text = self.text()?;
        choices.iter().position(|choice| *choice == text).ok_or_else(|| {
            let words = choices.join("\" or \"");
            let hint = nearest(text, choices.iter().copied());
            let hint = hint.map(|word| format!("did you mean \"{word}\"?"));
            self.error(
                format!(" is \"{}\", but must be \"{words}\"", excerpt(text)),
                hint.unwrap_or_else(|| "write one of these words".to_owned()),
            )
        })
    }

    pub(crate) fn error(&self, problem: impl Into<String>, hint: impl Into<String>) -> ConfigError {
        ConfigError::new(self.place(), problem, hint)
    }

    pub(crate) fn unit_error(&self, source: &UnitError) -> ConfigError {
        self.error(format!(": {source}"), source.hint().unwrap_or_default())
    }

    /// The error of a number outside of its range.
    pub(crate) fn range(&self, rule: &str) -> ConfigError {
        let found = self.shown();
        let has_sign = ["greater than zero", "zero or greater"].contains(&rule);
        let is_negative = has_sign && found.trim_start_matches('"').starts_with('-');
        let hint = if is_negative { "check its sign" } else { "check the number and its unit" };
        self.error(format!(" is {found}, but must be {rule}"), hint)
    }

    pub(crate) fn empty(&self) -> ConfigError {
        self.error(" is an empty list", ADD_RUNS)
    }

    /// The error of a value that needs another key.
    pub(crate) fn needs(&self, key: &str) -> ConfigError {
        self.error(format!(" needs `{key}`"), format!("add `{key}`"))
    }

    /// The error of a list with too many entries.
    pub(crate) fn too_many(&self, found: usize, most: usize) -> ConfigError {
        let problem =
            format!(" has {found} entries with repetitions, but at most {most} are allowed");
        self.error(problem, "use a smaller `count`")
    }

    /// The error of a value of a wrong kind.
    pub(crate) fn kind(&self, expected: &str) -> ConfigError {
        let hint = match expected {
            "a number" => "write the number without unit and quotes",
            "text in quotes" => "put it in quotes",
            "true or false" => "write true or false without quotes",
            "a list of damping ratios" => "write them as in [0.01, 0.02]",
            "a table" => &format!("write it as in {}", table_example(&self.key)),
            _ => "`lissom demo` writes an example",
        };
        self.error(format!(" is {}, where {expected} is expected", self.shown()), hint)
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

/// An example of the table of this key.
fn table_example(key: &str) -> &'static str {
    match key.rsplit('.').next() {
        Some("payload") => "{ mass = \"0.2 kg\", inertia = \"1e-4 kg*m^2\" }",
        Some("damping") => "{ ratio = 0.01 }",
        Some("section") => "{ round = \"0.8 mm\" }",
        Some(span) if span.starts_with("spans[") => "{ length = \"7 in\", mass = \"0.121 lb\" }",
        _ => "{ column = \"t\", unit = \"s\" }",
    }
}
