//! Coulomb friction of Section 6.2.2 of the 1989 report, compared with estimates from a virtual arm.

use serde::{Deserialize, Serialize};

/// What `lissom figures` identified, compared with the values printed in the 1989 report.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FiguresFile {
    /// Coulomb friction in A of motor current, one entry for each method.
    pub coulomb: Vec<ComparedCoulombEntry>,
}

/// Coulomb friction by one method.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ComparedCoulombEntry {
    /// Name of the method, with the direction of motion.
    pub method: String,
    /// Value printed in Section 6.2.2 of the 1989 report; null if it prints none.
    pub printed_a: Option<f64>,
    /// Estimate from the virtual arm's logs; null if the method has none.
    pub value_a: Option<f64>,
    /// Its standard error; 0 for the value that the virtual arm was given.
    pub std_a: Option<f64>,
}
