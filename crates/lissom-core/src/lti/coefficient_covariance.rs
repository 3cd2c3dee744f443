//! Standard errors of the response and of the roots of a transfer function, from the covariance of its coefficients.

use nalgebra::DMatrix;
use num_complex::Complex64;

use super::transfer_function::TransferFunction;

/// Smallest slope of a polynomial at a root, relative to its terms, at which the root is single.
const SINGLE_ROOT: f64 = 1e-6;

/// Covariance of the estimated coefficients of `G(s)·e^(−sτ)`, with G a [`TransferFunction`].
#[derive(Debug, Clone, PartialEq)]
pub struct CoefficientCovariance {
    /// Covariance matrix: numerator, denominator, both in descending powers of s, and the delay τ \[s\].
    pub matrix: DMatrix<f64>,
}

/// Standard errors of a frequency response.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ResponseError {
    /// Relative standard error of the magnitude, that of ln|G| \[1\].
    pub relative_magnitude: f64,
    /// Standard error of the phase \[rad\].
    pub phase_rad: f64,
}

/// Standard errors of a pole or zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RootError {
    /// Of its real part \[1/s\].
    pub real_per_s: f64,
    /// Of its imaginary part \[rad/s\].
    pub imaginary_rad_s: f64,
}

impl CoefficientCovariance {
    /// Of the rows of the matrix; `None` if it is not square.
    pub fn of_rows(rows: &[Vec<f64>]) -> Option<Self> {
        let n = rows.len();
        let square = rows.iter().all(|row| row.len() == n);
        square.then(|| Self { matrix: DMatrix::from_fn(n, n, |i, k| rows[i][k]) })
    }

    /// The rows of the matrix.
    pub fn rows(&self) -> Vec<Vec<f64>> {
        self.matrix.row_iter().map(|row| row.iter().copied().collect()).collect()
    }

    /// Whether the matrix has a row for each coefficient of `function` and one for the delay.
    pub fn fits(&self, function: &TransferFunction) -> bool {
        let rows = function.num.len() + function.den.len() + 1;
        self.matrix.shape() == (rows, rows)
    }

    /// Standard errors of the response at ω, by the delta method with
    /// `∂ln G/∂b_k = s^k/N(s)`, `∂ln G/∂a_k = −s^k/D(s)` and `∂ln G/∂τ = −s` at `s = jω`.
    ///
    /// `None` if the matrix does not [fit](Self::fits) the function, or where the response is zero or infinite.
    pub fn of_response(
        &self,
        function: &TransferFunction,
        omega_rad_s: f64,
    ) -> Option<ResponseError> {
        let s = Complex64::new(0.0, omega_rad_s);
        let [numerator, denominator] = [&function.num, &function.den].map(|c| value(c, s));
        let of_num = powers(function.num.len(), s).map(|power| power / numerator);
        let of_den = powers(function.den.len(), s).map(|power| -power / denominator);
        let slopes: Vec<Complex64> = of_num.chain(of_den).chain([-s]).collect();
        let [relative_magnitude, phase_rad] = self.along(function, &slopes)?;
        Some(ResponseError { relative_magnitude, phase_rad })
    }

    /// Standard errors of a pole p, from `∂p/∂a_k = −p^k/D'(p)`; `None` for a pole that is not single.
    pub fn of_pole(&self, function: &TransferFunction, pole: Complex64) -> Option<RootError> {
        self.of_root(function, &function.den, function.num.len(), pole)
    }

    /// Standard errors of a zero, as for a pole.
    pub fn of_zero(&self, function: &TransferFunction, zero: Complex64) -> Option<RootError> {
        self.of_root(function, &function.num, 0, zero)
    }

    fn of_root(
        &self,
        function: &TransferFunction,
        coefficients: &[f64],
        first: usize,
        root: Complex64,
    ) -> Option<RootError> {
        let degree = coefficients.len().checked_sub(1)?;
        let terms = coefficients.iter().zip(powers(coefficients.len(), root)).enumerate();
        let terms = terms.take(degree).map(|(k, (c, power))| power * ((degree - k) as f64 * c));
        // Root times slope: it has the unit of the terms.
        let (sum, size) =
            terms.fold((Complex64::ZERO, 0.0), |(sum, size), t| (sum + t, size + t.norm()));
        let at_zero = root.norm() == 0.0;
        let slope = if at_zero {
            Complex64::from(*coefficients.get(degree.checked_sub(1)?)?)
        } else {
            sum / root
        };
        let single = if at_zero { slope.norm() > 0.0 } else { sum.norm() > SINGLE_ROOT * size };
        if !single {
            return None;
        }
        let mut slopes = vec![Complex64::ZERO; function.num.len() + function.den.len() + 1];
        for (slot, power) in slopes.iter_mut().skip(first).zip(powers(coefficients.len(), root)) {
            *slot = -power / slope;
        }
        let [real_per_s, imaginary_rad_s] = self.along(function, &slopes)?;
        Some(RootError { real_per_s, imaginary_rad_s })
    }

    /// Standard errors of the real and the imaginary part of a quantity with these slopes.
    fn along(&self, function: &TransferFunction, slopes: &[Complex64]) -> Option<[f64; 2]> {
        if !self.fits(function) {
            return None;
        }
        let n = slopes.len();
        let variance = |part: fn(&Complex64) -> f64| {
            let rows = (0..n).map(|i| {
                let row: f64 = (0..n).map(|k| self.matrix[(i, k)] * part(&slopes[k])).sum();
                part(&slopes[i]) * row
            });
            rows.sum::<f64>()
        };
        let variances = [variance(|z| z.re), variance(|z| z.im)];
        // Rounding may leave a variance of zero below zero.
        variances.iter().all(|v| v.is_finite()).then(|| variances.map(|v| v.max(0.0).sqrt()))
    }
}

/// Powers of s with the coefficients of a polynomial, descending.
fn powers(count: usize, s: Complex64) -> impl Iterator<Item = Complex64> {
    (0..count).rev().map(move |k| (0..k).fold(Complex64::ONE, |power, _| power * s))
}

fn value(coefficients: &[f64], s: Complex64) -> Complex64 {
    coefficients.iter().fold(Complex64::ZERO, |sum, c| sum * s + c)
}

#[cfg(test)]
mod tests {
    use nalgebra::DVector;

    use super::*;

    /// `K/(s·(J·s + V))` with K, J, V and their deviations.
    fn drive() -> (TransferFunction, CoefficientCovariance) {
        let function = TransferFunction { num: vec![2.0], den: vec![1.0, 0.5, 0.0] };
        let errors = DVector::from_vec(vec![0.02, 0.0, 0.05, 0.0, 1e-3]);
        let matrix = DMatrix::from_diagonal(&errors.component_mul(&errors));
        (function, CoefficientCovariance { matrix })
    }

    #[test]
    fn a_response_follows_the_closed_form() {
        let (function, covariance) = drive();
        let w = 3.0_f64;
        let found = covariance.of_response(&function, w).unwrap();
        // |G| = b/(ω·√(ω² + a²)), arg G = −π/2 − atan(ω/a) − ωτ.
        let (a, size) = (0.5, w * w + 0.25);
        let relative = (0.01_f64.powi(2) + (0.05 * a / size).powi(2)).sqrt();
        let phase = ((0.05 * w / size).powi(2) + (w * 1e-3).powi(2)).sqrt();
        assert!((found.relative_magnitude / relative - 1.0).abs() < 1e-12, "{found:?} {relative}");
        assert!((found.phase_rad / phase - 1.0).abs() < 1e-12, "{found:?} {phase}");
        assert!(covariance.of_response(&function, 0.0).is_none());
    }

    #[test]
    fn single_roots_have_errors() {
        let (function, covariance) = drive();
        let pole = covariance.of_pole(&function, Complex64::from(-0.5)).unwrap();
        assert!((pole.real_per_s - 0.05).abs() < 1e-12 && pole.imaginary_rad_s < 1e-12, "{pole:?}");
        let origin = covariance.of_pole(&function, Complex64::ZERO).unwrap();
        assert!(origin.real_per_s < 1e-12, "{origin:?}");
        let double = TransferFunction { num: vec![1.0], den: vec![1.0, 2.0, 1.0] };
        let covariance = CoefficientCovariance { matrix: DMatrix::identity(5, 5) };
        assert!(covariance.of_pole(&double, Complex64::from(-1.0)).is_none());
        let other = TransferFunction { num: vec![1.0], den: vec![1.0, 2.0] };
        assert!(!covariance.fits(&other) && covariance.of_response(&other, 1.0).is_none());
    }

    #[test]
    fn a_pair_of_poles_moves_as_its_frequency_and_damping() {
        // s² + 2ζω·s + ω² with errors of ω alone: both parts of the pole move by the same share.
        let (w, zeta, error) = (8.0_f64, 0.1_f64, 0.04);
        let function = TransferFunction { num: vec![1.0], den: vec![1.0, 2.0 * zeta * w, w * w] };
        let slopes = DVector::from_vec(vec![0.0, 0.0, 2.0 * zeta * error, 2.0 * w * error, 0.0]);
        let covariance = CoefficientCovariance { matrix: &slopes * slopes.transpose() };
        let pole = Complex64::new(-zeta * w, w * (1.0 - zeta * zeta).sqrt());
        let found = covariance.of_pole(&function, pole).unwrap();
        assert!((found.real_per_s - zeta * error).abs() < 1e-9, "{found:?}");
        let expected = (1.0 - zeta * zeta).sqrt() * error;
        assert!((found.imaginary_rad_s - expected).abs() < 1e-9, "{found:?}");
    }
}
