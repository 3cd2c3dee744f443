//! Zeros of the responses θ_i/θ_m.

use num_complex::Complex64;

use super::bracket::root;
use super::chain::{BaseSide, Joined, TipSide};
use super::counted::counted_roots;
use super::element::{At, Element};
use super::frequencies::{Base, below_first, degrees, lowest};
use super::piece::cut_up;
use super::roots::further;
use super::{LumpedBeam, RootClass, class};
use crate::number::{Dual, Number, Scaled};

/// The finite zeros of one response, as z = s², ascending in |z|.
#[derive(Debug, Clone, PartialEq)]
pub struct Zeros {
    /// z = s² \[1/s²\] without damping: real, or in conjugate pairs.
    pub z: Vec<Complex64>,
    /// Number of zeros that the search did not find; zero except for extreme beams.
    pub missing: usize,
}

impl Zeros {
    /// Class of each zero, in the same order.
    pub fn classes(&self) -> Vec<RootClass> {
        self.z.iter().map(|z| class(*z)).collect()
    }

    /// Whether all zeros are on the imaginary axis (class a).
    pub fn minimum_phase(&self) -> bool {
        self.missing == 0 && self.z.iter().all(|z| class(*z) == RootClass::Imaginary)
    }
}

/// The numerator's sides at a joint.
pub(crate) fn at_joint<N: Number>(elements: &[Element], joint: usize, at: At<N>) -> Joined<N> {
    let mut base = BaseSide::clamped();
    elements[..joint].iter().for_each(|e| base.pass(at, e));
    let mut tip = TipSide::free();
    elements[joint..].iter().rev().for_each(|e| tip.pass(at, e));
    Joined::new(base, tip)
}

/// N′/N of a scaled dual.
pub(crate) fn log_slope(n: Scaled<Dual<Complex64>>) -> Complex64 {
    n.mantissa.slope / n.mantissa.value
}

/// Points of the first grid per zero sought.
const GRID_EACH: usize = 4;
/// Times that the grid is made twice as fine.
const FINER_MOST: usize = 5;

/// Zeros on both sides of z = 0 with |z| between `low` and `high`, `wanted` in all, by changes of
/// sign on a grid in log |z|, then by Brent's method.
pub(crate) fn real_zeros(
    numerator: impl Fn(f64) -> Scaled<f64>,
    wanted: usize,
    (low, high): (f64, f64),
) -> Vec<f64> {
    let positive = |v: f64| numerator(v).mantissa > 0.0;
    let mut grids: Vec<Vec<(f64, bool)>> = [1.0, -1.0]
        .iter()
        .map(|side| {
            let count = GRID_EACH * wanted + 8;
            let at =
                |k: usize| side * (low.ln() + (high / low).ln() * k as f64 / count as f64).exp();
            (0..=count).map(at).map(|v| (v, positive(v))).collect()
        })
        .collect();
    let changes = |grids: &[Vec<(f64, bool)>]| -> usize {
        grids.iter().map(|g| g.windows(2).filter(|w| w[0].1 != w[1].1).count()).sum()
    };
    for _ in 0..FINER_MOST {
        if changes(&grids) >= wanted {
            break;
        }
        for grid in &mut grids {
            let mut finer = Vec::with_capacity(2 * grid.len());
            for w in grid.windows(2) {
                let middle = (w[0].0 * w[1].0).sqrt().copysign(w[0].0);
                finer.push(w[0]);
                finer.push((middle, positive(middle)));
            }
            finer.extend(grid.last().copied());
            *grid = finer;
        }
    }
    let mut zeros = Vec::with_capacity(wanted);
    for grid in &grids {
        for w in grid.windows(2).filter(|w| w[0].1 != w[1].1) {
            zeros.push(root(&numerator, w[0].0, w[1].0));
        }
    }
    zeros
}

/// How far beyond the natural frequencies the search for zeros goes at first, in |z|.
const MARGIN: f64 = 1e3;

/// All zeros at `joint`, the lowest joint counting from the base.
fn all(elements: &[Element], joint: usize) -> Zeros {
    let wanted = degrees(elements).saturating_sub(1);
    if wanted == 0 {
        return Zeros { z: Vec::new(), missing: 0 };
    }
    let frequencies = lowest(elements, Base::Clamped, usize::MAX);
    let (first, last) = (frequencies[0], frequencies[frequencies.len() - 1]);
    let numerator = |z: f64| at_joint(elements, joint, At::undamped(z)).numerator();
    let slope = |z: Complex64| {
        log_slope(at_joint(elements, joint, At::undamped(Dual::variable(z))).numerator())
    };
    let mut range = (first * first / MARGIN, last * last * MARGIN);
    let mut z: Vec<Complex64> = Vec::new();
    for _ in 0..3 {
        z = real_zeros(numerator, wanted, range).into_iter().map(Complex64::from).collect();
        if z.len() < wanted {
            let more = further(slope, &z, wanted - z.len(), range);
            z.extend(more);
        }
        if z.len() >= wanted {
            break;
        }
        range = (range.0 / (MARGIN * MARGIN), range.1 * MARGIN * MARGIN);
    }
    z.sort_by(|a, b| a.norm().total_cmp(&b.norm()).then(a.im.total_cmp(&b.im)));
    let missing = wanted.saturating_sub(z.len());
    Zeros { z, missing }
}

/// The tip's numerator at `s` real, s² = z > 0, and how many of its zeros lie below, for a chain
/// that nothing at its end resists in turning.
///
/// The numerator of the part up to a point, taken along the beam, changes its sign as often as
/// there are zeros below: each further mass adds one zero above and lowers those that are there.
/// Parts of mass along the beam are so short that it changes once at most within one.
pub(crate) fn tip_numerator(elements: &[Element], s: f64) -> (Scaled<f64>, usize) {
    let at = At::undamped(s * s);
    let (mut side, mut below, mut positive) = (BaseSide::clamped(), 0, true);
    let mut exponent = 0;
    let mut pass = |element: &Element| {
        side.pass(at, element);
        exponent += side.taken_out();
        // A mass multiplies the motion by a positive pivot.
        let now = side.motion.0 > 0.0;
        below += usize::from(now != positive);
        positive = now;
    };
    for element in elements {
        match element {
            Element::Heavy { .. } => cut_up(&[*element], at).0.iter().for_each(&mut pass),
            _ => pass(element),
        }
    }
    let value = side.det.times(side.motion.0);
    (Scaled { exponent: value.exponent + exponent, ..value }, below)
}

/// The numerator at `joint` for z = s² > 0, and how many zeros lie below: as for the tip, with the
/// part beyond the joint attached to every point in turn.
fn real_numerator(elements: &[Element], joint: usize, s: f64) -> (Scaled<f64>, usize) {
    let at = At::undamped(s * s);
    let mut tip = TipSide::free();
    elements[joint..].iter().rev().for_each(|e| tip.pass(at, e));
    let (mut side, mut exponent) = (BaseSide::clamped(), 0);
    let (mut below, mut positive) = (0, true);
    for element in &elements[..joint] {
        side.pass(at, element);
        exponent += side.taken_out();
        let now = Joined::new(side, tip).numerator().mantissa > 0.0;
        below += usize::from(now != positive);
        positive = now;
    }
    let value = Joined::new(side, tip).numerator();
    (Scaled { exponent: value.exponent + exponent, ..value }, below)
}

/// The numerator at `joint` for z = −ω², and how many zeros lie above: each mass beyond the joint
/// adds one, seen as a change of sign of the numerator of the beam that ends there.
fn imaginary_numerator(elements: &[Element], joint: usize, omega: f64) -> (Scaled<f64>, usize) {
    let z = -omega * omega;
    let at = At::undamped(z);
    let mut side = BaseSide::clamped();
    elements[..joint].iter().for_each(|e| side.pass(at, e));
    // Deflection at the joint per motor angle, and per force and torque at the outer end.
    let mut here = side.motion.0;
    let (mut by_force, mut by_torque) = (side.compliance.a, side.compliance.b);
    let (mut below, mut positive) = (0, true);
    for element in &elements[joint..] {
        match *element {
            Element::Span { length, .. } | Element::Rigid { length } => {
                by_force += length * by_torque;
            }
            Element::Mass { mass, .. } => {
                let push = z * mass / (1.0 + z * mass * side.compliance.a);
                here -= by_force * push * side.motion.0;
                by_torque -= by_force * push * side.compliance.b;
                by_force -= by_force * push * side.compliance.a;
            }
            Element::Heavy { .. } | Element::Inertia { .. } => {}
        }
        side.pass(at, element);
        if matches!(element, Element::Mass { .. }) {
            let now = (here > 0.0) == (side.below % 2 == 0);
            below += usize::from(now != positive);
            positive = now;
        }
    }
    (at_joint(elements, joint, at).numerator(), below)
}

/// Half a relative distance over which the numerator changes its sign at a zero that is one.
const BESIDE: f64 = 1e-10;

/// All zeros at a mass with `inner` masses before and `outer` ones beyond it, as z, where both
/// counts are reached; `None` where rounding spoils one.
fn counted(elements: &[Element], joint: usize, inner: usize, outer: usize) -> Option<Vec<f64>> {
    let start = below_first(elements);
    let real = counted_roots(|s| real_numerator(elements, joint, s), inner, start);
    let imaginary = counted_roots(|w| imaginary_numerator(elements, joint, w), outer, start);
    // That count and that value come from different sums.
    let positive = |w: f64| imaginary_numerator(elements, joint, w).0.mantissa > 0.0;
    let there = |w: &f64| positive(w * (1.0 - BESIDE)) != positive(w * (1.0 + BESIDE));
    if real.len() != inner || imaginary.len() != outer || !imaginary.iter().all(there) {
        return None;
    }
    let z = real.iter().map(|s| s * s).chain(imaginary.iter().map(|w| -w * w));
    let mut z: Vec<f64> = z.collect();
    z.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
    Some(z)
}

impl LumpedBeam {
    /// The lowest `count` zeros of the tip's response as real s > 0, ascending \[1/s\]; −s is a zero as well. If no
    /// payload resists turning, all zeros of the tip are of this kind (class b).
    ///
    /// They are found by counting, at a cost that grows in proportion to the number of masses. `None` if the payload
    /// resists turning: use [`zeros`](Self::zeros).
    ///
    /// # Source
    /// That they are real, and that the changes of sign along the beam count them, is the oscillation theory of y⁗ =
    /// −z·m·y with one condition at one end and three at the other `[Elias1997]`. If all of them are found, no theory
    /// is needed: n − 1 changes of sign are n − 1 zeros.
    pub fn tip_zeros_per_s(&self, count: usize) -> Option<Vec<f64>> {
        if self.payload().turns() {
            return None;
        }
        let at = |s: f64| tip_numerator(self.elements(), s);
        Some(counted_roots(at, count.min(self.len() - 1), below_first(self.elements())))
    }

    /// The zeros of θ_i/θ_m at mass `mass`, counted from 0 at the base, without damping: one less than the degrees of
    /// freedom of the beam.
    ///
    /// With point masses they are counted: for mass i, counted from 0, the changes of sign along the beam give i zeros
    /// of class b and n − 1 − i of class a, and n − 1 zeros are all there are. With a payload that resists turning,
    /// real zeros are found as changes of sign of the numerator on a grid, and complex ones by Newton's method, where
    /// zeros already found are divided out; the degree of the numerator says when all are found. That search is made
    /// for at most 200 masses: with more it takes minutes and misses some. The mass at the point itself has no effect
    /// (invariance of zeros).
    ///
    /// `None` if there is no such mass.
    ///
    /// # Source
    /// `[Feliu1989, Section 3, properties 1, 2 and 4]`
    pub fn zeros(&self, mass: usize) -> Option<Zeros> {
        let joint = self.joints().nth(mass)?;
        if !self.payload().turns() {
            // Where rounding spoils the counts, the search says how many are missing.
            let outer = self.len() - 1 - mass;
            if let Some(z) = counted(self.elements(), joint, mass, outer) {
                return Some(Zeros { z: z.into_iter().map(Complex64::from).collect(), missing: 0 });
            }
        }
        Some(all(self.elements(), joint))
    }
}
