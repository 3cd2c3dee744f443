//! Columns of functions of the frequency: real parts above imaginary ones.

use num_complex::Complex64;

use crate::identify::responses::rational::Pole;

/// `1/D` of a pole at each frequency.
pub(super) fn inverses(omega_rad_s: &[f64], pole: &Pole) -> Vec<Complex64> {
    let inverse = |omega: &f64| {
        let denominator = pole.denominator(*omega);
        denominator.conj() * (1.0 / denominator.norm_sqr())
    };
    omega_rad_s.iter().map(inverse).collect()
}

/// `ω_k²/D_k` of a pole's `1/D_k`, or `s·ω_k/D_k` where turned.
pub(super) fn shape(pole: &Pole, turned: bool, omega_rad_s: f64, inverse: Complex64) -> Complex64 {
    let w = pole.omega_rad_s;
    if turned { Complex64::new(0.0, w * omega_rad_s) * inverse } else { w * w * inverse }
}

/// Appends a column, `of` each frequency and the pole's inverse there.
pub(super) fn push_column(
    columns: &mut Vec<f64>,
    omega_rad_s: &[f64],
    inverse: &[Complex64],
    of: impl Fn(f64, Complex64) -> Complex64,
) {
    let at = |(omega, inverse): (&f64, &Complex64)| of(*omega, *inverse);
    columns.extend(omega_rad_s.iter().zip(inverse).map(at).map(|z| z.re));
    columns.extend(omega_rad_s.iter().zip(inverse).map(at).map(|z| z.im));
}

/// Appends `factor` times a column in an output's deviations.
pub(super) fn push_weighted(rows: &mut Vec<f64>, column: &[f64], weights: &[f64], factor: f64) {
    for half in column.chunks_exact(weights.len()) {
        rows.extend(half.iter().zip(weights).map(|(part, weight)| factor * part * weight));
    }
}
