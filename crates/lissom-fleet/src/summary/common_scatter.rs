//! Scatter of the logs of a machine around its line, when each machine has few logs.

use statrs::function::gamma::digamma;

/// Steps of Newton's method for the inverse of the trigamma function.
const STEPS: usize = 60;
/// Relative change at which it ends.
const TOLERANCE: f64 = 1e-10;
/// From here on the asymptotic series of the trigamma function has 12 digits.
const ASYMPTOTIC: f64 = 15.0;

/// What machines have in common: variances of machines are scattered as σ0²·d0/χ²(d0).
///
/// Smyth, Stat. Appl. Genet. Mol. Biol. 3 (2004), art. 3: the variance of a machine is estimated from its own logs and, with
/// d0 degrees of freedom, from those of all machines. Without it, a machine with three logs that agree by chance would seem
/// to drift.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct CommonScatter {
    variance: f64,
    freedom: f64,
}

impl CommonScatter {
    /// From the variances of machines, each with its degrees of freedom. Without a machine it has no degree of freedom.
    pub(super) fn of(machines: &[(f64, f64)]) -> Self {
        let none = Self { variance: 0.0, freedom: 0.0 };
        let known = machines.iter().filter(|(variance, freedom)| *variance > 0.0 && *freedom > 0.0);
        let logs: Vec<(f64, f64)> = known
            .map(|(variance, d)| (variance.ln() - digamma(d / 2.0) + (d / 2.0).ln(), *d))
            .collect();
        if logs.len() < 2 {
            return none;
        }
        let count = logs.len() as f64;
        let mean = logs.iter().map(|(log, _)| log).sum::<f64>() / count;
        let excess = logs.iter().map(|(log, d)| {
            (log - mean) * (log - mean) * count / (count - 1.0) - trigamma(d / 2.0)
        });
        let excess = excess.sum::<f64>() / count;
        if excess <= 0.0 {
            return Self { variance: mean.exp(), freedom: f64::INFINITY };
        }
        let half = inverse_trigamma(excess);
        Self { variance: (mean + digamma(half) - half.ln()).exp(), freedom: 2.0 * half }
    }

    /// The variance of a machine, and its degrees of freedom, from its own variance and all others.
    pub(super) fn with_own(&self, own: f64, freedom: f64) -> (f64, f64) {
        if self.freedom.is_infinite() {
            return (self.variance, f64::INFINITY);
        }
        let all = self.freedom + freedom;
        ((self.freedom * self.variance + freedom * own) / all, all)
    }
}

/// ψ′(x) for x > 0: recurrence, then the asymptotic series (Abramowitz and Stegun 6.4.6 and 6.4.12).
fn trigamma(x: f64) -> f64 {
    let (mut x, mut sum) = (x, 0.0);
    while x < ASYMPTOTIC {
        sum += 1.0 / (x * x);
        x += 1.0;
    }
    let y = 1.0 / (x * x);
    sum + 1.0 / x + y / 2.0 + y / x * (1.0 / 6.0 - y * (1.0 / 30.0 - y * (1.0 / 42.0 - y / 30.0)))
}

/// The x with ψ′(x) = y: Newton's method on 1/ψ′, which is convex (Smyth 2004, appendix).
fn inverse_trigamma(y: f64) -> f64 {
    let mut x = 0.5 + 1.0 / y;
    for _ in 0..STEPS {
        let value = trigamma(x);
        // ψ″ from a central difference: it only steers the step.
        let h = 1e-4 * x;
        let slope = (trigamma(x + h) - trigamma(x - h)) / (2.0 * h);
        let step = value * (1.0 - value / y) / slope;
        x += step;
        if step.abs() <= TOLERANCE * x {
            break;
        }
    }
    x
}

#[cfg(test)]
mod tests {
    use rand_distr::{ChiSquared, Distribution as _};
    use rand_xoshiro::Xoshiro256PlusPlus;
    use rand_xoshiro::rand_core::SeedableRng as _;

    use super::*;

    #[test]
    fn trigamma_and_its_inverse() {
        // ψ′(1) = π²/6, ψ′(1/2) = π²/2.
        let square = std::f64::consts::PI * std::f64::consts::PI;
        assert!((trigamma(1.0) - square / 6.0).abs() < 1e-12);
        assert!((trigamma(0.5) - square / 2.0).abs() < 1e-11);
        for x in [0.05, 0.7, 3.0, 200.0] {
            assert!((inverse_trigamma(trigamma(x)) / x - 1.0).abs() < 1e-8, "{x}");
        }
    }

    #[test]
    fn finds_the_scatter_of_variances() {
        let mut random = Xoshiro256PlusPlus::seed_from_u64(5);
        let (d0, own) = (6.0, 5.0);
        let prior = ChiSquared::new(d0).unwrap();
        let logs = ChiSquared::new(own).unwrap();
        let mut machine = || {
            let variance = 2.0 * d0 / prior.sample(&mut random);
            (variance * logs.sample(&mut random) / own, own)
        };
        let machines: Vec<(f64, f64)> = (0..20_000).map(|_| machine()).collect();
        let common = CommonScatter::of(&machines);
        assert!((common.variance / 2.0 - 1.0).abs() < 0.05, "{common:?}");
        assert!((common.freedom / d0 - 1.0).abs() < 0.1, "{common:?}");
        assert_eq!(CommonScatter::of(&[(1.0, 5.0)]).with_own(3.0, 5.0), (3.0, 5.0));
    }
}
