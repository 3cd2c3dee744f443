//! Which readings are used, and which residuals may be correlated.

use rayon::prelude::*;

use crate::identify::output_error::thresholds::{
    RESIDUAL_BLOCK, RESIDUAL_BLOCKS_LEAST, RESIDUAL_BLOCKS_MOST,
};
use crate::identify::prepare::channel_check::clipped_share;
use crate::identify::prepare::thresholds::CLIPPED_REPORTED;
use crate::record::extent::range;
use crate::record::{Campaign, Run};
use crate::replay::Blocks;

/// Readings of each channel of a run that are used; `None` if all are.
pub(crate) type Masks = Vec<Option<Vec<bool>>>;

/// Leaves out readings at the ends of a channel's range, if the channel is clipped.
pub(crate) fn masks(campaign: &Campaign) -> Vec<Masks> {
    let of_run = |run: &Run| {
        std::iter::once(run.motor()).chain(run.tips().iter().map(Vec::as_slice)).map(mask).collect()
    };
    campaign.runs.par_iter().with_max_len(1).map(of_run).collect()
}

fn mask(x: &[f64]) -> Option<Vec<bool>> {
    if clipped_share(x) < CLIPPED_REPORTED {
        return None;
    }
    let low = x.iter().copied().fold(f64::INFINITY, f64::min);
    let near = 1e-9 * range(x);
    let high = low + range(x);
    Some(x.iter().map(|v| v - low > near && high - v > near).collect())
}

/// Blocks of samples of each run. `omega_rad_s` is the frequency of a run that is a sine in steady state.
pub(crate) fn blocks(campaign: &Campaign, omega_rad_s: &[Option<f64>]) -> Vec<Blocks> {
    let most = (RESIDUAL_BLOCKS_MOST / campaign.runs.len() as f64).max(RESIDUAL_BLOCKS_LEAST);
    let count =
        |samples: f64| (samples / RESIDUAL_BLOCK).round().clamp(RESIDUAL_BLOCKS_LEAST, most);
    let of_run = |(run, omega): (&Run, &Option<f64>)| {
        let period = omega.map(|w| std::f64::consts::TAU / (w * run.sample_time_s()));
        let samples = period.unwrap_or(run.len() as f64);
        Blocks { samples: samples / count(samples), period }
    };
    campaign.runs.iter().zip(omega_rad_s).map(of_run).collect()
}
