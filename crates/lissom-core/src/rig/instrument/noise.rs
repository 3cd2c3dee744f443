//! White noise of sensors.

use rand_distr::{Distribution, StandardNormal};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;

use crate::rig::RigError;
use crate::rig::error::positive;

/// White Gaussian noise: an independent random number at each sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Noise {
    std: f64,
}

impl Noise {
    /// Noise with the given standard deviation, in the unit of the signal.
    ///
    /// # Errors
    /// [`RigError::NotPositive`] if it is not positive and finite.
    pub fn new(std: f64) -> Result<Self, RigError> {
        Ok(Self { std: positive("standard deviation of noise", std)? })
    }

    /// Standard deviation, in the unit of the signal.
    pub fn std(&self) -> f64 {
        self.std
    }

    pub(super) fn draw(self, stream: &mut Xoshiro256PlusPlus) -> f64 {
        let normal: f64 = StandardNormal.sample(stream);
        self.std * normal
    }
}

/// One stream of random numbers for each sensor, motor first.
///
/// Stream k starts 2¹²⁸ numbers behind stream k − 1 of the same seed: they never overlap, and what
/// one sensor draws changes nothing for another.
#[derive(Debug, Clone)]
pub(in crate::rig) struct Streams(Vec<Xoshiro256PlusPlus>);

impl Streams {
    pub(in crate::rig) fn new(seed: u64, sensors: usize) -> Self {
        let mut next = Xoshiro256PlusPlus::seed_from_u64(seed);
        let one = |_| {
            let stream = next.clone();
            next.jump();
            stream
        };
        Self((0..sensors).map(one).collect())
    }

    /// The stream of a place; there are as many as were asked for.
    pub(in crate::rig) fn at(&mut self, place: usize) -> Option<&mut Xoshiro256PlusPlus> {
        self.0.get_mut(place)
    }
}
