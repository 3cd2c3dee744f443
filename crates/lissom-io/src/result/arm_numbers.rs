//! Checks of the numbers of an arm that is read: known units and plausible sizes.

use super::unit_keys::{Quantity, WithUnit};
use super::unit_names::UnitNames;

/// Largest plausible number in SI.
const LARGEST: f64 = 1e12;

/// A number under a key with its unit.
pub(super) type Number<Q> = WithUnit<Q, f64>;

/// A key of an arm that is missing or has a wrong value.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct WrongKey {
    /// The key, dotted.
    pub(crate) key: String,
    /// What it should be.
    pub(crate) expected: &'static str,
}

/// Reads numbers from a table of an arm.
pub(super) struct Numbers {
    pub(super) names: UnitNames,
    pub(super) at: &'static str,
}

impl Numbers {
    pub(super) fn wrong(&self, key: &str, expected: &'static str) -> WrongKey {
        WrongKey { key: format!("{}.{key}", self.at), expected }
    }

    pub(super) fn key<Q: Quantity>(&self) -> String {
        Q::keys(self.names).pop().unwrap_or_default()
    }

    pub(super) fn sane(&self, key: &str, value: f64) -> Result<f64, WrongKey> {
        if value.abs() > LARGEST {
            return Err(self.wrong(key, "a number of plausible size"));
        }
        Ok(value)
    }

    pub(super) fn of<Q: Quantity>(&self, number: &Number<Q>) -> Result<f64, WrongKey> {
        let key = self.key::<Q>();
        let value = number.get(self.names).ok_or_else(|| self.wrong(&key, "a number"))?;
        self.sane(&key, *value)
    }

    pub(super) fn positive<Q: Quantity>(&self, number: &Number<Q>) -> Result<f64, WrongKey> {
        let value = self.of(number)?;
        if value > 0.0 { Ok(value) } else { Err(self.wrong(&self.key::<Q>(), "greater than zero")) }
    }
}
