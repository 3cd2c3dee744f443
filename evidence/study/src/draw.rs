//! Random draws of one campaign.

use rand_distr::{Distribution, StandardUniform};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;

/// The random numbers of one campaign. They depend only on the seed of the study and the index of the
/// campaign, not on the number of threads or on other campaigns.
#[derive(Debug, Clone)]
pub(crate) struct Draw(Xoshiro256PlusPlus);

impl Draw {
    pub(crate) fn of(seed: u64, index: usize) -> Self {
        Self(Xoshiro256PlusPlus::seed_from_u64(mixed(seed) ^ index as u64))
    }

    /// Uniform in \[0, 1).
    fn unit(&mut self) -> f64 {
        StandardUniform.sample(&mut self.0)
    }

    /// A seed for another generator.
    pub(crate) fn seed(&mut self) -> u64 {
        StandardUniform.sample(&mut self.0)
    }

    pub(crate) fn uniform(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Uniform on a logarithmic scale.
    pub(crate) fn decade(&mut self, low: f64, high: f64) -> f64 {
        self.uniform(low.ln(), high.ln()).exp()
    }

    /// One of `low..=high`, all equally likely.
    pub(crate) fn whole(&mut self, low: u32, high: u32) -> u32 {
        let count = f64::from(high - low + 1);
        low + ((self.unit() * count) as u32).min(high - low)
    }

    pub(crate) fn chance(&mut self, probability: f64) -> bool {
        self.unit() < probability
    }
}

/// Mixes the bits of a seed so that neighbours differ (the finaliser of SplitMix64): campaign 3 of seed
/// 1 is not campaign 2 of seed 0.
fn mixed(seed: u64) -> u64 {
    let mut z = seed.wrapping_add(0x9E37_79B9_7F4A_7C15);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn draws_stay_in_their_ranges_and_reach_both_ends() {
        let mut draw = Draw::of(1, 0);
        let mut seen = [false; 7];
        for _ in 0..1000 {
            let bits = draw.whole(10, 16);
            seen[bits as usize - 10] = true;
            assert!((3.0..40.0).contains(&draw.decade(3.0, 40.0)));
        }
        assert_eq!(seen, [true; 7]);
    }

    #[test]
    fn neighbouring_seeds_and_indices_differ() {
        let first = |seed, index| Draw::of(seed, index).seed();
        assert_eq!(first(1, 2), first(1, 2));
        assert_ne!(first(1, 2), first(2, 1));
        assert_ne!(first(0, 3), first(1, 2));
    }
}
