//! Checks of the numbers of an arm that is read: plausible sizes.

/// Largest plausible number in SI.
const LARGEST: f64 = 1e12;

/// A key of an arm that is missing or has a wrong value.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct WrongKey {
    /// The key, dotted.
    pub(crate) key: String,
    /// What it should be.
    pub(crate) expected: String,
}

/// Reads numbers from a table of an arm.
pub(super) struct Numbers {
    pub(super) at: &'static str,
}

impl Numbers {
    pub(super) fn wrong(&self, key: &str, expected: impl Into<String>) -> WrongKey {
        WrongKey { key: format!("{}.{key}", self.at), expected: expected.into() }
    }

    pub(super) fn sane(&self, key: &str, value: f64) -> Result<f64, WrongKey> {
        if value.abs() > LARGEST {
            return Err(self.wrong(key, "a number of plausible size"));
        }
        Ok(value)
    }

    pub(super) fn positive(&self, key: &str, value: f64) -> Result<f64, WrongKey> {
        let value = self.sane(key, value)?;
        if value > 0.0 { Ok(value) } else { Err(self.wrong(key, "greater than zero")) }
    }
}
