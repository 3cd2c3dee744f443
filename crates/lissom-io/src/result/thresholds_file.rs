//! The list of thresholds in JSON.

use lissom_core::Threshold;
use serde::Serialize;

/// Every number that decides which estimates are given and which findings are reported.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ThresholdsFile {
    /// Version of lissom that wrote the file.
    pub lissom: String,
    /// The thresholds, those of one method together.
    pub thresholds: Vec<Threshold>,
}

impl ThresholdsFile {
    /// The list of this version.
    pub fn all() -> Self {
        Self {
            lissom: env!("CARGO_PKG_VERSION").to_owned(),
            thresholds: lissom_core::thresholds().copied().collect(),
        }
    }
}
