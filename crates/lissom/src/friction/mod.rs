//! Laws of dry friction and how they act over a step: used by the rig and by the replay.

mod bristle_step;
mod bristles;
mod coulomb;
mod dry_friction;
mod dry_terms;
mod error;
mod falloff;
mod lugre;
mod mode;
mod place;

pub(crate) use bristle_step::{BristleStep, LinearStep};
pub use bristles::Bristles;
pub(crate) use bristles::{
    Bending, Bristled, DAMPING, DEFLECTION, INPUTS, LEVEL, STIFFNESS, VELOCITY,
};
pub use coulomb::Coulomb;
pub use dry_friction::DryFriction;
pub(crate) use dry_friction::FrictionSeries;
pub(crate) use dry_terms::SHARE_PER_STEP;
pub use dry_terms::{DryTerms, NearRest, Ripple};
pub use error::DriveError;
pub use falloff::Falloff;
pub use lugre::LuGre;
pub use mode::Mode;
pub(crate) use place::Place;
