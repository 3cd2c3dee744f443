//! Validation: how well an identified arm predicts logs from which it was not identified.

pub(crate) mod cause;
mod expected;
mod kernel;
mod log_prediction;
mod motion_fit;
pub(crate) mod moved_mode;
mod residual;
pub(super) mod torque;
pub(super) mod torque_arm;
mod torque_rows;
mod validation_findings;
mod validation_text;
pub(super) mod zeros;

pub use cause::{Cause, CauseKind};
pub use log_prediction::{LogPrediction, predict_logs};
pub use motion_fit::{ChannelFit, Horizon, PredictedStretch};
pub use moved_mode::{MovedBy, MovedMode};
pub use residual::ChannelResidual;
use torque::torque;
pub use torque::{TorquePrediction, TorqueRun, TorqueStretch, TorqueTerms};
use zeros::zeros;

use thiserror::Error;

use crate::identify::findings::Finding;
use crate::identify::found_arm::FoundArm;
use crate::record::{Campaign, Run};
use crate::replay::{MOST_MODES, TURN_MOST};
use expected::expected;
use motion_fit::{FollowedLog, followed, lengths_s};
use moved_mode::moved_mode;
use residual::channel_residuals;

/// Options of a validation.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ValidationOptions {
    /// Length of the window over which torques are averaged \[s\]; if `None`, that of the
    /// logs the arm was identified from.
    pub window_s: Option<f64>,
    /// Time over which motion is predicted from one initial state \[s\]; if `None`, several times are tried.
    pub horizon_s: Option<f64>,
}

/// Why a campaign cannot be predicted at all.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ValidationError {
    /// The result and the log have different numbers of tips.
    #[error("the result has {expected} tips, but the log has {found}")]
    Tips {
        /// Tips of the result.
        expected: usize,
        /// Tips of the log.
        found: usize,
    },
    /// The result has more modes than can be simulated.
    #[error("the result has {found} modes, but at most {MOST_MODES} can be simulated")]
    Modes {
        /// Modes of the result.
        found: usize,
    },
    /// The arm changes far faster than the sample time of the log.
    #[error(
        "the result's arm changes its state at up to {rate_per_s:.1e} 1/s, thousands of times within a \
         sample of {sample_time_s} s"
    )]
    TooFast {
        /// Bound on its rates \[1/s\].
        rate_per_s: f64,
        /// Time between two samples \[s\].
        sample_time_s: f64,
    },
    /// The simulated motion grows without bounds.
    #[error(
        "the motion of the result's arm grows without bounds: it cannot be compared with the log"
    )]
    RunsAway,
    /// Neither torque nor motion could be predicted.
    #[error("the motor never moves long enough for a prediction")]
    NothingMoves,
}

/// Result of a validation.
#[derive(Debug, Clone, PartialEq)]
pub struct Validation {
    /// Prediction of torque; `None` if the tips do not determine the coupling torque, or if nothing moves.
    pub torque: Option<TorquePrediction>,
    /// Predictions of motion over successively shorter times.
    pub horizons: Vec<Horizon>,
    /// Index of the prediction in `horizons` to which the residuals belong.
    pub chosen: usize,
    /// The predicted parts of runs of that prediction.
    pub stretches: Vec<PredictedStretch>,
    /// Residual of each channel of that prediction, motor first, then tips.
    pub residuals: Vec<ChannelResidual>,
    /// A mode with another frequency in this log. It is given if the residual of a tip is above the noise of its
    /// sensor, and the other frequency removes at least half of the squared residual.
    pub moved_mode: Option<MovedMode>,
    /// Findings against the estimates.
    pub findings: Vec<Finding>,
}

/// Predicts torque and motion of a campaign from which `found` was not identified, and compares them with the logs.
///
/// # Errors
/// [`ValidationError`] if the arm does not fit the campaign's channels, if it cannot be simulated, or if nothing moves.
pub fn validate(
    found: &FoundArm,
    campaign: &Campaign,
    options: &ValidationOptions,
) -> Result<Validation, ValidationError> {
    check(found, campaign)?;
    let (found, campaign) = &found.in_time(campaign);
    let all = predicted(found, campaign, None);
    // The window of the logs used, so that both estimates compare.
    let window_s = options.window_s.or(found.torque_used.map(|used| used.window_s));
    let mut torque =
        torque(found.for_torque(), campaign, &zeros(found.for_torque(), campaign), window_s);
    // What the arm's own motion leaves is beside the log's only where it stays with it.
    if let (Some(torque), Some(followed)) = (&mut torque, fitting(&all).map(|i| &all[i])) {
        torque.compare(expected(found.for_torque(), campaign, followed, torque.window_s));
    }
    let mut predicted = match options.horizon_s {
        Some(_) => predicted(found, campaign, options.horizon_s),
        None => all,
    };
    let chosen = fitting(&predicted).unwrap_or(predicted.len().saturating_sub(1));
    let finite = torque.as_ref().is_none_or(|t| t.relative_error.is_finite());
    if !(finite && predicted.iter().all(FollowedLog::is_finite)) {
        return Err(ValidationError::RunsAway);
    }
    if predicted.is_empty() && torque.is_none() {
        return Err(ValidationError::NothingMoves);
    }
    let horizons: Vec<Horizon> = predicted.iter().map(|f| f.horizon.clone()).collect();
    let at = (!predicted.is_empty()).then(|| predicted.swap_remove(chosen));
    let stretches = at.as_ref().map_or(&[][..], |at| &at.stretches);
    let residuals = channel_residuals(campaign, stretches);
    let tip_departs = residuals.iter().skip(1).any(ChannelResidual::is_beyond_noise);
    let moved_mode =
        at.as_ref().filter(|_| tip_departs).and_then(|at| moved_mode(found, campaign, at));
    let stretches = at.map_or_else(Vec::new, |at| at.stretches);
    let findings = Vec::new();
    let mut validation =
        Validation { torque, horizons, chosen, stretches, residuals, moved_mode, findings };
    validation.findings = validation_findings::findings(found, campaign, &validation);
    Ok(validation)
}

/// Whether the arm fits the campaign's channels and can be simulated.
fn check(found: &FoundArm, campaign: &Campaign) -> Result<(), ValidationError> {
    let arm = &found.arm;
    let tips = campaign.channels.tips.len();
    if arm.shapes.len() != tips {
        return Err(ValidationError::Tips { expected: arm.shapes.len(), found: tips });
    }
    if arm.modes.len() > MOST_MODES {
        return Err(ValidationError::Modes { found: arm.modes.len() });
    }
    let rate_per_s = arm.rate_bound();
    for sample_time_s in campaign.runs.iter().map(Run::sample_time_s) {
        let turn = rate_per_s * sample_time_s;
        if turn > TURN_MOST || turn.is_nan() {
            return Err(ValidationError::TooFast { rate_per_s, sample_time_s });
        }
    }
    Ok(())
}

/// The longest time over which every channel fits.
fn fitting(predicted: &[FollowedLog]) -> Option<usize> {
    predicted.iter().position(FollowedLog::fits)
}

/// The motion over ever shorter times, or over the one asked for; none of an arm whose modes are not known.
fn predicted(found: &FoundArm, campaign: &Campaign, horizon_s: Option<f64>) -> Vec<FollowedLog> {
    if !found.moves() {
        return Vec::new();
    }
    let mut predicted: Vec<FollowedLog> = Vec::new();
    for length_s in lengths_s(campaign, horizon_s).into_iter().rev() {
        let shorter = predicted.last().map_or(&[][..], |f| &f.windows);
        predicted.extend(followed(&found.arm, campaign, length_s, shorter));
    }
    predicted.reverse();
    if horizon_s.is_some() {
        predicted.truncate(1);
    }
    predicted
}

#[cfg(test)]
mod tests;
pub(crate) mod thresholds;
