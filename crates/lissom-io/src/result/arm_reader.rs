//! The keys of a result's arm, each read with an error that names it.

use serde_json::Value;

use super::result_error::ResultError;

/// No machine has a larger number in SI.
const LARGEST: f64 = 1e12;

/// A result and the file that it is from.
pub(super) struct Reader {
    pub(super) file: String,
    pub(super) root: Value,
}

impl Reader {
    pub(super) fn list<'a>(
        &self,
        table: &'a Value,
        key: &str,
    ) -> Result<&'a Vec<Value>, ResultError> {
        table[key].as_array().ok_or_else(|| self.key(format!("arm.{key}"), "a list"))
    }

    pub(super) fn numbers(&self, list: &Value, key: &str) -> Result<Vec<f64>, ResultError> {
        let numbers = list.as_array().and_then(|l| l.iter().map(Value::as_f64).collect());
        numbers.ok_or_else(|| self.key(format!("arm.{key}"), "a list of numbers"))
    }

    pub(super) fn number(&self, table: &Value, at: &str, key: &str) -> Result<f64, ResultError> {
        let number =
            table[key].as_f64().ok_or_else(|| self.key(format!("{at}.{key}"), "a number"))?;
        if number.abs() > LARGEST {
            return Err(self.key(format!("{at}.{key}"), "a number that a machine may have"));
        }
        Ok(number)
    }

    pub(super) fn key(&self, key: String, expected: &'static str) -> ResultError {
        ResultError::Key { file: self.file.clone(), key, expected }
    }
}
