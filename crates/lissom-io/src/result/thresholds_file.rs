//! The list of thresholds in JSON.

use lissom_core::{Basis, Threshold, ThresholdValue};
use serde::{Deserialize, Serialize};

/// Every number that decides which estimates are given and which findings are reported.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ThresholdsFile {
    /// Version of lissom that wrote the file.
    pub lissom: String,
    /// The thresholds, those of one method together.
    pub thresholds: Vec<ThresholdEntry>,
}

/// A threshold.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ThresholdEntry {
    /// The method or step that it belongs to.
    pub method: String,
    /// Name of the constant in the source; unique within a method.
    pub name: String,
    /// Its value, or the values that are tried or applied in turn.
    pub values: Vec<f64>,
    /// Unit of the values; "1" for shares and ratios.
    pub unit: String,
    /// Origin of the value.
    pub basis: Basis,
    /// Meaning of the threshold, and the reason for its value.
    pub reason: String,
}

impl ThresholdsFile {
    /// The list of this version.
    pub fn all() -> Self {
        Self {
            lissom: env!("CARGO_PKG_VERSION").to_owned(),
            thresholds: lissom_core::thresholds().map(ThresholdEntry::of).collect(),
        }
    }
}

impl ThresholdEntry {
    fn of(t: &Threshold) -> Self {
        Self {
            method: t.method.to_owned(),
            name: t.name.to_owned(),
            values: match t.value {
                ThresholdValue::Number(value) => vec![value],
                ThresholdValue::Count(count) => vec![count as f64],
                ThresholdValue::Numbers(values) => values.to_vec(),
            },
            unit: t.unit.to_owned(),
            basis: t.basis,
            reason: t.reason.to_owned(),
        }
    }
}
