//! Covariance of the shared parameters from the residual that is really left.

use nalgebra::{DMatrix, DVector};

use crate::information::{Reduced, inverse};
use crate::replay::WindowSums;

/// Two covariances of the same figures.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Covariances {
    /// As if residuals were white, of the deviation that they have.
    pub(super) white: DMatrix<f64>,
    /// By leaving out one block of samples after another (jackknife): residuals within a block may
    /// belong together as they like.
    pub(super) blocks: DMatrix<f64>,
}

impl Covariances {
    /// From sums of which the first `shared` columns are the parameters.
    ///
    /// White: `N⁻¹·s²`, N the normal matrix with the windows' own unknowns eliminated. Blocks:
    /// `Σ δ_b·δ_bᵀ`, δ_b the change of the parameters without block b, to first order in the
    /// residuals and exactly in what the block adds to N: few blocks that carry much count fully.
    pub(super) fn at(sums: &[WindowSums], shared: usize) -> Self {
        let reduced: Vec<Reduced> = sums.iter().map(|s| Reduced::new(s, shared, 0.0)).collect();
        let zero = DMatrix::zeros(shared, shared);
        let normal = reduced.iter().fold(zero.clone(), |sum, r| sum + &r.normal);
        let (mut slopes, mut curvatures) = (0.0, 0.0);
        let (mut rows, mut unknowns) = (0, shared);
        let mut blocks = zero;
        for (sums, own) in sums.iter().zip(&reduced) {
            slopes += sums.slopes;
            curvatures += sums.curvatures;
            rows += sums.readings.iter().sum::<usize>();
            unknowns += sums.gram.ncols() - 1 - shared;
            let others = &normal - &own.normal;
            for change in without_each_block(sums, &others, shared) {
                blocks.ger(1.0, &change, &change, 1.0);
            }
        }
        let free = rows.saturating_sub(unknowns).max(1) as f64;
        Self { white: inverse(&normal) * (slopes / curvatures * rows as f64 / free), blocks }
    }

    /// Of parameters that depend on those of this covariance by `jacobian`.
    pub(super) fn through(self, jacobian: &DMatrix<f64>) -> Self {
        let through = |c: &DMatrix<f64>| jacobian * c * jacobian.transpose();
        Self { white: through(&self.white), blocks: through(&self.blocks) }
    }

    /// The white one, stretched where blocks say more.
    pub(super) fn larger(&self) -> DMatrix<f64> {
        let stretch = DVector::from_fn(self.white.nrows(), |i, _| {
            let ratio = self.blocks[(i, i)] / self.white[(i, i)];
            if ratio > 1.0 && ratio.is_finite() { ratio.sqrt() } else { 1.0 }
        });
        DMatrix::from_fn(self.white.nrows(), self.white.ncols(), |i, j| {
            self.white[(i, j)] * stretch[i] * stretch[j]
        })
    }
}

/// Deviation of parameter `i`.
pub(super) fn deviation(covariance: &DMatrix<f64>, i: usize) -> f64 {
    covariance[(i, i)].max(0.0).sqrt()
}

/// Change of the shared parameters where one block of a window after another is left out.
/// `others` is the normal matrix of all other windows.
fn without_each_block<'a>(
    sums: &'a WindowSums,
    others: &'a DMatrix<f64>,
    shared: usize,
) -> impl Iterator<Item = DVector<f64>> + 'a {
    let size = sums.gram.ncols() - 1;
    let mut all = sums.gram.view((0, 0), (size, size)).into_owned();
    let mut corner = all.view_mut((0, 0), (shared, shared));
    corner += others;
    sums.blocks.iter().map(move |block| {
        let left = &all - block.view((0, 0), (size, size));
        let score = block.column(size).rows(0, size).into_owned();
        (inverse(&left) * -score).rows(0, shared).into_owned()
    })
}
