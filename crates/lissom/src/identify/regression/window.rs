//! The smooth window of the regression.

use std::f64::consts::PI;

/// `w(x) = sin⁴(πx)` on a span of n samples, with derivatives and integrals.
///
/// w and its first three derivatives vanish at both ends: integrating by parts twice moves the
/// derivatives of a measured signal onto w and leaves no boundary terms.
#[derive(Debug, Clone)]
pub(crate) struct Window {
    /// w at samples 0..=n.
    pub(crate) value: Vec<f64>,
    /// ẇ at samples 0..=n \[1/s\].
    pub(crate) first: Vec<f64>,
    /// ẅ at samples 0..=n \[1/s²\].
    pub(crate) second: Vec<f64>,
    /// ∫w over each sample interval \[s\], length n: what a held signal is weighted with.
    pub(crate) held: Vec<f64>,
    /// 1/√∫ẅ²: scales a row to the noise that white noise in the angle puts into it.
    pub(crate) row_scale: f64,
}

impl Window {
    /// A window of `n` sample intervals.
    pub(crate) fn new(n: usize, sample_time_s: f64) -> Self {
        let length = n as f64 * sample_time_s;
        let rate = PI / length;
        let at = |k: usize| (PI * k as f64 / n as f64).sin_cos();
        let value = (0..=n).map(|k| at(k).0.powi(4)).collect();
        let first = (0..=n).map(|k| 4.0 * rate * at(k).0.powi(3) * at(k).1).collect();
        let second: Vec<f64> = (0..=n)
            .map(|k| {
                let (s, c) = at(k);
                rate * rate * (12.0 * s * s * c * c - 4.0 * s.powi(4))
            })
            .collect();
        // ∫ sin⁴(πx) dx = 3x/8 − sin(2πx)/(4π) + sin(4πx)/(32π)
        let integral = |k: usize| {
            let x = k as f64 / n as f64;
            length
                * (0.375 * x - (2.0 * PI * x).sin() / (4.0 * PI)
                    + (4.0 * PI * x).sin() / (32.0 * PI))
        };
        let held = (0..n).map(|k| integral(k + 1) - integral(k)).collect();
        let power: f64 = second.iter().map(|v| v * v).sum::<f64>() * sample_time_s;
        Self { value, first, second, held, row_scale: 1.0 / power.sqrt() }
    }

    /// Sample intervals spanned.
    pub(crate) fn len(&self) -> usize {
        self.held.len()
    }
}

/// Σ a·b over the shorter of two slices.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What integration by parts leaves of `∫w·ẍ − ∫ẅ·x` for a sinusoid over 0.4 s.
    fn left_over(n: usize) -> f64 {
        let t = 0.4 / n as f64;
        let w = Window::new(n, t);
        let x: Vec<f64> = (0..=n).map(|k| (3.0 * k as f64 * t).sin()).collect();
        let a: Vec<f64> = x.iter().map(|x| -9.0 * x).collect();
        (dot(&w.value, &a) - dot(&w.second, &x)).abs() * t
    }

    #[test]
    fn integration_by_parts_holds_to_the_fourth_order() {
        let (coarse, fine) = (left_over(20), left_over(40));
        assert!(coarse < 2e-4, "{coarse}");
        assert!(fine < coarse / 15.0, "{fine} {coarse}");
    }

    #[test]
    fn held_weights_sum_to_the_integral() {
        let w = Window::new(37, 0.01);
        assert!((w.held.iter().sum::<f64>() - 0.375 * 0.37).abs() < 1e-14);
    }
}
