//! Errors of a sensor: noise, and the steps in which it reads.

use statrs::function::erf::{erf, erfc};

/// StdSource beyond a step's edge from which on the tail is taken by its series.
const FAR: f64 = 20.0;
/// Curvature is never taken below this share of its mean, so that a step inside which nothing is
/// known does not vanish from the search.
const LEAST_CURVATURE: f64 = 0.05;

/// Errors of a sensor: noise of standard deviation σ, then rounding to steps of q (zero: no steps).
///
/// The probability of a reading `y` is `P(e) = Φ((e + q/2)/σ) − Φ((e − q/2)/σ)` if the true value is `y − e`, with the
/// normal distribution Φ. P is log-concave, so the cost `−ln P` is convex. Unlike a squared error, it accounts for the
/// fact that all values within a step give the same reading: constant readings, and steps that repeat each period,
/// count with the information that they contain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SensorNoise {
    /// Standard deviation σ of the noise, in the unit of the channel.
    pub sigma: f64,
    /// Step q, in the unit of the channel.
    pub step: f64,
}

/// Cost of an error, with its derivatives by it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Loss {
    /// `−2·ln(P(e)/P(0))`: a square in standard errors where there are no steps.
    pub(super) cost: f64,
    /// `−d ln P/de`.
    pub(super) slope: f64,
    /// A positive stand-in for `−d² ln P/de²`.
    pub(super) curvature: f64,
}

impl SensorNoise {
    /// Noise without steps.
    pub fn gaussian(sigma: f64) -> Self {
        Self { sigma, step: 0.0 }
    }

    /// Standard deviation of the error by noise and steps, √(σ² + q²/12).
    pub fn deviation(&self) -> f64 {
        (self.sigma * self.sigma + self.step * self.step / 12.0).sqrt()
    }

    /// Negative logarithm of the probability of a reading with this `error` (of the probability
    /// density, if there are no steps).
    pub fn surprise(&self, error: f64) -> f64 {
        if self.step <= 0.0 {
            return 0.5 * (error / self.sigma).powi(2) + self.sigma.ln();
        }
        -log_probability(error.abs() / self.sigma, 0.5 * self.step / self.sigma).0
    }

    pub(super) fn loss(&self, error: f64) -> Loss {
        if self.step <= 0.0 {
            let slope = error / (self.sigma * self.sigma);
            return Loss { cost: slope * error, slope, curvature: 1.0 / (self.sigma * self.sigma) };
        }
        let (e, h) = (error.abs() / self.sigma, 0.5 * self.step / self.sigma);
        self.stepped_loss(error, log_probability(e, h), log_probability(0.0, h).0)
    }

    /// From `ln P` and its derivatives at the error, for σ = 1, and `ln P(0)`.
    pub(super) fn stepped_loss(
        &self,
        error: f64,
        (log, slope, curvature): (f64, f64, f64),
        log_zero: f64,
    ) -> Loss {
        let h = 0.5 * self.step / self.sigma;
        let least = LEAST_CURVATURE / (1.0 + h * h / 3.0);
        Loss {
            cost: 2.0 * (log_zero - log),
            slope: slope.copysign(error) / self.sigma,
            curvature: curvature.max(least) / (self.sigma * self.sigma),
        }
    }
}

/// `ln P`, `−d ln P/de` and `−d² ln P/de²` for σ = 1, at e ≥ 0 and half a step h.
pub(super) fn log_probability(e: f64, h: f64) -> (f64, f64, f64) {
    let density = |x: f64| (-0.5 * x * x).exp() / (2.0 * std::f64::consts::PI).sqrt();
    let root = std::f64::consts::SQRT_2;
    let (near, far) = (e - h, e + h);
    if near > FAR {
        // Upper tail: Q(x) ≈ φ(x)/x·(1 − 1/x² + 3/x⁴); the far edge adds nothing unless the step is
        // short against the noise.
        let tail = |x: f64| (1.0 - 1.0 / (x * x) + 3.0 / x.powi(4)) / x;
        let ratio = (-0.5 * (far * far - near * near)).exp();
        let p = tail(near) - ratio * tail(far);
        let log = -0.5 * near * near - 0.5 * (2.0 * std::f64::consts::PI).ln() + p.ln();
        let slope = (1.0 - ratio) / p;
        let bend = (near - ratio * far) / p;
        return (log, slope, (slope * slope - bend).max(0.0));
    }
    let p = if near > 0.0 {
        0.5 * (erfc(near / root) - erfc(far / root))
    } else {
        0.5 * (erf(far / root) - erf(near / root))
    };
    let (a, b) = (density(near), density(far));
    let slope = (a - b) / p;
    let bend = (near * a - far * b) / p;
    (p.ln(), slope, slope * slope - bend)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Central differences of ln P, and a fine step against plain noise.
    #[test]
    fn slopes_and_curvatures_are_those_of_the_probability() {
        for h in [0.25, 0.5, 3.0, 12.0] {
            for e in [0.0, 0.4 * h, h, h + 1.0, h + 4.9, h + 9.0, h + 19.9, h + 20.1, h + 30.0] {
                let d = 1e-4;
                let at = |e: f64| log_probability(e.abs(), h);
                let (_, slope, curvature) = at(e);
                let by_difference = -(at(e + d).0 - at(e - d).0) / (2.0 * d);
                let bend = (at(e + d).1.copysign(e + d) - at(e - d).1.copysign(e - d)) / (2.0 * d);
                let tolerance = 2e-3 * (1.0 + slope.abs());
                assert!(
                    (slope - by_difference).abs() < tolerance,
                    "{e} {h}: {slope} {by_difference}"
                );
                if e > 0.0 {
                    assert!((curvature - bend).abs() < 0.02, "{e} {h}: {curvature} {bend}");
                }
            }
        }
    }

    #[test]
    fn fine_steps_are_plain_noise_and_coarse_ones_are_flat_within() {
        let fine = SensorNoise { sigma: 1.0, step: 0.1 };
        assert!((fine.loss(2.0).cost - 4.0).abs() < 0.02);
        let coarse = SensorNoise { sigma: 0.02, step: 1.0 };
        assert!(coarse.loss(0.3).cost < 1e-9 && coarse.loss(0.3).slope < 1e-9);
        assert!(coarse.loss(0.55).cost > 5.0);
        assert!((coarse.loss(-0.55).slope + coarse.loss(0.55).slope).abs() < 1e-12);
    }
}
