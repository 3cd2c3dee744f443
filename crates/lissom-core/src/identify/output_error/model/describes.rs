//! Whether an arm describes the runs.

use std::f64::consts::TAU;

use nalgebra::DMatrix;

use crate::identify::output_error::thresholds::{
    CRITICAL_DAMPING, RESIDUAL_AT_NOISE, RESIDUAL_FAR_ABOVE_NOISE, SLOW_INNOVATIONS, SLOW_RESIDUAL,
};
use crate::record::{Tip, TipQuantity};
use crate::replay::ModalArm;

/// Whether the slow share of some channel's residual is larger than its sensor's noise explains, or so large that noise of the
/// command was taken for what the arm lacks.
pub(crate) fn is_left(shares: &[f64], command_noise: f64) -> bool {
    most(shares) > if command_noise > 0.0 { SLOW_INNOVATIONS } else { SLOW_RESIDUAL }
}

/// The largest of some shares.
pub(crate) fn most(shares: &[f64]) -> f64 {
    shares.iter().copied().fold(0.0, f64::max)
}

/// Largest residual of an accepted arm, in the sensors' noise: a few times that if whole runs are replayed, about that if
/// shorter windows are.
pub(crate) fn accepted_residual(whole_runs: bool) -> f64 {
    if whole_runs { RESIDUAL_FAR_ABOVE_NOISE } else { RESIDUAL_AT_NOISE }
}

/// Whether windows of this length determine the arm's modes: each has an initial state of its own, and over less than a
/// period another frequency with another initial state gives nearly the same motion. Of as many of the
/// lowest modes as sensors measure the beam's position, the initial states are known.
pub(crate) fn sees_modes(arm: &ModalArm, tips: &[Tip], window_s: f64) -> bool {
    let positions = tips.iter().filter(|tip| tip.quantity != TipQuantity::Acceleration);
    let modes = arm.clamped_modes();
    modes.iter().skip(positions.count()).all(|(omega_rad_s, _)| omega_rad_s * window_s > TAU)
}

/// Whether an arm is possible, and its standard errors are known.
pub(crate) fn is_sound(arm: &ModalArm, covariance: &DMatrix<f64>) -> bool {
    let finite = covariance.diagonal().iter().all(|v| v.is_finite() && *v > 0.0);
    // What only the motor shows is a mode if it oscillates: an overdamped one is a lag of something else.
    let seen = |ratio: f64| !arm.shapes.is_empty() || ratio < CRITICAL_DAMPING;
    finite && arm.inertia_kg_m2 > 0.0 && arm.damping_ratios().into_iter().all(seen)
}
