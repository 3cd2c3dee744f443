//! Covariances of least-squares estimates from the scores of groups of rows, whatever the residuals within a group do.

use nalgebra::DMatrix;

use crate::identify::estimate::wider_by_student;

/// A group that carries all but this share of a direction counts as one that carries so much.
const ALONE: f64 = 0.05;

/// `N⁻¹·(Σ g·gᵀ)·N⁻¹` with g the score of each group, C/(C − 1) for their number, and so much more that 1.96 standard
/// errors are an interval of 95 % by Student's t with C − 1 degrees of freedom.
pub(super) fn sandwich(inverse: &DMatrix<f64>, scores: &DMatrix<f64>) -> DMatrix<f64> {
    let middle = scores * scores.transpose();
    let groups = scores.column_iter().filter(|g| g.norm() > 0.0).count() as f64;
    let freedom = (groups - 1.0).max(1.0);
    inverse * middle * inverse * (groups / freedom * wider_by_student(freedom).powi(2))
}

/// The same of few groups, each of which carries a good part of the whole: the estimates follow a group that carries much,
/// and its score is too small by that. With `W·Wᵀ = N⁻¹` each score is stretched to `W·(1 − Wᵀ·N_g·W)^{−1/2}·Wᵀ·g`, N_g
/// the normal equations of the group alone.
///
/// # Source
/// Bell and McCaffrey, Bias reduction in standard errors for linear regression with multi-stage samples, Survey Methodology
/// 28 (2002): the estimator CR2.
pub(super) fn of_few(
    white: &DMatrix<f64>,
    scores: &DMatrix<f64>,
    normals: &[DMatrix<f64>],
) -> DMatrix<f64> {
    let mut moved = DMatrix::zeros(white.nrows(), scores.ncols());
    for ((score, normal), mut moved) in
        scores.column_iter().zip(normals).zip(moved.column_iter_mut())
    {
        let own = (white.transpose() * normal * white).symmetric_eigen();
        let stretched = own.eigenvalues.map(|share| (1.0 - share).max(ALONE).sqrt().recip());
        let by =
            &own.eigenvectors * DMatrix::from_diagonal(&stretched) * own.eigenvectors.transpose();
        moved.copy_from(&(white * (by * (white.transpose() * score))));
    }
    let groups = scores.column_iter().filter(|g| g.norm() > 0.0).count() as f64;
    let freedom = (groups - 1.0).max(1.0);
    &moved * moved.transpose() * wider_by_student(freedom).powi(2)
}

/// The first covariance, stretched where the second has the larger variance.
pub(crate) fn larger(a: &DMatrix<f64>, b: &DMatrix<f64>) -> DMatrix<f64> {
    let p = a.nrows();
    let stretch: Vec<f64> = (0..p)
        .map(|i| {
            if b[(i, i)] > a[(i, i)] && a[(i, i)] > 0.0 {
                (b[(i, i)] / a[(i, i)]).sqrt()
            } else {
                1.0
            }
        })
        .collect();
    DMatrix::from_fn(p, p, |i, j| a[(i, j)] * stretch[i] * stretch[j])
}
