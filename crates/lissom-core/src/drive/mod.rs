//! The drive, Section 2.2: motor (14) and its friction.

mod motor;

pub use crate::friction::{Coulomb, DriveError, DryFriction, Falloff, LuGre};
pub use motor::{Motor, MotorBuilder};
