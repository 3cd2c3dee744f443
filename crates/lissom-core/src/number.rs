//! Numbers that the recursions run on: real, complex, with a derivative, and products that outgrow
//! the exponent.

use std::ops::{Add, Div, Mul, Neg, Sub};

use num_complex::Complex64;

/// A field that holds the reals.
///
/// Three real implementations: `f64` (undamped, on the axes of s² real), `Complex64` (any s) and
/// [`Dual`] of either (with d/dz).
pub(crate) trait Number:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// A real number.
    fn real(value: f64) -> Self;
    /// Product with a real number.
    fn times(self, factor: f64) -> Self;
    /// Size, for scaling.
    fn size(self) -> f64;
    /// Real part of the value, where signs count.
    fn sign_part(self) -> f64;
}

impl Number for f64 {
    fn real(value: f64) -> Self {
        value
    }
    fn times(self, factor: f64) -> Self {
        self * factor
    }
    fn size(self) -> f64 {
        self.abs()
    }
    fn sign_part(self) -> f64 {
        self
    }
}

impl Number for Complex64 {
    fn real(value: f64) -> Self {
        Self::new(value, 0.0)
    }
    fn times(self, factor: f64) -> Self {
        self * factor
    }
    fn size(self) -> f64 {
        self.re.abs().max(self.im.abs())
    }
    fn sign_part(self) -> f64 {
        self.re
    }
}

/// A value with its derivative by one variable.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Dual<N> {
    pub(crate) value: N,
    pub(crate) slope: N,
}

impl<N: Number> Dual<N> {
    /// The variable itself.
    pub(crate) fn variable(value: N) -> Self {
        Self { value, slope: N::real(1.0) }
    }
}

impl<N: Number> Add for Dual<N> {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self { value: self.value + o.value, slope: self.slope + o.slope }
    }
}
impl<N: Number> Sub for Dual<N> {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        Self { value: self.value - o.value, slope: self.slope - o.slope }
    }
}
impl<N: Number> Mul for Dual<N> {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        Self { value: self.value * o.value, slope: self.slope * o.value + self.value * o.slope }
    }
}
impl<N: Number> Div for Dual<N> {
    type Output = Self;
    fn div(self, o: Self) -> Self {
        let value = self.value / o.value;
        Self { value, slope: (self.slope - value * o.slope) / o.value }
    }
}
impl<N: Number> Neg for Dual<N> {
    type Output = Self;
    fn neg(self) -> Self {
        Self { value: -self.value, slope: -self.slope }
    }
}
impl<N: Number> Number for Dual<N> {
    fn real(value: f64) -> Self {
        Self { value: N::real(value), slope: N::real(0.0) }
    }
    fn times(self, factor: f64) -> Self {
        Self { value: self.value.times(factor), slope: self.slope.times(factor) }
    }
    fn size(self) -> f64 {
        self.value.size().max(self.slope.size())
    }
    fn sign_part(self) -> f64 {
        self.value.sign_part()
    }
}

/// `mantissa·2^exponent`: a product of thousands of factors neither over- nor underflows.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Scaled<N> {
    pub(crate) mantissa: N,
    pub(crate) exponent: i64,
}

/// Mantissas are brought back once they leave 2^±[`REACH`].
const REACH: i32 = 200;

impl<N: Number> Scaled<N> {
    pub(crate) fn one() -> Self {
        Self { mantissa: N::real(1.0), exponent: 0 }
    }

    /// Product with a number.
    #[must_use]
    pub(crate) fn times(self, factor: N) -> Self {
        Self { mantissa: self.mantissa * factor, exponent: self.exponent }.settled()
    }

    /// Product.
    #[must_use]
    pub(crate) fn product(self, other: Self) -> Self {
        Self { mantissa: self.mantissa * other.mantissa, exponent: self.exponent + other.exponent }
            .settled()
    }

    fn settled(mut self) -> Self {
        let size = self.mantissa.size();
        if size > 0.0 && size.is_finite() {
            let power = size.log2() as i32;
            if power.abs() > REACH {
                // In two steps: 2^−power may itself be out of range for a subnormal size.
                let half = power / 2;
                self.mantissa =
                    self.mantissa.times(2f64.powi(-half)).times(2f64.powi(half - power));
                self.exponent += i64::from(power);
            }
        }
        self
    }
}

impl Scaled<f64> {
    /// The same number with exponent `exponent`; far smaller ones become zero, far larger ones
    /// saturate.
    pub(crate) fn at(self, exponent: i64) -> f64 {
        let shift = (self.exponent - exponent).clamp(-2000, 2000) as i32;
        let half = shift / 2;
        (self.mantissa * 2f64.powi(half) * 2f64.powi(shift - half)).clamp(-f64::MAX, f64::MAX)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dual_differentiates_a_quotient() {
        let x = Dual::variable(2.0_f64);
        let y = (x * x + Dual::real(1.0)) / x; // x + 1/x
        assert!((y.value - 2.5).abs() < 1e-15);
        assert!((y.slope - 0.75).abs() < 1e-15);
    }

    #[test]
    fn products_keep_their_size_and_sign() {
        let mut product = Scaled::<f64>::one();
        for _ in 0..1000 {
            product = product.times(-1e-30);
        }
        for _ in 0..1000 {
            product = product.times(1e30);
        }
        assert!((product.at(0) - 1.0).abs() < 1e-10, "{product:?}");
        let small = Scaled { mantissa: 5e-324_f64, exponent: 0 }.times(0.5e-300);
        assert!(small.mantissa >= 0.0);
    }
}
