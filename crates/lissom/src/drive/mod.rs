//! The drive, Section 2.2: motor (14) and its Coulomb friction.

mod coulomb;
mod motor;

pub use coulomb::Coulomb;
pub use motor::{DriveError, Motor};
