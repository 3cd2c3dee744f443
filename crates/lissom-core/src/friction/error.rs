//! Error of a motor or a friction law with invalid parameters.

use thiserror::Error;

/// Error of a motor or a friction law with invalid parameters.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum DriveError {
    /// A quantity that is required is not given.
    #[error("{quantity} is not given")]
    NotGiven {
        /// Name of the quantity.
        quantity: &'static str,
    },
    /// A quantity that must be positive is not.
    #[error("{quantity} is {found}, but must be positive and finite")]
    NotPositive {
        /// Name of the quantity.
        quantity: &'static str,
        /// Its value.
        found: f64,
    },
    /// A quantity is not finite.
    #[error("{quantity} is {found}, but must be finite")]
    NotFinite {
        /// Name of the quantity.
        quantity: &'static str,
        /// Its value.
        found: f64,
    },
    /// A quantity that must not be negative is.
    #[error("{quantity} is {found}, but must be finite and not negative")]
    Negative {
        /// Name of the quantity.
        quantity: &'static str,
        /// Its value.
        found: f64,
    },
}
