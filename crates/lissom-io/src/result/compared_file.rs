//! Results side by side, in JSON.

use serde::{Deserialize, Serialize};

use super::channel_names::{AxisName, MethodName};
use super::estimate_entry::EstimateEntry;
use super::friction_term_entries::LawTermName;

/// The parameters of two or more results of lissom identify side by side. The first result is the one that the others
/// are compared with. SI units and rad/s; units are in the keys of the parameters.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ComparedFile {
    /// Version that wrote the file.
    pub lissom: String,
    /// Kind of axis of all results.
    pub axis: AxisName,
    /// Standard errors of a difference from which on it is called clear.
    pub clear_standard_errors: f64,
    /// The results, in the order given.
    pub results: Vec<ComparedResultEntry>,
    /// Every parameter that any of the results has.
    pub parameters: Vec<ComparedParameterEntry>,
}

/// A result that is compared.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ComparedResultEntry {
    /// The file as it was given.
    pub file: String,
    /// The method whose solution friction, inertia and coupling are; null where none has one.
    pub from: Option<MethodName>,
    /// Terms of its friction law beside Coulomb friction and one viscous coefficient.
    pub friction_terms: Vec<LawTermName>,
    /// Torque constant used, N*m or N per unit of command; null where it is unknown.
    pub torque_per_command: Option<f64>,
    /// Number of modes of the beam.
    pub modes: usize,
}

/// A parameter in all results.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ComparedParameterEntry {
    /// Its key in result.json, dotted, with the suffix of its unit.
    pub key: String,
    /// Its name in words.
    pub name: String,
    /// Its unit in words.
    pub unit: String,
    /// The estimate of each result; null where the result does not have it, or refuses it.
    pub values: Vec<Option<EstimateEntry>>,
    /// Codes of the warnings of each result that affect it: its standard error may then be too small.
    pub warnings: Vec<Vec<String>>,
    /// Difference of each result after the first to the first; null where one of the two has no value.
    pub differences: Vec<Option<ParameterDifferenceEntry>>,
}

/// The difference of a parameter to that of the first result.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ParameterDifferenceEntry {
    /// The value less that of the first result; of a phase between -pi and pi.
    pub value: f64,
    /// Its standard error, the root of the sum of both squares: the results are of different logs.
    pub std: f64,
    /// The difference relative to the magnitude of the first value; null of a phase, and where the 95 % interval of the
    /// first value contains zero.
    pub relative: Option<f64>,
    /// The difference in standard errors of the difference; null where that is zero.
    pub standard_errors: Option<f64>,
    /// Whether it is more than clear_standard_errors.
    pub clear: bool,
}
