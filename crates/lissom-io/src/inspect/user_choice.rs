//! What a user says about a channel: `COLUMN[:UNIT][,key=value...]`.

use serde::{Deserialize, Serialize};

use super::draft_error::DraftError;
use super::stated_unit::known_unit;
use crate::units::parse_any_unit;

/// What a user says about a channel.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Choice {
    /// The name of the channel, or its number from 1.
    pub column: String,
    /// Its unit; that of the file if absent.
    pub unit: Option<String>,
    /// Further keys of a `campaign.toml`, such as `scale`, with their values as TOML.
    pub keys: Vec<(String, String)>,
}

/// What the command is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CommandKey {
    /// A current.
    Current,
    /// A voltage.
    Voltage,
    /// A torque, or a number of unknown unit.
    Torque,
    /// The position reference of a servo.
    Goal,
}

impl CommandKey {
    /// The key of `[signals]`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Current => "current",
            Self::Voltage => "voltage",
            Self::Torque | Self::Goal => "command",
        }
    }
}

/// Keys that may follow, and whether their value is a text.
const KEYS: [(&str, bool); 9] = [
    ("scale", false),
    ("offset", false),
    ("radius", true),
    ("quantity", true),
    ("hold", true),
    ("name", true),
    ("origin", false),
    ("time", true),
    ("clock", true),
];

impl Choice {
    /// Reads `COLUMN[:UNIT][,key=value...]`.
    ///
    /// # Errors
    /// [`DraftError::Choice`] if a key is not known or a number is no number; [`DraftError::Unit`] if what follows the
    /// last colon is no unit. A name that has a colon needs `:UNIT` after it.
    pub fn parse(text: &str) -> Result<Self, DraftError> {
        let mut rest = text.trim();
        let mut keys = Vec::new();
        while let Some((before, last)) = rest.rsplit_once(',')
            && let Some((key, value)) = last.split_once('=')
        {
            let (key, value) = (key.trim(), value.trim().trim_matches('"'));
            let Some((_, is_text)) = KEYS.iter().find(|(known, _)| *known == key) else {
                let known = KEYS.map(|(known, _)| known).join(", ");
                return Err(DraftError::Choice {
                    text: text.to_owned(),
                    reason: format!("`{key}` is not one of the keys {known}"),
                });
            };
            if !is_text && value.parse::<f64>().is_err() {
                let reason = format!("`{key}` must be a number, and \"{value}\" is none");
                return Err(DraftError::Choice { text: text.to_owned(), reason });
            }
            let value = if *is_text { quoted(value) } else { value.to_owned() };
            keys.insert(0, (key.to_owned(), value));
            rest = before.trim_end();
        }
        let (column, unit) = match rest.rsplit_once(':') {
            None => (rest, None),
            Some((column, unit)) => (column, Some(unit.trim())),
        };
        if column.trim().is_empty() {
            let reason = "there is no column".to_owned();
            return Err(DraftError::Choice { text: text.to_owned(), reason });
        }
        // As people write it: `degrees`, `1/min`.
        let unit = unit.map(|unit| known_unit(unit).text);
        if let Some(unit) = &unit
            && let Err(source) = parse_any_unit(unit)
        {
            return Err(DraftError::Unit { text: text.to_owned(), source });
        }
        Ok(Self { column: column.trim().to_owned(), unit, keys })
    }
}

/// A text as TOML writes it.
pub(super) fn quoted(text: &str) -> String {
    toml::Value::String(text.to_owned()).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn column_unit_and_keys() {
        let found = Choice::parse("s x:m, quantity=deflection,radius=0.45 m").unwrap();
        assert_eq!((found.column.as_str(), found.unit.as_deref()), ("s x", Some("m")));
        let keys = [("quantity", "\"deflection\""), ("radius", "\"0.45 m\"")];
        assert_eq!(found.keys, keys.map(|(k, v)| (k.to_owned(), v.to_owned())));
        assert_eq!(Choice::parse("q").unwrap().unit, None);
        assert_eq!(Choice::parse("a:b:deg").unwrap().column, "a:b");
        assert!(Choice::parse("q:degg").is_err());
        assert!(Choice::parse("q:deg,scal=2").is_err());
        assert!(Choice::parse("q:deg,scale=x").is_err());
        assert!(Choice::parse(":deg").is_err());
    }
}
