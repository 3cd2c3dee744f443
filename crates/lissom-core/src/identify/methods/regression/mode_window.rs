//! Windows of the motor's equation with a mode that no tip measures.

use crate::identify::prepare::window::{Weights, Window};

/// A part of the inertia behind a spring.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ModeShape {
    /// Frequency with the motor clamped, ω \[rad/s\].
    pub(crate) omega_rad_s: f64,
    /// Damper over spring, c \[s\].
    pub(crate) damping_s: f64,
    /// Inertia before the spring as a share of all.
    pub(crate) inertia_share: f64,
}

/// Higher derivatives of a window.
#[derive(Debug)]
pub(crate) struct Derivatives {
    /// w⁗ at samples 0..=n \[1/s⁴\], for an integral.
    pub(crate) fourth: Weights,
    /// w⃛ at samples 0..=n \[1/s³\], for an integral.
    pub(crate) third: Weights,
    /// ∫ẅ over each sample interval \[1/s\], length n.
    pub(crate) held: Weights,
}

impl Derivatives {
    pub(crate) fn of(window: &Window, sample_time_s: f64) -> Self {
        let n = window.len();
        let rate = std::f64::consts::PI / (n as f64 * sample_time_s);
        // Neither the one nor the slope of the other vanishes at the ends.
        let weights = |of: &dyn Fn(f64) -> f64| {
            let at = |k: usize| {
                end_weight(k.min(n - k)) * of(std::f64::consts::PI * k as f64 / n as f64)
            };
            Weights::new((0..=n).map(at).collect())
        };
        // sin⁴y = 3/8 − cos(2y)/2 + cos(4y)/8.
        let fourth = |y: f64| rate.powi(4) * (32.0 * (4.0 * y).cos() - 8.0 * (2.0 * y).cos());
        let third = |y: f64| rate.powi(3) * (8.0 * (4.0 * y).sin() - 4.0 * (2.0 * y).sin());
        let held = window.first.windows(2).map(|x| x[1] - x[0]);
        Self {
            fourth: weights(&fourth),
            third: weights(&third),
            held: Weights::new(held.collect()),
        }
    }
}

/// Weight of a sample, so many from the nearer end, in an integral by Gregory's rule of the third order.
fn end_weight(from_end: usize) -> f64 {
    match from_end {
        0 => 3.0 / 8.0,
        1 => 7.0 / 6.0,
        2 => 23.0 / 24.0,
        _ => 1.0,
    }
}

/// Weights that take a known mode into account: with ω, c and J₁/J of [`ModeShape`]
///
/// `τ + c·τ̇ + τ̈/ω² = J·(θ̈ + c·θ⃛ + J₁/J·θ⁗/ω²) + V·(θ̇ + c·θ̈ + θ⃛/ω²)` and dry friction,
///
/// and in windows all derivatives are those of w.
#[derive(Debug)]
pub(crate) struct ModeWindow {
    /// Of the angle, for inertia.
    pub(crate) inertia: Weights,
    /// Of the angle, for viscous friction; with the sign of ẇ.
    pub(crate) viscous: Weights,
    /// Of a torque that is a sample's.
    pub(crate) torque: Weights,
    /// Of a torque that is held over each sample interval, length n.
    pub(crate) held: Weights,
}

impl ModeWindow {
    pub(crate) fn of(window: &Window, shape: ModeShape, sample_time_s: f64) -> Self {
        let higher = Derivatives::of(window, sample_time_s);
        let (c, soft) = (shape.damping_s, shape.omega_rad_s.powi(-2));
        let weights = |a: &Weights, b: (f64, &Weights), c: (f64, &Weights)| {
            let each = a.iter().zip(&**b.1).zip(&**c.1);
            Weights::new(each.map(|((x, y), z)| x + b.0 * y + c.0 * z).collect())
        };
        Self {
            inertia: weights(
                &window.second,
                (-c, &higher.third),
                (shape.inertia_share * soft, &higher.fourth),
            ),
            viscous: weights(&window.first, (-c, &window.second), (soft, &higher.third)),
            torque: weights(&window.value, (-c, &window.first), (soft, &window.second)),
            held: weights(&window.held, (-c, &window.rise), (soft, &higher.held)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `∫w·(derivative of a sinusoid)` by parts, for the third and the fourth.
    #[test]
    fn higher_derivatives_are_those_of_the_window() {
        let (n, w) = (80_u32, 9.0);
        let t = 0.7 / f64::from(n);
        let window = Window::new(n as usize, t);
        let higher = Derivatives::of(&window, t);
        let wave = |f: fn(f64) -> f64| (0..=n).map(|k| f(w * f64::from(k) * t)).collect::<Vec<_>>();
        let angle = wave(f64::sin);
        let (third, fourth) = (wave(|x| -x.cos()), angle.clone());
        let by_parts = [-higher.third.dot(&angle) * t, higher.fourth.dot(&angle) * t];
        let direct =
            [window.value.dot(&third) * w.powi(3) * t, window.value.dot(&fourth) * w.powi(4) * t];
        for (a, b) in by_parts.iter().zip(direct) {
            assert!((a - b).abs() < 1e-3 * b.abs().max(1.0), "{by_parts:?} {direct:?}");
        }
    }
}
