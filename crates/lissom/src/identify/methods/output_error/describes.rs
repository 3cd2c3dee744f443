//! Whether an arm describes the runs.

use nalgebra::DMatrix;

use crate::replay::ModalArm;

/// Residual relative to the sensors' noise beyond which something else is in it \[1\].
pub(super) const BEYOND: f64 = 3.0;
/// Residual relative to the sensors' noise below which nothing else is in it \[1\].
pub(super) const AT_NOISE: f64 = 1.25;
/// Share of a channel's squared residual that is slower than its sensor's noise, from which on the arm
/// has not all that moves \[1\].
const LEFT: f64 = 0.003;

/// Whether some channel's share is more than its sensor's noise leaves.
pub(super) fn is_left(shares: &[f64]) -> bool {
    most(shares) > LEFT
}

/// The largest of some shares.
pub(super) fn most(shares: &[f64]) -> f64 {
    shares.iter().copied().fold(0.0, f64::max)
}

/// Whether an arm is accepted: over whole runs it leaves no more than a few times the sensors' noise, over shorter
/// windows no more than that noise.
pub(super) fn stands(
    arm: &ModalArm,
    covariance: &DMatrix<f64>,
    whole_runs: bool,
    beyond_noise: f64,
) -> bool {
    let finite = covariance.diagonal().iter().all(|v| v.is_finite() && *v > 0.0);
    let most = if whole_runs { BEYOND } else { AT_NOISE };
    beyond_noise < most && finite && arm.inertia_kg_m2 > 0.0
}
