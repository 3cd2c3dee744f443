//! Findings about the command, friction, models and methods, for the estimates that were chosen.

use crate::identify::drive_estimates::Method;
use crate::identify::estimate::Estimate;
use crate::identify::findings::{EstimateUnits, Finding, rows};
use crate::identify::judge::beam_choice::complete;
use crate::identify::judge::evidence::{Chosen, Evidence};
use crate::identify::judge::thresholds::{
    METHODS_DISAGREE, MODEL_MISFIT, ODD_HARMONICS, OFFSET_REPORTED,
};
use crate::identify::methods::regression::coupled_tips;
use crate::identify::prepare::run_analysis::RunKind;
use crate::identify::thresholds::PRESENT;
use crate::record::{CommandQuantity, Hold, TipQuantity};

/// Findings about models, methods and tips.
pub(super) fn remarks(evidence: &Evidence<'_>, chosen: &Chosen) -> Vec<Finding> {
    let mut findings = Vec::new();
    model(evidence, &mut findings);
    methods(evidence, chosen, &mut findings);
    tips(evidence, chosen, &mut findings);
    findings
}

/// Findings about the command and about friction.
pub(super) fn of_friction(evidence: &Evidence<'_>, chosen: &Chosen) -> Vec<Finding> {
    let mut findings = Vec::new();
    command(evidence, &mut findings);
    friction(evidence, chosen, &mut findings);
    findings
}

fn command(evidence: &Evidence<'_>, findings: &mut Vec<Finding>) {
    let command = &evidence.campaign.channels.command;
    if command.torque_per_command.is_none() {
        findings.push(Finding::new(rows::PerUnitOfCommand {}));
    }
    let commanded = command.hold == Hold::Sampled && command.quantity != CommandQuantity::Current;
    if commanded {
        findings.push(Finding::new(rows::CommandNotMeasured {}));
    }
}

/// The jump of the torque at a reversal, without what terms that may be there would change of Coulomb friction.
fn torque_jump(evidence: &Evidence<'_>) -> Option<Estimate> {
    let law = evidence.methods.friction_law.as_ref().and_then(|law| law.chosen.projected[0]);
    law.or_else(|| evidence.methods.regression.as_ref()?.coulomb)
}

fn friction(evidence: &Evidence<'_>, chosen: &Chosen, findings: &mut Vec<Finding>) {
    let mut shown = None;
    for run in evidence.runs {
        let RunKind::Sinusoidal(s) = &run.kind else { continue };
        let size = |k: usize| s.command.get(k).map_or(0.0, |p| p.value.norm());
        let (odd, even) = (size(3) + size(5), size(2) + size(4));
        let certain = s.command.get(3).is_some_and(|p| p.value.norm() > PRESENT * p.std);
        if certain && odd > ODD_HARMONICS * even {
            shown = Some(Finding::new(rows::OddHarmonics {
                run: run.name.clone(),
                third_share: size(3) / size(1).max(f64::MIN_POSITIVE),
                odd_over_even: odd / even.max(f64::MIN_POSITIVE),
            }));
            break;
        }
    }
    if shown.is_none()
        && let Some(c) = torque_jump(evidence)
        && c.ci95()[0] > 0.0
    {
        shown = Some(rows::TorqueJump { standard_errors: c.value / c.std }.into());
    }
    findings.extend(shown);
    if let Some(offset) = chosen.drive.friction.offset
        && offset.value.abs() > PRESENT * offset.std
        && let Some(c) = chosen.drive.friction.coulomb
        && offset.value.abs() > OFFSET_REPORTED * c.value
    {
        let units = EstimateUnits::new(&evidence.campaign.channels);
        let share = offset.value / c.value;
        findings.push(Finding::new(rows::Offset { offset, units, share }));
    }
}

/// Reports a rational model that does not fit its own responses, if the result contains it.
fn model(evidence: &Evidence<'_>, findings: &mut Vec<Finding>) {
    let of_arm = evidence.replay().is_some();
    if !of_arm
        && let Some(m) = &evidence.methods.motor_model
        && m.weighted_rms > MODEL_MISFIT
    {
        let rms_standard_errors = m.weighted_rms;
        findings.push(Finding::new(rows::ModelMisfit { rms_standard_errors }));
    }
}

fn methods(evidence: &Evidence<'_>, chosen: &Chosen, findings: &mut Vec<Finding>) {
    let constant = evidence.campaign.channels.command.torque_per_unit();
    let third =
        evidence.methods.third_harmonic.as_ref().map(|t| t.coulomb_command.scaled(constant));
    let classical = evidence.methods.constant_velocity.as_ref().and_then(|c| c.coulomb);
    let taken = chosen.drive.friction.coulomb;
    let apart = |other: Option<Estimate>| {
        let difference_share = other?.value / taken?.value - 1.0;
        (difference_share.abs() > METHODS_DISAGREE).then_some(difference_share)
    };
    findings.extend(
        apart(third).map(|difference_share| {
            Finding::new(rows::ThirdHarmonicDisagrees { difference_share })
        }),
    );
    findings.extend(apart(classical).map(|difference_share| {
        Finding::new(rows::ConstantVelocityDisagrees { difference_share })
    }));
    let sinusoidal = evidence.runs.iter().any(|r| matches!(r.kind, RunKind::Sinusoidal(_)));
    if third.is_none() && sinusoidal {
        findings.push(Finding::new(rows::NoPairs {}));
    }
}

fn tips(evidence: &Evidence<'_>, chosen: &Chosen, findings: &mut Vec<Finding>) {
    let campaign = evidence.campaign;
    let replayed = chosen.method == Some(Method::OutputError);
    // The equation in slip phases then counts the beam's inertia with that of the motor.
    let rigid = !replayed
        && chosen.drive.inertia.is_some()
        && coupled_tips(campaign).is_empty()
        && evidence.methods.motor_model.as_ref().map(|m| m.inertia) != chosen.drive.inertia;
    for tip in &campaign.channels.tips {
        let acceleration = tip.quantity == TipQuantity::Acceleration;
        if acceleration || !tip.calibrated {
            findings.push(Finding::new(rows::TipWithoutAngle {
                tip: tip.name.clone(),
                acceleration,
                inertia_with_beam: rigid,
            }));
        }
    }
    if !evidence.methods.beam_regression.as_ref().is_some_and(complete)
        && let Some(model) = &evidence.methods.beam_model
        && model.modes.len() > campaign.channels.tips.len()
        && evidence.methods.regression.as_ref().is_some_and(|r| !r.coupling.is_empty())
    {
        let (modes, tips) = (model.modes.len(), campaign.channels.tips.len());
        findings.push(Finding::new(rows::MoreModesThanTips { modes, tips }));
    }
}
