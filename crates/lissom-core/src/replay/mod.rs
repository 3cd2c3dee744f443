//! Replay: simulates an arm under the logged command of a run, with exact derivatives of the predicted sensor readings
//! by every parameter and by the initial state.
//!
//! While the joint slips or sticks, the arm is linear: whole samples are computed with matrices, events with Taylor
//! series. Where the motor stops or reverses, the derivatives jump (saltation).
//!
//! [`predict`] simulates one window, [`sums`](fn@sums) compares windows with their logs, and [`ModalArm`]
//! is the model that is simulated.

mod arm_modes;
mod coordinates;
mod events;
mod friction;
mod innovations;
mod lanes;
mod late_tips;
mod linear;
mod loaded;
mod losses;
mod modal_arm;
mod noise;
mod parameter;
mod piece_matrices;
mod point_masses;
mod prediction;
mod rates;
mod replayed_motion;
mod series;
mod sums;
mod tangents;
mod transition;
mod window;

pub use crate::friction::{
    DryTerms, FrictionNumber, NearRest, NearRestNumber, ROOT_SPEED_RAD_S, ROUNDED_LOAD_SHARE,
    Ripple, RippleNumber, Root, WithLoad,
};
pub use arm_modes::ArmModes;
pub(crate) use coordinates::{Body, in_coordinates};
pub(crate) use modal_arm::TURN_MOST;
pub use modal_arm::{MOST_MODES, ModalArm, Oscillator};
pub use noise::SensorNoise;
pub use parameter::{Parameter, free_parameters};
pub use point_masses::{BeamCoordinate, BeamDerivative, PointMasses};
pub use prediction::{Prediction, innovations, predict};
pub use sums::{Blocks, Sampling, Window, WindowCost, WindowSums, costs, sums};

#[cfg(test)]
mod tests;
