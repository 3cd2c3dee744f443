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
/// Most groups added at a time.
const MOST: usize = 3;

/// A parameter that was tried.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extension {
    /// Which.
    pub parameter: Parameter,
    /// Its value where it was added, else the one that a single step promises.
    pub value: f64,
    /// Deviation of that.
    pub std: f64,
    /// Share of the cost that it, or its group, was expected to take away.
    pub share: f64,
    /// Whether it was added.
    pub added: bool,
}

/// Adds parameters to `free` while the residual calls for some, each time the group that takes most;
/// tells whether it added any.
pub(super) fn extend(
    fitting: &Fitting<'_>,
    fit: &mut Fit,
    free: &mut Vec<Parameter>,
    report: &mut Report,
) -> bool {
    let mut added = false;
    for _ in 0..MOST {
        let found = promises(fitting, fit, free);
        let called_for = |group: &&Vec<Extension>| {
            group.iter().any(|e| e.value.abs() > DEVIATIONS * e.std && e.share > SHARE)
        };
        let share = |group: &Vec<Extension>| group.first().map_or(0.0, |e| e.share);
        let best = found.iter().filter(called_for).max_by(|a, b| share(a).total_cmp(&share(b)));
        let Some(best) = best else { break };
        added = true;
        report.extensions.extend(best.iter().map(|e| Extension { added: true, ..*e }));
        free.extend(best.iter().map(|e| e.parameter));
        fitting.search(fit, free, report);
        drop_dampers(fitting, fit, free, report);
    }
    added
}

/// What is not called for, with the figures of the test.
pub(super) fn refused(fitting: &Fitting<'_>, fit: &Fit, free: &[Parameter]) -> Vec<Extension> {
    promises(fitting, fit, free).into_iter().flatten().collect()
}

/// What one step of a search with each group beside `free` promises: score tests, all from one
/// replay.
fn promises(fitting: &Fitting<'_>, fit: &Fit, free: &[Parameter]) -> Vec<Vec<Extension>> {
    let groups = candidates(fit, free);
    let all: Vec<Parameter> = free.iter().chain(groups.iter().flatten()).copied().collect();
    let problem = fitting.problem(&all, &fit.noise, false);
    let point = problem.at(fit.point.arm.clone(), fit.point.windows.clone());
    let mut first = free.len();
    let mut found = Vec::new();
    for group in groups {
        let kept: Vec<usize> = (0..free.len()).chain(first..first + group.len()).collect();
        first += group.len();
        let sums = point.sums.iter().map(|s| s.of(&kept, all.len())).collect();
        found.push(score(&Point { sums, ..point.clone() }, free.len(), &group));
    }
    found
}

/// Dampers that others beside them leave nothing of go.
fn drop_dampers(
    fitting: &Fitting<'_>,
    fit: &mut Fit,
    free: &mut Vec<Parameter>,
    report: &mut Report,
) {
    let damper = |p: &Parameter| {
        matches!(
            p,
            Parameter::DampingWithin(_)
                | Parameter::DampingGrounded(_)
                | Parameter::DampingAtPoint(_)
        )
    };
    if free.iter().filter(|p| damper(p)).count() <= fit.point.arm.modes.len() {
        return;
    }
    let problem = fitting.problem(free, &fit.noise, false);
    let point = problem.at(fit.point.arm.clone(), fit.point.windows.clone());
    let covariance = Covariances::at(&point, free.len()).larger();
    let std = |i: usize| covariance[(i, i)].max(0.0).sqrt();
    let gone: Vec<Parameter> = (0..free.len())
        .filter(|&i| damper(&free[i]) && free[i].of(&fit.point.arm) < THERE * std(i))
        .map(|i| free[i])
        .collect();
    if gone.is_empty() {
        return;
    }
    free.retain(|p| !gone.contains(p));
    for p in gone {
        p.set(&mut fit.point.arm, 0.0);
    }
    fitting.search(fit, free, report);
}

/// Groups of parameters that may be added to `free`, each as a whole.
fn candidates(fit: &Fit, free: &[Parameter]) -> Vec<Vec<Parameter>> {
    let arm = &fit.point.arm;
    let modes = 0..arm.modes.len();
    let mut groups = vec![vec![Parameter::CommandLag], vec![Parameter::ViscousDifference]];
    groups.push(modes.clone().map(Parameter::DampingWithin).collect());
    groups.push(if arm.at_points_per_s.is_empty() {
        modes.map(Parameter::DampingGrounded).collect()
    } else {
        modes.map(Parameter::DampingAtPoint).collect()
    });
    for group in &mut groups {
        group.retain(|p| !free.contains(p));
    }
    groups.retain(|group| !group.is_empty());
    groups
}

/// The step that a search would make from `point` in the parameters of `group`, which follow
/// `before` others.
fn score(point: &Point, before: usize, group: &[Parameter]) -> Vec<Extension> {
    let shared = before + group.len();
    let mut normal = DMatrix::zeros(shared, shared);
    let mut right = DVector::zeros(shared);
    for sums in &point.sums {
        let reduced = Reduced::new(sums, shared, 0.0);
        normal += reduced.normal;
        right += reduced.right;
    }
    let step = inverse(&normal) * &right;
    let covariance = Covariances::at(point, shared).larger();
    let share = right.dot(&step) / point.cost();
    let figure = |(k, parameter): (usize, &Parameter)| {
        let i = before + k;
        let (value, std) = (step[i], covariance[(i, i)].max(0.0).sqrt());
        Extension { parameter: *parameter, value, std, share, added: false }
    };
    group.iter().enumerate().map(figure).filter(|e| e.value.is_finite()).collect()
}
