//! Why numbers of a motor or a friction law are rejected.

use thiserror::Error;

/// A number cannot belong to a motor or a friction law.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum DriveError {
    /// A quantity that must be positive is not positive, or not finite.
    #[error("{quantity} = {found} is not positive and finite")]
    NotPositive {
        /// Name of the quantity.
        quantity: &'static str,
        /// The number found.
        found: f64,
    },
    /// A quantity that may have either sign is not finite.
    #[error("{quantity} = {found} is not finite")]
    NotFinite {
        /// Name of the quantity.
        quantity: &'static str,
        /// The number found.
        found: f64,
    },
    /// A quantity that must not be negative is negative, or not finite.
    #[error("{quantity} = {found} is negative or not finite")]
    Negative {
        /// Name of the quantity.
        quantity: &'static str,
        /// The number found.
        found: f64,
    },
}
