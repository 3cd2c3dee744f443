//! What runs say of an arm before they are made: Fisher information and the covariance that follows.

use nalgebra::{DMatrix, DVector};

use crate::record::Campaign;
use crate::replay::{Blocks, ModalArm, Parameter, SensorNoise, Window, WindowSums, sums};

/// Covariance that the best unbiased estimator of `parameters` has from these runs (the Cramér-Rao
/// bound), the state at the start of each window and the zero of each tip unknown too.
///
/// ```text
/// C = (Σ_w H_pp − H_pz·H_zz⁻¹·H_zp)⁻¹,   H = Σ (∂ŷ/∂(p, z))ᵀ·(∂ŷ/∂(p, z))/σ²
/// ```
///
/// p the parameters, z a window's own unknowns, ŷ what each sensor shows at each sample as the replay
/// gives it, σ its [deviation](SensorNoise::deviation). `arm` and `windows` may be those that an
/// [output error](crate::identify::OutputError) has found, or known beforehand. What the runs do not
/// show at all has an infinite variance.
///
/// # Source
/// `[Pintelon2012]`, with the derivatives of [`replay`](crate::replay) through stick and slip.
pub fn expected_covariance(
    arm: &ModalArm,
    parameters: &[Parameter],
    campaign: &Campaign,
    windows: &[Window],
    noise: &[SensorNoise],
) -> DMatrix<f64> {
    let whole = campaign.runs.iter().map(|r| r.len() as f64).fold(1.0, f64::max);
    let found = growing_information(arm, parameters, campaign, windows, noise, whole);
    let n = parameters.len();
    let all = found.iter().filter_map(|w| w.last());
    covariance(&all.fold(DMatrix::zeros(n, n), |sum, one| sum + one))
}

/// Information of each window after one, two, … stretches of `samples`.
pub(super) fn growing_information(
    arm: &ModalArm,
    parameters: &[Parameter],
    campaign: &Campaign,
    windows: &[Window],
    noise: &[SensorNoise],
    samples: f64,
) -> Vec<Vec<DMatrix<f64>>> {
    let noise: Vec<SensorNoise> =
        noise.iter().map(|n| SensorNoise::gaussian(n.deviation())).collect();
    let masks = vec![vec![None; noise.len()]; campaign.runs.len()];
    let blocks = vec![Blocks { samples, period: None }; campaign.runs.len()];
    let sampling = crate::replay::Sampling { noise: &noise, blocks: &blocks, masks: &masks };
    let of_window = |sums: &WindowSums| {
        let size = sums.gram.ncols() - 1;
        let mut gram = DMatrix::zeros(size, size);
        let grow = |block: &DMatrix<f64>| {
            gram += block.view((0, 0), (size, size));
            without_own(&gram, parameters.len())
        };
        sums.blocks.iter().map(grow).collect()
    };
    sums(arm, parameters, campaign, windows, sampling).iter().map(of_window).collect()
}

/// `H_pp − H_pz·H_zz⁻¹·H_zp` of the first `shared` rows and columns.
fn without_own(gram: &DMatrix<f64>, shared: usize) -> DMatrix<f64> {
    let own = gram.ncols() - shared;
    let h_zp = gram.view((shared, 0), (own, shared));
    let h_zz = gram.view((shared, shared), (own, own)).into_owned();
    let eliminated = h_zp.transpose() * covariance_of_known(&h_zz) * h_zp;
    gram.view((0, 0), (shared, shared)) - eliminated
}

/// Eigenvalue of the scaled information, relative to the largest, below which its direction is not
/// shown.
const RANK: f64 = 1e-13;

/// Inverse of an information matrix; a parameter that takes part in a direction which is not shown has
/// an infinite variance.
pub(super) fn covariance(information: &DMatrix<f64>) -> DMatrix<f64> {
    let (mut found, lost) = inverted(information);
    for (i, lost) in lost.iter().enumerate() {
        if *lost {
            found[(i, i)] = f64::INFINITY;
        }
    }
    found
}

fn covariance_of_known(information: &DMatrix<f64>) -> DMatrix<f64> {
    inverted(information).0
}

/// Share of a parameter in a direction that is not shown, from which on it counts as lost.
const TAKES_PART: f64 = 1e-6;

/// Pseudo-inverse, scaled to a diagonal of ones first, and which parameters it lost.
fn inverted(matrix: &DMatrix<f64>) -> (DMatrix<f64>, Vec<bool>) {
    let n = matrix.nrows();
    let scale = DVector::from_fn(n, |i, _| {
        let d = matrix[(i, i)];
        if d > 0.0 && d.is_finite() { 1.0 / d.sqrt() } else { 0.0 }
    });
    let scaled = DMatrix::from_fn(n, n, |i, j| matrix[(i, j)] * scale[i] * scale[j]);
    let mut lost = vec![false; n];
    let mut found = DMatrix::zeros(n, n);
    if n == 0 || !scaled.iter().all(|v| v.is_finite()) {
        return (found, vec![true; n]);
    }
    let eigen = scaled.symmetric_eigen();
    let least = RANK * eigen.eigenvalues.max();
    for (value, vector) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
        if *value > least {
            let v = vector.component_mul(&scale);
            found.ger(1.0 / value, &v, &v, 1.0);
        } else {
            for (lost, share) in lost.iter_mut().zip(&vector) {
                *lost |= share.abs() > TAKES_PART;
            }
        }
    }
    (found, lost)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_shown_is_not_known() {
        let m = DMatrix::from_row_slice(3, 3, &[4e6, 0.0, 2e3, 0.0, 0.0, 0.0, 2e3, 0.0, 9.0]);
        let c = covariance(&m);
        assert!(c[(1, 1)].is_infinite() && (c[(0, 0)] * (4e6 - 4e6 / 9.0) - 1.0).abs() < 1e-9);
        // Two parameters of which only the sum is shown.
        let sum = covariance(&DMatrix::from_element(2, 2, 1.0));
        assert!(sum[(0, 0)].is_infinite() && sum[(1, 1)].is_infinite());
    }

    #[test]
    fn an_unknown_of_the_window_costs_its_share() {
        let gram = DMatrix::from_row_slice(2, 2, &[4.0, 2.0, 2.0, 2.0]);
        assert!((without_own(&gram, 1)[(0, 0)] - 2.0).abs() < 1e-12);
    }
}
