//! Standard errors that runs can give, before they are identified or made.

use nalgebra::DMatrix;

use super::{covariance, without_own};
use crate::record::Campaign;
use crate::replay::{Blocks, ModalArm, Parameter, Sampling, SensorNoise, Window, WindowSums, sums};

/// Covariance of the best unbiased estimator of `parameters` from these runs (the Cramér-Rao bound). The state at the
/// start of each window and the zero of each tip count as unknown, too.
///
/// ```text
/// C = (Σ_w H_pp − H_pz·H_zz⁻¹·H_zp)⁻¹,   H = Σ (∂ŷ/∂(p, z))ᵀ·(∂ŷ/∂(p, z))/σ²
/// ```
///
/// p are the parameters, z the unknowns of a single window, ŷ the readings of each sensor at each sample as the replay
/// predicts them, and σ the [standard deviation](SensorNoise::standard error) of their errors. `arm` and `windows` may be
/// those that the [output-error method](crate::identify::OutputError) has found, or may be known in advance. A
/// parameter that the runs do not determine has an infinite variance. Rows and columns are in the order of
/// `parameters`, in SI units.
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

/// Fisher information of each window about `parameters` after one, two, … stretches of `samples` samples, without the
/// unknowns of the window itself.
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
    let sampling = Sampling { noise: &noise, blocks: &blocks, masks: &masks, command_noise: 0.0 };
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
