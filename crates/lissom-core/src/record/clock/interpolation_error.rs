//! How precisely samples are predicted from their neighbours, measured on samples that are left out.

use super::lagrange::left_out;

/// Most places that are looked at: enough for a mean.
const MOST_PLACES: usize = 20_000;

/// The error of samples that are interpolated at a grid like that of the samples themselves.
///
/// Samples are left out and predicted from their next four neighbours (1, 1, 2 and 2 steps away), and from those that
/// are 1, 1, 3 and 3 steps away. With noise σ and a fourth difference A of the motion the mean square errors are
/// A²/36 + 1.944 σ² and 9 A²/64 + 1.641 σ²; a point halfway between two samples has the error 3 A/128.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct InterpolationError {
    /// Of a point halfway between two samples, rms; without the samples' noise.
    pub(super) rms: f64,
    /// Standard deviation of the noise of the samples.
    pub(super) noise: f64,
    /// Root mean square of what acceleration moves within a step.
    pub(super) bend: f64,
}

impl InterpolationError {
    /// Of a channel at times in steps.
    pub(super) fn of(time: &[f64], y: &[f64]) -> Self {
        let near = mean_square(time, y, [-2, -1, 1, 2]);
        let far = mean_square(time, y, [-3, -1, 1, 3]);
        let fourth = ((far - 0.844 * near) / (0.1406 - 0.0234)).max(0.0);
        let noise = (near - fourth / 36.0).max(0.0) / 1.944;
        let bend = (mean_bend(y) - 6.0 * noise).max(0.0);
        Self { rms: 3.0 / 128.0 * fourth.sqrt(), noise: noise.sqrt(), bend: bend.sqrt() }
    }
}

fn mean_square(time: &[f64], y: &[f64], nodes: [isize; 4]) -> f64 {
    let stride = y.len() / MOST_PLACES + 1;
    let errors = (0..y.len()).step_by(stride).filter_map(|k| left_out(time, y, k, nodes));
    let (sum, count) = errors
        .filter(|(_, squares)| *squares < 4.0)
        .fold((0.0, 0_usize), |(sum, count), (error, _)| (sum + error * error, count + 1));
    sum / count.max(1) as f64
}

fn mean_bend(y: &[f64]) -> f64 {
    let bends = y.windows(3).map(|y| (y[2] - 2.0 * y[1] + y[0]).powi(2));
    bends.sum::<f64>() / y.len().max(1) as f64
}

/// Rms error of rows that are filled in where `lost` follow each other, from rows that are left out.
pub(super) fn fill_error(y: &[f64], lost: usize) -> f64 {
    let stride = y.len() / MOST_PLACES + 1;
    let before = (lost / 2 + 1).cast_signed();
    let after = lost.cast_signed() + 1 - before;
    let nodes = [-before - 1, -before, after, after + 1];
    let time: Vec<f64> = (0..y.len()).map(|k| k as f64).collect();
    let errors = (0..y.len()).step_by(stride).filter_map(|k| left_out(&time, y, k, nodes));
    let (sum, count) =
        errors.fold((0.0, 0_usize), |(sum, count), (error, _)| (sum + error * error, count + 1));
    (sum / count.max(1) as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_error_of_a_sine_is_found_without_and_with_noise() {
        let n = 5000;
        let step = 0.4;
        let time: Vec<f64> = (0..n).map(f64::from).collect();
        let mut state = 1_u64;
        let mut uniform = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 40) as f64 / f64::from(1 << 24) - 0.5
        };
        let expected = 3.0 / 128.0 * step * step * step * step / 2.0_f64.sqrt();
        for size in [0.0, 3e-3] {
            let y: Vec<f64> = time.iter().map(|t| (step * t).sin() + size * uniform()).collect();
            let found = InterpolationError::of(&time, &y);
            assert!((found.rms / expected - 1.0).abs() < 0.3, "{size}: {found:?} {expected}");
            // Terms of sixth order count as noise: some 5e-4 here.
            assert!((found.noise - size * 0.2887).abs() < 6e-4, "{found:?}");
        }
        assert!(fill_error(&time.iter().map(|t| t * t).collect::<Vec<_>>(), 3) < 1e-6);
    }
}
