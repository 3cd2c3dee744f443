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
}

impl EstimateEntry {
    /// The entry of an estimate.
    pub fn of(e: Estimate) -> Self {
        Self { value: e.value, std: e.std, ci95: e.ci95() }
    }

    /// The estimate.
    pub fn estimate(&self) -> Estimate {
        Estimate { value: self.value, std: self.std }
    }

    /// The entry of an estimate that may be refused.
    pub(crate) fn or_null(e: Option<Estimate>) -> Option<Self> {
        e.map(Self::of)
    }

    /// The entries of a list.
    pub(crate) fn list<'a>(all: impl IntoIterator<Item = &'a Estimate>) -> Vec<Self> {
        all.into_iter().copied().map(Self::of).collect()
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
            natural_frequency_rad_s: EstimateEntry::of(m.natural_frequency_rad_s),
            damping_ratio: m.given_damping_ratio().map(EstimateEntry::of),
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
