//! Laws of dry friction and how they act over a step: used by the rig and by the replay.

mod bristle_step;
mod bristles;
mod mode;
mod place;

pub(crate) use bristle_step::{BristleStep, LinearStep};
pub use bristles::Bristles;
pub(crate) use bristles::{
    Bending, Bristled, DAMPING, DEFLECTION, INPUTS, LEVEL, STIFFNESS, VELOCITY,
};
pub use mode::Mode;
pub(crate) use place::Place;
