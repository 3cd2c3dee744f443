//! Modes that the runs do not show go.

use super::covariance::Covariances;
use super::start::free_parameters;
use super::{Fit, Fitting, Report};
use crate::replay::{ModalArm, Parameter};

/// A mode is in doubt whose stiffness is not this many deviations from zero…
const DEVIATIONS: f64 = 5.0;
/// …or whose frequency is not known to this share.
const FREQUENCY: f64 = 0.02;
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
        // Both costs at the noise of the fuller arm.
        let problem = fitting.problem(&fewer, &fit.noise, false);
        let arm = without.point.arm.clone();
        let cost = problem.at(arm, without.point.windows.clone()).cost();
        if cost > fit.point.cost() * (1.0 + SHARE) {
            return;
        }
        *fit = without;
        *free = fewer;
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
        oscillator.grounded_per_s =
            2.0 * ratio * oscillator.omega_rad_s - oscillator.within_per_s;
    }
    arm.at_points_per_s.clear();
    arm.modes.remove(mode);
    for row in &mut arm.shapes {
        let gone = row.remove(mode);
        row.last_mut().into_iter().for_each(|r| *r += gone);
    }
    arm
}
