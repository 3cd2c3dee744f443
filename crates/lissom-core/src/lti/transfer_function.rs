//! Rational transfer functions.

use num_complex::Complex64;

/// A rational transfer function, `num(s)/den(s)`, with coefficients in descending powers of s \[1/s\].
#[derive(Debug, Clone, PartialEq)]
pub struct TransferFunction {
    /// Coefficients of the numerator.
    pub num: Vec<f64>,
    /// Coefficients of the denominator.
    pub den: Vec<f64>,
}

impl TransferFunction {
    /// Frequency response: the value at `s = jω`, ω in rad/s.
    pub fn response(&self, omega_rad_s: f64) -> Complex64 {
        let s = Complex64::new(0.0, omega_rad_s);
        let value = |c: &[f64]| c.iter().fold(Complex64::ZERO, |sum, a| sum * s + a);
        value(&self.num) / value(&self.den)
    }

    /// Returns the same function with a leading coefficient of one in the denominator.
    #[must_use]
    pub fn monic(&self) -> Self {
        let lead = self.den.first().copied().unwrap_or(1.0);
        let divide = |c: &[f64]| c.iter().map(|a| a / lead).collect();
        Self { num: divide(&self.num), den: divide(&self.den) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_integrator_turns_back_by_ninety_degrees() {
        let g = TransferFunction { num: vec![4.0], den: vec![2.0, 0.0] };
        assert!((g.response(2.0) - Complex64::new(0.0, -1.0)).norm() < 1e-15);
        assert_eq!(g.monic().num, [2.0]);
    }
}
