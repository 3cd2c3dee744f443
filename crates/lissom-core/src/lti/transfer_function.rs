//! Rational transfer functions.

use nalgebra::DMatrix;
use num_complex::Complex64;

use crate::eigenvalues::eigenvalues;

/// A rational transfer function, `num(s)/den(s)`, with coefficients in descending powers of s \[1/s\].
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
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

    /// Roots of the denominator \[1/s\]; `None` if they are not found.
    pub fn poles(&self) -> Option<Vec<Complex64>> {
        roots(&self.den)
    }

    /// Finite roots of the numerator \[1/s\]; `None` if they are not found.
    pub fn zeros(&self) -> Option<Vec<Complex64>> {
        roots(&self.num)
    }

    /// Returns the same function with a leading coefficient of one in the denominator.
    #[must_use]
    pub fn monic(&self) -> Self {
        let lead = self.den.first().copied().unwrap_or(1.0);
        let divide = |c: &[f64]| c.iter().map(|a| a / lead).collect();
        Self { num: divide(&self.num), den: divide(&self.den) }
    }
}

/// Roots of a polynomial with coefficients in descending powers: the eigenvalues of its companion matrix, in a unit of s in
/// which the product of the roots other than zero has magnitude one.
fn roots(coefficients: &[f64]) -> Option<Vec<Complex64>> {
    let is_zero = |c: &&f64| c.abs() < f64::MIN_POSITIVE;
    let leading = coefficients.iter().take_while(is_zero).count();
    let trailing = coefficients[leading..].iter().rev().take_while(is_zero).count();
    let c = &coefficients[leading..coefficients.len() - trailing];
    let mut found = vec![Complex64::ZERO; trailing];
    let (Some(first), Some(last)) = (c.first(), c.last()) else { return Some(Vec::new()) };
    let degree = c.len() - 1;
    if degree == 0 {
        return Some(found);
    }
    let unit = (last / first).abs().powf(1.0 / degree as f64);
    let mut companion = DMatrix::zeros(degree, degree);
    let mut power = 1.0;
    for k in 0..degree {
        power *= unit;
        companion[(0, k)] = -c[k + 1] / first / power;
        if k > 0 {
            companion[(k, k - 1)] = 1.0;
        }
    }
    found.extend(eigenvalues(&companion)?.into_iter().map(|root| root * unit));
    Some(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_of_a_drive_with_a_mode() {
        // s·(s + 3)·(s² + 2·0.01·500·s + 500²), and a numerator without the highest power.
        let (a, b) = (10.0, 250_000.0);
        let den = vec![1.0, 3.0 + a, b + 3.0 * a, 3.0 * b, 0.0];
        let g = TransferFunction { num: vec![0.0, 2.0, 0.0, 8.0], den };
        let mut poles = g.poles().unwrap();
        poles.sort_by(|p, q| p.norm().total_cmp(&q.norm()));
        assert!(poles[0].norm() < 1e-300 && (poles[1] + 3.0).norm() < 1e-9);
        assert!((poles[2].norm() - 500.0).abs() < 1e-9 && (poles[2].re + 5.0).abs() < 1e-9);
        let zeros = g.zeros().unwrap();
        assert!(zeros.len() == 2 && zeros.iter().all(|z| (z.im.abs() - 2.0).abs() < 1e-12));
        let nothing = TransferFunction { num: vec![], den: vec![0.0, 0.0] };
        assert_eq!((nothing.zeros(), nothing.poles()), (Some(vec![]), Some(vec![])));
        assert_eq!(TransferFunction { num: vec![f64::NAN, 1.0], den: vec![] }.zeros(), None);
    }

    #[test]
    fn an_integrator_turns_back_by_ninety_degrees() {
        let g = TransferFunction { num: vec![4.0], den: vec![2.0, 0.0] };
        assert!((g.response(2.0) - Complex64::new(0.0, -1.0)).norm() < 1e-15);
        assert_eq!(g.monic().num, [2.0]);
    }
}
