//! How noisy a channel is: its sensor's step and the noise beyond it, from its samples alone.

use crate::identify::prepare::thresholds::{STEP_MULTIPLES, STEP_WHOLE};
use crate::record::extent::{least_difference, range};

/// Differences below this share of the range are rounding, not steps.
const ROUNDING: f64 = 1e-9;
/// Samples looked at, spread over the record.
const SAMPLES: usize = 8192;
/// Share of the fourth differences that is kept, the smaller ones, and the mean square of so many of a normal
/// number of standard error one, `1 − 2·z·φ(z)/KEPT` with z where |x| is less in this share.
const KEPT: f64 = 0.8;
const KEPT_SQUARE: f64 = 0.437_723;
/// Σ of the squares of 1, −4, 6, −4, 1.
const FOURTH_DIFFERENCE: f64 = 70.0;

/// Noise of a channel, in its own unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ChannelNoise {
    /// Step of the sensor; 0 where the samples have none.
    pub(crate) step: f64,
    /// Standard error of all noise: rounding, step/√12, and what the sensor adds.
    pub(crate) std: f64,
    /// Standard error of what is independent from sample to sample: less than that of all noise where the
    /// motion takes many samples for a step.
    pub(crate) independent: f64,
}

/// Step and noise of uniform samples of a smooth motion.
///
/// The step is the smallest difference between neighbours, if nearly all others are multiples of
/// it. The standard error is from the fourth differences, which smooth motion leaves small, without the largest, which
/// are those of its few corners; never less than step/√12. Of white noise it is exact; of
/// rounding alone, whose errors hang together, good to a half.
pub(crate) fn channel_noise(x: &[f64]) -> ChannelNoise {
    let (step, independent) = (step(x), independent_noise(x));
    ChannelNoise { step, std: independent.max(step / 12.0_f64.sqrt()), independent }
}

/// What a sensor shows of `value` that reads in steps of `step`, one of which is `one`.
pub(crate) fn reading(value: f64, one: f64, step: f64) -> f64 {
    if step > 0.0 { one + ((value - one) / step).round() * step } else { value }
}

/// [`ChannelNoise::independent`] of uniform samples of a smooth motion.
pub(crate) fn independent_noise(x: &[f64]) -> f64 {
    let mut fourth: Vec<f64> = x
        .windows(5)
        .step_by(apart(x))
        .map(|w| (w[0] - 4.0 * w[1] + 6.0 * w[2] - 4.0 * w[3] + w[4]).abs())
        .collect();
    if fourth.is_empty() {
        return 0.0;
    }
    spread(&mut fourth) / FOURTH_DIFFERENCE.sqrt()
}

/// Standard error of normal numbers whose sizes these are, from the smaller ones.
pub(crate) fn spread(sizes: &mut [f64]) -> f64 {
    let count = ((KEPT * sizes.len() as f64) as usize).max(1);
    let (below, last, _) = sizes.select_nth_unstable_by(count - 1, f64::total_cmp);
    let square: f64 = below.iter().chain([&*last]).map(|x| x * x).sum();
    (square / count as f64 / KEPT_SQUARE).sqrt()
}

/// Samples from one that is looked at to the next.
fn apart(x: &[f64]) -> usize {
    x.len().div_ceil(SAMPLES).max(1)
}

/// The sensor's step, or 0.
fn step(x: &[f64]) -> f64 {
    let floor = ROUNDING * range(x);
    let step = least_difference(x, floor);
    if !step.is_finite() {
        return 0.0;
    }
    let is_whole = |d: f64| (d / step - (d / step).round()).abs() < STEP_WHOLE;
    let moves = x.windows(2).step_by(apart(x)).map(|w| (w[1] - w[0]).abs());
    let (whole, all) = moves
        .filter(|d| *d > floor)
        .fold((0, 0), |(whole, all), d| (whole + i32::from(is_whole(d)), all + 1));
    if f64::from(whole) >= STEP_MULTIPLES * f64::from(all) { step } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wave(noise: f64) -> Vec<f64> {
        // A fixed sequence that no one can tell from noise: sums of twelve uniform numbers.
        let mut state = 1_u64;
        let mut uniform = move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        (0..20_000)
            .map(|k| {
                let normal: f64 = (0..12).map(|_| uniform()).sum::<f64>() - 6.0;
                (0.004 * f64::from(k)).sin() + noise * normal
            })
            .collect()
    }

    #[test]
    fn white_noise_is_found() {
        let found = channel_noise(&wave(1e-3));
        assert!(found.step.abs() < 1e-12, "{found:?}");
        assert!((found.std / 1e-3 - 1.0).abs() < 0.05, "{found:?}");
    }

    #[test]
    fn a_step_is_found_with_and_without_noise() {
        for (noise, expected) in
            [0.0, 0.2, 0.3, 0.5].map(|noise: f64| (noise, (noise * noise + 1.0 / 12.0).sqrt()))
        {
            let q = 0.0015;
            let x: Vec<f64> = wave(noise * q).iter().map(|x| (x / q).round() * q).collect();
            let found = channel_noise(&x);
            assert!((found.step / q - 1.0).abs() < 1e-6, "{found:?}");
            let ratio = found.std / q / expected;
            // Rounding alone is no white noise.
            let near = if noise == 0.0 {
                0.5
            } else if noise < 0.3 {
                0.2
            } else {
                0.1
            };
            assert!((ratio - 1.0).abs() < near, "{noise}: {ratio}");
        }
    }

    #[test]
    fn a_channel_at_rest_has_none() {
        assert_eq!(
            channel_noise(&[1.0; 50]),
            ChannelNoise { step: 0.0, std: 0.0, independent: 0.0 }
        );
    }
}
