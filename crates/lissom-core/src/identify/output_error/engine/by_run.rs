//! The information of each run on the parameters, and the estimates of the other runs without it.

use std::collections::BTreeSet;

use nalgebra::{DMatrix, DVector};

use crate::information::{Inverse, Reduced, inverted};
use crate::replay::{Window, WindowSums};

/// Normal equations of each run, in the coordinates that the search changes.
///
/// Near the estimates the sum of squared residuals of a run is a quadratic function. So the estimates without a run
/// follow without another fit.
#[derive(Debug, Clone)]
pub struct ByRun {
    runs: Vec<OneRun>,
    /// ∂parameter/∂coordinate.
    jacobian: DMatrix<f64>,
}

#[derive(Debug, Clone)]
struct OneRun {
    run: usize,
    normal: DMatrix<f64>,
    right: DVector<f64>,
    /// Sum of squared residuals, in standard deviations of the assumed noise.
    squares: f64,
    /// Number of readings minus the number of unknowns of the run's windows.
    free: f64,
}

impl OneRun {
    /// Sum of squares after the coordinates change by `step`.
    fn squares_at(&self, step: &DVector<f64>) -> f64 {
        self.squares - 2.0 * step.dot(&self.right) + step.dot(&(&self.normal * step))
    }
}

impl ByRun {
    /// From sums over windows of which the first `shared` columns are the coordinates.
    pub(crate) fn of(
        sums: &[WindowSums],
        windows: &[Window],
        shared: usize,
        jacobian: Option<DMatrix<f64>>,
    ) -> Self {
        let present: BTreeSet<usize> = windows.iter().map(|w| w.run).collect();
        let of_run = |run: usize| {
            let mut found = OneRun {
                run,
                normal: DMatrix::zeros(shared, shared),
                right: DVector::zeros(shared),
                squares: 0.0,
                free: 0.0,
            };
            for (sums, _) in sums.iter().zip(windows).filter(|(_, w)| w.run == run) {
                let reduced = Reduced::new(sums, shared, 0.0);
                found.normal += reduced.normal;
                found.right += reduced.right;
                found.squares += sums.slopes;
                let own = sums.gram.ncols() - 1 - shared;
                found.free += sums.readings.iter().sum::<usize>() as f64 - own as f64;
            }
            found
        };
        let runs = present.into_iter().map(of_run).collect();
        Self { runs, jacobian: jacobian.unwrap_or_else(|| DMatrix::identity(shared, shared)) }
    }

    /// Adds parameters that the search did not change, to `count` in all.
    pub(crate) fn of_parameters(mut self, count: usize) -> Self {
        self.jacobian.resize_vertically_mut(count, 0.0);
        self
    }

    /// Indices of the runs in their campaign.
    pub(crate) fn runs(&self) -> impl Iterator<Item = usize> + '_ {
        self.runs.iter().map(|r| r.run)
    }

    /// Compares a run with all others, at the estimates of the others.
    pub(crate) fn beside_others(&self, run: usize) -> Option<BesideOthers> {
        let one = self.runs.iter().find(|r| r.run == run)?;
        let step = self.step(Some(run));
        let others = self.runs.iter().filter(|r| r.run != run);
        let sum = |(squares, free), r: &OneRun| (squares + r.squares_at(&step), free + r.free);
        let (squares, free) = others.fold((0.0, 0.0), sum);
        let variance = squares / (free - step.len() as f64).max(1.0);
        let own = one.squares_at(&step) / one.free.max(1.0);
        let found = BesideOthers { residual: (own / variance).sqrt(), noise: variance.sqrt() };
        found.residual.is_finite().then_some(found)
    }

    /// Covariance of quantities of the arm from all runs but `without`. The residuals are taken as white, with the
    /// assumed noise. `more` is further information on the parameters. `slopes` has a column ∂quantity/∂parameter for
    /// each quantity. A quantity that cannot be identified has an infinite variance.
    pub(crate) fn covariance(
        &self,
        slopes: &DMatrix<f64>,
        without: Option<usize>,
        more: Option<&DMatrix<f64>>,
    ) -> DMatrix<f64> {
        let (normal, _) = self.normal(without);
        let normal = match more {
            Some(more) => normal + self.jacobian.tr_mul(more) * &self.jacobian,
            None => normal,
        };
        let Inverse { matrix, lost } = inverted(&normal);
        let slopes = self.jacobian.tr_mul(slopes);
        let mut found = slopes.tr_mul(&(matrix * &slopes));
        for (i, of_parameter) in slopes.column_iter().enumerate() {
            if of_parameter.iter().zip(&lost).any(|(slope, lost)| *lost && *slope != 0.0) {
                found[(i, i)] = f64::INFINITY;
            }
        }
        found
    }

    /// Change of quantities of the arm if a run is left out, by one step of the normal equations of the others.
    pub(crate) fn change_without(&self, slopes: &DMatrix<f64>, run: usize) -> DVector<f64> {
        slopes.tr_mul(&(&self.jacobian * (self.step(Some(run)) - self.step(None))))
    }

    /// Step from the estimates to those of all runs but `without`.
    fn step(&self, without: Option<usize>) -> DVector<f64> {
        let (normal, right) = self.normal(without);
        inverted(&normal).matrix * right
    }

    fn normal(&self, without: Option<usize>) -> (DMatrix<f64>, DVector<f64>) {
        let n = self.jacobian.ncols();
        let others = self.runs.iter().filter(|r| Some(r.run) != without);
        others.fold((DMatrix::zeros(n, n), DVector::zeros(n)), |(normal, right), r| {
            (normal + &r.normal, right + &r.right)
        })
    }
}

/// A run compared with the others.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct BesideOthers {
    /// Rms of its residual, relative to that of the others.
    pub(crate) residual: f64,
    /// Rms of the others' residual, in standard deviations of the assumed noise.
    pub(crate) noise: f64,
}
