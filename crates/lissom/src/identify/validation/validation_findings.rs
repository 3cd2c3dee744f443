//! What a validation says against the figures.

use crate::identify::finding::Finding;
use crate::identify::finding::Severity::{Info, Refusal, Warning};
use crate::identify::found_arm::FoundArm;
use crate::identify::thresholds::{REFUSED_TORQUE, REJECTED_CHANCE, UNEXPLAINED_TORQUE};
use crate::identify::validation::Validation;
use crate::identify::validation::cause::{Cause, CauseKind};
use crate::identify::validation::moved_mode::MovedBy;
use crate::identify::validation::thresholds::{
    AS_EXPECTED, CAUSE_NAMED, FITS_PERCENT, FOLLOWS_COMMAND, GOOD_PREDICTION, SAME_WINDOW,
    WORSE_THAN_USED,
};
use crate::identify::validation::torque::{TorquePrediction, shows_coupling};
use crate::record::{Axis, Campaign, Channels};

/// What findings are about.
const TORQUE: &str = "torque";
const MOTION: &str = "motion";
const RESIDUALS: &str = "residuals";

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
    findings.sort_by_key(|f| std::cmp::Reverse(f.severity));
    findings
}

fn not_predicted(found: &FoundArm, campaign: &Campaign) -> Finding {
    let (message, hint) = if shows_coupling(&found.arm, campaign) {
        (
            "no window lies within the log while the motor moves, sensors read and what acts is logged: \
             no torque is predicted",
            "a longer log or a shorter --window; check the unit of its time",
        )
    } else {
        (
            "the torque between motor and beam does not follow from these tips: no torque is predicted",
            "measure the angle of as many points as there are modes; the motion is predicted without",
        )
    };
    Finding::new("torque-not-predicted", Refusal, &[TORQUE], message.to_owned(), hint)
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
        findings.push(Finding::new(
            "torque-hidden",
            Info,
            &[TORQUE],
            format!(
                "sensors and reversals alone leave {:.0} % of the torque under a window of {:.4} s",
                100.0 * expected,
                torque.window_s
            ),
            "a longer window (`--window`) tells more, or slower and larger motion",
        ));
    }
    if error < GOOD_PREDICTION {
        return;
    }
    let beyond = error > AS_EXPECTED * expected;
    let hint = "look at what the residual looks like, and at the stretches where it is largest";
    if beyond && error > REFUSED_TORQUE {
        let message =
            format!("{:.0} % of the torque is left: the figures do not hold", 100.0 * error);
        findings.push(Finding::new("prediction-failed", Refusal, &[TORQUE], message, hint));
    } else if beyond && error > UNEXPLAINED_TORQUE {
        let message = format!("{:.0} % of the torque is left", 100.0 * error);
        findings.push(Finding::new("prediction-poor", Warning, &[TORQUE], message, hint));
    }
    if let Some(used) = found.torque_used
        && (torque.window_s / used.window_s - 1.0).abs() < SAME_WINDOW
        && beyond
        && error > WORSE_THAN_USED * used.relative_error
    {
        findings.push(Finding::new(
            "prediction-worse",
            Warning,
            &[TORQUE],
            format!(
                "{:.2} % of the torque is left; of the logs that the figures are from {:.2} % is, and \
                 of this one if the arm is right {:.2} %",
                100.0 * error,
                100.0 * used.relative_error,
                100.0 * expected
            ),
            "the figures hold for the motion that they are from: identify from both kinds together",
        ));
    }
    let beyond = |a: &&Cause, b: &&Cause| a.share_beyond().total_cmp(&b.share_beyond());
    if let Some(cause) =
        torque.causes.iter().max_by(beyond).filter(|c| c.share_beyond() > CAUSE_NAMED)
    {
        findings.push(Finding::new(
            "residual-torque",
            Warning,
            &[TORQUE],
            format!(
                "{:.0} % of the squared residual of the torque looks like {}, {}",
                100.0 * cause.share_beyond(),
                cause.kind.words(),
                size(cause, channels)
            ),
            cause_hint(cause.kind),
        ));
    }
}

/// How large a term is, beyond what the arm's own motion looks like, with its unit.
fn size(cause: &Cause, channels: &Channels) -> String {
    let value = cause.value - cause.expected_value;
    if cause.kind == CauseKind::Delay {
        return format!("{:+.3} ms", 1e3 * value);
    }
    if cause.kind == CauseKind::Coupling {
        return format!("{:+.2} %", 100.0 * value);
    }
    let (torque, angle) = match (channels.command.torque_per_command, channels.axis) {
        (None, _) => return format!("{value:+.3e} per unit of command"),
        (Some(_), Axis::Rotary) => ("N·m", "rad"),
        (Some(_), Axis::Linear) => ("N", "m"),
    };
    let unit = match (cause.kind, channels.axis) {
        (CauseKind::Inertia, Axis::Rotary) => "kg·m²".to_owned(),
        (CauseKind::Inertia, Axis::Linear) => "kg".to_owned(),
        (CauseKind::Viscous | CauseKind::ViscousByDirection, _) => format!("{torque}·s/{angle}"),
        (CauseKind::Position, _) => format!("{torque}/{angle}"),
        _ => torque.to_owned(),
    };
    format!("{value:+.3e} {unit}")
}

fn cause_hint(kind: CauseKind) -> &'static str {
    match kind {
        CauseKind::Delay => "an amplifier's delay, or channels that are not sampled together",
        CauseKind::Inertia => "another load than in the logs used, or a wrong torque constant",
        CauseKind::Viscous | CauseKind::ViscousByDirection => {
            "friction changes with warmth and load, and need not grow in proportion to speed"
        }
        CauseKind::Coulomb | CauseKind::Offset => {
            "friction changes with warmth, load and place; a constant torque is a load or an offset"
        }
        CauseKind::Position => "gravity, a spring, or a wrongly scaled tip",
        CauseKind::Coupling => {
            "a stiffer or softer beam than in the logs used, or a tip of another scale"
        }
        CauseKind::NearRest => "Stribeck friction or presliding: the law has no such term",
    }
}

/// Motion that does not stay with the log over whole runs.
fn departure(validation: &Validation) -> Option<Finding> {
    let whole = validation.horizons.iter().find(|h| h.whole_runs)?;
    let worst = whole.channels.iter().map(|c| c.fit_percent).fold(f64::INFINITY, f64::min);
    let holds = validation.horizons.get(validation.chosen)?;
    let least = holds.channels.iter().map(|c| c.fit_percent).fold(f64::INFINITY, f64::min);
    let until = if least >= FITS_PERCENT {
        format!("over {:.3} s it holds {least:.1} %", holds.length_s)
    } else {
        format!("over {:.3} s still {least:.1} %", holds.length_s)
    };
    (worst < FITS_PERCENT).then(|| {
        Finding::new(
            "motion-departs",
            Info,
            &[MOTION],
            format!("from one initial state a whole run is followed to {worst:.1} % only; {until}"),
            "without its loop a motor drifts by whatever a figure is off: shorter times judge the arm",
        )
    })
}

/// A beam that is not the one of the logs used.
fn beam(validation: &Validation) -> Option<Finding> {
    let moved = validation.moved_mode?;
    let (what, hint) = match moved.by {
        MovedBy::Load => (
            "its stiffness as it is",
            "another load than in the logs used: identify from logs of this arm, or predict it with `lissom payload`",
        ),
        MovedBy::Stiffness => (
            "its stiffness with it",
            "a stiffer or softer beam than in the logs used: identify from logs of this arm",
        ),
    };
    Some(Finding::new(
        "mode-moved",
        Warning,
        &[MOTION],
        format!(
            "mode {} looks as if at {:.4} rad/s in place of {:.4} ({:+.2} %), {what}: with that {:.1} % of the squared \
             residual of the motion is left",
            moved.mode + 1,
            moved.of_log_rad_s,
            moved.omega_rad_s,
            100.0 * (moved.of_log_rad_s / moved.omega_rad_s - 1.0),
            100.0 * moved.residual_ratio
        ),
        hint,
    ))
}

fn residual_findings(campaign: &Campaign, validation: &Validation, findings: &mut Vec<Finding>) {
    for (channel, r) in validation.residuals.iter().enumerate() {
        let name = match channel.checked_sub(1) {
            None => "motor",
            Some(tip) => campaign.channels.tips[tip].name.as_str(),
        };
        if !r.is_beyond_noise() {
            continue;
        }
        if r.outside() > FOLLOWS_COMMAND {
            findings.push(Finding::new(
                "residual-follows-command",
                Warning,
                &[RESIDUALS],
                format!(
                    "{name}: the residual goes with the command at {:.0} % of the lags (5 % by chance)",
                    100.0 * r.outside()
                ),
                "something of what the command does is not in the arm: a delay, a mode, another inertia \
                 or friction",
            ));
        }
        if r.white_probability < REJECTED_CHANCE {
            findings.push(Finding::new(
                "residual-not-white",
                Info,
                &[RESIDUALS],
                format!(
                    "{name}: the residual is {:.1} times the sensor's own noise and not white",
                    r.rms / r.sensor_noise.max(f64::MIN_POSITIVE)
                ),
                "what the arm does not describe; deviations that take a residual for white are too small",
            ));
        }
    }
}
