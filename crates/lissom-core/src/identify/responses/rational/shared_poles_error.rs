//! Why responses cannot be fitted with shared poles.

use thiserror::Error;

/// Why responses cannot be fitted.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum SharedPolesError {
    /// There is nothing to fit.
    #[error("no output: give one response at least")]
    NoOutput,
    /// There is nothing to find.
    #[error("no poles asked for: one pair at least")]
    NoPoles,
    /// A frequency that is none.
    #[error("frequency {index} is {found_rad_s} rad/s: all must be finite and positive")]
    Frequency {
        /// Its place, from 0.
        index: usize,
        /// What it is \[rad/s\].
        found_rad_s: f64,
    },
    /// An output on another grid.
    #[error(
        "output {output} has {found} responses for {expected} frequencies: all must share one grid"
    )]
    Grid {
        /// Its place, from 0.
        output: usize,
        /// Responses it has.
        found: usize,
        /// Frequencies there are.
        expected: usize,
    },
    /// A response that is no number, or has no deviation.
    #[error(
        "output {output}, point {index}: a response needs a finite value and a deviation above zero"
    )]
    Response {
        /// The output's place, from 0.
        output: usize,
        /// The point's, from 0.
        index: usize,
    },
    /// More unknowns than data.
    #[error("{unknowns} unknowns and {readings} readings: too few frequencies for so many poles")]
    TooFew {
        /// Numbers to find.
        unknowns: usize,
        /// Real numbers to find them from.
        readings: usize,
    },
    /// The search ended nowhere.
    #[error("no {modes} pairs of poles can be told apart: try fewer")]
    NotFound {
        /// Pairs of poles asked for.
        modes: usize,
    },
}
