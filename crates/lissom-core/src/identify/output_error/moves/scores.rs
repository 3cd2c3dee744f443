//! Score tests: the expected result of one step of a search with further parameters, for all groups from one replay.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use crate::identify::output_error::engine::covariance::{Covariances, standard_error};
use crate::identify::output_error::model::fit::{ArmFit, Extension};
use crate::identify::output_error::model::fitting::Fitting;
use crate::identify::thresholds::{CLEARLY_PRESENT, PRESENT};
use crate::information::{inverse, normal_equations};
use crate::replay::{Parameter, WindowSums};

/// Expected result of adding a group of parameters.
pub(crate) struct Promise {
    pub(crate) group: Vec<Extension>,
    /// Squared distance of the whole group from zero in standard errors, `vᵀ·C⁻¹·v`.
    together: f64,
    /// Change of the other coordinates, relative to a step without the group.
    pub(crate) moved: DVector<f64>,
    /// The same for a unit of each parameter of the group.
    pub(crate) slopes: DMatrix<f64>,
    /// Information on the group: the inverse of its covariance.
    information: DMatrix<f64>,
}

impl Promise {
    pub(crate) fn share(&self) -> f64 {
        self.group.first().map_or(0.0, |e| e.share)
    }

    /// Whether the group as a whole is significant. Single parameters of it may not be, such as dampers of several
    /// modes.
    pub(crate) fn stands_together(&self) -> bool {
        self.together > CLEARLY_PRESENT * CLEARLY_PRESENT * self.group.len() as f64
    }

    /// Largest distance of a parameter of the group from zero, in its standard errors.
    pub(crate) fn standard_errors(&self) -> f64 {
        let of = |e: &Extension| if e.std > 0.0 { (e.value / e.std).abs() } else { 0.0 };
        self.group.iter().map(of).fold(0.0, f64::max)
    }

    /// Probability of the values `other` compared with zero, if both are equally likely beforehand.
    pub(crate) fn instead(&self, other: &DVector<f64>) -> f64 {
        let values = DVector::from_iterator(self.group.len(), self.group.iter().map(|e| e.value));
        let off = |v: &DVector<f64>| v.dot(&(&self.information * v));
        1.0 / (1.0 + (0.5 * (off(&(other - &values)) - off(&values))).exp())
    }

    /// Probability that the group is present, `1/(1 + exp((9 − d²)/2))`, where d is the distance from zero in
    /// standard errors. The ratio of the likelihoods is exp(d²/2). The prior is such that d = 3 gives one half.
    pub(crate) fn likelihood(&self) -> f64 {
        1.0 / (1.0 + (0.5 * (PRESENT * PRESENT - self.standard_errors().powi(2))).exp())
    }
}

/// Sums by the free coordinates, and the expected result of each group, from one replay.
pub(crate) fn all_scores(
    fitting: &Fitting<'_>,
    fit: &ArmFit,
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
pub(crate) struct Promised {
    step: DVector<f64>,
    /// Inverse of the normal matrix.
    inverse: DMatrix<f64>,
    /// Share by which it is expected to lower the cost.
    pub(crate) share: f64,
}

impl Promised {
    /// In the first `shared` coordinates.
    pub(crate) fn of(sums: &[WindowSums], shared: usize) -> Self {
        let (normal, right) = normal_equations(sums, shared);
        let inverse = inverse(&normal);
        let step = &inverse * &right;
        let share = right.dot(&step) / sums.iter().map(|s| s.cost).sum::<f64>();
        Self { step, inverse, share }
    }
}

/// The step that a search would make in the parameters of `group`, which follow `before` others. `alone` is the step
/// in those others only.
fn score(sums: &[WindowSums], before: usize, group: &[Parameter], alone: &Promised) -> Promise {
    let shared = before + group.len();
    let Promised { step, share, inverse: known } = Promised::of(sums, shared);
    let covariance = Covariances::at(sums, shared).larger();
    let share = share - alone.share;
    let estimate = |(k, parameter): (usize, &Parameter)| {
        let (value, std) = (step[before + k], standard_error(&covariance, before + k));
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
        group: group.iter().enumerate().map(estimate).filter(finite).collect(),
        moved: step.rows(0, before) - &alone.step,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two dampers whose readings are nearly the same. Their sum is ten standard errors from zero, and each is less
    /// than one from zero, since the other can replace it.
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
        assert!(twins.standard_errors() < 1.0, "{}", twins.standard_errors());
        assert!((twins.together - 100.0 * 2.0 / (1.0 + alike)).abs() < 0.1, "{}", twins.together);
        assert!(twins.stands_together());
        let one = found(&[Parameter::DampingAtPoint(0)]);
        assert!((one.standard_errors() - shown).abs() < 0.01 && one.stands_together());
    }
}
