//! Estimates of gravity of an unbalanced load.

use crate::identify::estimate::Estimate;
use crate::load::GravityLoad;
use crate::record::Campaign;

/// Estimate of the gravity of an unbalanced load: the torque `g_s·sin θ + g_c·cos θ = m·g·l·sin(θ + φ)` that the motor
/// has to supply, at the motor's angle θ as logged
/// \[N·m, or the unit of the command if the torque constant is unknown\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gravity {
    /// g_s.
    pub sine: Estimate,
    /// g_c.
    pub cosine: Estimate,
    /// Covariance of g_s and g_c.
    pub covariance: f64,
}

impl Gravity {
    /// Builds the estimate from both coefficients and their covariance.
    pub fn new(sine: Estimate, cosine: Estimate, covariance: f64) -> Self {
        Self { sine, cosine, covariance }
    }

    /// Largest torque m·g·l = √(g_s² + g_c²).
    pub fn amplitude(&self) -> Estimate {
        let (s, c) = (self.sine, self.cosine);
        let value = s.value.hypot(c.value);
        let square = (s.value * s.std).powi(2)
            + (c.value * c.std).powi(2)
            + 2.0 * s.value * c.value * self.covariance;
        let std = square.max(0.0).sqrt() / value.max(f64::MIN_POSITIVE);
        Estimate { value, std }
    }

    /// Torque constant \[N·m per unit of command\] that follows if the largest torque of the load is known to be
    /// `mgl_nm`: `K = assumed·m·g·l/√(g_s² + g_c²)`. `assumed` is the torque constant with which this estimate was made
    /// (1 if it is per unit of command).
    pub fn torque_constant(&self, mgl_nm: f64, assumed: f64) -> Estimate {
        let amplitude = self.amplitude();
        let value = assumed * mgl_nm / amplitude.value;
        Estimate { value, std: value * amplitude.std / amplitude.value }
    }

    /// Phase φ \[rad\], from −π to π: at θ = −φ the load is in its equilibrium, hanging or upright.
    pub fn phase_rad(&self) -> Estimate {
        let (s, c) = (self.sine, self.cosine);
        let square = (c.value * s.std).powi(2) + (s.value * c.std).powi(2)
            - 2.0 * s.value * c.value * self.covariance;
        let std =
            square.max(0.0).sqrt() / (s.value.powi(2) + c.value.powi(2)).max(f64::MIN_POSITIVE);
        Estimate { value: c.value.atan2(s.value), std }
    }

    /// The load without its standard errors.
    pub fn load(&self) -> GravityLoad {
        GravityLoad { sine_nm: self.sine.value, cosine_nm: self.cosine.value }
    }

    /// Converts to another unit: all values are multiplied by `factor`.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        let covariance = self.covariance * factor * factor;
        Self { sine: self.sine.scaled(factor), cosine: self.cosine.scaled(factor), covariance }
    }
}

/// Torque per command by which the load that was found is the one that the campaign says.
pub(crate) fn torque_constant(campaign: &Campaign, gravity: Option<Gravity>) -> Option<Estimate> {
    let assumed = campaign.channels.command.torque_per_unit();
    Some(gravity?.torque_constant(campaign.mgl_nm?, assumed))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against differences of amplitude and phase by the coefficients.
    #[test]
    fn amplitude_and_phase_have_the_errors_of_their_coefficients() {
        let estimate = |value: f64, std: f64| Estimate { value, std };
        let load = Gravity::new(estimate(0.3, 0.01), estimate(-0.4, 0.02), 1e-4);
        let of = |s: f64, c: f64| [s.hypot(c), c.atan2(s)];
        let h = 1e-6;
        for (k, found) in [load.amplitude(), load.phase_rad()].into_iter().enumerate() {
            let by_sine = (of(0.3 + h, -0.4)[k] - of(0.3 - h, -0.4)[k]) / (2.0 * h);
            let by_cosine = (of(0.3, -0.4 + h)[k] - of(0.3, -0.4 - h)[k]) / (2.0 * h);
            let variance = (by_sine * 0.01).powi(2)
                + (by_cosine * 0.02).powi(2)
                + 2.0 * by_sine * by_cosine * 1e-4;
            assert!((found.value - of(0.3, -0.4)[k]).abs() < 1e-12);
            assert!((found.std / variance.sqrt() - 1.0).abs() < 1e-6, "{k}: {}", found.std);
        }
    }
}
