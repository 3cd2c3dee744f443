//! The motor's velocity, smoothed.

use crate::identify::methods::regression::window::Window;

/// Velocity at every sample: the angle weighted with the derivative of a window about it.
pub(crate) fn velocity(motor: &[f64], smooth: usize, sample_time_s: f64) -> Vec<f64> {
    let window = Window::new(smooth, sample_time_s);
    let (n, half) = (window.len(), window.len() / 2);
    // What a ramp of one per second shows.
    let ramp: f64 = window.first.iter().enumerate().map(|(k, w)| w * k as f64).sum();
    let scale = 1.0 / (ramp * sample_time_s);
    let last = motor.len().saturating_sub(n + 1);
    let at = |k: usize| {
        let from = k.saturating_sub(half).min(last);
        let moved = motor[from..].iter().zip(&*window.first).map(|(x, w)| (x - motor[from]) * w);
        scale * moved.sum::<f64>()
    };
    (0..motor.len()).map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ramp_has_its_velocity_everywhere() {
        let ramp: Vec<f64> = (0..100).map(|k| 2.0 + 0.003 * f64::from(k)).collect();
        for v in velocity(&ramp, 9, 0.01) {
            assert!((v - 0.3).abs() < 1e-12, "{v}");
        }
    }
}
