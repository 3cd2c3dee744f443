//! The frequency of a sinusoidal record.

use num_complex::Complex64;
use rustfft::FftPlanner;

use super::harmonics::least_squares;

/// Halvings of the bracket in the refinement: from one bin to 1e-9 of it.
const REFINEMENTS: usize = 45;

/// Frequency of the strongest line of `samples` \[rad/s\].
///
/// The peak of a windowed spectrum, refined by golden section on the least-squares residual of
/// the fundamental. `None` for a constant signal or a line below two periods in the record.
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
        least_squares(samples, omega, sample_time_s, 1).map_or(f64::INFINITY, |h| h.residual_rms)
    };
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    let (mut low, mut high) = ((peak as f64 - 1.0) * bin, (peak as f64 + 1.0) * bin);
    let (mut a, mut b) = (high - golden * (high - low), low + golden * (high - low));
    let (mut ra, mut rb) = (residual(a), residual(b));
    for _ in 0..REFINEMENTS {
        if ra < rb {
            high = b;
            (b, rb) = (a, ra);
            a = high - golden * (high - low);
            ra = residual(a);
        } else {
            low = a;
            (a, ra) = (b, rb);
            b = low + golden * (high - low);
            rb = residual(b);
        }
    }
    Some(0.5 * (low + high))
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
