//! Inverses of information matrices in which some directions may be unknown.

use nalgebra::{DMatrix, DVector};

use crate::information::thresholds::{LOST_PARAMETER, UNKNOWN_DIRECTION};

/// Square of a pivot of the scaled matrix above which no direction is near that.
const SOUND: f64 = 1e-11;

/// Pseudo-inverse of an information matrix.
#[derive(Debug, Clone, PartialEq)]
pub struct Inverse {
    /// The inverse; zero along unknown directions.
    pub matrix: DMatrix<f64>,
    /// For each parameter, whether it takes part in an unknown direction.
    pub lost: Vec<bool>,
}

/// Inverse of a symmetric positive semidefinite matrix. The matrix is first scaled to a diagonal of ones; directions
/// that it does not determine are left out.
pub fn inverse(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    inverted(matrix).matrix
}

/// A matrix R for which `R·Rᵀ` is the [`inverse`] of a symmetric positive semidefinite matrix. R has one column for
/// each direction; the column is zero if the direction is unknown.
pub fn inverse_root(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    let (scale, scaled) = scaled(matrix);
    if !scaled.iter().all(|v| v.is_finite()) {
        return DMatrix::zeros(matrix.nrows(), matrix.nrows());
    }
    let eigen = scaled.symmetric_eigen();
    let least = UNKNOWN_DIRECTION * eigen.eigenvalues.max();
    let root = |value: f64| if value > least { 1.0 / value.sqrt() } else { 0.0 };
    let roots = eigen.eigenvalues.map(root);
    DMatrix::from_diagonal(&scale) * eigen.eigenvectors * DMatrix::from_diagonal(&roots)
}

/// One over the root of a matrix' diagonal, and the matrix so scaled that its diagonal is ones.
fn scaled(matrix: &DMatrix<f64>) -> (DVector<f64>, DMatrix<f64>) {
    let n = matrix.nrows();
    let scale = DVector::from_fn(n, |i, _| {
        let d = matrix[(i, i)];
        if d > 0.0 && d.is_finite() { 1.0 / d.sqrt() } else { 0.0 }
    });
    let scaled = DMatrix::from_fn(n, n, |i, j| matrix[(i, j)] * scale[i] * scale[j]);
    (scale, scaled)
}

/// Covariance from an information matrix: its inverse, with an infinite variance for each parameter that takes part in
/// an unknown direction.
pub fn covariance(information: &DMatrix<f64>) -> DMatrix<f64> {
    let Inverse { mut matrix, lost } = inverted(information);
    for (i, _) in lost.iter().enumerate().filter(|(_, lost)| **lost) {
        matrix[(i, i)] = f64::INFINITY;
    }
    matrix
}

/// The inverse as [`inverse`] computes it, and the parameters that take part in an unknown direction.
pub fn inverted(matrix: &DMatrix<f64>) -> Inverse {
    let n = matrix.nrows();
    let (scale, scaled) = scaled(matrix);
    if n == 0 || !scaled.iter().all(|v| v.is_finite()) {
        return Inverse { matrix: DMatrix::zeros(n, n), lost: vec![true; n] };
    }
    // Nearly always sound, and ten times as fast.
    if let Some(found) = sound_inverse(&scaled) {
        let matrix = DMatrix::from_fn(n, n, |i, j| found[(i, j)] * scale[i] * scale[j]);
        return Inverse { matrix, lost: vec![false; n] };
    }
    let eigen = scaled.symmetric_eigen();
    let least = UNKNOWN_DIRECTION * eigen.eigenvalues.max();
    let mut found = DMatrix::zeros(n, n);
    let mut lost = vec![false; n];
    for (value, vector) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
        if *value > least {
            let v = vector.component_mul(&scale);
            found.ger(1.0 / value, &v, &v, 1.0);
        } else {
            for (lost, share) in lost.iter_mut().zip(&vector) {
                *lost |= share.abs() > LOST_PARAMETER;
            }
        }
    }
    Inverse { matrix: found, lost }
}

/// Inverse of a matrix with a diagonal of ones whose directions are all well determined.
fn sound_inverse(scaled: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let factor = scaled.clone().cholesky()?;
    let least = factor.l_dirty().diagonal().min();
    (least * least > SOUND).then(|| factor.inverse())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_inverse_leaves_out_what_is_unknown() {
        let m = DMatrix::from_row_slice(3, 3, &[4e6, 0.0, 2e3, 0.0, 0.0, 0.0, 2e3, 0.0, 9.0]);
        let i = inverse(&m);
        let back = &m * &i * &m;
        assert!((back - &m).norm() < 1e-6 && i[(1, 1)] == 0.0);
        let root = inverse_root(&m);
        assert!((&root * root.transpose() - &i).norm() < 1e-12 * i.norm());
    }

    #[test]
    fn what_is_not_shown_is_not_known() {
        let m = DMatrix::from_row_slice(3, 3, &[4e6, 0.0, 2e3, 0.0, 0.0, 0.0, 2e3, 0.0, 9.0]);
        let c = covariance(&m);
        assert!(c[(1, 1)].is_infinite() && (c[(0, 0)] * (4e6 - 4e6 / 9.0) - 1.0).abs() < 1e-9);
        // Two parameters of which only the sum is shown.
        let sum = covariance(&DMatrix::from_element(2, 2, 1.0));
        assert!(sum[(0, 0)].is_infinite() && sum[(1, 1)].is_infinite());
    }
}
