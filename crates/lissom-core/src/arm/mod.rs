//! The arm: a beam and a drive, joined by the coupling torque (15).

mod arm_builder;
mod coupled_arm;

pub use arm_builder::{ArmBuildError, ArmBuilder};
pub use coupled_arm::Arm;
