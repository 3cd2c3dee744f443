//! Number of modes: modes are added while they make the fit better, and overdamped ones are taken out.

use crate::identify::methods::output_error::engine::coordinates::Body;
use crate::identify::methods::output_error::engine::covariance::standard_error;
use crate::identify::methods::output_error::model::fit::{ArmFit, Report};
use crate::identify::methods::output_error::model::fitting::Fitting;
use crate::identify::methods::output_error::thresholds::{
    CRITICAL_DAMPING, FIRST_MODE_OSCILLATIONS, MODE_FAINT, MODE_RETUNED, MODE_RETUNED_CLOSELY,
    NEW_MODE_DAMPING, NEW_MODE_FREQUENCIES, NEW_MODE_SHARE, NEW_MODE_TURN, PROBE_STEPS,
    REPETITIONS_MOST,
};
use crate::replay::{MOST_MODES, ModalArm, Oscillator, Parameter, free_parameters};

/// Adds modes above the others, up to as many as tips, while each makes the fit better.
pub(crate) fn grow(fitting: &Fitting<'_>, fit: &mut ArmFit, report: &mut Report) {
    let tips = fitting.campaign.channels.tips.len().min(MOST_MODES);
    while !fit.body.arm.modes.is_empty() && fit.body.arm.modes.len() < tips {
        let beyond = with_one_more(fitting, fit, report);
        if !fitting.is_better(&beyond, fit) {
            break;
        }
        *fit = beyond;
    }
}

/// Adds a mode to the initial state of every window: it moves with the motor.
fn begin_undeflected(fit: &mut ArmFit) {
    for window in &mut fit.windows {
        let with_motor = [window.start[0], window.start[1]];
        window.start.extend(with_motor);
    }
}

/// Takes out what is not a mode: overdamped ones, which do not oscillate and which no beam has (a rigid axis that started with
/// a mode has one), and, without tips, one that makes hardly an oscillation in a run.
pub(crate) fn drop_impossible(fitting: &Fitting<'_>, fit: &mut ArmFit, report: &mut Report) {
    let slowest_rad_s = FIRST_MODE_OSCILLATIONS * std::f64::consts::TAU / fitting.longest_s();
    let slow = |fit: &ArmFit| {
        let arm = &fit.body.arm;
        let slow = |mode: &Oscillator| mode.omega_rad_s < slowest_rad_s;
        arm.modes.iter().position(slow).filter(|_| arm.shapes.is_empty())
    };
    if let Some(mode) = slow(fit) {
        *fit = refitted(fitting, without_mode(fit, mode), report);
    }
    let overdamped = |fit: &ArmFit| {
        fit.body.arm.damping_ratios().iter().position(|ratio| *ratio >= CRITICAL_DAMPING)
    };
    while let Some(mode) = overdamped(fit) {
        let without = refitted(fitting, without_mode(fit, mode), report);
        if !fitting.is_better(&without, fit) {
            break;
        }
        *fit = without;
    }
}

/// Takes out one mode. Its share in each tip's motion goes to the last mode that remains.
fn without_mode(fit: &ArmFit, mode: usize) -> ArmFit {
    let mut fit = fit.clone();
    fit.body.masses = None;
    let arm = &mut fit.body.arm;
    for (j, ratio) in arm.damping_ratios().into_iter().enumerate() {
        let oscillator = &mut arm.modes[j];
        oscillator.grounded_per_s = 2.0 * ratio * oscillator.omega_rad_s - oscillator.within_per_s;
    }
    arm.at_points_per_s.clear();
    arm.modes.remove(mode);
    for row in &mut arm.shapes {
        let gone = row.remove(mode);
        row.last_mut().into_iter().for_each(|r| *r += gone);
    }
    for window in &mut fit.windows {
        window.start.drain(2 + 2 * mode..4 + 2 * mode);
    }
    fit
}

/// Searches again with the free parameters of the fit's modes.
fn refitted(fitting: &Fitting<'_>, fit: ArmFit, report: &mut Report) -> ArmFit {
    let mut fit = refreed(fitting, fit);
    fitting.search(&mut fit, report);
    fit
}

/// Sets the free parameters to those of the fit's modes. Lags and viscous friction by direction stay free.
fn refreed(fitting: &Fitting<'_>, mut fit: ArmFit) -> ArmFit {
    let beside = |p: &Parameter| {
        matches!(p, Parameter::CommandLag | Parameter::ViscousDifference | Parameter::TipLag(_))
    };
    let extra: Vec<Parameter> = fit.free.iter().copied().filter(beside).collect();
    fit.free = free_parameters(&fitting.campaign.channels, &fit.body.arm);
    fit.free.extend(extra);
    fit
}

/// Searches with a mode above all others. It takes over a part of the highest mode, which may represent several.
///
/// A search that begins at a wrong frequency of the new mode ends in a wrong minimum. So short searches on a part of
/// the windows begin at each of some frequencies, and with both signs of the turn of point masses. The best
/// continues.
fn with_one_more(fitting: &Fitting<'_>, fit: &ArmFit, report: &mut Report) -> ArmFit {
    let last = highest(&fit.body.arm);
    let mut best: Option<(f64, ArmFit)> = None;
    for times in NEW_MODE_FREQUENCIES {
        let beyond = one_beyond(fit.clone(), last, times);
        let new = beyond.body.arm.modes.len() - 1;
        let body = Body::of_masses(fitting.campaign, beyond.body.arm.clone());
        let bodies = match body.masses {
            Some(_) => {
                [NEW_MODE_TURN, -NEW_MODE_TURN].map(|t| body.clone().turned(last, new, t)).into()
            }
            None => vec![beyond.body.clone()],
        };
        for body in bodies {
            let start = refreed(fitting, ArmFit { body, ..beyond.clone() });
            let Some((cost, body)) = fitting.probe(&start, PROBE_STEPS) else { continue };
            if best.as_ref().is_none_or(|(least, _)| cost < *least) {
                best = Some((cost, ArmFit { body, ..start }));
            }
        }
    }
    let Some((_, start)) = best else { return fit.clone() };
    let found = refitted(fitting, start, report);
    match retuned(fitting, &found) {
        Some(other) => refitted(fitting, other, report),
        None => found,
    }
}

/// The highest mode at another frequency, if a short search from there ends at a lower cost than one from here. The
/// cost is conclusive, because the other parameters are about right.
fn retuned(fitting: &Fitting<'_>, fit: &ArmFit) -> Option<ArmFit> {
    let (least, _) = fitting.probe(fit, PROBE_STEPS)?;
    let others = MODE_RETUNED.iter().filter_map(|times| probed(fitting, fit, *times));
    let others = others.filter(|(cost, _)| *cost < least);
    others.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, other)| other)
}

/// Result and cost of a short search from a fit whose highest mode is put at `times` its frequency.
fn probed(fitting: &Fitting<'_>, fit: &ArmFit, times: f64) -> Option<(f64, ArmFit)> {
    let mode = highest(&fit.body.arm);
    let mut other = fit.clone();
    other.body.tune(mode, (times - 1.0) * fit.body.arm.modes[mode].omega_rad_s);
    for window in &mut other.windows {
        let (angle, speed) = (window.start[0], window.start[1]);
        window.start[2 + 2 * mode..4 + 2 * mode].copy_from_slice(&[angle, speed]);
    }
    let (cost, body) = fitting.probe(&other, PROBE_STEPS)?;
    Some((cost, ArmFit { body, ..other }))
}

/// Arms from which to search again after a wrong minimum, the likeliest first: results of short searches on short
/// windows with the highest mode at its own and at other frequencies.
pub(crate) fn starts_again(fitting: &Fitting<'_>, fit: &ArmFit) -> Vec<ModalArm> {
    // A single mode is driven or absent: the residual has another cause.
    if fit.body.arm.modes.len() < 2 {
        return Vec::new();
    }
    let mut short = fit.clone();
    short.body = Body::of_masses(fitting.campaign, undamped(fit.body.arm.clone()));
    fitting.shorten(&mut short);
    let mut tried: Vec<(f64, ArmFit)> = MODE_RETUNED_CLOSELY
        .iter()
        .chain(&MODE_RETUNED)
        .filter_map(|times| probed(fitting, &short, *times))
        .collect();
    tried.sort_by(|a, b| a.0.total_cmp(&b.0));
    tried.into_iter().take(REPETITIONS_MOST).map(|(_, fit)| undamped(fit.body.arm)).collect()
}

/// Removes damping against the frame, which the search has to find again, and negative damping within the beam.
fn undamped(mut arm: ModalArm) -> ModalArm {
    for mode in &mut arm.modes {
        mode.within_per_s = mode.within_per_s.max(0.0);
        mode.grounded_per_s = 0.0;
    }
    arm.at_points_per_s.fill(0.0);
    arm
}

/// The mode of the highest frequency.
pub(crate) fn highest(arm: &ModalArm) -> usize {
    let omega = |j: &usize| arm.modes[*j].omega_rad_s;
    (0..arm.modes.len()).max_by(|a, b| omega(a).total_cmp(&omega(b))).unwrap_or(0)
}

fn one_beyond(mut fit: ArmFit, last: usize, times: f64) -> ArmFit {
    let arm = &mut fit.body.arm;
    let cut = arm.modes[last];
    arm.modes[last].stiffness_nm_per_rad *= 1.0 - NEW_MODE_SHARE;
    arm.modes.push(Oscillator {
        omega_rad_s: times * cut.omega_rad_s,
        stiffness_nm_per_rad: NEW_MODE_SHARE * cut.stiffness_nm_per_rad,
        // It must not ring for long, because its frequency is hardly known.
        within_per_s: 2.0 * NEW_MODE_DAMPING * times * cut.omega_rad_s,
        grounded_per_s: 0.0,
    });
    for row in &mut arm.shapes {
        row.push(NEW_MODE_SHARE * row[last]);
        row[last] *= 1.0 - NEW_MODE_SHARE;
    }
    begin_undeflected(&mut fit);
    fit
}

/// Whether the highest of several modes is faint: its stiffness is hardly known.
pub(crate) fn highest_is_faint(fitting: &Fitting<'_>, fit: &ArmFit) -> bool {
    let arm = &fit.body.arm;
    let stiffness = || known_to(fitting, fit)(Parameter::Stiffness(highest(arm)));
    arm.modes.len() > 1 && stiffness().is_some_and(|share| share > MODE_FAINT)
}

/// Relative standard errors of parameters.
fn known_to<'a>(
    fitting: &Fitting<'_>,
    fit: &'a ArmFit,
) -> impl Fn(Parameter) -> Option<f64> + use<'a> {
    let covariance = fitting.covariances(fit).larger();
    move |p| {
        let i = fit.free.iter().position(|q| *q == p)?;
        Some(standard_error(&covariance, i) / p.of(&fit.body.arm).abs())
    }
}
