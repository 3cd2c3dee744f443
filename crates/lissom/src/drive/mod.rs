//! The drive, Section 2.2: motor (14) and its friction.

mod coulomb;
mod dry_friction;
mod lugre;
mod motor;

pub use coulomb::Coulomb;
pub(crate) use dry_friction::FrictionSeries;
pub use dry_friction::{DryFriction, Falloff};
pub use lugre::LuGre;
pub use motor::{DriveError, Motor};
