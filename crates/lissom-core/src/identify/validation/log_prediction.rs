//! What an arm predicts of logs, without a judgement.

use super::motion_fit::{FollowedLog, PredictedStretch, longest_fitting};
use super::residual::{ChannelResidual, channel_residuals};
use super::torque::{TorquePrediction, torque};
use super::zeros::zeros;
use super::{ValidationError, check};
use crate::identify::found_arm::FoundArm;
use crate::record::Campaign;

/// Torque and motion of logs as an arm predicts them, for plots.
#[derive(Debug, Clone, PartialEq)]
pub struct LogPrediction {
    /// Prediction of torque, without [`TorquePrediction::expected_error`]; `None` if the tips do not determine the coupling
    /// torque, or if nothing moves.
    pub torque: Option<TorquePrediction>,
    /// The predicted parts of runs, over the longest time over which every channel fits.
    pub stretches: Vec<PredictedStretch>,
    /// Residual of each channel of this prediction, motor first, then tips.
    pub residuals: Vec<ChannelResidual>,
}

/// Predicts torque and motion of a campaign: the same values as [`validate`](super::validate) without options, in a fraction
/// of its time, because nothing is judged and no cause of the residual is searched.
///
/// # Errors
/// As [`validate`](super::validate).
pub fn predict_logs(
    found: &FoundArm,
    campaign: &Campaign,
) -> Result<LogPrediction, ValidationError> {
    check(found, campaign)?;
    let (found, campaign) = &found.in_time(campaign);
    let arm = found.for_torque();
    let window_s = found.torque_used.map(|used| used.window_s);
    let torque = torque(arm, campaign, &zeros(arm, campaign), window_s);
    let followed = if found.moves() { longest_fitting(&found.arm, campaign) } else { None };
    let finite = torque.as_ref().is_none_or(|t| t.relative_error.is_finite());
    if !(finite && followed.as_ref().is_none_or(FollowedLog::is_finite)) {
        return Err(ValidationError::RunsAway);
    }
    if followed.is_none() && torque.is_none() {
        return Err(ValidationError::NothingMoves);
    }
    let stretches = followed.map_or_else(Vec::new, |followed| followed.stretches);
    let residuals = channel_residuals(campaign, &stretches);
    Ok(LogPrediction { torque, stretches, residuals })
}
