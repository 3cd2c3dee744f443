//! The drive: motor (14) and its friction (Section 2.2 of the 1989 report).

mod motor;

pub use crate::friction::{Coulomb, DriveError, DryFriction, Falloff, LuGre};
pub use motor::{Motor, MotorBuilder};
