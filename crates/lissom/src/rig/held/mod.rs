//! The fast engine: arms under torques that are held over samples, in the modes of each phase.

pub(in crate::rig) mod arm;
mod blocks;
mod crossing;
pub(in crate::rig) mod flow;
pub(in crate::rig) mod lane;
mod matrices;
mod modal;
mod motion;
mod search;

pub use arm::HeldArm;
pub use matrices::HeldStep;
pub use motion::{HeldMotion, Work};
