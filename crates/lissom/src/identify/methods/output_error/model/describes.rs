//! Whether an arm describes the runs.

use nalgebra::DMatrix;

use crate::identify::methods::output_error::thresholds::{
    RESIDUAL_AT_NOISE, RESIDUAL_FAR_ABOVE_NOISE, SLOW_RESIDUAL,
};
use crate::replay::ModalArm;

/// Whether the slow share of some channel's residual is larger than its sensor's noise explains.
pub(crate) fn is_left(shares: &[f64]) -> bool {
    most(shares) > SLOW_RESIDUAL
}

/// The largest of some shares.
pub(crate) fn most(shares: &[f64]) -> f64 {
    shares.iter().copied().fold(0.0, f64::max)
}

/// Whether an arm is accepted: its residual is at most a few times the sensors' noise if whole runs are replayed, and
/// about that noise if shorter windows are replayed.
pub(crate) fn stands(
    arm: &ModalArm,
    covariance: &DMatrix<f64>,
    whole_runs: bool,
    beyond_noise: f64,
) -> bool {
    let finite = covariance.diagonal().iter().all(|v| v.is_finite() && *v > 0.0);
    let most = if whole_runs { RESIDUAL_FAR_ABOVE_NOISE } else { RESIDUAL_AT_NOISE };
    beyond_noise < most && finite && arm.inertia_kg_m2 > 0.0
}
