//! A sensor: noise is added, then the value is rounded.

use rand_xoshiro::Xoshiro256PlusPlus;

use super::{Noise, Quantiser};

/// A sensor of an angle \[rad\], or of a current (A in place of rad).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Sensor {
    /// Noise before rounding; `None`: no noise.
    pub noise: Option<Noise>,
    /// Rounding; `None`: no rounding.
    pub quantiser: Option<Quantiser>,
}

impl From<Quantiser> for Sensor {
    fn from(quantiser: Quantiser) -> Self {
        Self { noise: None, quantiser: Some(quantiser) }
    }
}

impl From<Noise> for Sensor {
    fn from(noise: Noise) -> Self {
        Self { noise: Some(noise), quantiser: None }
    }
}

impl Sensor {
    /// A sensor without noise and rounding.
    pub const IDEAL: Self = Self { noise: None, quantiser: None };

    /// What it gives for an angle, and whether that was cut off at the range's end.
    pub(in crate::rig) fn read(
        &self,
        angle_rad: f64,
        stream: Option<&mut Xoshiro256PlusPlus>,
    ) -> (f64, bool) {
        let noisy = match (&self.noise, stream) {
            (Some(noise), Some(stream)) => angle_rad + noise.draw(stream),
            _ => angle_rad,
        };
        self.quantiser.map_or((noisy, false), |q| (q.read(noisy), q.exceeded(noisy)))
    }

    /// Standard deviation of the error of a reading \[rad\]: √(s² + q²/12), with the standard deviation s of the noise
    /// and the step q. The rounding error is assumed to be uniform over a step.
    pub fn deviation(&self) -> f64 {
        let step = self.quantiser.map_or(0.0, |q| q.step());
        let noise = self.noise.map_or(0.0, |n| n.std());
        (noise * noise + step * step / 12.0).sqrt()
    }

    /// Step, or standard deviation of the noise, whichever is larger \[rad\].
    pub fn resolution(&self) -> f64 {
        let step = self.quantiser.map_or(0.0, |q| q.step());
        self.noise.map_or(step, |n| n.std().max(step))
    }
}
