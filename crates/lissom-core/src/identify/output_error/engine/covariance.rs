//! Covariance of the shared parameters, from the residual.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use crate::information::{Reduced, inverse, inverse_root};
use crate::replay::WindowSums;

/// Smallest share of the information on a direction that is outside of one block: a floor against rounding.
const LEAST_REST: f64 = 1e-9;

/// Root of the sum of P's squared eigenvalues, an upper bound of each, from which on the series takes too long.
const LARGE_SHARE: f64 = 0.8;

/// The most terms of the series: 0.8^100 is 2e-10.
const SERIES_TERMS: u32 = 100;

/// The series ends with a term below this share of its sum.
const SERIES_LEFT: f64 = 1e-9;

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
        let inverse_normal = inverse(&normal);
        let (mut slopes, mut curvatures) = (0.0, 0.0);
        let (mut rows, mut unknowns) = (0, shared);
        for sums in sums {
            slopes += sums.slopes;
            curvatures += sums.curvatures;
            rows += sums.readings.iter().sum::<usize>();
            unknowns += sums.gram.ncols() - 1 - shared;
        }
        let by_blocks = |(sums, own): (&WindowSums, &Reduced)| {
            let mut blocks = zero.clone();
            for change in moved_by_blocks(sums, own, &normal, &inverse_normal) {
                blocks.ger(1.0, &change, &change, 1.0);
            }
            blocks
        };
        let of_windows: Vec<DMatrix<f64>> =
            sums.par_iter().with_max_len(1).zip(&reduced).map(by_blocks).collect();
        let free = rows.saturating_sub(unknowns).max(1) as f64;
        Self {
            white: &inverse_normal * ((slopes / curvatures).max(1.0) * rows as f64 / free),
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
pub(crate) fn standard_error(covariance: &DMatrix<f64>, i: usize) -> f64 {
    covariance[(i, i)].max(0.0).sqrt()
}

/// Change of the shared parameters by the residuals of each block of a window, whose own unknowns are eliminated in
/// `own`; `normal` is the normal matrix of all windows.
///
/// It is `L⁻ᵀ·(I − P)^(−1/2)·L⁻¹·g_b`, with the whole normal matrix `M = L·Lᵀ`, the block's slope g_b and its share
/// `P = L⁻¹·M_b·L⁻ᵀ` in M by directions. If one block has nearly all of the information on a direction, its residual
/// along that direction is nearly zero: for white residuals the slope has the variance `P·(I − P)`. With the root the
/// sum over blocks is then the white covariance (HC2 of \[MacKinnon1985\]). The factor `(I − P)⁻¹`, which leaves each
/// block out, would give the standard error that the direction has without its block.
///
/// For small shares the root is a series; eigenvalues for each of thousands of blocks take much longer.
fn moved_by_blocks(
    sums: &WindowSums,
    own: &Reduced,
    normal: &DMatrix<f64>,
    inverse_normal: &DMatrix<f64>,
) -> Vec<DVector<f64>> {
    let shared = normal.nrows();
    if let [_] = sums.blocks.as_slice() {
        // A block that is the whole window has all of the information on the window's own unknowns, and its slope
        // along them is zero.
        return vec![moved(normal, inverse_normal, &own.normal, &own.right)];
    }
    let size = sums.gram.ncols() - 1;
    let mut all = sums.gram.view((0, 0), (size, size)).into_owned();
    let mut corner = all.view_mut((0, 0), (shared, shared));
    corner += normal - &own.normal;
    let inverse_all = inverse(&all);
    let of_block = |block: &DMatrix<f64>| {
        let score = block.column(size).rows(0, size).into_owned();
        let normal = block.view((0, 0), (size, size)).into_owned();
        let change = moved(&all, &inverse_all, &normal, &score);
        change.rows(0, shared).into_owned()
    };
    sums.blocks.iter().map(of_block).collect()
}

/// The change by a block with this normal matrix and slope, of all with the normal matrix `all`.
fn moved(
    all: &DMatrix<f64>,
    inverse: &DMatrix<f64>,
    block: &DMatrix<f64>,
    score: &DVector<f64>,
) -> DVector<f64> {
    // Its eigenvalues are those of P.
    let share = inverse * block;
    if share.dot(&share.transpose()) < LARGE_SHARE * LARGE_SHARE {
        by_series(&share, inverse * score)
    } else {
        by_eigenvalues(&inverse_root(all), block, score)
    }
}

/// `L⁻ᵀ·(I − P)^(−1/2)·L⁻¹·g`, from the eigenvalues of `P = L⁻¹·block·L⁻ᵀ`; `root` is L⁻ᵀ.
fn by_eigenvalues(root: &DMatrix<f64>, block: &DMatrix<f64>, score: &DVector<f64>) -> DVector<f64> {
    let share = root.transpose() * block * root;
    let eigen = share.symmetric_eigen();
    let rest = eigen.eigenvalues.map(|p| 1.0 / (1.0 - p).max(LEAST_REST).sqrt());
    let along = (eigen.eigenvectors.transpose() * (root.transpose() * score)).component_mul(&rest);
    root * (eigen.eigenvectors * along)
}

/// The same by the binomial series `Σ c_k·share^k·change`, with c_k = c_(k−1)·(2k − 1)/(2k), `share = M⁻¹·block` and
/// `change = M⁻¹·g`.
fn by_series(share: &DMatrix<f64>, change: DVector<f64>) -> DVector<f64> {
    let mut sum = change.clone();
    let mut term = change;
    for k in 1..=SERIES_TERMS {
        term = share * term * (1.0 - 0.5 / f64::from(k));
        sum += &term;
        if term.norm() < SERIES_LEFT * sum.norm() {
            break;
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A block with a quarter of the information, spread over three of four directions.
    #[test]
    fn the_series_is_the_root() {
        let rows =
            DMatrix::from_fn(3, 4, |i, j| 0.3 * f64::from((1 + 5 * i + 3 * j) as u32 % 7) - 0.8);
        let block = rows.transpose() * &rows;
        let all =
            &block * 6.0 + DMatrix::from_diagonal(&DVector::from_vec(vec![8.0, 5.0, 9.0, 6.0]));
        let root = inverse_root(&all);
        let inverse = &root * root.transpose();
        let score = DVector::from_vec(vec![0.3, -1.0, 0.4, 2.0]);
        let (share, plain) = (&inverse * &block, &inverse * &score);
        let size = share.dot(&share.transpose()).sqrt();
        assert!((0.1..LARGE_SHARE).contains(&size), "{size}");
        let [series, exact] =
            [by_series(&share, plain.clone()), by_eigenvalues(&root, &block, &score)];
        assert!((&series - &exact).norm() < 1e-6 * exact.norm());
        assert!((plain - &exact).norm() > 1e-3 * exact.norm(), "the root changes nothing");
    }
}
