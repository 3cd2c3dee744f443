//! First zero of a sum of decaying oscillations.

use num_complex::Complex64;

use super::blocks::Rates;
use super::flow::{ModalBlock, phi};

/// Halvings of the interval before two crossings count as one.
const DEPTH: u32 = 52;
/// Exponent from which on a term has decayed to nothing beside the digits of any other.
const GONE: f64 = -50.0;

/// `f(t) = f(0) + Σ Re(a·(e^{μt} − 1)/μ)`: what blocks contribute to the watched under a held torque.
#[derive(Debug, Clone, Default)]
pub(in crate::rig) struct Wave {
    start: f64,
    terms: Vec<Term>,
    /// Evaluations so far.
    pub(in crate::rig) evaluations: usize,
}

#[derive(Debug, Clone, Copy)]
struct Term {
    /// μ \[1/s\], with Re μ ≤ 0.
    rate: Complex64,
    /// a: its real part is the term's slope at the start.
    slope: Complex64,
    /// |μ|, |a|.
    speed: f64,
    size: f64,
}

/// A point of a wave: value and slope.
#[derive(Debug, Clone, Copy)]
struct CrossingPoint {
    time: f64,
    value: f64,
    slope: f64,
}

impl Wave {
    /// Room for `blocks` blocks.
    pub(in crate::rig) fn with_room(blocks: usize) -> Self {
        Self { terms: Vec::with_capacity(2 * blocks), ..Self::default() }
    }

    /// `start + sign·(change of what is watched)` of blocks in states `y` under `torque`.
    pub(in crate::rig) fn set(
        &mut self,
        start: f64,
        sign: f64,
        blocks: &[ModalBlock],
        y: &[[f64; 2]],
        torque: f64,
    ) {
        self.start = start;
        self.terms.clear();
        let mut add = |rate: Complex64, slope: Complex64, speed: f64| {
            let size = slope.norm_sqr().sqrt();
            if size > 0.0 {
                self.terms.push(Term { rate, slope, speed, size });
            }
        };
        for (block, &[a, b]) in blocks.iter().zip(y) {
            let ([g1, g2], [c1, c2]) = (block.gain, block.read);
            let [one, other] = block.sizes.map(|(_, speed)| speed);
            match block.rates {
                Rates::Oscillating(mu) => {
                    let rate = mu * Complex64::new(a, b) + Complex64::new(g1, g2) * torque;
                    add(mu, Complex64::new(c1, -c2) * rate * sign, one);
                }
                Rates::Apart(p, q) => {
                    add(p.into(), (c1 * (p * a + g1 * torque) * sign).into(), one);
                    add(q.into(), (c2 * (q * b + g2 * torque) * sign).into(), other);
                }
            }
        }
    }

    /// Slope at the start.
    pub(in crate::rig) fn slope(&self) -> f64 {
        self.terms.iter().map(|t| t.slope.re).sum()
    }

    /// Second derivative at the start.
    pub(in crate::rig) fn bend(&self) -> f64 {
        self.terms.iter().map(|t| (t.slope * t.rate).re).sum()
    }

    /// Bounds on the derivatives of this order, from 1.
    pub(in crate::rig) fn bound(&self, order: i32) -> f64 {
        self.terms.iter().map(|t| t.size * t.speed.powi(order - 1)).sum()
    }

    fn at(&mut self, time: f64) -> CrossingPoint {
        self.evaluations += 1;
        let mut point = CrossingPoint { time, value: 0.0, slope: 0.0 };
        for t in &self.terms {
            let z = t.rate * time;
            let [once, _] = phi(z);
            point.value += (t.slope * once).re;
            point.slope += (t.slope * (1.0 + z * once)).re;
        }
        point.value = self.start + time * point.value;
        point
    }

    /// First `t` in `(from, to]` at which the wave, positive at `from`, stops being so; `None`
    /// where it does not, `Some(from)` where it is not positive there but for rounding.
    ///
    /// A stretch is passed over where the ends less the most that the wave departs from its chord
    /// keep it positive: no crossing is stepped over, not even a pair of close ones, down to
    /// stretches of `(to − from)·2⁻⁵²`.
    pub(in crate::rig) fn first_zero(&mut self, from: f64, to: f64) -> Option<f64> {
        if self.start > to * self.bound(1) {
            return None;
        }
        let first = if from > 0.0 {
            self.at(from)
        } else {
            CrossingPoint { time: 0.0, value: self.start, slope: self.slope() }
        };
        if first.value <= 0.0 {
            return Some(from);
        }
        let last = self.at(to);
        self.descend(first, last, DEPTH)
    }

    fn descend(&mut self, first: CrossingPoint, last: CrossingPoint, depth: u32) -> Option<f64> {
        let width = last.time - first.time;
        let (mut stray, mut turn) = (0.0, 0.0);
        for t in self.terms.iter().filter(|t| t.rate.re * first.time > GONE) {
            let angle = t.speed * width;
            // As `chord` in flow.rs, for the value and for the slope.
            stray += t.size * (angle * width / 8.0).min(2.0 / t.speed);
            turn += t.size * (angle * angle / 8.0).min(2.0);
        }
        if first.value.min(last.value) > stray {
            return None;
        }
        if last.value <= 0.0 && first.slope.max(last.slope) + turn < 0.0 {
            return Some(self.single_crossing(first, last));
        }
        if depth == 0 {
            return (last.value <= 0.0).then_some(last.time);
        }
        let middle = self.at(first.time + 0.5 * width);
        self.descend(first, middle, depth - 1).or_else(|| self.descend(middle, last, depth - 1))
    }

    /// The crossing where the wave falls all the way: Newton's method fenced by bisection.
    fn single_crossing(&mut self, first: CrossingPoint, last: CrossingPoint) -> f64 {
        let (mut low, mut high) = (first.time, last.time);
        let smallest = f64::EPSILON * last.time;
        let bend = self.bound(2);
        // Newton from the end where the wave is nearer to zero.
        let mut here = if first.value < -last.value { first } else { last };
        // Newton doubles the digits; the fence halves when Newton leaves it: 100 is never reached.
        for _ in 0..100 {
            let newton = here.time - here.value / here.slope;
            let inside = newton > low && newton < high;
            let next = if inside { newton } else { 0.5 * (low + high) };
            // What a step δ of Newton's leaves to go is f̈·δ²/(2·ḟ).
            let change = (next - here.time).abs();
            let done = inside && bend * change * change <= -here.slope * smallest;
            if done || change <= smallest {
                return next;
            }
            here = self.at(next);
            if here.value > 0.0 {
                low = next;
            } else {
                high = next;
            }
        }
        high
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Times of events agree with closed forms to this \[s\].
    const TIME_S: f64 = 1e-14;

    /// `1 + Σ` of terms with these μ and a.
    fn wave(start: f64, terms: &[(Complex64, Complex64)]) -> Wave {
        let terms = terms.iter().map(|&(rate, slope)| Term {
            rate,
            slope,
            speed: rate.norm(),
            size: slope.norm(),
        });
        Wave { start, terms: terms.collect(), evaluations: 0 }
    }

    #[test]
    fn a_decay_crosses_where_its_logarithm_says() {
        let mut w = wave(1.0, &[(Complex64::from(-2.0), Complex64::from(-4.0))]);
        let found = w.first_zero(0.0, 3.0).unwrap();
        // 1 − 2·(1 − e^{−2t}) = 0.
        assert!((found - 0.5 * 2.0_f64.ln()).abs() < TIME_S, "{found}");
    }

    #[test]
    fn a_dip_within_the_interval_is_found() {
        // 1 + depth·(cos ωt − 1): below zero about π/ω where depth > 1/2, for a share of 1e-4 of it.
        let (omega, depth) = (3.0_f64, 0.5 * (1.0 + 1e-8));
        let mu = Complex64::new(0.0, omega);
        let mut w = wave(1.0, &[(mu, mu * depth)]);
        let found = w.first_zero(0.0, 2.0).unwrap();
        let exact = (1.0 - 1.0 / depth).acos() / omega;
        // At such a graze a rounding ε moves the crossing by √ε.
        assert!((found - exact).abs() < 1e-11, "{found} {exact}");
    }

    #[test]
    fn what_only_comes_near_has_none() {
        let mu = Complex64::new(0.0, 3.0);
        let mut w = wave(1.0, &[(mu, mu * 0.5 * (1.0 - 1e-8))]);
        assert_eq!(w.first_zero(0.0, 2.0), None);
    }

    #[test]
    fn a_term_that_decays_at_once_is_not_followed_to_the_end() {
        // 0.5 + 0.5·e^{−1e12·t} − t/2, which falls to one half within picoseconds.
        let at_once = Complex64::from(-1e12);
        let mut w = wave(
            1.0,
            &[(Complex64::from(-1e-30), Complex64::from(-0.5)), (at_once, at_once * 0.5)],
        );
        let found = w.first_zero(0.0, 2.0).unwrap();
        assert!((found - 1.0).abs() < TIME_S, "{found}");
        assert!(w.evaluations < 1000, "{}", w.evaluations);
    }

    #[test]
    fn a_fast_small_term_does_not_hide_the_crossing() {
        // 1 − t + 1e-3·(cos 1e4·t − 1), against bisection on the same formula near t = 0.999.
        let fast = Complex64::new(0.0, 1e4);
        let mut w =
            wave(1.0, &[(Complex64::from(-1e-30), Complex64::from(-1.0)), (fast, fast * 1e-3)]);
        let found = w.first_zero(0.0, 2.0).unwrap();
        let f = |t: f64| 1.0 - t + 1e-3 * ((1e4 * t).cos() - 1.0);
        // Just before it is positive, everywhere before too, just after negative.
        assert!(f(found - 1e-9) > 0.0 && f(found + 1e-9) < 0.0, "{found}");
        assert!((0..200_000).all(|k| f(found * k as f64 / 200_000.0) > 0.0));
    }
}
