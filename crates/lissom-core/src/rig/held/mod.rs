//! The fast engine: arms under torques that are constant over each sample, computed with the modes of slip and stick.

mod blocks;
mod crossing;
pub(in crate::rig) mod flow;
pub(in crate::rig) mod held_arm;
mod held_motion;
pub(in crate::rig) mod lane;
mod matrices;
mod modal;
mod search;

pub use held_arm::HeldArm;
pub use held_motion::{HeldMotion, Work};
pub use matrices::HeldStep;
