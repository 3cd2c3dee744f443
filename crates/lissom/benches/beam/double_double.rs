//! Pairs of doubles whose sum carries about 106 bits, and the reference computed in them.

use std::ops::{Add, Div, Mul, Neg, Sub};

use lissom::beam::LumpedBeam;

/// The unevaluated sum of a double and what it lacks.
///
/// # Source
/// `[Dekker1971]`, with a fused multiply-add in place of his splitting.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DoubleDouble(f64, f64);

/// The sum of two doubles, exactly; `a` the larger.
fn settled(a: f64, b: f64) -> DoubleDouble {
    let sum = a + b;
    DoubleDouble(sum, b - (sum - a))
}

/// The sum of two doubles, exactly.
fn two_sum(a: f64, b: f64) -> DoubleDouble {
    let sum = a + b;
    let rest = sum - a;
    DoubleDouble(sum, (a - (sum - rest)) + (b - rest))
}

impl From<f64> for DoubleDouble {
    fn from(value: f64) -> Self {
        Self(value, 0.0)
    }
}
impl Add for DoubleDouble {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        let (high, low) = (two_sum(self.0, o.0), two_sum(self.1, o.1));
        let sum = settled(high.0, high.1 + low.0);
        settled(sum.0, sum.1 + low.1)
    }
}
impl Neg for DoubleDouble {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0, -self.1)
    }
}
impl Sub for DoubleDouble {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        self + -o
    }
}
impl Mul for DoubleDouble {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        let product = self.0 * o.0;
        let rest = self.0.mul_add(o.0, -product);
        settled(product, rest + self.0.mul_add(o.1, self.1 * o.0))
    }
}
impl Div for DoubleDouble {
    type Output = Self;
    fn div(self, o: Self) -> Self {
        let first = self.0 / o.0;
        let rest = self - o * first.into();
        let second = rest.0 / o.0;
        let rest = rest - o * second.into();
        settled(first, second) + Self::from(rest.0 / o.0)
    }
}

/// θ_n/θ_m of an undamped beam and its last pivot, by the recursion of compliance and motion.
///
/// The pivot changes its sign where a natural frequency is passed. What the recursion loses by
/// cancellation (a factor of some 1e4 at 1000 spans) 106 bits can spare.
pub(crate) fn tip(beam: &LumpedBeam, omega_rad_s: f64) -> (f64, f64) {
    type D = DoubleDouble;
    let [one, two, three] = [1.0, 2.0, 3.0].map(D::from);
    let omega = D::from(omega_rad_s);
    let z = -(omega * omega);
    let [mut c11, mut c12, mut c22, mut d1, mut length, mut pivot] = [D::from(0.0); 6];
    let mut d2 = one;
    for span in beam.spans() {
        let (l, m) = (D::from(span.length_m), D::from(span.mass_kg));
        let bend = l / span.flexural_rigidity_n_m2.into();
        c11 = c11 + l * (two * c12 + l * (c22 + bend / three));
        c12 = c12 + l * (c22 + bend / two);
        c22 = c22 + bend;
        d1 = d1 + l * d2;
        length = length + l;
        pivot = one + z * m * c11;
        let g = one / pivot;
        let q = z * m * g;
        c22 = c22 - q * c12 * c12;
        d2 = d2 - q * c12 * d1;
        (c11, c12, d1) = (c11 * g, c12 * g, d1 * g);
    }
    ((d1 / length).0, pivot.0)
}

/// A natural frequency beside `near_rad_s`, to some 1e-17 of it: the last pivot's zero by chords.
pub(crate) fn frequency(beam: &LumpedBeam, near_rad_s: f64) -> f64 {
    // The pivot has a pole between two of its zeros: stay close.
    let (mut a, mut b) = (near_rad_s * (1.0 - 1e-11), near_rad_s * (1.0 + 1e-11));
    let (mut fa, mut fb) = (tip(beam, a).1, tip(beam, b).1);
    for _ in 0..3 {
        let c = b - fb * ((b - a) / (fb - fa));
        (a, fa) = (b, fb);
        (b, fb) = (c, tip(beam, c).1);
        if fb.total_cmp(&fa).is_eq() {
            break;
        }
    }
    b
}
