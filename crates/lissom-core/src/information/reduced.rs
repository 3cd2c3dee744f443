//! Normal equations of one window, with the unknowns of the window eliminated.

use nalgebra::{DMatrix, DVector};

use super::inverse;
use crate::replay::{Window, WindowSums};

/// Where the motor's velocity stands among a window's own unknowns.
const VELOCITY: usize = 1;

/// Normal equations `(H_pp − H_pz·H_zz⁻¹·H_zp)·δp = g_p − H_pz·H_zz⁻¹·g_z` of the parameters p, with the unknowns z of
/// one window eliminated.
#[derive(Debug, Clone)]
pub struct Reduced {
    /// Matrix H_pp − H_pz·H_zz⁻¹·H_zp.
    pub normal: DMatrix<f64>,
    /// Right side g_p − H_pz·H_zz⁻¹·g_z.
    pub right: DVector<f64>,
    /// H_zz⁻¹·g_z: change of z at constant p.
    pub own: DVector<f64>,
    /// H_zz⁻¹·H_zp: change of z by p.
    pub by_shared: DMatrix<f64>,
}

impl Reduced {
    /// Builds the equations from sums whose first `shared` columns are the parameters. The diagonal of H_zz is
    /// increased by the share `damping`.
    pub fn new(sums: &WindowSums, shared: usize, damping: f64) -> Self {
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

/// Normal matrix and right side for the shared parameters, summed over all windows, with the
/// unknowns of each window eliminated.
pub fn normal_equations(sums: &[WindowSums], shared: usize) -> (DMatrix<f64>, DVector<f64>) {
    let zero = (DMatrix::zeros(shared, shared), DVector::zeros(shared));
    sums.iter()
        .map(|s| Reduced::new(s, shared, 0.0))
        .fold(zero, |(normal, right), r| (normal + r.normal, right + r.right))
}

/// Information of one window about the parameters, `H_pp − H_pz·H_zz⁻¹·H_zp`; the first `shared` rows and columns of
/// `gram` are p. If the joint sticks at the start of the window, its initial velocity is known to be zero.
pub fn without_own(gram: &DMatrix<f64>, shared: usize, window: &Window) -> DMatrix<f64> {
    let stuck = window.start.get(1) == Some(&0.0);
    let own: Vec<usize> =
        (shared..gram.ncols()).filter(|z| !(stuck && *z == shared + VELOCITY)).collect();
    let h_zp = gram.select_rows(&own).columns(0, shared).into_owned();
    let h_zz = gram.select_rows(&own).select_columns(&own);
    gram.view((0, 0), (shared, shared)) - h_zp.transpose() * inverse(&h_zz) * h_zp
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_unknown_of_the_window_costs_its_share() {
        let gram = DMatrix::from_row_slice(2, 2, &[4.0, 2.0, 2.0, 2.0]);
        let window = Window { run: 0, samples: 0..=9, start: vec![0.0, 1.0], zeros: vec![] };
        assert!((without_own(&gram, 1, &window)[(0, 0)] - 2.0).abs() < 1e-12);
    }
}
