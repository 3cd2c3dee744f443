//! Laws of dry friction, and how they act over a step in time; used by rig, replay and identification.

mod bristle_step;
mod bristles;
mod coulomb;
mod dry_friction;
mod dry_terms;
mod error;
mod falloff;
mod lugre;
mod mode;
mod near_rest;
mod phase_series;
mod place;
mod ripple;
mod root;
mod square_root_series;
mod taylor_row;
mod with_load;

pub(crate) use bristle_step::{BristleStep, LinearStep};
pub(crate) use bristles::Bristles;
pub use coulomb::Coulomb;
pub use dry_friction::DryFriction;
pub(crate) use dry_friction::FrictionSeries;
pub(crate) use dry_terms::TermScale;
pub use dry_terms::{DryTerms, FrictionNumber};
pub use error::DriveError;
pub use falloff::Falloff;
pub use lugre::LuGre;
pub use mode::Mode;
pub use near_rest::{NearRest, NearRestNumber};
pub(crate) use phase_series::PhaseSeries;
pub(crate) use place::Place;
pub use ripple::{Ripple, RippleNumber};
pub use root::{ROOT_SPEED_RAD_S, Root};
pub use with_load::{ROUNDED_LOAD_SHARE, WithLoad};
