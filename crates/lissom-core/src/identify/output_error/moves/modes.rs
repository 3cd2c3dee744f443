//! Number of modes: modes are added while they make the fit better, and overdamped ones are taken out.

use crate::identify::output_error::engine::covariance::standard_error;
use crate::identify::output_error::model::fit::{ArmFit, Report};
use crate::identify::output_error::model::fitting::Fitting;
use crate::identify::output_error::thresholds::{
    CRITICAL_DAMPING, FIRST_MODE_OSCILLATIONS, MODE_RETUNED, MODE_RETUNED_CLOSELY, NEW_MODE_ABOVE,
    NEW_MODE_DAMPING, NEW_MODE_FREQUENCIES, NEW_MODE_SHARE, NEW_MODE_STARTS, NEW_MODE_TURN,
    PROBE_STEPS, REPETITIONS_MOST, RESIDUAL_ABOVE_NOISE,
};
use crate::identify::responses::thresholds::MODE_DAMPING_MOST;
use crate::identify::thresholds::{PRESENT, REFUSED_ERROR};
use crate::replay::{Body, MOST_MODES, ModalArm, Oscillator, Parameter, free_parameters};

/// Adds modes above the others, up to as many as tips, while each makes the fit better. An axis without tips keeps the mode that
/// it started with.
pub(crate) fn grow_to_tips(fitting: &Fitting<'_>, fit: &mut ArmFit, report: &mut Report) {
    let tips = fitting.campaign.channels.tips.len().min(MOST_MODES);
    let mut grows = true;
    while grows && (1..tips).contains(&fit.body.arm.modes.len()) {
        grows = adds_mode(fitting, fit, report);
    }
}

/// Adds further modes than tips where the residual is above the noise, and over all windows where noise of the command may hide
/// that it is.
pub(crate) fn grow(fitting: &Fitting<'_>, fit: &mut ArmFit, report: &mut Report) {
    grow_to_tips(fitting, fit, report);
    let lacks = |fit: &ArmFit| {
        let hidden = fit.whole_runs && fit.command_noise > 0.0;
        hidden || fitting.beyond_noise(fit) >= RESIDUAL_ABOVE_NOISE
    };
    let most = if fitting.campaign.channels.tips.is_empty() { 0 } else { MOST_MODES };
    let mut grows = true;
    while grows && (1..most).contains(&fit.body.arm.modes.len()) && lacks(fit) {
        retune(fitting, fit, report);
        grows = lacks(fit) && adds_mode(fitting, fit, report);
    }
}

/// Searches again from another frequency of the highest mode where that promises more: a further mode may hide that the search
/// ended in a wrong minimum.
fn retune(fitting: &Fitting<'_>, fit: &mut ArmFit, report: &mut Report) {
    let Some(other) = retuned(fitting, fit) else { return };
    let other = refitted(fitting, other, report);
    if fitting.is_better(&other, fit) {
        *fit = other;
    }
}

/// Searches to the end, and again from another frequency of the highest mode if that promises more.
fn settled(fitting: &Fitting<'_>, start: ArmFit, report: &mut Report) -> ArmFit {
    let found = refitted(fitting, start, report);
    if fitting.beyond_noise(&found) < RESIDUAL_ABOVE_NOISE && is_above_others(&found.body.arm) {
        return found;
    }
    match retuned(fitting, &found) {
        Some(other) => refitted(fitting, other, report),
        None => found,
    }
}

/// Adds a mode above the others if the fit is better with it.
fn adds_mode(fitting: &Fitting<'_>, fit: &mut ArmFit, report: &mut Report) -> bool {
    // A fit at the noise has little to gain.
    let above_noise = fitting.beyond_noise(fit) >= RESIDUAL_ABOVE_NOISE;
    let starts = if above_noise { NEW_MODE_STARTS } else { 1 };
    for start in with_one_more(fitting, fit).into_iter().take(starts) {
        let beyond = settled(fitting, start, report);
        let arm = &beyond.body.arm;
        let oscillates =
            arm.damping_ratios().last().is_some_and(|ratio| *ratio < MODE_DAMPING_MOST);
        if is_above_others(arm) && oscillates && fitting.is_better(&beyond, fit) {
            *fit = beyond;
            return true;
        }
        if fitting.budget.is_spent() {
            break;
        }
    }
    false
}

/// Whether the last mode is clearly above the others, and takes energy.
fn is_above_others(arm: &ModalArm) -> bool {
    let Some((last, others)) = arm.modes.split_last() else { return false };
    let is_damped = arm.damping_ratios().last().is_some_and(|ratio| *ratio > 0.0);
    is_damped && others.iter().all(|mode| last.omega_rad_s > NEW_MODE_ABOVE * mode.omega_rad_s)
}

/// Adds a mode to the initial state of every window: it moves with the motor.
fn begin_undeflected(fit: &mut ArmFit) {
    for window in &mut fit.windows {
        let with_motor = [window.start[0], window.start[1]];
        window.start.extend(with_motor);
    }
}

/// Takes out what is not a mode: of several one that gains energy; overdamped ones, which do not oscillate (a rigid axis that
/// started with a mode has one); one beside another; and, without tips, one that makes hardly an oscillation in a run.
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
    let driven = |fit: &ArmFit| {
        let ratios = fit.body.arm.damping_ratios();
        let several = ratios.len() > 1;
        let surely = |j: usize| {
            let share = known_to(fitting, fit, Parameter::DampingWithin(j));
            share.is_some_and(|share| share < 1.0 / PRESENT)
        };
        (0..ratios.len()).find(|j| several && ratios[*j] < 0.0 && surely(*j))
    };
    while let Some(mode) = driven(fit).or_else(|| beside_another(&fit.body.arm)) {
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

/// A mode so near to another that both are one; the one of less stiffness.
fn beside_another(arm: &ModalArm) -> Option<usize> {
    let modes = &arm.modes;
    let is_one = |i: usize, j: usize| {
        let [a, b] = [i, j].map(|k| modes[k].omega_rad_s);
        i != j
            && a.max(b) < NEW_MODE_ABOVE * a.min(b)
            && modes[i].stiffness_nm_per_rad <= modes[j].stiffness_nm_per_rad
    };
    (0..modes.len()).find(|i| (0..modes.len()).any(|j| is_one(*i, j)))
}

/// Takes the stiffness out of modes above the first whose stiffness is not known to be more than nothing, where the arm is not
/// worse or the standard error exceeds it, and out of overdamped ones: the tips show them, and the motor does not. Their inertia
/// is then part of that of the motor.
pub(crate) fn lighten(fitting: &Fitting<'_>, fit: &mut ArmFit, report: &mut Report) {
    for mode in (0..fit.body.arm.modes.len()).rev() {
        let of_beam = fit.body.arm.modes.iter().filter(|m| m.stiffness_nm_per_rad > 0.0).count();
        let Some(known) = known_to(fitting, fit, Parameter::Stiffness(mode)) else { continue };
        let overdamped = fit.body.arm.damping_ratios()[mode] >= CRITICAL_DAMPING;
        if of_beam < 2 || (known < 1.0 / PRESENT && !overdamped) {
            continue;
        }
        let mut light = fit.clone();
        light.body.masses = None;
        light.body.arm.modes[mode].stiffness_nm_per_rad = 0.0;
        light.free.retain(|p| *p != Parameter::Stiffness(mode));
        fitting.search(&mut light, report);
        if overdamped || known > REFUSED_ERROR || fitting.is_better(&light, fit) {
            *fit = light;
        }
    }
}

/// Relative standard error of a free parameter.
fn known_to(fitting: &Fitting<'_>, fit: &ArmFit, parameter: Parameter) -> Option<f64> {
    let at = fit.free.iter().position(|p| *p == parameter)?;
    let covariance = fitting.covariances(fit).larger();
    Some(standard_error(&covariance, at) / parameter.of(&fit.body.arm).abs())
}

/// Takes out one mode. Its stiffness and its share in each tip's motion go to the mode nearest to it.
fn without_mode(fit: &ArmFit, mode: usize) -> ArmFit {
    let mut fit = fit.clone();
    fit.body.masses = None;
    let arm = &mut fit.body.arm;
    without_points(arm);
    let gone = arm.modes.remove(mode);
    let apart = |j: &usize| (arm.modes[*j].omega_rad_s / gone.omega_rad_s).ln().abs();
    let nearest = (0..arm.modes.len()).min_by(|a, b| apart(a).total_cmp(&apart(b)));
    for row in &mut arm.shapes {
        let share = row.remove(mode);
        if let Some(j) = nearest {
            row[j] += share;
        }
    }
    if let Some(j) = nearest {
        arm.modes[j].stiffness_nm_per_rad += gone.stiffness_nm_per_rad;
    }
    for window in &mut fit.windows {
        window.start.drain(2 + 2 * mode..4 + 2 * mode);
    }
    fit
}

/// Gives the damping of dampers at points to the modes.
fn without_points(arm: &mut ModalArm) {
    if arm.at_points_per_s.is_empty() {
        return;
    }
    for (j, ratio) in arm.damping_ratios().into_iter().enumerate() {
        let mode = &mut arm.modes[j];
        mode.grounded_per_s = 2.0 * ratio * mode.omega_rad_s - mode.within_per_s;
    }
    arm.at_points_per_s.clear();
}

/// Searches again with the free parameters of the fit's modes.
fn refitted(fitting: &Fitting<'_>, fit: ArmFit, report: &mut Report) -> ArmFit {
    let mut fit = refreed(fitting, fit);
    fitting.search(&mut fit, report);
    fit
}

/// Sets the free parameters to those of the fit's modes. Dampers beyond those within the beam, lags, and viscous friction by
/// direction stay.
fn refreed(fitting: &Fitting<'_>, mut fit: ArmFit) -> ArmFit {
    let beside = |p: &Parameter| {
        matches!(p, Parameter::CommandLag | Parameter::ViscousDifference | Parameter::TipLag(_))
    };
    let extra: Vec<Parameter> = fit.free.iter().copied().filter(beside).collect();
    fit.free = free_parameters(&fitting.campaign.channels, &fit.body.arm);
    fit.free.extend(extra);
    let grounded = fit.body.arm.modes.iter().enumerate().filter(|(_, m)| m.grounded_per_s != 0.0);
    fit.free.extend(grounded.map(|(j, _)| Parameter::DampingGrounded(j)));
    let at_points = fit.body.arm.at_points_per_s.iter().enumerate().filter(|(_, c)| **c != 0.0);
    fit.free.extend(at_points.map(|(i, _)| Parameter::DampingAtPoint(i)));
    fit
}

/// Fits with a mode above all others, the likeliest first.
///
/// A search that begins at a wrong frequency of the new mode ends in a wrong minimum. So short searches on a part of the windows
/// begin at each mode that the tips' responses show and at each of some further frequencies.
fn with_one_more(fitting: &Fitting<'_>, fit: &ArmFit) -> Vec<ArmFit> {
    let last = highest(&fit.body.arm);
    let mut found: Vec<(f64, ArmFit)> = Vec::new();
    let omega_rad_s = fit.body.arm.modes[last].omega_rad_s;
    let shown = fitting.shown_rad_s.iter().map(|shown| shown / omega_rad_s);
    let tried = shown.filter(|times| *times > NEW_MODE_ABOVE).chain(NEW_MODE_FREQUENCIES);
    for start in tried.flat_map(|times| one_beyond(fitting, fit, last, times * omega_rad_s)) {
        let start = refreed(fitting, start);
        let probed = fitting.probe(&start, PROBE_STEPS);
        if let Some((cost, body)) = probed.filter(|(_, body)| is_above_others(&body.arm)) {
            found.push((cost, ArmFit { body, ..start }));
        }
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    found.into_iter().map(|(_, fit)| fit).collect()
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
    short.body = Body::of_masses(&fitting.campaign.channels, undamped(fit.body.arm.clone()));
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

/// Starts with a mode at this frequency. Where the residual is above the noise, the mode `last` may represent several: the new one
/// takes a part of it, with either sign of what the tips see. Elsewhere its inertia is in the motor's, with which a mode moves that
/// is not modelled, and the tips hardly see it.
fn one_beyond(fitting: &Fitting<'_>, fit: &ArmFit, last: usize, omega_rad_s: f64) -> Vec<ArmFit> {
    let mut fit = fit.clone();
    fit.body.masses = None;
    let arm = &mut fit.body.arm;
    without_points(arm);
    let stiffness = NEW_MODE_SHARE * arm.modes[last].stiffness_nm_per_rad;
    arm.modes.push(Oscillator {
        omega_rad_s,
        stiffness_nm_per_rad: stiffness,
        // It must not ring for long, because its frequency is hardly known.
        within_per_s: 2.0 * NEW_MODE_DAMPING * omega_rad_s,
        grounded_per_s: 0.0,
    });
    arm.shapes.iter_mut().for_each(|row| row.push(0.0));
    begin_undeflected(&mut fit);
    let new = fit.body.arm.modes.len() - 1;
    let split = |sign: f64| {
        let mut fit = fit.clone();
        let arm = &mut fit.body.arm;
        arm.modes[last].stiffness_nm_per_rad -= stiffness;
        for row in &mut arm.shapes {
            row[new] = sign * NEW_MODE_SHARE * row[last];
            row[last] -= row[new];
        }
        fit
    };
    let masses = Body::of_masses(&fitting.campaign.channels, split(1.0).body.arm);
    if masses.masses.is_some() {
        let turned = |sign: f64| masses.clone().turned(last, new, sign * NEW_MODE_TURN);
        return [1.0, -1.0].map(|sign| ArmFit { body: turned(sign), ..fit.clone() }).into();
    }
    if fitting.beyond_noise(&fit) >= RESIDUAL_ABOVE_NOISE {
        return [1.0, -1.0].map(split).into();
    }
    let arm = &mut fit.body.arm;
    let inertia = (stiffness / omega_rad_s.powi(2)).min(NEW_MODE_SHARE * arm.inertia_kg_m2);
    arm.inertia_kg_m2 -= inertia;
    if let Some(mode) = arm.modes.last_mut() {
        mode.stiffness_nm_per_rad = inertia * omega_rad_s.powi(2);
    }
    vec![fit]
}
