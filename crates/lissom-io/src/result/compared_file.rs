//! Comparison of results in JSON.

use lissom_core::identify::Method;
use lissom_core::record::Axis;
use serde::{Deserialize, Serialize};

use super::estimate_entry::EstimateEntry;
use super::friction_term_entries::LawTermName;

/// The parameters of two or more results of lissom identify side by side. The first result is the one that the others
/// are compared with. SI units and rad/s; units are in the keys of the parameters.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ComparedFile {
    /// Version of lissom that wrote the file.
    pub lissom: String,
    /// Kind of axis of all results.
    pub axis: Axis,
    /// Number of standard errors above which a difference is called clear.
    pub clear_standard_errors: f64,
    /// The results, in the order given.
    pub results: Vec<ComparedResultEntry>,
    /// All parameters of the results.
    pub parameters: Vec<ComparedParameterEntry>,
}

/// One of the compared results.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ComparedResultEntry {
    /// The file name as given.
    pub file: String,
    /// The method that gave friction, inertia and coupling; null if none has a solution.
    pub from: Option<Method>,
    /// Terms of its friction law in addition to Coulomb friction and one viscous coefficient.
    pub friction_terms: Vec<LawTermName>,
    /// Torque constant used, N*m or N per unit of command; null if it is unknown.
    pub torque_per_command: Option<f64>,
    /// Number of modes of the beam.
    pub modes: usize,
}

/// A parameter in all results.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ComparedParameterEntry {
    /// Its key in result.json, with dots and the suffix of its unit.
    pub key: String,
    /// Its name in words.
    pub name: String,
    /// Its unit in words.
    pub unit: String,
    /// The estimate of each result; null if the result does not have it, or refuses it.
    pub values: Vec<Option<EstimateEntry>>,
    /// Codes of the warnings of each result that affect it. With a warning the standard error may be too small.
    pub warnings: Vec<Vec<String>>,
    /// Difference between each further result and the first one; null if one of the two has no value.
    pub differences: Vec<Option<ParameterDifferenceEntry>>,
}

/// The difference between a parameter and that of the first result.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ParameterDifferenceEntry {
    /// The value minus that of the first result; for a phase between -pi and pi.
    pub value: f64,
    /// Its standard error, the root of the sum of both squares, because the results are from different logs.
    pub std: f64,
    /// The difference relative to the magnitude of the first value; null for a phase, and if the 95 % interval of the
    /// first value contains zero.
    pub relative: Option<f64>,
    /// The difference divided by its standard error; null if that is zero.
    pub standard_errors: Option<f64>,
    /// Whether the difference is larger than clear_standard_errors.
    pub clear: bool,
}
