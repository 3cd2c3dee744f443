//! Terms whose presence the logs do not decide, and the kind of damping: what they add to the standard errors.

use nalgebra::{DMatrix, DVector};

use crate::identify::output_error::model::fit::{ArmFit, Extension};
use crate::identify::output_error::model::fitting::Fitting;
use crate::identify::output_error::moves::extend::candidates;
use crate::identify::output_error::moves::scores::all_scores;
use crate::identify::output_error::thresholds::{
    OTHER_DAMPING_FELT, OTHER_DAMPING_LIKELY, OTHER_DAMPING_REPORTED,
};
use crate::identify::thresholds::SIGN_SHOWN;
use crate::replay::{Parameter, WindowSums};

/// Smallest singular value that is used: a floor against rounding.
const ROUNDING: f64 = 1e-12;

/// Terms that the logs do not decide.
pub(crate) struct Undecided {
    /// Sums by the free coordinates.
    pub(crate) sums: Vec<WindowSums>,
    /// Change of the free parameters by each group that is not free, times the root of the probability that the group
    /// is present. Outer products of these are added to the covariance, which is then the mean over both cases.
    moved: Vec<DVector<f64>>,
    /// Damping of another kind.
    by_kind: Vec<OtherKind>,
}

/// Parameters and their covariance.
pub(crate) struct KnownParameters {
    /// The free parameters, then dampers of another kind that may be present instead.
    pub(crate) parameters: Vec<Parameter>,
    pub(crate) covariance: DMatrix<f64>,
    /// Free parameters whose standard errors are much larger because the kind of damping is not known.
    pub(crate) open_by_damping: Vec<Parameter>,
}

impl Undecided {
    /// Adds the undecided terms to the covariance `decided` of the free parameters.
    pub(crate) fn known(&self, free: &[Parameter], decided: DMatrix<f64>) -> KnownParameters {
        let mut covariance = decided;
        for moved in &self.moved {
            covariance.ger(1.0, moved, moved, 1.0);
        }
        let before = covariance.diagonal();
        let felt: Vec<&OtherKind> = self.by_kind.iter().filter(|o| o.is_felt(&before)).collect();
        let mut parameters = free.to_vec();
        for (parameter, _) in felt.iter().flat_map(|other| &other.dampers) {
            if !parameters.contains(parameter) {
                parameters.push(*parameter);
            }
        }
        covariance.resize_mut(parameters.len(), parameters.len(), 0.0);
        for other in felt {
            let root = other.root(&parameters);
            covariance.ger(1.0, &root, &root, 1.0);
        }
        let longer =
            |i: &usize| (covariance[(*i, *i)] / before[*i]).sqrt() >= OTHER_DAMPING_REPORTED;
        let open_by_damping = (0..free.len()).filter(longer).map(|i| free[i]).collect();
        KnownParameters { parameters, covariance, open_by_damping }
    }
}

/// Dampers of one kind in place of those that are free.
struct OtherKind {
    /// The dampers and their values.
    dampers: Vec<(Parameter, f64)>,
    /// Change of the free parameters.
    moved: DVector<f64>,
    /// Probability compared with the dampers that are free, if both are equally likely beforehand.
    likely: f64,
}

impl OtherKind {
    fn counts(&self) -> bool {
        let values = self.dampers.iter().map(|(_, value)| value);
        let finite = self.moved.iter().chain(values).all(|v| v.is_finite());
        finite && self.likely > OTHER_DAMPING_LIKELY
    }

    /// Whether it makes some free parameter less certain; `variances` are those without it.
    fn is_felt(&self, variances: &DVector<f64>) -> bool {
        let mut each = self.moved.iter().zip(variances.iter());
        each.any(|(moved, variance)| self.likely * moved * moved > OTHER_DAMPING_FELT * variance)
    }

    /// What it adds to the covariance of `parameters`, of which the free ones come first: a vector whose outer
    /// product is added.
    fn root(&self, parameters: &[Parameter]) -> DVector<f64> {
        let mut root = DVector::zeros(parameters.len());
        root.rows_mut(0, self.moved.len()).copy_from(&self.moved);
        for (parameter, value) in &self.dampers {
            if let Some(i) = parameters.iter().position(|p| p == parameter) {
                root[i] = *value;
            }
        }
        root * self.likely.sqrt()
    }
}

/// Groups that are not free and whose presence the samples do not decide.
pub(crate) fn undecided(fitting: &Fitting<'_>, fit: &ArmFit) -> Undecided {
    let (sums, promises) = all_scores(fitting, fit, &candidates(fitting, fit));
    let jacobian = fit.body.jacobian(&fit.free);
    let speaking = promises.iter().filter(|p| p.standard_errors() > SIGN_SHOWN);
    let weighed = speaking.map(|p| {
        let moved = &p.moved * p.likelihood().sqrt();
        jacobian.as_ref().map_or(moved.clone(), |jacobian| jacobian * moved)
    });
    let of_kind = promises.iter().flat_map(|p| {
        let slopes = jacobian.as_ref().map_or(p.slopes.clone(), |jacobian| jacobian * &p.slopes);
        let whole = in_place_of_others(fit, &p.group, &slopes);
        // All dampers of the group, and each alone if there are several.
        let each = whole.iter().flat_map(|all| {
            let several = if all.len() > 1 { all.len() } else { 0 };
            let only = |k| DVector::from_fn(all.len(), |i, _| if i == k { all[k] } else { 0.0 });
            (0..several).map(only)
        });
        let others = whole.iter().cloned().chain(each).map(|values| {
            let likely = p.instead(&values);
            let there = p.group.iter().zip(&values).filter(|(_, value)| **value != 0.0);
            let dampers = there.map(|(e, value)| (e.parameter, *value)).collect();
            OtherKind { dampers, moved: &slopes * &values, likely }
        });
        others.filter(OtherKind::counts).collect::<Vec<_>>()
    });
    Undecided { moved: weighed.collect(), by_kind: of_kind.collect(), sums }
}

/// Values of a group's dampers if they replace all others \[1/s\]: those for which the free ones become zero, to
/// first order. `slopes` has the changes of the free parameters by each of the group. `None` for other groups.
fn in_place_of_others(
    fit: &ArmFit,
    group: &[Extension],
    slopes: &DMatrix<f64>,
) -> Option<DVector<f64>> {
    let is_damper = |p: &Parameter| {
        use Parameter::{DampingAtPoint, DampingGrounded, DampingWithin};
        matches!(p, DampingWithin(_) | DampingGrounded(_) | DampingAtPoint(_))
    };
    let others: Vec<usize> = (0..fit.free.len()).filter(|i| is_damper(&fit.free[*i])).collect();
    if others.is_empty() || !group.iter().all(|e| is_damper(&e.parameter)) {
        return None;
    }
    let now = DVector::from_fn(others.len(), |i, _| fit.free[others[i]].of(&fit.body.arm));
    let falls = DMatrix::from_fn(others.len(), group.len(), |i, k| -slopes[(others[i], k)]);
    let values = falls.svd(true, true).solve(&now, ROUNDING).ok()?;
    values.iter().all(|v| v.is_finite()).then_some(values)
}
