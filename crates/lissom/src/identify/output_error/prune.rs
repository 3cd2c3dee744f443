//! Modes that the runs do not show go.

use super::covariance::Covariances;
use super::start::free_parameters;
use super::{Fit, Fitting, Report};
use crate::replay::{ModalArm, Oscillator, Parameter};

/// A mode is in doubt whose stiffness is not this many deviations from zero…
const DEVIATIONS: f64 = 5.0;
/// …or whose frequency is not known to this share.
const FREQUENCY: f64 = 0.02;
/// A mode put beyond the others begins at this many times the highest, with this share of the coupling.
const BEYOND: f64 = 3.0;
const BEYOND_SHARE: f64 = 0.1;
/// It goes where the cost rises by no more than this share without it.
const SHARE: f64 = 2e-3;

/// Takes out one mode in doubt after another, as long as the residual allows it.
pub(super) fn modes(
    fitting: &Fitting<'_>,
    fit: &mut Fit,
    free: &mut Vec<Parameter>,
    report: &mut Report,
) {
    while fit.point.arm.modes.len() > 1 {
        let Some(mode) = doubtful(fitting, fit, free) else { return };
        let mut without = fit.clone();
        without.point.arm = less(&fit.point.arm, mode);
        for window in &mut without.point.windows {
            window.start.drain(2 + 2 * mode..4 + 2 * mode);
        }
        let mut fewer = free_parameters(fitting.campaign, &without.point.arm);
        let extra = [Parameter::CommandLag, Parameter::ViscousDifference];
        fewer.extend(extra.into_iter().filter(|p| free.contains(p)));
        fitting.search(&mut without, &fewer, report);
        let at_noise_of = |other: &Fit, free: &[Parameter]| {
            let problem = fitting.problem(free, &fit.noise, false);
            problem.at(other.point.arm.clone(), other.point.windows.clone()).cost()
        };
        let before = at_noise_of(fit, free);
        if at_noise_of(&without, &fewer) <= before * (1.0 + SHARE) {
            *fit = without;
            *free = fewer;
            continue;
        }
        // It stands for something: for a mode beyond the others, perhaps.
        let mut beyond = without;
        put_beyond(&mut beyond);
        let mut free_beyond = free_parameters(fitting.campaign, &beyond.point.arm);
        free_beyond.extend(fewer.iter().filter(|p| extra.contains(p)));
        fitting.search(&mut beyond, &free_beyond, report);
        if at_noise_of(&beyond, &free_beyond) > before * (1.0 - SHARE) {
            return;
        }
        *fit = beyond;
        *free = free_beyond;
    }
}

/// Adds a mode above all others that no tip shows yet.
fn put_beyond(fit: &mut Fit) {
    let arm = &mut fit.point.arm;
    let highest = arm.modes.iter().map(|m| m.omega_rad_s).fold(0.0, f64::max);
    let coupling = arm.coupling_nm_per_rad();
    arm.modes.push(Oscillator {
        omega_rad_s: BEYOND * highest,
        stiffness_nm_per_rad: BEYOND_SHARE * coupling,
        within_per_s: 0.0,
        grounded_per_s: 0.0,
    });
    arm.shapes.iter_mut().for_each(|row| row.push(0.0));
    for window in &mut fit.point.windows {
        let still = [window.start[0], window.start[1]];
        window.start.extend(still);
    }
}

/// The mode that stands least.
fn doubtful(fitting: &Fitting<'_>, fit: &Fit, free: &[Parameter]) -> Option<usize> {
    let problem = fitting.problem(free, &fit.noise, false);
    let point = problem.at(fit.point.arm.clone(), fit.point.windows.clone());
    let covariance = Covariances::at(&point, free.len()).larger();
    let relative = |p: Parameter| {
        let i = free.iter().position(|q| *q == p)?;
        Some(covariance[(i, i)].max(0.0).sqrt() / p.of(&fit.point.arm).abs())
    };
    let doubt = |j: usize| {
        let stiffness = relative(Parameter::Stiffness(j))? * DEVIATIONS;
        let frequency = relative(Parameter::Frequency(j))? / FREQUENCY;
        Some((j, stiffness.max(frequency)))
    };
    let all = (0..fit.point.arm.modes.len()).filter_map(doubt);
    all.filter(|(_, d)| *d > 1.0).max_by(|a, b| a.1.total_cmp(&b.1)).map(|(j, _)| j)
}

/// The arm without one of its modes; the rest of Σr = 1 goes to the last that is left.
fn less(arm: &ModalArm, mode: usize) -> ModalArm {
    let mut arm = arm.clone();
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
    arm
}
