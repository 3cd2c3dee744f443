//! Normal equations of one window, with its own unknowns eliminated.

use nalgebra::{DMatrix, DVector};

use crate::replay::WindowSums;

/// Eigenvalue of the scaled matrix, relative to the largest, below which its direction is unknown.
const RANK: f64 = 1e-14;

/// `(H_pp − H_pz·H_zz⁻¹·H_zp)·δp = g_p − H_pz·H_zz⁻¹·g_z` of parameters p and the window's own z.
pub(super) struct Reduced {
    pub(super) normal: DMatrix<f64>,
    pub(super) right: DVector<f64>,
    /// H_zz⁻¹·g_z.
    pub(super) own: DVector<f64>,
    /// H_zz⁻¹·H_zp.
    pub(super) by_shared: DMatrix<f64>,
}

impl Reduced {
    /// With the diagonal of H_zz raised by `damping`.
    pub(super) fn new(sums: &WindowSums, shared: usize, damping: f64) -> Self {
        let size = sums.gram.ncols() - 1;
        let own = size - shared;
        let mut h_zz = sums.gram.view((shared, shared), (own, own)).into_owned();
        for i in 0..own {
            h_zz[(i, i)] *= 1.0 + damping;
        }
        let h_zp = sums.gram.view((shared, 0), (own, shared)).into_owned();
        let right = sums.gram.column(size);
        let inverse = inverse(&h_zz);
        let by_shared = &inverse * &h_zp;
        let change = inverse * right.rows(shared, own);
        Self {
            normal: sums.gram.view((0, 0), (shared, shared)) - h_zp.transpose() * &by_shared,
            right: right.rows(0, shared) - h_zp.transpose() * &change,
            own: change,
            by_shared,
        }
    }
}

/// Inverse of a symmetric positive matrix, scaled to a diagonal of ones first; directions that it
/// does not determine are left out.
pub(super) fn inverse(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    let n = matrix.nrows();
    let scale = DVector::from_fn(n, |i, _| {
        let d = matrix[(i, i)];
        if d > 0.0 && d.is_finite() { 1.0 / d.sqrt() } else { 0.0 }
    });
    let scaled = DMatrix::from_fn(n, n, |i, j| matrix[(i, j)] * scale[i] * scale[j]);
    if n == 0 || !scaled.iter().all(|v| v.is_finite()) {
        return DMatrix::zeros(n, n);
    }
    let eigen = scaled.symmetric_eigen();
    let least = RANK * eigen.eigenvalues.max();
    let mut found = DMatrix::zeros(n, n);
    for (value, vector) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
        if *value > least {
            let v = vector.component_mul(&scale);
            found.ger(1.0 / value, &v, &v, 1.0);
        }
    }
    found
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
    }
}
