//! The fast engine: arms under torques that are constant over each sample, computed with the modes of slip and stick.

mod blocks;
mod crossing;
mod flow;
mod held_arm;
mod held_motion;
mod modal;
mod search;

pub use held_arm::HeldArm;
pub use held_motion::{HeldMotion, Work};
