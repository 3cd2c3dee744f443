//! What runs say of an arm before they are identified, or made.

use nalgebra::DMatrix;

use super::{covariance, without_own};
use crate::record::Campaign;
use crate::replay::{Blocks, ModalArm, Parameter, Sampling, SensorNoise, Window, WindowSums, sums};

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
pub fn growing_information(
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
    let sampling = Sampling { noise: &noise, blocks: &blocks, masks: &masks };
    let of_window = |(sums, window): (&WindowSums, &Window)| {
        let size = sums.gram.ncols() - 1;
        let mut gram = DMatrix::zeros(size, size);
        let grow = |block: &DMatrix<f64>| {
            gram += block.view((0, 0), (size, size));
            without_own(&gram, parameters.len(), window)
        };
        sums.blocks.iter().map(grow).collect()
    };
    let found = sums(arm, parameters, campaign, windows, sampling);
    found.iter().zip(windows).map(of_window).collect()
}
