//! How precisely logs determine the parameters of an arm: Fisher information, its inverse, and standard errors.
//!
//! [`sums`] of a replay contain the products of its derivatives. The unknowns that belong to a single window (its
//! initial state and the zeros of the tips) are eliminated, the results are added over all windows and
//! [inverted](inverse). [`propagated`] converts the covariance to the standard error of any function of the parameters.

mod arm_parameter;
mod correlation;
mod expected;
mod inverse;
mod propagated;
mod reduced;
pub(crate) mod thresholds;

pub use arm_parameter::ArmParameter;
pub use correlation::correlation;
pub use expected::{expected_covariance, growing_information};
pub use inverse::{Inverse, covariance, inverse, inverse_root, inverted};
pub use propagated::{along, beside, propagated, slopes};
pub use reduced::{Reduced, normal_equations, without_own};

#[cfg(doc)]
use crate::replay::sums;
