//! Bristles that bend before the joint slips, and the friction of a joint on them over a step in time.

use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::number::Number;

/// Exponents below which `1 − (1 − e^{−u})/u` is taken by its series.
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

/// What bends the bristles over a step: velocities and levels at its beginning, halfway and at its end, the
/// deflection at its beginning, σ0 and σ1.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bending<T> {
    pub(crate) velocity: [T; 3],
    pub(crate) z: T,
    pub(crate) level: [T; 3],
    pub(crate) stiffness: T,
    pub(crate) damping: T,
}

/// Number of inputs of a [`Bending`], in their order.
pub(crate) const INPUTS: usize = 9;
pub(crate) const VELOCITY: usize = 0;
pub(crate) const DEFLECTION: usize = 3;
pub(crate) const LEVEL: usize = 4;
pub(crate) const STIFFNESS: usize = 7;
pub(crate) const DAMPING: usize = 8;

/// Friction over a step: its torque at both ends, how far its mean over time is above the mean of both ends, and the
/// deflection halfway and at the end.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bristled<T> {
    pub(crate) from: T,
    pub(crate) to: T,
    pub(crate) beyond: T,
    pub(crate) middle_z: T,
    pub(crate) z: T,
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
    pub(crate) fn slopes_now(&self) -> [f64; INPUTS] {
        self.varied().now().by
    }

    /// Over a step, with derivatives by the inputs.
    pub(crate) fn slopes(&self, duration_s: f64) -> Bristled<[f64; INPUTS]> {
        let found = self.varied().over(duration_s);
        Bristled {
            from: found.from.by,
            to: found.to.by,
            beyond: found.beyond.by,
            middle_z: found.middle_z.by,
            z: found.z.by,
        }
    }
}

impl<T: Exponential> Bending<T> {
    /// Friction at the beginning.
    pub(crate) fn now(&self) -> T {
        self.torque(self.z, 0)
    }

    /// Over a step: z follows its level over the travel exactly where that is linear in it, in two halves; the
    /// torque's mean is Simpson's of σ0·z, and exact of σ1·ż.
    pub(crate) fn over(&self, duration_s: f64) -> Bristled<T> {
        let [first, middle, last] = self.velocity;
        // Of a parabola through the three velocities.
        let part =
            |near: T, far: T| (near.times(5.0) + middle.times(8.0) - far).times(duration_s / 24.0);
        let half_s = 0.5 * duration_s;
        let bent = self.half(self.z, 0, part(first, last), half_s);
        let middle_z = self.z + bent;
        let bent = bent + self.half(middle_z, 1, part(last, first), half_s);
        let z = self.z + bent;
        let (from, to) = (self.now(), self.torque(z, 2));
        let mean_z = (self.z + middle_z.times(4.0) + z).times(1.0 / 6.0);
        let mean = self.stiffness * mean_z + (self.damping * bent).times(1.0 / duration_s);
        Bristled { from, to, beyond: mean - (from + to).times(0.5), middle_z, z }
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

    /// Change of the deflection over half a step from place `at` to the next, over which the motor turns by `travel`; where it
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
        let to_rest = follows(z, [first; 2], (forgets * until).times(0.5 * half_s));
        let second = steady(at + 1, b.signum());
        let rest = T::real(1.0) - until;
        to_rest + follows(z + to_rest, [second; 2], (then * rest).times(0.5 * half_s))
    }
}

/// Change of z with `dz/du = ζ − z` over u, ζ linear in it.
fn follows<T: Exponential>(z: T, [from, to]: [T; 2], u: T) -> T {
    let forgotten = -(-u).exp_m1();
    let lags = if u.sign_part() < SMALL {
        u * (T::real(0.5) - u * (T::real(1.0 / 6.0) - u.times(1.0 / 24.0)))
    } else {
        T::real(1.0) - forgotten / u
    };
    (from - z) * forgotten + (to - from) * lags
}

fn size<T: Number>(x: T) -> T {
    if x.sign_part() < 0.0 { -x } else { x }
}

/// Numbers with an exponential.
pub(crate) trait Exponential: Number {
    /// `e^x − 1`, exact near zero.
    fn exp_m1(self) -> Self;
}

impl Exponential for f64 {
    fn exp_m1(self) -> Self {
        f64::exp_m1(self)
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
    fn exp_m1(self) -> Self {
        let value = self.value.exp_m1();
        Self { value, by: self.by.map(|v| (value + 1.0) * v) }
    }
}
