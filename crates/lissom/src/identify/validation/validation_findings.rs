//! What a validation shows against the estimates, in findings.

use crate::identify::findings::{Channel, EstimateUnits, Finding, ValidationFinding};
use crate::identify::found_arm::FoundArm;
use crate::identify::validation::Validation;
use crate::identify::validation::cause::Cause;
use crate::identify::validation::torque::{TorquePrediction, shows_coupling};
use crate::record::{Campaign, Channels};

/// Of a torque of which less is left nothing is said.
pub(super) const GOOD: f64 = 0.03;
/// Nothing is called bad where no more is left than this many times what the arm's own motion leaves.
const AS_EXPECTED: f64 = 1.2;
/// Torque left from which on a prediction is called bad…
const BAD: f64 = 0.15;
/// …and from which on it is none.
const NONE: f64 = 0.6;
/// A log not used that is predicted worse than those used by this factor.
const WORSE: f64 = 1.5;
/// A term that takes this share of the squared residual away by itself is named: the residual falls
/// to 0.9 of itself.
const NAMED: f64 = 0.19;
/// Share of the residual's lags with the command beyond the 95 % band, four times what chance puts
/// there.
const FOLLOWS: f64 = 0.2;
/// Probability below which a residual is not white.
const WHITE: f64 = 0.01;
/// Relative difference of two windows under which figures still compare.
const SAME_WINDOW: f64 = 0.2;
/// Fit of whole runs below which the motion departs \[%\].
const DEPARTS: f64 = 90.0;

pub(super) fn findings(
    found: &FoundArm,
    campaign: &Campaign,
    validation: &Validation,
) -> Vec<Finding> {
    let mut findings = Vec::new();
    match &validation.torque {
        Some(torque) => torque_findings(found, &campaign.channels, torque, &mut findings),
        None => findings.push(not_predicted(found, campaign)),
    }
    findings.extend(departure(validation));
    findings.extend(beam(validation));
    residual_findings(campaign, validation, &mut findings);
    findings.sort_by_key(|f| std::cmp::Reverse(f.severity()));
    findings
}

fn not_predicted(found: &FoundArm, campaign: &Campaign) -> Finding {
    let coupling_known = shows_coupling(&found.arm, campaign);
    Finding::new(ValidationFinding::TorqueNotPredicted { coupling_known })
}

fn torque_findings(
    found: &FoundArm,
    channels: &Channels,
    torque: &TorquePrediction,
    findings: &mut Vec<Finding>,
) {
    let error = torque.relative_error;
    let expected = torque.expected_error.unwrap_or(0.0);
    if expected > BAD {
        let window_s = torque.window_s;
        let found = ValidationFinding::TorqueHidden { expected_share: expected, window_s };
        findings.push(Finding::new(found));
    }
    if error < GOOD {
        return;
    }
    let beyond = error > AS_EXPECTED * expected;
    let residual_share = error;
    if beyond && error > NONE {
        findings.push(Finding::new(ValidationFinding::PredictionFailed { residual_share }));
    } else if beyond && error > BAD {
        findings.push(Finding::new(ValidationFinding::PredictionPoor { residual_share }));
    }
    if let Some(used) = found.torque_used
        && (torque.window_s / used.window_s - 1.0).abs() < SAME_WINDOW
        && beyond
        && error > WORSE * used.relative_error
    {
        findings.push(Finding::new(ValidationFinding::PredictionWorse {
            residual_share,
            residual_share_of_identification: used.relative_error,
            expected_share: expected,
        }));
    }
    let beyond = |a: &&Cause, b: &&Cause| a.share_beyond().total_cmp(&b.share_beyond());
    if let Some(cause) = torque.causes.iter().max_by(beyond).filter(|c| c.share_beyond() > NAMED) {
        let found = ValidationFinding::ResidualTorque {
            cause: *cause,
            units: EstimateUnits::new(channels),
        };
        findings.push(Finding::new(found));
    }
}

/// Motion that does not stay with the log over whole runs.
fn departure(validation: &Validation) -> Option<Finding> {
    let whole = validation.horizons.iter().find(|h| h.whole_runs)?;
    let worst = whole.channels.iter().map(|c| c.fit_percent).fold(f64::INFINITY, f64::min);
    let holds = validation.horizons.get(validation.chosen)?;
    let least = holds.channels.iter().map(|c| c.fit_percent).fold(f64::INFINITY, f64::min);
    let found = ValidationFinding::MotionDeparts {
        fit_percent: worst,
        shorter_s: holds.length_s,
        shorter_fit_percent: least,
    };
    (worst < DEPARTS).then(|| Finding::new(found))
}

/// A beam that is not the one of the logs used.
fn beam(validation: &Validation) -> Option<Finding> {
    Some(Finding::new(ValidationFinding::ModeMoved { moved: validation.moved_mode? }))
}

fn residual_findings(campaign: &Campaign, validation: &Validation, findings: &mut Vec<Finding>) {
    for (channel, r) in validation.residuals.iter().enumerate() {
        let channel = match channel.checked_sub(1) {
            None => Channel::Motor,
            Some(tip) => Channel::Tip(campaign.channels.tips[tip].name.clone()),
        };
        if !r.is_beyond_noise() {
            continue;
        }
        if r.outside() > FOLLOWS {
            let (channel, share) = (channel.clone(), r.outside());
            let found = ValidationFinding::ResidualFollowsCommand { channel, share };
            findings.push(Finding::new(found));
        }
        if r.white_probability < WHITE {
            let noise_ratio = r.rms / r.sensor_noise.max(f64::MIN_POSITIVE);
            let found = ValidationFinding::ResidualNotWhite { channel, noise_ratio };
            findings.push(Finding::new(found));
        }
    }
}
