//! Which figures stand, and what speaks against them.

use super::constant_velocity::{alone, only_constant_velocities, stand_in};
use super::finding::{Finding, Severity, key};
use super::found_arm::FoundArm;
use super::friction_law;
use super::identified::{Beam, Friction, Identified};
use super::output_error::{self, OutputError};
use super::regression::{self, BeamRegression};
use super::run_analysis::RunKind;
use super::separability::Separability;
use super::{Estimate, Severity::Warning};
use crate::record::{Campaign, CommandQuantity, Hold, TipQuantity};

/// A figure whose deviation is beyond this share of it is called uncertain…
pub(super) const UNCERTAIN: f64 = 0.2;
/// …and beyond this share it is refused.
const UNKNOWN: f64 = 1.0;
/// Weighted residual of the motor's rational model from which on its coupling is not taken.
const MODEL_MISFIT: f64 = 3.0;
/// Share of the tips' windowed acceleration below which their own equations explain it all.
const COMPLETE: f64 = 0.02;
/// Methods that differ by more than this share disagree.
const DISAGREE: f64 = 0.15;
/// A figure this many deviations from zero is there.
const PRESENT: f64 = 3.0;

/// Fills in the figures by the best method that the data carry, and the findings about them.
/// `used` are the runs that the methods used.
pub(crate) fn conclude(campaign: &Campaign, used: &Campaign, id: &mut Identified) {
    let constant = campaign.channels.command.torque_per_command.unwrap_or(1.0);
    from_regression(id);
    output_error::verdict(campaign, id);
    if id.friction.coulomb.is_none() {
        id.friction.coulomb =
            id.third_harmonic.as_ref().map(|t| t.coulomb_command.scaled(constant));
    }
    let replayed = id.output_error.as_ref().is_some_and(OutputError::stands);
    // Slip phases do not tell the motor's inertia from that of a beam whose angle no tip gives.
    let coupled = id.motor_model.as_ref().is_some_and(|m| {
        regression::coupled_tips(campaign).is_empty()
            && !m.coupling.is_empty()
            && m.poles_given
            && m.weighted_rms < MODEL_MISFIT
    });
    if (id.regression.is_none() || coupled)
        && !replayed
        && let Some(motor) = &id.motor_model
    {
        let back_emf = campaign.channels.command.back_emf_viscous;
        id.inertia = Some(motor.inertia);
        id.friction.viscous =
            Some(Estimate { value: motor.viscous.value - back_emf, std: motor.viscous.std });
        id.findings.extend(motor.delay_s.map(|lag| output_error::command_lag(campaign, lag)));
    }
    let alone = alone(id);
    if alone {
        id.findings.push(only_constant_velocities(campaign));
    }
    stand_in(id);
    beam(campaign, id, alone);
    refuse_the_unknown(id);
    command(campaign, id);
    friction(id);
    id.findings.extend(friction_law::finding(campaign.channels.axis, id));
    if !alone {
        regression::findings(id);
    }
    model(id);
    methods(id, constant);
    tips(campaign, id);
    id.separability = Separability::of(id, used);
    id.findings.extend(id.separability.as_ref().and_then(Separability::finding));
    // What is wrong with the logs comes before what follows from it.
    id.findings.sort_by_key(|f| (!f.is_about_readings(), std::cmp::Reverse(f.severity)));
    id.arm = FoundArm::of(id, used);
}

fn from_regression(id: &mut Identified) {
    let Some(r) = &id.regression else { return };
    if [r.inertia, r.coulomb].iter().all(|e| e.is_some_and(|e| e.is_negative())) {
        id.findings.push(Finding::new(
            "command-sign",
            Severity::Refusal,
            &[key::COULOMB, key::VISCOUS, key::INERTIA],
            "inertia and friction come out negative together: the command's sign is reversed \
             against the motor's"
                .to_owned(),
            "give the command or the motor a negative scale in the campaign",
        ));
    }
    id.friction = Friction {
        coulomb: r.coulomb,
        forward: r.forward,
        backward: r.backward,
        offset: r.offset,
        viscous: r.viscous_by_direction.map(|d| d.mean).or(r.viscous),
        viscous_by_direction: r.viscous_by_direction.map(|d| (d.forward, d.backward)),
        ..Friction::default()
    };
    id.inertia = r.inertia;
    if let Some(law) = &id.friction_law
        && law.chosen.departs()
    {
        id.friction = friction_law::friction(&law.chosen);
        id.inertia = law.chosen.inertia;
    }
}

fn beam(campaign: &Campaign, id: &mut Identified, alone: bool) {
    if let Some(oe) = id.output_error.as_ref().filter(|oe| oe.stands())
        && !oe.arm.modes.is_empty()
    {
        id.beam = oe.beam(&campaign.channels);
        return;
    }
    let tips = campaign.channels.tips.len();
    let fitted = id.beam_model.as_ref().map_or(&[][..], |b| &b.modes[..]);
    let modes = match &id.beam_regression {
        // As many equations as tips: where they leave nothing there are no further modes.
        Some(r) if fitted.len() <= tips || complete(r) => r.modes.clone(),
        _ => fitted.to_vec(),
    };
    let mut by_tip = id.regression.as_ref().map_or(Vec::new(), |r| r.coupling.clone());
    let mut total = id.regression.as_ref().and_then(|r| r.total_coupling);
    if let Some(law) = &id.friction_law
        && law.chosen.departs()
        && !by_tip.is_empty()
    {
        by_tip.clone_from(&law.chosen.coupling);
        total = law.chosen.total_coupling;
    }
    let coupling = total.or_else(|| {
        // Without a calibrated tip: from the motor's response, where its model fits.
        let model = id.motor_model.as_ref().filter(|_| tips > 0 && by_tip.is_empty())?;
        let fits = !model.coupling.is_empty() && model.weighted_rms < MODEL_MISFIT;
        fits.then(|| Estimate {
            value: model.coupling.iter().map(|e| e.value).sum(),
            std: model.coupling.iter().map(|e| e.std * e.std).sum::<f64>().sqrt(),
        })
    });
    if modes.is_empty() && tips > 0 && !alone {
        id.findings.push(Finding::new(
            "modes-not-found",
            Severity::Refusal,
            &[key::MODES],
            "no mode explains the tips' responses to the motor".to_owned(),
            "drive it at six or more frequencies about the beam's resonance, or with a sweep",
        ));
    }
    if tips == 0
        && let Some(model) = id.motor_model.as_ref().filter(|m| m.weighted_rms < MODEL_MISFIT)
        && let Some(pole) = model.poles.first()
    {
        id.findings.push(Finding::new(
            "flexible-without-tip",
            Warning,
            &[key::INERTIA, key::VISCOUS, key::COULOMB],
            format!(
                "the motor's response looks flexible, clamped at about {:.3e} rad/s, and no tip is \
                 measured",
                pole.omega_rad_s
            ),
            "measure a tip: from the motor alone its figures are rough",
        ));
    }
    id.beam = Beam { modes, coupling, coupling_by_tip: by_tip };
}

/// Whether the beam's equations on the measured tips explain their motion.
fn complete(r: &BeamRegression) -> bool {
    r.relative_residual.iter().all(|left| *left < COMPLETE)
}

/// Figures that are not known to their own size are taken back.
fn refuse_the_unknown(id: &mut Identified) {
    let mut findings = Vec::new();
    let regression = id.regression.is_some();
    let mut look = |name: &'static str, figure: &mut Option<Estimate>, hint: &'static str| {
        let Some(e) = *figure else {
            if !regression {
                // One refusal of the whole regression says it.
                return;
            }
            findings.push(Finding::new(
                "not-separable",
                Severity::Refusal,
                &[name],
                format!("{name} cannot be told from other terms in these runs"),
                hint,
            ));
            return;
        };
        let share = if e.value == 0.0 { f64::INFINITY } else { e.std / e.value.abs() };
        let (code, what) = if e.is_negative() {
            ("negative-figure", "negative: the model does not fit".to_owned())
        } else if share.is_infinite() {
            ("poor-excitation", "with nothing in the runs that shows it".to_owned())
        } else if share > UNKNOWN || share.is_nan() || e.value < 0.0 {
            ("poor-excitation", format!("uncertain by ±{:.0} %: not known", 100.0 * share))
        } else if share > UNCERTAIN {
            let message = format!(
                "{name} is known to ±{:.0} % only (one deviation): these motions hardly show it",
                100.0 * share
            );
            findings.push(Finding::new("poor-excitation", Warning, &[name], message, hint));
            return;
        } else {
            return;
        };
        let message = format!("{name} would be {:.4e}, {what}", e.value);
        findings.push(Finding::new(code, Severity::Refusal, &[name], message, hint));
        *figure = None;
    };
    look(key::COULOMB, &mut id.friction.coulomb, "add slow runs in both directions");
    look(key::VISCOUS, &mut id.friction.viscous, "add runs at higher speed and larger amplitude");
    look(
        key::INERTIA,
        &mut id.inertia,
        "add runs with more acceleration: faster sines, larger amplitude",
    );
    if !id.beam.coupling_by_tip.is_empty() || id.beam.coupling.is_some() {
        look(key::COUPLING, &mut id.beam.coupling, "drive it near the beam's resonance");
    }
    for figure in [id.friction.forward, id.friction.backward] {
        if let Some(e) = figure.filter(Estimate::is_negative) {
            findings.push(Finding::new(
                "negative-figure",
                Severity::Refusal,
                &[key::COULOMB, key::OFFSET],
                format!(
                    "friction in one direction would be {:.4e}, negative: the model does not fit",
                    e.value
                ),
                "a large load or an offset of a sensor; check units, signs and a camera's origin",
            ));
            id.friction.coulomb = None;
        }
    }
    if findings.iter().any(|f| f.code == "negative-figure") {
        findings.push(Finding::new(
            "others-doubtful",
            Warning,
            &[key::COULOMB, key::VISCOUS, key::INERTIA, key::COUPLING],
            "a figure that must be positive came out negative: the others are doubtful too"
                .to_owned(),
            "the equation does not describe these runs: check signs, units and what acts on the axis",
        ));
    }
    if id.friction.coulomb.is_none() {
        id.friction.forward = None;
        id.friction.backward = None;
        id.friction.offset = None;
    }
    id.findings.extend(findings);
}

fn command(campaign: &Campaign, id: &mut Identified) {
    let command = &campaign.channels.command;
    if command.torque_per_command.is_none() {
        id.findings.push(Finding::new(
            "per-unit-of-command",
            Severity::Info,
            &[key::COULOMB, key::VISCOUS, key::INERTIA],
            "the torque constant is unknown: figures are per unit of command".to_owned(),
            "state drive.torque_constant in the campaign",
        ));
    }
    let commanded = command.hold == Hold::Sampled && command.quantity != CommandQuantity::Current;
    if commanded {
        id.findings.push(Finding::new(
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

fn friction(id: &mut Identified) {
    let mut shown = None;
    for run in &id.runs {
        let RunKind::Sinusoidal(s) = &run.kind else { continue };
        let size = |k: usize| s.command.get(k).map_or(0.0, |p| p.value.norm());
        let (odd, even) = (size(3) + size(5), size(2) + size(4));
        let certain = s.command.get(3).is_some_and(|p| p.value.norm() > PRESENT * p.std);
        if certain && odd > 2.0 * even {
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
        && let Some(c) = id.regression.as_ref().and_then(|r| r.coulomb)
        && c.ci95()[0] > 0.0
    {
        shown = Some(format!(
            "the torque jumps with the direction of motion, by {:.1} deviations: dry friction",
            c.value / c.std
        ));
    }
    if let Some(message) = shown {
        id.findings.push(Finding::new(
            "friction-visible",
            Severity::Info,
            &[key::COULOMB, key::RAW],
            message,
            "a linear fit of the raw response would be wrong; use the corrected one",
        ));
    }
    if let Some(offset) = id.friction.offset
        && offset.value.abs() > PRESENT * offset.std
        && let Some(c) = id.friction.coulomb
        && offset.value.abs() > 0.01 * c.value
    {
        id.findings.push(Finding::new(
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
fn model(id: &mut Identified) {
    let of_arm = id.output_error.as_ref().is_some_and(OutputError::stands);
    if !of_arm
        && let Some(m) = &id.motor_model
        && m.weighted_rms > MODEL_MISFIT
    {
        id.findings.push(Finding::new(
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

fn methods(id: &mut Identified, constant: f64) {
    let third = id.third_harmonic.as_ref().map(|t| t.coulomb_command.scaled(constant));
    let classical = id.constant_velocity.as_ref().and_then(|c| c.coulomb);
    let taken = id.friction.coulomb;
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
        if apart.abs() > DISAGREE {
            id.findings.push(Finding::new(
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
    let sinusoidal = id.runs.iter().any(|r| matches!(r.kind, RunKind::Sinusoidal(_)));
    if third.is_none() && sinusoidal {
        id.findings.push(Finding::new(
            "no-pairs",
            Severity::Info,
            &[key::THIRD],
            "no two runs are at a frequency and its triple: the third-harmonic method needs pairs"
                .to_owned(),
            "add for each frequency ω0 a run at 3ω0",
        ));
    }
}

fn tips(campaign: &Campaign, id: &mut Identified) {
    let replayed = id.output_error.as_ref().is_some_and(OutputError::stands);
    // Slip phases then turn the beam with the motor.
    let rigid = !replayed
        && id.inertia.is_some()
        && regression::coupled_tips(campaign).is_empty()
        && id.motor_model.as_ref().map(|m| m.inertia) != id.inertia;
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
        id.findings.push(Finding::new(
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
    if !id.beam_regression.as_ref().is_some_and(complete)
        && let Some(model) = &id.beam_model
        && model.modes.len() > campaign.channels.tips.len()
        && id.regression.as_ref().is_some_and(|r| !r.coupling.is_empty())
    {
        id.findings.push(Finding::new(
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
