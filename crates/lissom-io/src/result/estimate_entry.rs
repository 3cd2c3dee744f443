//! Estimates in JSON.

use lissom_core::identify::{Estimate, ModeEstimate};
use serde::{Deserialize, Serialize};

/// An estimate with its standard error and its 95 % interval; null if a finding refuses it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct EstimateEntry {
    /// The estimate.
    pub value: f64,
    /// Its standard error.
    pub std: f64,
    /// 95 % interval.
    pub ci95: [f64; 2],
    /// Unit of these numbers: N·m, A, N·m·s/rad and others; 1 for a ratio.
    pub unit: String,
}

/// A number, or several of one kind, with their unit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct NumberEntry<T = f64> {
    /// The number.
    pub value: T,
    /// Its unit.
    pub unit: String,
}

impl EstimateEntry {
    /// The entry of an estimate.
    pub fn of(e: Estimate, unit: impl Into<String>) -> Self {
        Self { value: e.value, std: e.std, ci95: e.ci95(), unit: unit.into() }
    }

    /// The estimate.
    pub fn estimate(&self) -> Estimate {
        Estimate { value: self.value, std: self.std }
    }

    /// The entry of an estimate that may be refused.
    pub(crate) fn or_null(e: Option<Estimate>, unit: impl Into<String>) -> Option<Self> {
        e.map(|e| Self::of(e, unit))
    }

    /// The entries of a list.
    pub(crate) fn list<'a>(
        all: impl IntoIterator<Item = &'a Estimate>,
        unit: impl Into<String>,
    ) -> Vec<Self> {
        let unit = unit.into();
        all.into_iter().map(|e| Self::of(*e, unit.as_str())).collect()
    }
}

impl<T> NumberEntry<T> {
    /// The entry of a number.
    pub(crate) fn of(value: T, unit: impl Into<String>) -> Self {
        Self { value, unit: unit.into() }
    }
}

/// A mode of the beam with the motor clamped.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct BeamModeEntry {
    /// Natural frequency without damping.
    pub natural_frequency_rad_s: EstimateEntry,
    /// Damping ratio; `null` if it would be negative.
    pub damping_ratio: Option<EstimateEntry>,
}

impl BeamModeEntry {
    /// The entry of a mode.
    pub fn of(m: &ModeEstimate) -> Self {
        Self {
            natural_frequency_rad_s: EstimateEntry::of(m.natural_frequency_rad_s, "rad/s"),
            damping_ratio: EstimateEntry::or_null(m.given_damping_ratio(), "1"),
        }
    }

    /// The entries of a list of modes.
    pub(crate) fn list(all: &[ModeEstimate]) -> Vec<Self> {
        all.iter().map(Self::of).collect()
    }
}

/// A number for JSON; an infinite or undefined number becomes null.
pub(crate) fn finite(value: f64) -> Option<f64> {
    Some(value).filter(|v| v.is_finite())
}
