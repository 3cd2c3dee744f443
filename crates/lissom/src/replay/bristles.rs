//! Bristles that hold the joint and bend before it slips, over a step of the replay.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::tangents::{Answers, Lanes};
use crate::number::Number;

/// Exponents below which `(1 − e^{−u})/u` is taken by its series.
const SMALL: f64 = 1e-2;

/// What yields before the joint slips: the joint's dry friction is
///
/// ```text
/// F = σ0·z + σ1·ż + O,   ż = θ̇ − σ0·|θ̇|/g·z
/// ```
///
/// with the deflection z \[rad\] and, as its level g \[N·m\], Coulomb friction with what it has near rest and
/// over the travel; O the offset. There is no sticking: the joint swings on its bristles.
///
/// # Source
/// `[deWit1995, eqs. (2)-(5)]`; viscous friction, the source's σ2, is the arm's own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bristles {
    /// σ0 \[N·m/rad\].
    pub stiffness_nm_per_rad: f64,
    /// σ1 \[N·m·s/rad\].
    pub damping_nm_s_per_rad: f64,
}

/// The bristles of a replay: how far they are bent, with its derivatives by every unknown.
#[derive(Debug, Clone, Default)]
pub(super) struct Bent {
    pub(super) z: f64,
    pub(super) by: Vec<Lanes>,
    /// Room for what a step asks of the law's own numbers.
    pub(super) own: Vec<Answers>,
}

/// What bends the bristles over a step: velocities and levels at its beginning, halfway and at its end, the
/// deflection at its beginning, σ0 and σ1.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bending<T> {
    pub(super) velocity: [T; 3],
    pub(super) z: T,
    pub(super) level: [T; 3],
    pub(super) stiffness: T,
    pub(super) damping: T,
}

/// Number of inputs of a [`Bending`], in their order.
pub(super) const INPUTS: usize = 9;
pub(super) const VELOCITY: usize = 0;
pub(super) const DEFLECTION: usize = 3;
pub(super) const LEVEL: usize = 4;
pub(super) const STIFFNESS: usize = 7;
pub(super) const DAMPING: usize = 8;

/// What friction does over a step: its torque at both ends, by how much its mean is beyond theirs, and the
/// deflection at the end.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bristled<T> {
    pub(super) from: T,
    pub(super) to: T,
    pub(super) beyond: T,
    pub(super) z: T,
}

impl Bending<f64> {
    /// With derivatives by its own inputs.
    fn varied(&self) -> Bending<Gradient> {
        let of = |value: f64, at: usize| Gradient::variable(value, at);
        let three = |x: [f64; 3], at: usize| [0, 1, 2].map(|i| of(x[i], at + i));
        Bending {
            velocity: three(self.velocity, VELOCITY),
            z: of(self.z, DEFLECTION),
            level: three(self.level, LEVEL),
            stiffness: of(self.stiffness, STIFFNESS),
            damping: of(self.damping, DAMPING),
        }
    }

    /// Derivatives of friction at the beginning by the inputs.
    pub(super) fn slopes_now(&self) -> [f64; INPUTS] {
        self.varied().now().by
    }

    /// Over a step, with derivatives by the inputs.
    pub(super) fn slopes(&self, duration_s: f64) -> Bristled<[f64; INPUTS]> {
        let found = self.varied().over(duration_s);
        Bristled { from: found.from.by, to: found.to.by, beyond: found.beyond.by, z: found.z.by }
    }
}

impl<T: Exponential> Bending<T> {
    /// Friction at the beginning.
    pub(super) fn now(&self) -> T {
        self.torque(self.z, 0)
    }

    /// Over a step: z follows its level over the travel exactly where that is linear in it, in two halves; the
    /// torque's mean is Simpson's of σ0·z, and exact of σ1·ż.
    pub(super) fn over(&self, duration_s: f64) -> Bristled<T> {
        let [first, middle, last] = self.velocity;
        // Of a parabola through the three velocities.
        let part =
            |near: T, far: T| (near.times(5.0) + middle.times(8.0) - far).times(duration_s / 24.0);
        let half_s = 0.5 * duration_s;
        let middle = self.half(self.z, 0, part(first, last), half_s);
        let end = self.half(middle, 1, part(last, first), half_s);
        let from = self.now();
        let to = self.torque(end, 2);
        let mean_z = (self.z + middle.times(4.0) + end).times(1.0 / 6.0);
        let mean =
            self.stiffness * mean_z + (self.damping * (end - self.z)).times(1.0 / duration_s);
        Bristled { from, to, beyond: mean - (from + to).times(0.5), z: end }
    }

    /// σ0·z + σ1·ż at place `at` of the three.
    fn torque(&self, z: T, at: usize) -> T {
        let rate = self.velocity[at] - self.forgets(at) * z;
        self.stiffness * z + self.damping * rate
    }

    /// Rate at which they forget what they were bent by, σ0·|v|/g.
    fn forgets(&self, at: usize) -> T {
        self.stiffness * size(self.velocity[at]) / self.level[at]
    }

    /// The deflection after half a step from place `at` to the next, over which the motor turns by `travel`; where it
    /// reverses, the velocity is taken for linear in time.
    fn half(&self, z: T, at: usize, travel: T, half_s: f64) -> T {
        let [before, after] = [self.velocity[at], self.velocity[at + 1]];
        let [a, b] = [before, after].map(Number::sign_part);
        // Bent as in steady motion that way.
        let steady = |at: usize, way: f64| (self.level[at] / self.stiffness).times(way);
        let [forgets, then] = [self.forgets(at), self.forgets(at + 1)];
        if a * b >= 0.0 {
            let way = if a + b < 0.0 { -1.0 } else { 1.0 };
            let mut u = (forgets + then).times(0.5 * half_s);
            if travel.sign_part() * (a + b) > 0.0 {
                u = u * travel / (before + after).times(0.5 * half_s);
            }
            return follows(z, [steady(at, way), steady(at + 1, way)], u);
        }
        // To rest, and away from it the other way.
        let until = before / (before - after);
        let first = steady(at, a.signum());
        let turned = follows(z, [first; 2], (forgets * until).times(0.5 * half_s));
        let second = steady(at + 1, b.signum());
        let rest = T::real(1.0) - until;
        follows(turned, [second; 2], (then * rest).times(0.5 * half_s))
    }
}

/// `dz/du = ζ − z` over u, ζ linear in it.
fn follows<T: Exponential>(z: T, [from, to]: [T; 2], u: T) -> T {
    let left = (-u).exp();
    let mean = if u.sign_part() < SMALL {
        let series = T::real(1.0 / 6.0) - u.times(1.0 / 24.0);
        T::real(1.0) - u * (T::real(0.5) - u * series)
    } else {
        (T::real(1.0) - left) / u
    };
    to + (z - from) * left - (to - from) * mean
}

fn size<T: Number>(x: T) -> T {
    if x.sign_part() < 0.0 { -x } else { x }
}

/// Numbers with an exponential.
pub(super) trait Exponential: Number {
    fn exp(self) -> Self;
}

impl Exponential for f64 {
    fn exp(self) -> Self {
        f64::exp(self)
    }
}

/// A value with its derivatives by the inputs of a [`Bending`].
#[derive(Debug, Clone, Copy)]
struct Gradient {
    value: f64,
    by: [f64; INPUTS],
}

impl Gradient {
    fn variable(value: f64, at: usize) -> Self {
        let mut by = [0.0; INPUTS];
        by[at] = 1.0;
        Self { value, by }
    }

    fn with(value: f64, (a, x): (f64, &Self), (b, y): (f64, &Self)) -> Self {
        let mut by = [0.0; INPUTS];
        for (by, (x, y)) in by.iter_mut().zip(x.by.iter().zip(&y.by)) {
            *by = a * x + b * y;
        }
        Self { value, by }
    }
}

impl Add for Gradient {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self::with(self.value + o.value, (1.0, &self), (1.0, &o))
    }
}
impl Sub for Gradient {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        Self::with(self.value - o.value, (1.0, &self), (-1.0, &o))
    }
}
impl Mul for Gradient {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        Self::with(self.value * o.value, (o.value, &self), (self.value, &o))
    }
}
impl Div for Gradient {
    type Output = Self;
    fn div(self, o: Self) -> Self {
        let value = self.value / o.value;
        Self::with(value, (1.0 / o.value, &self), (-value / o.value, &o))
    }
}
impl Neg for Gradient {
    type Output = Self;
    fn neg(self) -> Self {
        self.times(-1.0)
    }
}

impl Number for Gradient {
    fn real(value: f64) -> Self {
        Self { value, by: [0.0; INPUTS] }
    }
    fn times(self, factor: f64) -> Self {
        Self { value: factor * self.value, by: self.by.map(|v| factor * v) }
    }
    fn size(self) -> f64 {
        self.value.abs()
    }
    fn sign_part(self) -> f64 {
        self.value
    }
}

impl Exponential for Gradient {
    fn exp(self) -> Self {
        let value = self.value.exp();
        Self { value, by: self.by.map(|v| value * v) }
    }
}
