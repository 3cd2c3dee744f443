//! Covariance of the shared parameters from the residual that is really left.

use nalgebra::{DMatrix, DVector};

use super::normal::{Reduced, inverse};
use super::search::Point;

/// Two covariances of the same figures.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Covariances {
    /// As if residuals were white, of the deviation that they have.
    pub(super) white: DMatrix<f64>,
    /// From the scores of blocks of residuals, coloured as they are.
    pub(super) coloured: DMatrix<f64>,
}

/// Covariances at `point`, with `lags` blocks on either side taken as correlated.
///
/// `N⁻¹·M·N⁻¹`: N the normal matrix with the windows' own unknowns eliminated, M the long-run
/// variance of the scores of blocks, by Bartlett's weights within each window.
pub(super) fn covariances(point: &Point, shared: usize, lags: usize) -> Covariances {
    let mut normal = DMatrix::zeros(shared, shared);
    let mut middle = DMatrix::zeros(shared, shared);
    let (mut blocks, mut rows, mut own) = (0, 0, 0);
    for sums in &point.sums {
        let reduced = Reduced::new(sums, shared, 0.0);
        normal += &reduced.normal;
        let size = sums.gram.ncols() - 1;
        own += size - shared;
        rows += sums.samples * sums.squares.len();
        let scores: Vec<DVector<f64>> = sums
            .scores
            .iter()
            .map(|g| g.rows(0, shared) - reduced.by_shared.tr_mul(&g.rows(shared, size - shared)))
            .collect();
        blocks += scores.len();
        for (i, a) in scores.iter().enumerate() {
            for (lag, b) in scores[i..].iter().take(lags + 1).enumerate() {
                let weight = 1.0 - lag as f64 / (lags as f64 + 1.0);
                if lag == 0 {
                    middle.ger(weight, a, a, 1.0);
                } else {
                    middle.ger(weight, a, b, 1.0);
                    middle.ger(weight, b, a, 1.0);
                }
            }
        }
    }
    let inverse = inverse(&normal);
    let free = rows.saturating_sub(own + shared).max(1) as f64;
    let blocks = blocks as f64;
    let small = blocks / (blocks - shared as f64).max(1.0);
    Covariances {
        coloured: &inverse * middle * &inverse * small,
        white: inverse * (point.cost() / free),
    }
}
