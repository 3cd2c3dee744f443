//! Products of tall matrices.

use nalgebra::{Const, DMatrix, Dyn, MatrixView};

/// Most columns of a matrix that `gemm` multiplies one by one. Its way of doing so reads beyond a view whose
/// rows are not next to each other (nalgebra 0.34.2).
const ONE_BY_ONE: usize = 5;

/// `Aᵀ·A`. By the blocked product that uses what the processor has; `tr_mul` takes one dot product after
/// another, and is slower (`benches/rational` has the times of whole fits).
pub(super) fn products(a: &DMatrix<f64>) -> DMatrix<f64> {
    let (rows, columns) = a.shape();
    if rows.min(columns) <= ONE_BY_ONE {
        return a.tr_mul(a);
    }
    let (count, stride) = (Dyn(columns), Dyn(rows));
    let transposed = MatrixView::from_slice_with_strides_generic(
        a.as_slice(),
        count,
        stride,
        stride,
        Const::<1>,
    );
    let mut found = DMatrix::zeros(columns, columns);
    found.gemm(1.0, &transposed, a, 0.0);
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn they_are_those_of_the_transposed_matrix() {
        for (rows, columns) in [(7, 6), (400, 3), (4, 7), (600, 41)] {
            let a = DMatrix::from_fn(rows, columns, |i, j| (0.7 * i as f64 + 1.3 * j as f64).sin());
            assert!((products(&a) - a.transpose() * &a).amax() < 1e-12 * rows as f64);
        }
    }
}
