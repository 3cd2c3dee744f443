//! Eigenvalues of matrices that come from outside, numbers and all.

use nalgebra::{DMatrix, Schur};
use num_complex::Complex64;

/// Sweeps of the QR method for each row: it takes two or three where it converges at all.
const SWEEPS: usize = 100;

/// All of them; `None` where an element is not finite, or the QR method does not end: of some matrices with rows that
/// are the same it goes on for ever.
pub(crate) fn eigenvalues(matrix: &DMatrix<f64>) -> Option<Vec<Complex64>> {
    if matrix.iter().any(|v| !v.is_finite()) {
        return None;
    }
    if matrix.is_empty() {
        return Some(Vec::new());
    }
    let schur = Schur::try_new(matrix.clone(), f64::EPSILON, SWEEPS * matrix.nrows())?;
    Some(schur.complex_eigenvalues().iter().copied().collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_oscillator_has_a_pair() {
        let found = eigenvalues(&DMatrix::from_row_slice(2, 2, &[0.0, 1.0, -4.0, 0.0])).unwrap();
        assert_eq!(found.len(), 2);
        assert!(found.iter().all(|z| z.re.abs() < 1e-12 && (z.im.abs() - 2.0).abs() < 1e-12));
    }

    #[test]
    fn what_has_none_ends() {
        let mut matrix = DMatrix::from_element(4, 4, 1.0);
        assert!(eigenvalues(&matrix).is_none_or(|all| all.len() == 4));
        matrix[(1, 2)] = f64::NAN;
        assert_eq!(eigenvalues(&matrix), None);
        assert_eq!(eigenvalues(&DMatrix::zeros(0, 0)), Some(Vec::new()));
    }
}
