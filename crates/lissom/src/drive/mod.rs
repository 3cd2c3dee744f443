//! The drive, Section 2.2: motor (14) and its friction.

mod coulomb;
mod lugre;
mod motor;

pub use coulomb::Coulomb;
pub use lugre::LuGre;
pub use motor::{DriveError, Motor};
