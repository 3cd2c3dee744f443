//! Normal equations of one window, with its own unknowns eliminated.

use nalgebra::{DMatrix, DVector};

use crate::replay::WindowSums;

/// Eigenvalue of the scaled matrix, relative to the largest, below which its direction is unknown.
const RANK: f64 = 1e-14;
/// Square of a pivot of the scaled matrix above which no direction is near that.
const SOUND: f64 = 1e-11;

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

/// Normal matrix and right side of the shared parameters, all windows' own unknowns eliminated.
pub(super) fn normal_equations(sums: &[WindowSums], shared: usize) -> (DMatrix<f64>, DVector<f64>) {
    let zero = (DMatrix::zeros(shared, shared), DVector::zeros(shared));
    sums.iter()
        .map(|s| Reduced::new(s, shared, 0.0))
        .fold(zero, |(normal, right), r| (normal + r.normal, right + r.right))
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
    // Nearly always sound, and ten times as fast.
    if let Some(found) = sound_inverse(&scaled) {
        return DMatrix::from_fn(n, n, |i, j| found[(i, j)] * scale[i] * scale[j]);
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
    }
}
