//! Transfer functions in terms of zeros, poles and gain.

use num_complex::Complex64;

use super::TransferFunction;

/// A transfer function in zero-pole-gain form, `gain·Π(s − z)/Π(s − p)`.
///
/// This form stays accurate at any order. Polynomial coefficients do not: at degree 100, coefficients in double
/// precision no longer determine the roots.
#[derive(Debug, Clone, PartialEq)]
pub struct ZeroPoleGain {
    /// Finite zeros \[1/s\].
    pub zeros: Vec<Complex64>,
    /// Poles \[1/s\].
    pub poles: Vec<Complex64>,
    /// Ratio of the leading coefficients of numerator and denominator.
    pub gain: f64,
    /// Number of zeros and poles that were not found; zero except for extreme models.
    pub missing: usize,
}

/// A zero this far to the right, relatively, is there but for rounding.
const RIGHT: f64 = 1e-9;

impl ZeroPoleGain {
    /// Whether no zero lies to the right of the imaginary axis. Pairs on the axis count as minimum phase, as in the
    /// 1989 report. False if zeros or poles are missing.
    pub fn minimum_phase(&self) -> bool {
        self.missing == 0 && self.zeros.iter().all(|z| z.re <= RIGHT * z.norm())
    }

    /// Number of poles minus number of zeros.
    pub fn relative_degree(&self) -> usize {
        self.poles.len().saturating_sub(self.zeros.len())
    }

    /// Value at the complex frequency `s` \[1/s\].
    pub fn value(&self, s: Complex64) -> Complex64 {
        // Zeros and poles by turns: the product stays in range.
        let mut value = Complex64::from(self.gain);
        for k in 0..self.zeros.len().max(self.poles.len()) {
            if let Some(z) = self.zeros.get(k) {
                value *= s - z;
            }
            if let Some(p) = self.poles.get(k) {
                value /= s - p;
            }
        }
        value
    }

    /// Converts to polynomials in s, with a monic denominator. `None` if a coefficient is too large for a double, or if
    /// zeros or poles are missing.
    pub fn transfer_function(&self) -> Option<TransferFunction> {
        if self.missing > 0 {
            return None;
        }
        let num: Vec<f64> = polynomial(&self.zeros).iter().map(|c| c * self.gain).collect();
        let den = polynomial(&self.poles);
        let finite = num.iter().chain(&den).all(|c| c.is_finite());
        finite.then_some(TransferFunction { num, den })
    }
}

/// Monic polynomial with these roots, descending powers; roots are real or in conjugate pairs.
fn polynomial(roots: &[Complex64]) -> Vec<f64> {
    let mut all = vec![Complex64::from(1.0)];
    // Opposite roots first: s² − z² has no linear term but for rounding.
    let mut left: Vec<Complex64> = roots.to_vec();
    while let Some(root) = left.pop() {
        let opposite = left.iter().position(|r| (r + root).norm() <= 1e-14 * root.norm());
        let factor = match opposite {
            Some(at) => {
                let other = left.swap_remove(at);
                vec![Complex64::from(1.0), Complex64::ZERO, root * other]
            }
            None => vec![Complex64::from(1.0), -root],
        };
        let mut product = vec![Complex64::ZERO; all.len() + factor.len() - 1];
        for (i, a) in all.iter().enumerate() {
            for (j, b) in factor.iter().enumerate() {
                product[i + j] += a * b;
            }
        }
        all = product;
    }
    all.iter().map(|c| c.re).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_resonance_by_its_roots() {
        let j = Complex64::new(0.0, 3.0);
        let g = ZeroPoleGain { zeros: vec![], poles: vec![j, -j], gain: 9.0, missing: 0 };
        let t = g.transfer_function().unwrap();
        assert_eq!((t.num.as_slice(), t.den.as_slice()), (&[9.0][..], &[1.0, 0.0, 9.0][..]));
        assert!((g.value(Complex64::new(0.0, 1.5)).re - 4.0 / 3.0).abs() < 1e-15);
        assert!(g.minimum_phase());
        assert_eq!(g.relative_degree(), 2);
    }
}
