//! Covariance of the shared parameters, from the residual.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use crate::information::{Reduced, inverse, inverse_root};
use crate::replay::WindowSums;

/// Smallest share of the information on a direction that is outside of one block: a floor against rounding.
const LEAST_REST: f64 = 1e-9;

/// Two covariances of the same parameters.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Covariances {
    /// If residuals are white noise, with their own variance or, if that is smaller, the variance assumed in the fit.
    pub(crate) white: DMatrix<f64>,
    /// By blocks of samples: residuals within a block may be correlated in any way.
    pub(crate) blocks: DMatrix<f64>,
}

impl Covariances {
    /// From sums of which the first `shared` columns are the parameters.
    ///
    /// White: `N⁻¹·s²`. N is the normal matrix after the windows' own unknowns are eliminated. s² is the sum of the
    /// squared slopes of the costs over the sum of their curvatures, and 1 at least. It is below 1 only if a sensor's
    /// noise is below the smallest that a fit assumes; too few readings near the edges of its steps then show how
    /// small the noise is.
    ///
    /// Blocks: `Σ δ_b·δ_bᵀ`, where δ_b is the change of the parameters by the residuals of a block,
    /// [`moved_by_blocks`].
    pub(crate) fn at(sums: &[WindowSums], shared: usize) -> Self {
        let reduced: Vec<Reduced> = sums.iter().map(|s| Reduced::new(s, shared, 0.0)).collect();
        let zero = DMatrix::zeros(shared, shared);
        let normal = reduced.iter().fold(zero.clone(), |sum, r| sum + &r.normal);
        let (mut slopes, mut curvatures) = (0.0, 0.0);
        let (mut rows, mut unknowns) = (0, shared);
        for sums in sums {
            slopes += sums.slopes;
            curvatures += sums.curvatures;
            rows += sums.readings.iter().sum::<usize>();
            unknowns += sums.gram.ncols() - 1 - shared;
        }
        let by_blocks = |(sums, own): (&WindowSums, &Reduced)| {
            let others = &normal - &own.normal;
            let mut blocks = zero.clone();
            for change in moved_by_blocks(sums, &others, shared) {
                blocks.ger(1.0, &change, &change, 1.0);
            }
            blocks
        };
        let of_windows: Vec<DMatrix<f64>> =
            sums.par_iter().with_max_len(1).zip(&reduced).map(by_blocks).collect();
        let free = rows.saturating_sub(unknowns).max(1) as f64;
        Self {
            white: inverse(&normal) * ((slopes / curvatures).max(1.0) * rows as f64 / free),
            blocks: of_windows.into_iter().fold(zero, |sum, b| sum + b),
        }
    }

    /// Of parameters that depend on those of this covariance by `jacobian`.
    pub(crate) fn through(self, jacobian: &DMatrix<f64>) -> Self {
        let through = |c: &DMatrix<f64>| jacobian * c * jacobian.transpose();
        Self { white: through(&self.white), blocks: through(&self.blocks) }
    }

    /// The white covariance, with standard errors increased to those by blocks where these are larger.
    pub(crate) fn larger(&self) -> DMatrix<f64> {
        let stretch = DVector::from_fn(self.white.nrows(), |i, _| {
            let ratio = self.blocks[(i, i)] / self.white[(i, i)];
            if ratio > 1.0 && ratio.is_finite() { ratio.sqrt() } else { 1.0 }
        });
        DMatrix::from_fn(self.white.nrows(), self.white.ncols(), |i, j| {
            self.white[(i, j)] * stretch[i] * stretch[j]
        })
    }
}

/// Standard error of parameter `i`.
pub(crate) fn deviation(covariance: &DMatrix<f64>, i: usize) -> f64 {
    covariance[(i, i)].max(0.0).sqrt()
}

/// Change of the shared parameters by the residuals of each block of a window. `others` is the normal matrix of all
/// other windows.
///
/// It is `L⁻ᵀ·(I − P)^(−1/2)·L⁻¹·g_b`, with the whole normal matrix `M = L·Lᵀ`, the block's slope g_b and its share
/// `P = L⁻¹·M_b·L⁻ᵀ` in M by directions. If one block has nearly all of the information on a direction, its residual
/// along that direction is nearly zero: for white residuals the slope has the variance `P·(I − P)`. With the root the
/// sum over blocks is then the white covariance (HC2 of \[MacKinnon1985\]). The factor `(I − P)⁻¹`, which leaves each
/// block out, would give the standard error that the direction has without its block.
fn moved_by_blocks<'a>(
    sums: &'a WindowSums,
    others: &'a DMatrix<f64>,
    shared: usize,
) -> impl Iterator<Item = DVector<f64>> + 'a {
    let size = sums.gram.ncols() - 1;
    let mut all = sums.gram.view((0, 0), (size, size)).into_owned();
    let mut corner = all.view_mut((0, 0), (shared, shared));
    corner += others;
    let root = inverse_root(&all);
    sums.blocks.iter().map(move |block| {
        let share = root.transpose() * block.view((0, 0), (size, size)) * &root;
        let score = root.transpose() * block.column(size).rows(0, size);
        let eigen = share.symmetric_eigen();
        let rest = eigen.eigenvalues.map(|p| 1.0 / (1.0 - p).max(LEAST_REST).sqrt());
        let along = (eigen.eigenvectors.transpose() * score).component_mul(&rest);
        (&root * (eigen.eigenvectors * along)).rows(0, shared).into_owned()
    })
}
