//! What one step of a search with further parameters promises: score tests, all from one replay.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use crate::identify::methods::output_error::covariance::{Covariances, deviation};
use crate::identify::methods::output_error::fit::{Extension, Fit};
use crate::identify::methods::output_error::fitting::Fitting;
use crate::identify::thresholds::{CLEARLY_PRESENT, PRESENT};
use crate::information::{inverse, normal_equations};
use crate::replay::{Parameter, WindowSums};

/// What one step of a search with each of some groups beside the free parameters promises.
pub(super) fn scores(
    fitting: &Fitting<'_>,
    fit: &Fit,
    groups: &[Vec<Parameter>],
) -> Vec<Vec<Extension>> {
    all_scores(fitting, fit, groups).1.into_iter().map(|promise| promise.group).collect()
}

/// Share of the cost that a group takes.
pub(super) fn share(group: &[Extension]) -> f64 {
    group.first().map_or(0.0, |e| e.share)
}

/// What a group of parameters promises.
pub(super) struct Promise {
    pub(super) group: Vec<Extension>,
    /// Square of how many deviations all of the group together stand from zero, `vᵀ·C⁻¹·v`.
    together: f64,
    /// Change of the coordinates that are free without it, beside the change without it.
    pub(super) moved: DVector<f64>,
    /// The same by each of the group, per unit.
    pub(super) slopes: DMatrix<f64>,
    /// What the samples know of the group, the inverse of its covariance.
    information: DMatrix<f64>,
}

impl Promise {
    pub(super) fn share(&self) -> f64 {
        share(&self.group)
    }

    /// Whether the group is there, though each of it may be nothing beside the others: dampers of several modes say.
    pub(super) fn stands_together(&self) -> bool {
        self.together > CLEARLY_PRESENT * CLEARLY_PRESENT * self.group.len() as f64
    }

    /// The most that a parameter of the group stands from zero, in its deviations.
    pub(super) fn deviations(&self) -> f64 {
        let of = |e: &Extension| if e.std > 0.0 { (e.value / e.std).abs() } else { 0.0 };
        self.group.iter().map(of).fold(0.0, f64::max)
    }

    /// How likely `other` values are beside none, both held for as likely beforehand.
    pub(super) fn instead(&self, other: &DVector<f64>) -> f64 {
        let values = DVector::from_iterator(self.group.len(), self.group.iter().map(|e| e.value));
        let off = |v: &DVector<f64>| v.dot(&(&self.information * v));
        1.0 / (1.0 + (0.5 * (off(&(other - &values)) - off(&values))).exp())
    }

    /// How likely the group is to be there: `1/(1 + exp((9 − d²)/2))`. The likelihoods' ratio is
    /// exp(d²/2), and beforehand a group is held for as rare as lets d = 3 decide nothing.
    pub(super) fn likelihood(&self) -> f64 {
        1.0 / (1.0 + (0.5 * (PRESENT * PRESENT - self.deviations().powi(2))).exp())
    }
}

/// Sums by what is free, and what each group promises beside: from one replay.
pub(super) fn all_scores(
    fitting: &Fitting<'_>,
    fit: &Fit,
    groups: &[Vec<Parameter>],
) -> (Vec<WindowSums>, Vec<Promise>) {
    let free = fit.coordinates();
    let all: Vec<Parameter> = fit.free.iter().chain(groups.iter().flatten()).copied().collect();
    let point = fitting.point(fit, &all);
    let first_of_windows = fit.body.coordinates(&all).len();
    let own: Vec<usize> = (0..free).collect();
    let without: Vec<WindowSums> =
        point.sums.iter().map(|s| s.of(&own, first_of_windows)).collect();
    let alone = Promised::of(&without, free);
    let of_group = |(i, group): (usize, &Vec<Parameter>)| {
        let first = free + groups[..i].iter().map(Vec::len).sum::<usize>();
        let kept: Vec<usize> = (0..free).chain(first..first + group.len()).collect();
        let sums: Vec<WindowSums> =
            point.sums.iter().map(|s| s.of(&kept, first_of_windows)).collect();
        score(&sums, free, group, &alone)
    };
    let found = groups.par_iter().with_max_len(1).enumerate().map(of_group).collect();
    (without, found)
}

/// One step of a search in all coordinates.
pub(super) struct Promised {
    step: DVector<f64>,
    /// Of the normal matrix.
    inverse: DMatrix<f64>,
    /// Share of the cost that it promises to take.
    pub(super) share: f64,
}

impl Promised {
    /// In the first `shared` coordinates.
    pub(super) fn of(sums: &[WindowSums], shared: usize) -> Self {
        let (normal, right) = normal_equations(sums, shared);
        let inverse = inverse(&normal);
        let step = &inverse * &right;
        let share = right.dot(&step) / sums.iter().map(|s| s.cost).sum::<f64>();
        Self { step, inverse, share }
    }
}

/// The step that a search would make in the parameters of `group`, which follow `before` others that
/// promise `alone` by themselves.
fn score(sums: &[WindowSums], before: usize, group: &[Parameter], alone: &Promised) -> Promise {
    let shared = before + group.len();
    let Promised { step, share, inverse: known } = Promised::of(sums, shared);
    let covariance = Covariances::at(sums, shared).larger();
    let share = share - alone.share;
    let figure = |(k, parameter): (usize, &Parameter)| {
        let (value, std) = (step[before + k], deviation(&covariance, before + k));
        Extension { parameter: *parameter, value, std, share, added: false }
    };
    let finite = |e: &Extension| e.value.is_finite() && e.share.is_finite();
    let values = step.rows(before, group.len());
    let own = covariance.view((before, before), (group.len(), group.len()));
    let information = inverse(&own.into_owned());
    let beside = known.view((0, before), (before, group.len()));
    let of_group = known.view((before, before), (group.len(), group.len())).into_owned();
    Promise {
        together: values.dot(&(&information * values)),
        slopes: beside * inverse(&of_group),
        information,
        group: group.iter().enumerate().map(figure).filter(finite).collect(),
        moved: step.rows(0, before) - &alone.step,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two dampers whose readings are nearly the same; what they have in common is ten deviations from zero, and each
    /// less than one, since the other may stand for it.
    #[test]
    fn twins_stand_together() {
        let (alike, shown) = (0.99, 10.0);
        let rows = [1.0, alike, shown, alike, 1.0, shown, shown, shown, 1e4];
        let gram = DMatrix::from_row_slice(3, 3, &rows);
        let sums = WindowSums {
            gram,
            blocks: Vec::new(),
            squares: vec![1e4],
            readings: vec![10_000],
            cost: 1e4,
            slopes: 1.0,
            curvatures: 1.0,
            samples: 10_000,
        };
        let sums = [sums];
        let alone = Promised::of(&sums, 0);
        let found = |group: &[Parameter]| {
            let kept: Vec<usize> = (0..group.len()).collect();
            score(&sums.each_ref().map(|s| s.of(&kept, 2)), 0, group, &alone)
        };
        let twins = found(&[Parameter::DampingAtPoint(0), Parameter::DampingAtPoint(1)]);
        assert!(twins.deviations() < 1.0, "{}", twins.deviations());
        assert!((twins.together - 100.0 * 2.0 / (1.0 + alike)).abs() < 0.1, "{}", twins.together);
        assert!(twins.stands_together());
        let one = found(&[Parameter::DampingAtPoint(0)]);
        assert!((one.deviations() - shown).abs() < 0.01 && one.stands_together());
    }
}
