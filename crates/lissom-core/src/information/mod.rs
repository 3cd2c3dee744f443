//! What logs say of an arm's parameters: Fisher information, its inverse, and what follows for figures.
//!
//! [`sums`] of a replay hold the products of its derivatives. A window's own unknowns (its initial state,
//! the tips' zeros) are eliminated from them, what is left is added up over the windows and
//! [inverted](inverse), and [`propagated`] turns the covariance into the deviation of any figure.

mod expected;
mod figure;
mod inverse;
mod propagated;
mod reduced;
pub(crate) mod thresholds;

pub use expected::{expected_covariance, growing_information};
pub use figure::Figure;
pub use inverse::{Inverse, covariance, inverse, inverse_root, inverted};
pub use propagated::{along, beside, propagated, slopes};
pub use reduced::{Reduced, normal_equations, without_own};

#[cfg(doc)]
use crate::replay::sums;
