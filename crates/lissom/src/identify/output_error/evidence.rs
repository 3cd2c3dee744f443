//! Which parameters beyond the simplest law the residual calls for.

use nalgebra::{DMatrix, DVector};

use super::covariance::Covariances;
use super::normal::{Reduced, inverse};
use super::search::Point;
use super::{Fit, Fitting, Report};
use crate::replay::Parameter;

/// A parameter is called for where it would stand this many deviations from what it is without…
const DEVIATIONS: f64 = 4.0;
/// …and take at least this share of the cost away: what is smaller changes no figure.
const SHARE: f64 = 1e-3;
/// A damper is there when it stands this many deviations from zero.
const THERE: f64 = 2.0;
/// Most parameters added.
const MOST: usize = 4;

/// A parameter that was tried.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extension {
    /// Which.
    pub parameter: Parameter,
    /// Its value where it was added, else the one that a single step promises.
    pub value: f64,
    /// Deviation of that.
    pub std: f64,
    /// Share of the cost that it was expected to take away.
    pub share: f64,
    /// Whether it was added.
    pub added: bool,
}

/// Adds parameters to `free` while the residual calls for one, each time the one that takes most;
/// tells whether it added any.
pub(super) fn extend(
    fitting: &Fitting<'_>,
    fit: &mut Fit,
    free: &mut Vec<Parameter>,
    report: &mut Report,
) -> bool {
    let before = report.extensions.len();
    while report.extensions.len() < MOST {
        let found = promises(fitting, fit, free);
        let called_for = |e: &&Extension| e.value.abs() > DEVIATIONS * e.std && e.share > SHARE;
        let best = found.iter().filter(called_for).max_by(|a, b| a.share.total_cmp(&b.share));
        let Some(best) = best.copied() else { break };
        report.extensions.push(Extension { added: true, ..best });
        free.push(best.parameter);
        fitting.search(fit, free, report);
        replaced(fitting, fit, free, report, best.parameter);
    }
    report.extensions.len() > before
}

/// What is not called for, with the figures of the test.
pub(super) fn refused(fitting: &Fitting<'_>, fit: &Fit, free: &[Parameter]) -> Vec<Extension> {
    promises(fitting, fit, free)
}

/// What one step of a search with each candidate beside `free` promises: score tests, all from one
/// replay.
fn promises(fitting: &Fitting<'_>, fit: &Fit, free: &[Parameter]) -> Vec<Extension> {
    let candidates = candidates(fit, free);
    let all: Vec<Parameter> = free.iter().chain(&candidates).copied().collect();
    let problem = fitting.problem(&all, &fit.noise, false);
    let point = problem.at(fit.point.arm.clone(), fit.point.windows.clone());
    let score = |(i, parameter): (usize, &Parameter)| {
        let kept: Vec<usize> = (0..free.len()).chain([free.len() + i]).collect();
        let sums = point.sums.iter().map(|s| s.of(&kept, all.len())).collect();
        score(&Point { sums, ..point.clone() }, kept.len(), *parameter)
    };
    candidates.iter().enumerate().filter_map(score).collect()
}

/// A mode's other damper goes where the one just added leaves nothing of it.
fn replaced(
    fitting: &Fitting<'_>,
    fit: &mut Fit,
    free: &mut Vec<Parameter>,
    report: &mut Report,
    added: Parameter,
) {
    let other = match added {
        Parameter::DampingGrounded(j) => Parameter::DampingWithin(j),
        Parameter::DampingWithin(j) => Parameter::DampingGrounded(j),
        _ => return,
    };
    let Some(i) = free.iter().position(|p| *p == other) else { return };
    let problem = fitting.problem(free, &fit.noise, false);
    let point = problem.at(fit.point.arm.clone(), fit.point.windows.clone());
    let std = Covariances::at(&point, free.len()).larger()[(i, i)].max(0.0).sqrt();
    if other.of(&fit.point.arm) < THERE * std {
        free.remove(i);
        other.set(&mut fit.point.arm, 0.0);
        fitting.search(fit, free, report);
    }
}

/// What may be added to `free`.
fn candidates(fit: &Fit, free: &[Parameter]) -> Vec<Parameter> {
    let mut all = vec![Parameter::CommandLag, Parameter::ViscousDifference];
    for j in 0..fit.point.arm.modes.len() {
        all.extend([Parameter::DampingWithin(j), Parameter::DampingGrounded(j)]);
    }
    all.retain(|p| !free.contains(p));
    all
}

/// The step that a search would make from `point` in the last of its `shared` parameters.
fn score(point: &Point, shared: usize, parameter: Parameter) -> Option<Extension> {
    let mut normal = DMatrix::zeros(shared, shared);
    let mut right = DVector::zeros(shared);
    for sums in &point.sums {
        let reduced = Reduced::new(sums, shared, 0.0);
        normal += reduced.normal;
        right += reduced.right;
    }
    let step = inverse(&normal) * &right;
    let covariance = Covariances::at(point, shared).larger();
    let last = shared - 1;
    let (value, std) = (step[last], covariance[(last, last)].max(0.0).sqrt());
    let share = right.dot(&step) / point.cost();
    value.is_finite().then_some(Extension { parameter, value, std, share, added: false })
}
