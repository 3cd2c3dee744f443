//! Pairs of doubles whose sum carries about 106 bits.

use std::ops::{Add, Div, Mul, Neg, Sub};

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

impl DoubleDouble {
    /// The double next to it.
    pub(crate) fn value(self) -> f64 {
        self.0
    }
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
