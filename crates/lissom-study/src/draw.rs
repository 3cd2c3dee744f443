//! Random draws of one campaign.

use rand_distr::{Distribution, StandardUniform};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;

/// The stream of one campaign: a function of the study's seed and the campaign's index alone, so
/// that neither the number of threads nor the other campaigns matter.
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

    /// A seed for something of its own.
    pub(crate) fn seed(&mut self) -> u64 {
        StandardUniform.sample(&mut self.0)
    }

    pub(crate) fn uniform(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Uniform in the logarithm.
    pub(crate) fn decade(&mut self, low: f64, high: f64) -> f64 {
        self.uniform(low.ln(), high.ln()).exp()
    }

    /// One of `low..=high`, each as likely.
    pub(crate) fn whole(&mut self, low: u32, high: u32) -> u32 {
        let count = f64::from(high - low + 1);
        low + ((self.unit() * count) as u32).min(high - low)
    }

    pub(crate) fn chance(&mut self, probability: f64) -> bool {
        self.unit() < probability
    }
}

/// A seed whose neighbours give unlike bits (the finaliser of SplitMix64), so that campaign 3 of seed
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
