//! Reads a `limits.toml`.

use std::path::Path;

use super::path_pattern::PathPattern;
use crate::config::{ConfigError, Source, Value};
use crate::io_error::Error;

/// The content of a `limits.toml`.
#[derive(Debug, Clone, PartialEq)]
pub struct LimitsFile {
    /// What the end of a log's path says.
    pub path: Option<PathPattern>,
    /// The limits.
    pub limits: Vec<Limit>,
}

/// Limits of a parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct Limit {
    /// Its key in `result.json`.
    pub parameter: String,
    /// Its unit, as `result.json` has it; `*` and `^2` for `·` and `²` are the same.
    pub unit: String,
    /// Smallest value.
    pub min: Option<f64>,
    /// Largest value.
    pub max: Option<f64>,
}

impl LimitsFile {
    /// Reads a file.
    ///
    /// # Errors
    /// [`Error::Config`] if the file cannot be read, or a key or value is wrong.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let source = Source::read(path)?;
        let document = source.parse()?;
        let root = source.root(&document);
        root.only("path limits")?;
        let path = root.optional("path", |value| {
            PathPattern::parse(value.text()?).map_err(|expected| value.kind(expected))
        })?;
        let value = root.need("limits")?;
        let items = value.list("a list of limits, each a table [[limits]]")?;
        if items.is_empty() {
            return Err(value.empty().into());
        }
        let limits = items.iter().map(limit).collect::<Result<Vec<_>, _>>()?;
        Ok(Self { path, limits })
    }
}

fn limit(value: &Value<'_>) -> Result<Limit, ConfigError> {
    let table = value.table()?;
    table.only("parameter unit min max")?;
    let parameter = table.need("parameter")?.text()?.to_owned();
    let unit = table.need("unit")?.text()?.replace('*', "·").replace("^2", "²");
    let (min, max) = (table.optional("min", Value::number)?, table.optional("max", Value::number)?);
    match (min, max) {
        (None, None) => Err(table.none_of(&["min", "max"])),
        (Some(min), Some(max)) if min >= max => {
            Err(table.need("min")?.range(&format!("below {max}")))
        }
        _ => Ok(Limit { parameter, unit, min, max }),
    }
}
