//! Dry friction that changes randomly over time.

use rand_distr::{Distribution, StandardNormal};
use rand_xoshiro::Xoshiro256PlusPlus;

use super::RigError;
use super::error::positive;

/// Dry friction that changes randomly over time: all of it is multiplied by `1 + x(t)`, where x is an
/// Ornstein-Uhlenbeck process of mean zero with `E[x(t)·x(t + τ)] = s²·e^{−|τ|/T}`.
///
/// The factor is constant over each sample of the sensors. Its steps are small compared with s if T is many samples. A
/// negative factor would become zero; with the largest s allowed this takes five standard deviations.
///
/// ```
/// use lissom::rig::{FrictionWander, Scene};
/// let scene = Scene { wander: Some(FrictionWander::new(0.03, 2.0)?), ..Scene::default() }; // 3 %, 2 s
/// assert!(scene.check().is_ok());
/// # Ok::<(), lissom::rig::RigError>(())
/// ```
///
/// With [`Settle::Detected`](super::Settle) the motion never becomes steadier than these changes allow, so use a fixed
/// time to settle.
///
/// This is the simplest process with a standard deviation and a correlation time. Friction of real joints differs by a
/// few percent from stroke to stroke.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrictionWander {
    relative_std: f64,
    correlation_time_s: f64,
}

impl FrictionWander {
    /// Largest standard deviation \[1\].
    const STD_MOST: f64 = 0.2;

    /// Builds the process from the standard deviation s of the factor \[1\], at most 0.2,
    /// and the correlation time T \[s\].
    ///
    /// # Errors
    /// [`RigError::NotPositive`] if a number is not positive and finite; [`RigError::Wander`] if s is above 0.2.
    pub fn new(relative_std: f64, correlation_time_s: f64) -> Result<Self, RigError> {
        positive("standard deviation of wandering friction", relative_std)?;
        positive("correlation time of wandering friction in s", correlation_time_s)?;
        if relative_std > Self::STD_MOST {
            return Err(RigError::Wander { found: relative_std, most: Self::STD_MOST });
        }
        Ok(Self { relative_std, correlation_time_s })
    }

    /// Standard deviation s of the factor \[1\].
    pub fn relative_std(&self) -> f64 {
        self.relative_std
    }

    /// Correlation time T \[s\].
    pub fn correlation_time_s(&self) -> f64 {
        self.correlation_time_s
    }

    /// The process from sample to sample.
    pub(super) fn path(&self, sample_time_s: f64) -> WanderPath {
        let keep = (-sample_time_s / self.correlation_time_s).exp();
        WanderPath { keep, std: self.relative_std, now: None }
    }
}

/// The factor's way.
#[derive(Debug, Clone)]
pub(super) struct WanderPath {
    keep: f64,
    std: f64,
    /// x; `None` before the first sample.
    now: Option<f64>,
}

impl WanderPath {
    /// The factor of the next sample.
    pub(super) fn next(&mut self, stream: &mut Xoshiro256PlusPlus) -> f64 {
        let normal: f64 = StandardNormal.sample(stream);
        let next = match self.now {
            None => self.std * normal,
            Some(now) => self.keep * now + self.std * (1.0 - self.keep * self.keep).sqrt() * normal,
        };
        self.now = Some(next);
        (1.0 + next).max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use rand_xoshiro::rand_core::SeedableRng;

    use super::*;

    /// Samples of the statistics below: 200 000 correlation times, so that a variance is known to 0.3 %.
    const SAMPLES: usize = 2_000_000;

    #[test]
    fn the_factor_has_its_standard_deviation_and_its_time() {
        let wander = FrictionWander::new(0.05, 0.1).unwrap();
        let mut path = wander.path(0.01);
        let mut stream = Xoshiro256PlusPlus::seed_from_u64(3);
        let x: Vec<f64> = (0..SAMPLES).map(|_| path.next(&mut stream) - 1.0).collect();
        let product = |lag: usize| {
            x.iter().zip(&x[lag..]).map(|(a, b)| a * b).sum::<f64>() / (SAMPLES - lag) as f64
        };
        assert!((product(0) / 0.0025 - 1.0).abs() < 0.02, "{}", product(0));
        // After one correlation time e⁻¹ is left.
        assert!((product(10) / product(0) - (-1.0_f64).exp()).abs() < 0.02);
        assert!((x.iter().sum::<f64>() / SAMPLES as f64).abs() < 1e-3);
    }

    #[test]
    fn senseless_wander_is_refused() {
        assert!(matches!(FrictionWander::new(0.0, 1.0), Err(RigError::NotPositive { .. })));
        assert!(matches!(FrictionWander::new(f64::NAN, 1.0), Err(RigError::NotPositive { .. })));
        assert!(matches!(FrictionWander::new(0.02, 0.0), Err(RigError::NotPositive { .. })));
        assert!(matches!(FrictionWander::new(0.3, 1.0), Err(RigError::Wander { .. })));
    }
}
