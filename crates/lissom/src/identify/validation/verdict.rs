//! What a validation says against the figures.

use super::{CauseKind, TorquePrediction, Validation};
use crate::identify::Finding;
use crate::identify::Severity::{Info, Refusal, Warning};
use crate::identify::found_arm::FoundArm;
use crate::record::Campaign;

/// Of a torque of which less is left nothing is said: sensors (1 % by the choice of the window) and
/// the velocity's sign about a reversal leave that of the true arm.
const GOOD: f64 = 0.03;
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
/// A residual of up to this many times the sensor's own noise is as good as that.
const NOISE: f64 = 1.5;
/// Fit of whole runs below which the motion departs \[%\].
const DEPARTS: f64 = 90.0;

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
        Some(torque) => torque_findings(found, torque, &mut findings),
        None => findings.push(Finding::new(
            "torque-not-predicted",
            Refusal,
            &[TORQUE],
            "the torque between motor and beam does not follow from these tips: no torque is \
             predicted"
                .to_owned(),
            "measure the angle of as many points as there are modes; the motion is predicted without",
        )),
    }
    findings.extend(departure(validation));
    residual_findings(campaign, validation, &mut findings);
    findings.sort_by_key(|f| std::cmp::Reverse(f.severity));
    findings
}

fn torque_findings(found: &FoundArm, torque: &TorquePrediction, findings: &mut Vec<Finding>) {
    let error = torque.relative_error;
    if error < GOOD {
        return;
    }
    let hint = "look at what the residual looks like, and at the stretches where it is largest";
    if error > NONE {
        let message =
            format!("{:.0} % of the torque is left: the figures do not hold", 100.0 * error);
        findings.push(Finding::new("prediction-failed", Refusal, &[TORQUE], message, hint));
    } else if error > BAD {
        let message = format!("{:.0} % of the torque is left", 100.0 * error);
        findings.push(Finding::new("prediction-poor", Warning, &[TORQUE], message, hint));
    }
    if let Some(used) = found.torque_used
        && (torque.window_s / used.window_s - 1.0).abs() < SAME_WINDOW
        && error > WORSE * used.relative_error
    {
        findings.push(Finding::new(
            "prediction-worse",
            Warning,
            &[TORQUE],
            format!(
                "{:.2} % of the torque is left, {:.1} times the {:.2} % of the logs that the figures \
                 are from",
                100.0 * error,
                error / used.relative_error,
                100.0 * used.relative_error
            ),
            "the figures hold for the motion that they are from: identify from both kinds together",
        ));
    }
    let named = torque.causes.iter().filter(|c| c.share > NAMED);
    for cause in named.take(1) {
        findings.push(Finding::new(
            "residual-torque",
            Warning,
            &[TORQUE],
            format!(
                "{:.0} % of the squared residual of the torque looks like {}, {:+.3e} in SI units",
                100.0 * cause.share,
                cause.kind.words(),
                cause.value
            ),
            cause_hint(cause.kind),
        ));
    }
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
        CauseKind::NearRest => "Stribeck friction or presliding: the law has no such term",
    }
}

/// Motion that does not stay with the log over whole runs.
fn departure(validation: &Validation) -> Option<Finding> {
    let whole = validation.horizons.iter().find(|h| h.whole_runs)?;
    let worst = whole.channels.iter().map(|c| c.fit_percent).fold(f64::INFINITY, f64::min);
    let holds = validation.horizons.get(validation.chosen)?;
    let least = holds.channels.iter().map(|c| c.fit_percent).fold(f64::INFINITY, f64::min);
    let until = if least >= DEPARTS {
        format!("over {:.3} s it holds {least:.1} %", holds.length_s)
    } else {
        format!("over {:.3} s still {least:.1} %", holds.length_s)
    };
    (worst < DEPARTS).then(|| {
        Finding::new(
            "motion-departs",
            Info,
            &[MOTION],
            format!("from one initial state a whole run is followed to {worst:.1} % only; {until}"),
            "without its loop a motor drifts by whatever a figure is off: shorter times judge the arm",
        )
    })
}

fn residual_findings(campaign: &Campaign, validation: &Validation, findings: &mut Vec<Finding>) {
    for (channel, r) in validation.residuals.iter().enumerate() {
        let name = match channel.checked_sub(1) {
            None => "motor",
            Some(tip) => campaign.channels.tips[tip].name.as_str(),
        };
        if r.rms < NOISE * r.sensor_noise {
            continue;
        }
        if r.outside() > FOLLOWS {
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
        if r.white_probability < WHITE {
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
