//! The motor's velocity, smoothed.

use crate::identify::prepare::phases::{Phase, phases_of, velocities};
use crate::identify::prepare::window::Window;

/// Velocity at every sample, the angle weighted with the derivative of a window about it, and the slip phases of the same
/// smoothing.
pub(crate) fn velocity_and_phases(
    motor: &[f64],
    smooth: usize,
    sample_time_s: f64,
) -> (Vec<f64>, Vec<Phase>) {
    let window = Window::new(smooth, sample_time_s);
    let half = window.len() / 2;
    // What a ramp of one per second shows.
    let ramp: f64 = window.first.iter().enumerate().map(|(k, w)| -w * k as f64).sum();
    let scale = 1.0 / (ramp * sample_time_s);
    let mut moved = velocities(motor, &window);
    let phases = phases_of(&moved, &window, 0.0);
    if moved.is_empty() {
        // Shorter than the smoothing: one velocity for all of it.
        let from_first = motor.iter().zip(&*window.first).map(|(x, w)| (motor[0] - x) * w);
        moved.push(from_first.sum::<f64>());
    }
    let last = moved.len() - 1;
    let mut velocity = vec![scale * moved[0]; half.min(motor.len())];
    velocity.extend(moved.iter().take(motor.len() - velocity.len()).map(|moved| scale * moved));
    velocity.resize(motor.len(), scale * moved[last]);
    (velocity, phases)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ramp_has_its_velocity_everywhere() {
        let ramp: Vec<f64> = (0..100).map(|k| 2.0 + 0.003 * f64::from(k)).collect();
        for v in velocity_and_phases(&ramp, 9, 0.01).0 {
            assert!((v - 0.3).abs() < 1e-12, "{v}");
        }
    }
}
