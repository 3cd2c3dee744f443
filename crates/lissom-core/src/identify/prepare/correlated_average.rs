//! Mean of a noisy signal with correlated errors over a part of a run, and its change within that part.

use std::borrow::Cow;
use std::f64::consts::PI;

use nalgebra::{Matrix3, Vector3};

use crate::identify::thresholds::PRESENT;

/// Longer series are first averaged to about this many values: only slow changes matter here.
const VALUES_MOST: usize = 4096;
/// Bins of the residual's spectrum that stand for its level at zero frequency. The mean and the
/// quadratic, under the window, end below the first of them.
const BINS: std::ops::RangeInclusive<usize> = 3..=18;
/// Fewest values from which a level is read: the bins stay below half the Nyquist frequency.
pub(crate) const VALUES_LEAST: usize = 72;
/// Of these the strongest are left out: an oscillation of the beam, or of friction once a turn,
/// stands in so many of them, and the window takes it out of the mean.
const LINES: usize = 4;
/// Independent values in that level: twelve complex bins, of which a Hann window correlates
/// neighbours by 2/3 and the next by 1/6: `2·12/(1 + 2·(2/3)² + 2·(1/6)²)`.
pub(crate) const FREEDOM: f64 = 12.4;

/// What a series is, averaged under a Hann window.
///
/// The window takes oscillations out of the mean with the third power of their number of periods,
/// where a plain mean does with the first.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Average {
    /// Mean.
    pub(crate) mean: f64,
    /// Its standard deviation: the residual's spectrum at low frequency, and the slow change where
    /// one is there.
    pub(crate) std: f64,
    /// Largest minus smallest value of the parabola through the series.
    pub(crate) change: f64,
    /// Standard deviation of that.
    pub(crate) change_std: f64,
}

/// Averages `series`; `None` with fewer than [`VALUES_LEAST`] values.
///
/// A parabola in time is fitted under the same weights. What it leaves is coloured (ringing,
/// sensor steps): the deviations come from the level of its spectrum at low frequency.
pub(crate) fn average(series: &[f64]) -> Option<Average> {
    let series = thinned(series);
    let n = series.len();
    if n < VALUES_LEAST {
        return None;
    }
    // τ from −1 to 1 over the stretch, and the window cos²(πτ/2).
    let place = |k: usize| (2.0 * k as f64 + 1.0) / n as f64 - 1.0;
    let weight: Vec<f64> = (0..n).map(|k| (0.5 * PI * place(k)).cos().powi(2)).collect();
    let (mut total, mut squares, mut sum) = (0.0, 0.0, 0.0);
    for (w, y) in weight.iter().zip(&*series) {
        total += w;
        squares += w * w;
        sum += w * y;
    }
    let mean = sum / total;
    let (mut normal, mut spread) = (Matrix3::zeros(), Matrix3::zeros());
    let mut right = Vector3::zeros();
    for (k, (w, y)) in weight.iter().zip(&*series).enumerate() {
        let row = Vector3::new(1.0, place(k), place(k).powi(2));
        normal += *w * row * row.transpose();
        spread += w * w * row * row.transpose();
        right += *w * (y - mean) * row;
    }
    let inverse = normal.try_inverse()?;
    let fit = inverse * right;
    let parabola = |k: usize| fit[0] + place(k) * (fit[1] + place(k) * fit[2]);
    let left: Vec<f64> = weight
        .iter()
        .zip(&*series)
        .enumerate()
        .map(|(k, (w, y))| w * (y - mean - parabola(k)))
        .collect();
    let level = low_level(&left) / squares;
    let covariance = level * inverse * spread * inverse;
    let at = |x: f64| x * (fit[1] + x * fit[2]);
    let vertex = -0.5 * fit[1] / fit[2];
    let ends = [at(-1.0), at(1.0), if vertex.abs() < 1.0 { at(vertex) } else { at(1.0) }];
    let change =
        ends.iter().fold(f64::MIN, |m, v| m.max(*v)) - ends.iter().fold(f64::MAX, |m, v| m.min(*v));
    let change_std = (4.0 * covariance[(1, 1)] + covariance[(2, 2)]).max(0.0).sqrt();
    let slow = if change > PRESENT * change_std {
        weight.iter().enumerate().map(|(k, w)| w * parabola(k).powi(2)).sum::<f64>() / total
    } else {
        0.0
    };
    let std = (level * squares / (total * total) + slow).sqrt();
    Some(Average { mean, std, change, change_std })
}

/// Means of neighbours, where there are many; what is left over at the end falls away.
fn thinned(series: &[f64]) -> Cow<'_, [f64]> {
    let factor = series.len().div_ceil(VALUES_MOST);
    if factor < 2 {
        return Cow::Borrowed(series);
    }
    let mean = |c: &[f64]| c.iter().sum::<f64>() / factor as f64;
    Cow::Owned(series.chunks_exact(factor).map(mean).collect())
}

/// Power of the low bins, lines left out.
fn low_level(x: &[f64]) -> f64 {
    let step = 2.0 * PI / x.len() as f64;
    let power = |bin: usize| {
        let (mut re, mut im) = (0.0, 0.0);
        let (turn_sin, turn_cos) = (step * bin as f64).sin_cos();
        let (mut sin, mut cos) = (0.0, 1.0);
        for v in x {
            re += v * cos;
            im += v * sin;
            (cos, sin) = (cos * turn_cos - sin * turn_sin, sin * turn_cos + cos * turn_sin);
        }
        re * re + im * im
    };
    let mut powers: Vec<f64> = BINS.map(power).collect();
    powers.sort_by(f64::total_cmp);
    let kept = powers.len() - LINES;
    // Powers of noise are exponential: the i-th smallest of n has mean Σ 1/(n − j), j < i.
    let (mut expected, mut of_all) = (0.0, 0.0);
    for i in 0..kept {
        of_all += 1.0 / (powers.len() - i) as f64;
        expected += of_all;
    }
    powers[..kept].iter().sum::<f64>() / expected
}

#[cfg(test)]
mod tests {
    use rand_distr::{Distribution as _, StandardNormal};
    use rand_xoshiro::Xoshiro256PlusPlus;
    use rand_xoshiro::rand_core::SeedableRng as _;

    use super::*;

    fn noise(seed: u64, n: usize) -> Vec<f64> {
        let mut rng = Xoshiro256PlusPlus::seed_from_u64(seed);
        (0..n).map(|_| StandardNormal.sample(&mut rng)).collect()
    }

    /// Ratio of scatter of the mean over seeds to the standard error claimed.
    fn honesty(colour: impl Fn(Vec<f64>) -> Vec<f64>) -> f64 {
        let (mut scatter, mut claimed) = (0.0, 0.0);
        for seed in 0..400 {
            let a = average(&colour(noise(seed, 1000))).unwrap();
            scatter += a.mean * a.mean;
            claimed += a.std * a.std;
        }
        (scatter / claimed).sqrt()
    }

    #[test]
    fn deviations_of_white_and_coloured_noise_are_honest() {
        // 400 seeds give the ratio to 3.5 % (one standard error).
        let white = honesty(|x| x);
        assert!((white - 1.0).abs() < 0.12, "{white}");
        let red = honesty(|x| {
            let mut state = 0.0;
            x.iter()
                .map(|e| {
                    state = 0.8 * state + e;
                    state
                })
                .collect()
        });
        assert!((red - 1.0).abs() < 0.12, "{red}");
        // Sensor steps: differences of white noise.
        let blue = honesty(|x| x.windows(2).map(|w| w[1] - w[0]).collect());
        assert!(blue < 1.0, "{blue}");
    }

    #[test]
    fn ringing_falls_out_of_the_mean() {
        // 7.3 periods: a plain mean is off by up to 4 %, and the Hann window's by 1/(2π·7.3³).
        let x: Vec<f64> =
            (0..1000).map(|k| 2.0 + (2.0 * PI * 7.3 * f64::from(k) / 1000.0).sin()).collect();
        let a = average(&x).unwrap();
        assert!((a.mean - 2.0).abs() < 1e-3, "{a:?}");
        // And out of its standard error: unit amplitude over 7 periods would count as 0.1.
        assert!(a.std < 1e-2, "{a:?}");
    }

    #[test]
    fn a_slow_change_is_measured_and_counted() {
        let x: Vec<f64> = (0..1000).map(|k| 5.0 + f64::from(k) / 1000.0).collect();
        let a = average(&x).unwrap();
        assert!((a.change - 1.0).abs() < 2e-3, "{a:?}");
        // Of a line over −½ to ½ under the window: ½·√(1/3 − 2/π²).
        let expected = 0.5 * (1.0_f64 / 3.0 - 2.0 / (PI * PI)).sqrt();
        assert!((a.std / expected - 1.0).abs() < 1e-2, "{a:?}");
    }

    #[test]
    fn long_series_are_thinned_without_a_change_of_the_mean() {
        let x = noise(3, 100_000);
        let plain = x.iter().sum::<f64>() / x.len() as f64;
        let a = average(&x).unwrap();
        assert!((a.mean - plain).abs() < 3.0 * a.std && a.std < 2.0 / 1e5_f64.sqrt(), "{a:?}");
    }

    #[test]
    fn few_values_give_none() {
        assert!(average(&[1.0; VALUES_LEAST - 1]).is_none());
        assert!(average(&[1.0; VALUES_LEAST]).is_some_and(|a| a.std < 1e-12 && a.mean > 0.9));
    }
}
