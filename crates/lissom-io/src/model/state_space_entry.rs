//! Matrices and state spaces in JSON.

use lissom_core::Matrix;
use lissom_core::lti::StateSpace;
use serde::{Deserialize, Serialize};

/// A state space with the names of its states, inputs and outputs; matrices are lists of rows.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct StateSpaceEntry {
    /// System matrix.
    pub a: Vec<Vec<f64>>,
    /// Input matrix.
    pub b: Vec<Vec<f64>>,
    /// Output matrix.
    pub c: Vec<Vec<f64>>,
    /// Feedthrough.
    pub d: Vec<Vec<f64>>,
    /// Names of the states.
    pub states: Vec<String>,
    /// Names of the inputs.
    pub inputs: Vec<String>,
    /// Names of the outputs.
    pub outputs: Vec<String>,
}

impl StateSpaceEntry {
    /// The entry of a state space.
    pub fn of(s: &StateSpace) -> Self {
        Self {
            a: matrix_rows(&s.a),
            b: matrix_rows(&s.b),
            c: matrix_rows(&s.c),
            d: matrix_rows(&s.d),
            states: s.states.clone(),
            inputs: s.inputs.clone(),
            outputs: s.outputs.clone(),
        }
    }
}

/// A matrix as a list of rows.
pub(crate) fn matrix_rows(m: &Matrix) -> Vec<Vec<f64>> {
    m.row_iter().map(|r| r.iter().copied().collect()).collect()
}
