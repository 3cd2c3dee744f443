//! The noise of each channel, from the residual of a fit.

use crate::identify::output_error::engine::data::Masks;
use crate::identify::output_error::thresholds::{
    NOISE_LEAST_FACTOR, NOISE_OVER_STEP_LEAST, NOISE_RESIDUALS, SENSOR_STEP_COUNTED,
};
use crate::identify::prepare::channel_noise::channel_noise;
use crate::record::{Campaign, Run};
use crate::replay::{Prediction, SensorNoise, Window};

/// Steps of the golden-section search for ln σ, to 1 % of σ.
const GOLDEN_STEPS: usize = 24;

/// First estimate, from the samples alone, no less than their rounding. A sensor's steps are counted as Gaussian noise.
pub(crate) fn of_samples(campaign: &Campaign) -> Vec<SensorNoise> {
    let rounding = |x: &[f64]| f64::EPSILON * x.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
    each_channel(campaign, &|x| channel_noise(x).std.max(rounding(x)))
        .into_iter()
        .map(SensorNoise::gaussian)
        .collect()
}

/// Step of each channel's sensor; zero where it has none.
pub(crate) fn steps(campaign: &Campaign) -> Vec<f64> {
    each_channel(campaign, &|x| channel_noise(x).step)
}

/// Median over the runs of a quantity of each channel, motor first, then tips.
fn each_channel(campaign: &Campaign, estimate: &dyn Fn(&[f64]) -> f64) -> Vec<f64> {
    let channel = |c: usize, run: &Run| match c.checked_sub(1) {
        None => estimate(run.motor()),
        Some(tip) => estimate(&run.tips()[tip]),
    };
    (0..=campaign.channels.tips.len())
        .map(|c| {
            let mut found: Vec<f64> = campaign.runs.iter().map(|run| channel(c, run)).collect();
            found.sort_by(f64::total_cmp);
            found[found.len() / 2]
        })
        .collect()
}

/// Residuals of each channel over windows whose readings are `predicted`.
pub(crate) fn residuals(
    campaign: &Campaign,
    windows: &[Window],
    predicted: &[Option<Prediction>],
    masks: &[Masks],
) -> Vec<Vec<f64>> {
    let mut all = vec![Vec::new(); 1 + campaign.channels.tips.len()];
    for (window, found) in windows.iter().zip(predicted) {
        let Some(found) = found else { continue };
        let run = &campaign.runs[window.run];
        for (c, (left, predicted)) in all.iter_mut().zip(&found.channels).enumerate() {
            let logged = match c.checked_sub(1) {
                None => run.motor(),
                Some(tip) => &run.tips()[tip],
            };
            let counts = |k: &usize| masks[window.run][c].as_ref().is_none_or(|m| m[*k]);
            let pairs = window.samples.clone().zip(predicted).filter(|(k, _)| counts(k));
            left.extend(pairs.map(|(k, p)| logged[k] - p));
        }
    }
    all
}

/// Most likely noise of a sensor with steps of `step`, from its residuals; no less than `least`.
pub(crate) fn most_likely(residuals: &[f64], step: f64, least: f64) -> SensorNoise {
    let pieces = (residuals.len() / NOISE_RESIDUALS).max(1);
    let looked_at: Vec<f64> = residuals.iter().copied().step_by(pieces).collect();
    let squares: f64 = looked_at.iter().map(|e| e * e).sum();
    let deviation = (squares / looked_at.len().max(1) as f64).sqrt().max(least);
    if step < SENSOR_STEP_COUNTED * deviation {
        return SensorNoise::gaussian(deviation);
    }
    // −ln of the probability of the sensor's readings.
    let unlikely = |log_sigma: f64| {
        let noise = SensorNoise { sigma: log_sigma.exp(), step };
        looked_at.iter().map(|e| noise.surprise(*e)).sum::<f64>()
    };
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    let (mut low, mut high) =
        ((NOISE_OVER_STEP_LEAST * step).ln(), (2.0 * deviation.max(step)).ln());
    for _ in 0..GOLDEN_STEPS {
        let (a, b) = (high - golden * (high - low), low + golden * (high - low));
        if unlikely(a) < unlikely(b) { high = b } else { low = a }
    }
    SensorNoise { sigma: (0.5 * (low + high)).exp(), step }
}

/// Whether a sensor shows its steps and no noise: its noise is the smallest that is assumed.
pub(crate) fn is_least(noise: &SensorNoise) -> bool {
    noise.step > 0.0 && noise.sigma < NOISE_LEAST_FACTOR * NOISE_OVER_STEP_LEAST * noise.step
}
