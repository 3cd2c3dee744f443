//! A sensor: noise, then rounding.

use rand_xoshiro::Xoshiro256PlusPlus;

use super::{Noise, Quantiser};

/// A sensor of an angle, or of a current (A in place of rad).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Sensor {
    /// Noise before rounding \[rad\]; `None`: none.
    pub noise: Option<Noise>,
    /// Rounding; `None`: none.
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
    /// A sensor that gives the angle itself.
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

    /// √(s² + q²/12) of noise with deviation s and steps of q, as if a reading's error were spread evenly
    /// over a step \[rad\].
    pub fn deviation(&self) -> f64 {
        let step = self.quantiser.map_or(0.0, |q| q.step());
        let noise = self.noise.map_or(0.0, |n| n.std());
        (noise * noise + step * step / 12.0).sqrt()
    }

    /// Its step or the deviation of its noise, whichever is larger \[rad\].
    pub fn resolution(&self) -> f64 {
        let step = self.quantiser.map_or(0.0, |q| q.step());
        self.noise.map_or(step, |n| n.std().max(step))
    }
}
