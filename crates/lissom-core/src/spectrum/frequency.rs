//! The frequency of a sinusoidal record.

use num_complex::Complex64;
use rustfft::FftPlanner;

use super::harmonic_fit::HarmonicFit;

/// The refinement ends at this part of a bin: below it the residual's minimum is flat to rounding.
const REFINED_TO: f64 = 1e-8;
/// Most steps of the refinement.
const MOST_STEPS: usize = 60;

/// Finds the frequency of the strongest line of `samples` \[rad/s\].
///
/// It takes the peak of a windowed spectrum and refines it by Brent's method on the least-squares residual of the
/// fundamental. `None` for a constant signal, or if the record contains fewer than two periods.
///
/// # Source
/// `[Brent1973]`
pub fn find_frequency(samples: &[f64], sample_time_s: f64) -> Option<f64> {
    let n = samples.len();
    let mean = samples.iter().sum::<f64>() / n as f64;
    let mut buffer: Vec<Complex64> = samples
        .iter()
        .enumerate()
        .map(|(k, x)| {
            let hann = 0.5 - 0.5 * (std::f64::consts::TAU * k as f64 / n as f64).cos();
            Complex64::from(hann * (x - mean))
        })
        .collect();
    FftPlanner::new().plan_fft_forward(n).process(&mut buffer);
    let (peak, height) = buffer[..n / 2]
        .iter()
        .enumerate()
        .skip(2)
        .map(|(k, z)| (k, z.norm_sqr()))
        .max_by(|a, b| a.1.total_cmp(&b.1))?;
    if height <= 0.0 {
        return None;
    }
    let bin = std::f64::consts::TAU / (n as f64 * sample_time_s);
    let residual = |omega: f64| {
        HarmonicFit::new(n, omega * sample_time_s, 1)
            .map_or(f64::INFINITY, |fit| fit.residual(samples, &fit.solution(samples), None).power)
    };
    let (low, high) = ((peak as f64 - 1.0) * bin, (peak as f64 + 1.0) * bin);
    Some(minimum(residual, low, high, REFINED_TO * bin))
}

/// Where `f` is least between `low` and `high`, to `tolerance`: Brent's method, parabolas through the last points
/// within a golden section.
pub(crate) fn minimum(f: impl Fn(f64) -> f64, mut low: f64, mut high: f64, tolerance: f64) -> f64 {
    let golden = 0.5 * (3.0 - 5.0_f64.sqrt());
    let start = low + golden * (high - low);
    let same = |a: f64, b: f64| a.total_cmp(&b).is_eq();
    // The least value so far, the second, and the one before.
    let mut points = [(start, f(start)); 3];
    let (mut step, mut before) = (0.0_f64, 0.0_f64);
    for _ in 0..MOST_STEPS {
        let [(x, fx), (w, fw), (v, fv)] = points;
        let middle = 0.5 * (low + high);
        if (x - middle).abs() <= 2.0 * tolerance - 0.5 * (high - low) {
            break;
        }
        let (r, q) = ((x - w) * (fx - fv), (x - v) * (fx - fw));
        let (p, q) = ((x - v) * q - (x - w) * r, 2.0 * (q - r));
        let parabola = -p / q;
        let good = q != 0.0
            && before.abs() > tolerance
            && parabola.abs() < 0.5 * before.abs()
            && x + parabola > low
            && x + parabola < high;
        let farther = if x < middle { high - x } else { low - x };
        before = if good { step } else { farther };
        step = if good { parabola } else { golden * before };
        if good && (x + step - low < 2.0 * tolerance || high - x - step < 2.0 * tolerance) {
            step = tolerance.copysign(middle - x);
        }
        let u = x + if step.abs() >= tolerance { step } else { tolerance.copysign(step) };
        let fu = f(u);
        if fu <= fx {
            if u >= x {
                low = x;
            } else {
                high = x;
            }
            points = [(u, fu), points[0], points[1]];
        } else {
            if u < x {
                low = u;
            } else {
                high = u;
            }
            if fu <= fw || same(w, x) {
                points = [points[0], (u, fu), points[1]];
            } else if fu <= fv || same(v, x) || same(v, w) {
                points[2] = (u, fu);
            }
        }
    }
    points[0].0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_a_frequency_between_bins() {
        let omega = 7.123_456;
        let x: Vec<f64> = (0..3000).map(|k| (omega * k as f64 * 0.005 + 0.3).sin() + 2.0).collect();
        let found = find_frequency(&x, 0.005).unwrap();
        assert!((found / omega - 1.0).abs() < 1e-7, "{found}");
    }

    #[test]
    fn a_constant_has_none() {
        assert_eq!(find_frequency(&[1.0; 100], 0.01), None);
    }
}
