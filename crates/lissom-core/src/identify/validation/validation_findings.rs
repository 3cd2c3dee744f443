//! What a validation shows against the estimates, in findings.

use crate::identify::findings::{Channel, EstimateUnits, Finding, rows};
use crate::identify::found_arm::FoundArm;
use crate::identify::thresholds::{REFUSED_TORQUE, REJECTED_CHANCE, UNEXPLAINED_TORQUE};
use crate::identify::validation::Validation;
use crate::identify::validation::cause::Cause;
use crate::identify::validation::thresholds::{
    AS_EXPECTED, CAUSE_NAMED, FITS_PERCENT, FOLLOWS_COMMAND, GOOD_PREDICTION, SAME_WINDOW,
    WORSE_THAN_USED,
};
use crate::identify::validation::torque::{TorquePrediction, shows_coupling};
use crate::record::{Campaign, Channels};

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
    if shows_coupling(found.for_torque(), campaign) {
        return Finding::new(rows::NoWindow {});
    }
    Finding::new(rows::CouplingUnknown {})
}

fn torque_findings(
    found: &FoundArm,
    channels: &Channels,
    torque: &TorquePrediction,
    findings: &mut Vec<Finding>,
) {
    let error = torque.relative_error;
    let expected = torque.expected_error.unwrap_or(0.0);
    if expected > UNEXPLAINED_TORQUE {
        let window_s = torque.window_s;
        let found = rows::TorqueHidden { expected_share: expected, window_s };
        findings.push(Finding::new(found));
    }
    if error < GOOD_PREDICTION {
        return;
    }
    let beyond = error > AS_EXPECTED * expected;
    let residual_share = error;
    if beyond && error > UNEXPLAINED_TORQUE {
        let failed = error > REFUSED_TORQUE;
        findings.push(Finding::new(rows::PredictionPoor { residual_share, failed }));
    }
    if let Some(used) = found.torque_used
        && (torque.window_s / used.window_s - 1.0).abs() < SAME_WINDOW
        && beyond
        && error > WORSE_THAN_USED * used.relative_error
    {
        findings.push(Finding::new(rows::PredictionWorse {
            residual_share,
            of_identification: used.relative_error,
            expected_share: expected,
        }));
    }
    let beyond = |a: &&Cause, b: &&Cause| a.share_beyond().total_cmp(&b.share_beyond());
    if let Some(cause) =
        torque.causes.iter().max_by(beyond).filter(|c| c.share_beyond() > CAUSE_NAMED)
    {
        let found = rows::ResidualTorque { cause: *cause, units: EstimateUnits::new(channels) };
        findings.push(Finding::new(found));
    }
}

/// Motion that does not stay with the log over whole runs.
fn departure(validation: &Validation) -> Option<Finding> {
    let whole = validation.horizons.iter().find(|h| h.whole_runs)?;
    let worst = whole.channels.iter().map(|c| c.fit_percent).fold(f64::INFINITY, f64::min);
    let holds = validation.horizons.get(validation.chosen)?;
    let least = holds.channels.iter().map(|c| c.fit_percent).fold(f64::INFINITY, f64::min);
    let found = rows::MotionDeparts {
        fit_percent: worst,
        shorter_s: holds.length_s,
        shorter_fit_percent: least,
    };
    (worst < FITS_PERCENT).then(|| Finding::new(found))
}

/// A beam that is not the one of the logs used.
fn beam(validation: &Validation) -> Option<Finding> {
    Some(Finding::new(rows::ModeMoved { moved: validation.moved_mode? }))
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
        if r.outside() > FOLLOWS_COMMAND {
            let (channel, share) = (channel.clone(), r.outside());
            let found = rows::ResidualFollowsCommand { channel, share };
            findings.push(Finding::new(found));
        }
        if r.white_probability < REJECTED_CHANCE {
            let noise_ratio = r.rms / r.sensor_noise.max(f64::MIN_POSITIVE);
            let found = rows::ResidualNotWhite { channel, noise_ratio };
            findings.push(Finding::new(found));
        }
    }
}
