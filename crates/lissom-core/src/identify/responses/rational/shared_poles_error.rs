//! Why responses cannot be fitted with shared poles.

use thiserror::Error;

/// Why responses cannot be fitted.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum SharedPolesError {
    /// There is no response to fit.
    #[error("there is no response; at least one is needed")]
    NoOutput,
    /// No poles are requested.
    #[error("the number of pole pairs is zero; at least one is needed")]
    NoPoles,
    /// A frequency is not positive and finite.
    #[error("frequency {index} is {found_rad_s} rad/s, but all must be positive and finite")]
    Frequency {
        /// Index of the frequency, from 0.
        index: usize,
        /// Its value \[rad/s\].
        found_rad_s: f64,
    },
    /// An output has another number of values than there are frequencies.
    #[error(
        "output {output} has {found} responses, but there are {expected} frequencies: all outputs must have the same frequencies"
    )]
    Grid {
        /// Index of the output, from 0.
        output: usize,
        /// Number of its responses.
        found: usize,
        /// Number of frequencies.
        expected: usize,
    },
    /// A response is not finite, or has no standard error.
    #[error(
        "output {output}, frequency {index}: a response needs a finite value, and a standard error above zero"
    )]
    Response {
        /// Index of the output, from 0.
        output: usize,
        /// Index of the frequency, from 0.
        index: usize,
    },
    /// There are more unknowns than data.
    #[error(
        "there are too few frequencies for so many poles: {readings} readings for {unknowns} unknowns"
    )]
    TooFew {
        /// Number of unknowns.
        unknowns: usize,
        /// Number of real values measured.
        readings: usize,
    },
    /// The search found no solution.
    #[error("the responses do not show {modes} separate pairs of poles; try fewer")]
    NotFound {
        /// Requested number of pole pairs.
        modes: usize,
    },
}
