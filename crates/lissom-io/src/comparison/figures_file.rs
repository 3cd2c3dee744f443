//! Coulomb friction of Section 6.2.2 of the 1989 report, compared with estimates from a virtual arm.

use serde::{Deserialize, Serialize};

/// What `lissom figures` identified, compared with what the 1989 report prints.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FiguresFile {
    /// Coulomb friction in A of motor current, one entry for each way to find it.
    pub coulomb: Vec<ComparedCoulombEntry>,
}

/// Coulomb friction as one method finds it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ComparedCoulombEntry {
    /// Name of the method, with the direction of motion.
    pub figure: String,
    /// Value printed in Section 6.2.2 of the 1989 report; null where it prints none.
    pub printed_a: Option<f64>,
    /// Estimate from the virtual arm's logs; null where the method has none.
    pub value_a: Option<f64>,
    /// Its standard error; 0 for the value that the virtual arm was given.
    pub std_a: Option<f64>,
}
