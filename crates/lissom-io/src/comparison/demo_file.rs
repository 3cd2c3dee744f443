//! The demo's estimates compared with the values of its virtual arm.

use lissom_core::identify::Estimate;
use serde::{Deserialize, Serialize};

use crate::result::ResultFile;

/// What `lissom demo` identified, compared with the values of the arm that it simulated.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct DemoFile {
    /// Some parameters of the arm, each with the estimates of three methods.
    pub comparison: Vec<ComparisonEntry>,
    /// The whole result, as in result.json.
    pub result: ResultFile,
}

/// A parameter of the arm, and what each method estimates.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ComparisonEntry {
    /// Name of the parameter.
    pub parameter: String,
    /// Unit of all its values.
    pub unit: String,
    /// Its value in the simulated arm.
    #[serde(rename = "true")]
    pub truth: f64,
    /// Estimate of the third-harmonic method; null if it has none.
    pub third_harmonic: Option<ComparedEstimateEntry>,
    /// Estimate of the regression; null if it has none.
    pub regression: Option<ComparedEstimateEntry>,
    /// Estimate of the output-error method; null if it has none.
    pub output_error: Option<ComparedEstimateEntry>,
}

/// An estimate with its standard error.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ComparedEstimateEntry {
    /// The estimate.
    pub value: f64,
    /// Its standard error.
    pub std: f64,
}

impl ComparedEstimateEntry {
    /// The entry of an estimate.
    pub fn of(e: Estimate) -> Self {
        Self { value: e.value, std: e.std }
    }
}
