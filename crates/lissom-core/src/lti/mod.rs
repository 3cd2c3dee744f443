//! Linear time-invariant models: transfer functions and state spaces.

mod coefficient_covariance;
pub(crate) mod first_root;
mod polynomial;
mod state_space;
mod transfer_function;
mod zero_pole_gain;

pub use coefficient_covariance::{CoefficientCovariance, ResponseError, RootError};
pub use polynomial::{add, multiply};
pub use state_space::StateSpace;
pub use transfer_function::TransferFunction;
pub use zero_pole_gain::ZeroPoleGain;
