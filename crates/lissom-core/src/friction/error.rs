//! Why numbers are refused.

use thiserror::Error;

/// Why numbers cannot make a motor or a law of friction.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum DriveError {
    /// A quantity that must be positive is not.
    #[error("{quantity} = {found} is not positive and finite")]
    NotPositive {
        /// Which quantity.
        quantity: &'static str,
        /// The number found.
        found: f64,
    },
    /// A quantity of either sign is no number, or infinite.
    #[error("{quantity} = {found} is not finite")]
    NotFinite {
        /// Which quantity.
        quantity: &'static str,
        /// The number found.
        found: f64,
    },
    /// A quantity that must not be negative is.
    #[error("{quantity} = {found} is negative or not finite")]
    Negative {
        /// Which quantity.
        quantity: &'static str,
        /// The number found.
        found: f64,
    },
}
