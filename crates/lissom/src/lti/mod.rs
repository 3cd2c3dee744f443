//! Linear models: transfer functions and state space.

mod polynomial;
mod state_space;
mod transfer_function;

pub use polynomial::{add, multiply};
pub use state_space::StateSpace;
pub use transfer_function::TransferFunction;
