//! Correlation from covariance.

use nalgebra::DMatrix;

/// Correlation matrix of a covariance matrix; a quantity without variance is correlated with none.
pub fn correlation(covariance: &DMatrix<f64>) -> DMatrix<f64> {
    let n = covariance.nrows();
    DMatrix::from_fn(n, n, |i, j| {
        let sizes = (covariance[(i, i)] * covariance[(j, j)]).sqrt();
        let has_no_variance = sizes <= 0.0;
        let both = 0.5 * (covariance[(i, j)] + covariance[(j, i)]);
        if has_no_variance { f64::from(i == j) } else { both / sizes }
    })
}
