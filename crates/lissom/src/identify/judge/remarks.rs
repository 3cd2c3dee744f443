//! What the taken estimates do not say by themselves: findings about command, friction, models and methods.

use crate::identify::drive_estimates::Method;
use crate::identify::finding::Severity::Warning;
use crate::identify::finding::{Finding, Severity, key};
use crate::identify::judge::beam_choice::complete;
use crate::identify::judge::evidence::{Chosen, Evidence};
use crate::identify::judge::thresholds::{
    METHODS_DISAGREE, MODEL_MISFIT, ODD_HARMONICS, OFFSET_REPORTED,
};
use crate::identify::methods::regression::coupled_tips;
use crate::identify::prepare::run_analysis::RunKind;
use crate::identify::thresholds::PRESENT;
use crate::record::{CommandQuantity, Hold, TipQuantity};

/// All of them.
pub(super) fn remarks(evidence: &Evidence<'_>, chosen: &Chosen) -> Vec<Finding> {
    let mut findings = Vec::new();
    model(evidence, &mut findings);
    methods(evidence, chosen, &mut findings);
    tips(evidence, chosen, &mut findings);
    findings
}

/// About the command, and that there is friction.
pub(super) fn of_friction(evidence: &Evidence<'_>, chosen: &Chosen) -> Vec<Finding> {
    let mut findings = Vec::new();
    command(evidence, &mut findings);
    friction(evidence, chosen, &mut findings);
    findings
}

fn command(evidence: &Evidence<'_>, findings: &mut Vec<Finding>) {
    let command = &evidence.campaign.channels.command;
    if command.torque_per_command.is_none() {
        findings.push(Finding::new(
            "per-unit-of-command",
            Severity::Info,
            &[key::COULOMB, key::VISCOUS, key::INERTIA],
            "the torque constant is unknown: figures are per unit of command".to_owned(),
            "state drive.torque_constant in the campaign",
        ));
    }
    let commanded = command.hold == Hold::Sampled && command.quantity != CommandQuantity::Current;
    if commanded {
        findings.push(Finding::new(
            "command-not-measured",
            Severity::Info,
            &[key::COULOMB, key::VISCOUS],
            "the drive's input is its command, not a measurement: the amplifier's dead band, \
             drop and delay are counted as the joint's"
                .to_owned(),
            "log the motor current where the drive gives it",
        ));
    }
}

fn friction(evidence: &Evidence<'_>, chosen: &Chosen, findings: &mut Vec<Finding>) {
    let mut shown = None;
    for run in evidence.runs {
        let RunKind::Sinusoidal(s) = &run.kind else { continue };
        let size = |k: usize| s.command.get(k).map_or(0.0, |p| p.value.norm());
        let (odd, even) = (size(3) + size(5), size(2) + size(4));
        let certain = s.command.get(3).is_some_and(|p| p.value.norm() > PRESENT * p.std);
        if certain && odd > ODD_HARMONICS * even {
            let share = 100.0 * size(3) / size(1).max(f64::MIN_POSITIVE);
            shown = Some(format!(
                "odd harmonics stand out of the command (third {share:.1} % of the fundamental in \
                 {}, even ones {:.1} times smaller): dry friction",
                run.name,
                odd / even.max(f64::MIN_POSITIVE)
            ));
            break;
        }
    }
    if shown.is_none()
        && let Some(c) = evidence.methods.regression.as_ref().and_then(|r| r.coulomb)
        && c.ci95()[0] > 0.0
    {
        shown = Some(format!(
            "the torque jumps with the direction of motion, by {:.1} deviations: dry friction",
            c.value / c.std
        ));
    }
    if let Some(message) = shown {
        findings.push(Finding::new(
            "friction-visible",
            Severity::Info,
            &[key::COULOMB, key::RAW],
            message,
            "a linear fit of the raw response would be wrong; use the corrected one",
        ));
    }
    if let Some(offset) = chosen.drive.friction.offset
        && offset.value.abs() > PRESENT * offset.std
        && let Some(c) = chosen.drive.friction.coulomb
        && offset.value.abs() > OFFSET_REPORTED * c.value
    {
        findings.push(Finding::new(
            "offset",
            Severity::Info,
            &[key::OFFSET],
            format!(
                "friction differs by direction, or a constant load acts: {:.1} % of the mean",
                100.0 * offset.value / c.value
            ),
            "the two are the same to a motion log; a load from another orientation tells them apart",
        ));
    }
}

/// A rational model that does not fit its own responses, where models are made of it.
fn model(evidence: &Evidence<'_>, findings: &mut Vec<Finding>) {
    let of_arm = evidence.replay().is_some();
    if !of_arm
        && let Some(m) = &evidence.methods.motor_model
        && m.weighted_rms > MODEL_MISFIT
    {
        findings.push(Finding::new(
            "model-misfit",
            Warning,
            &["models.motor", "models.tips", "models.state_space"],
            format!(
                "the motor's rational model misses its responses by {:.1} deviations (rms)",
                m.weighted_rms
            ),
            "a delay, a lag or a mode without a tip is not in it, damping within the beam, which it has against the \
             frame, or the responses are poorer than they look",
        ));
    }
}

fn methods(evidence: &Evidence<'_>, chosen: &Chosen, findings: &mut Vec<Finding>) {
    let constant = evidence.torque_per_command();
    let third =
        evidence.methods.third_harmonic.as_ref().map(|t| t.coulomb_command.scaled(constant));
    let classical = evidence.methods.constant_velocity.as_ref().and_then(|c| c.coulomb);
    let taken = chosen.drive.friction.coulomb;
    let others = [
        (
            third,
            "third harmonic",
            key::THIRD,
            "sticking, sensor steps and saturation lower the third harmonic's figure",
        ),
        (
            classical,
            "constant velocities",
            key::CLASSICAL,
            "an extrapolation to rest errs where friction does not grow in proportion to speed",
        ),
    ];
    for (other, name, affected, hint) in others {
        let (Some(other), Some(taken)) = (other, taken) else { continue };
        let apart = other.value / taken.value - 1.0;
        if apart.abs() > METHODS_DISAGREE {
            findings.push(Finding::new(
                "methods-disagree",
                Warning,
                &[key::COULOMB, affected],
                format!(
                    "{name} and the figure taken differ by {:.0} % in Coulomb friction",
                    100.0 * apart
                ),
                hint,
            ));
        }
    }
    let sinusoidal = evidence.runs.iter().any(|r| matches!(r.kind, RunKind::Sinusoidal(_)));
    if third.is_none() && sinusoidal {
        findings.push(Finding::new(
            "no-pairs",
            Severity::Info,
            &[key::THIRD],
            "no two runs are at a frequency and its triple: the third-harmonic method needs pairs"
                .to_owned(),
            "add for each frequency ω0 a run at 3ω0",
        ));
    }
}

fn tips(evidence: &Evidence<'_>, chosen: &Chosen, findings: &mut Vec<Finding>) {
    let campaign = evidence.campaign;
    let replayed = chosen.method == Some(Method::OutputError);
    // Slip phases then turn the beam with the motor.
    let rigid = !replayed
        && chosen.drive.inertia.is_some()
        && coupled_tips(campaign).is_empty()
        && evidence.methods.motor_model.as_ref().map(|m| m.inertia) != chosen.drive.inertia;
    let (severity, affects, and): (_, &[_], _) = if rigid {
        (
            Warning,
            &[key::COUPLING, key::INERTIA],
            "; the inertia is about that of motor and beam together",
        )
    } else {
        (Severity::Info, &[key::COUPLING], "")
    };
    for tip in &campaign.channels.tips {
        let why = match (tip.quantity, tip.calibrated) {
            (TipQuantity::Acceleration, _) => "an acceleration",
            (_, false) => "of unknown scale",
            _ => continue,
        };
        findings.push(Finding::new(
            "tip-without-angle",
            severity,
            affects,
            format!(
                "tip {} is {why}: it gives modes, but no coupling by regression{and}",
                tip.name
            ),
            "measure the tip's angle or deflection for the coupling",
        ));
    }
    if !evidence.methods.beam_regression.as_ref().is_some_and(complete)
        && let Some(model) = &evidence.methods.beam_model
        && model.modes.len() > campaign.channels.tips.len()
        && evidence.methods.regression.as_ref().is_some_and(|r| !r.coupling.is_empty())
    {
        findings.push(Finding::new(
            "more-modes-than-tips",
            Warning,
            &[key::COUPLING, key::INERTIA],
            format!(
                "the responses show {} modes and {} tips are measured: the coupling torque is \
                 not a sum over these tips alone",
                model.modes.len(),
                campaign.channels.tips.len()
            ),
            "measure as many points as there are modes in the band",
        ));
    }
}
