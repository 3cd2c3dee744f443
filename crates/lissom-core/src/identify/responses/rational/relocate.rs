//! Vector fitting: moves poles to the zeros of a common denominator, without starting values close to them.

use nalgebra::{DMatrix, DVector};

use crate::eigenvalues::eigenvalues;
use crate::identify::responses::rational::Pole;
use crate::identify::responses::rational::columns::{inverses, push_column, push_weighted, shape};
use crate::identify::responses::rational::products::products;
use crate::identify::responses::rational::weighted::{Output, Weighted};

/// Rounding that a normal matrix with a diagonal of ones is raised by.
const ROUNDING: f64 = 1e-13;
/// A root is real whose imaginary part is this share of it or less.
const REAL: f64 = 1e-9;
/// Least damping ratio of a moved pole: none stands on the frequencies of the data.
const LEAST_DAMPING: f64 = 1e-5;

/// One relocation. With the numerators n_i and the common factor σ in the basis of the poles,
/// `σ·H_i = n_i` is linear in both; the zeros of σ are where the poles of all H_i are.
///
/// `n_i = Σ (a_ik + b_ik·s)/D_k`, `σ = d + Σ (c_k + e_k·s)/D_k`, `D_k = s² + 2ζ_kω_k·s + ω_k²`. d is free and
/// the mean of Re σ is asked to be one, so that noise does not draw σ towards its value at infinity.
/// Numerators have terms in s here, whatever the fit's own have: without them σ cannot move poles that
/// are far off.
///
/// # Source
/// B. Gustavsen, A. Semlyen, "Rational approximation of frequency domain responses by vector fitting",
/// IEEE Trans. Power Delivery 14 (1999); relaxed: B. Gustavsen, ibid. 21 (2006); outputs one by one:
/// D. Deschrijver et al., IEEE Microw. Wireless Compon. Lett. 18 (2008).
pub(super) fn relocated(data: &Weighted, poles: &[Pole]) -> Option<Vec<Pole>> {
    let basis = PoleBasis::new(data, poles);
    let unknowns = 2 * poles.len() + 1;
    let each = data.each(2 * unknowns, |output| without_numerator(data, &basis, output))?;
    let mut normal = each.into_iter().reduce(|a, b| a + b)?;
    let points = data.omega.len() as f64;
    let size = data.outputs.iter().map(Output::squares).sum::<f64>().sqrt() / points;
    let mean = basis.real_sums(points) * size;
    normal.ger(1.0, &mean, &mean, 1.0);
    let sigma = solved(&normal, &(mean * (size * points)))?;
    let (constant, rest) = (sigma[unknowns - 1], sigma.rows(0, unknowns - 1));
    zeros(poles, &(rest / constant))
}

/// The poles' basis on the frequencies: `ω_k²/D_k` and `s·ω_k/D_k`, real parts above imaginary ones.
struct PoleBasis {
    columns: DMatrix<f64>,
}

impl PoleBasis {
    fn new(data: &Weighted, poles: &[Pole]) -> Self {
        let points = data.omega.len();
        let mut columns = Vec::with_capacity(4 * points * poles.len());
        for pole in poles {
            let inverse = inverses(&data.omega, pole);
            for turned in [false, true] {
                push_column(&mut columns, &data.omega, &inverse, |omega, inverse| {
                    shape(pole, turned, omega, inverse)
                });
            }
        }
        let columns = DMatrix::from_vec(2 * points, 2 * poles.len(), columns);
        Self { columns }
    }

    /// Sums of the real parts, and of a one.
    fn real_sums(&self, points: f64) -> DVector<f64> {
        let each = self.columns.column_iter().map(|c| c.rows(0, c.len() / 2).sum());
        DVector::from_iterator(self.columns.ncols() + 1, each.chain([points]))
    }
}

/// Normal matrix of σ's coefficients from one output, its own numerator eliminated.
fn without_numerator(data: &Weighted, basis: &PoleBasis, output: &Output) -> Option<DMatrix<f64>> {
    let (points, own) = (data.omega.len(), basis.columns.ncols());
    let all = 2 * own + 1;
    let mut rows = Vec::with_capacity(2 * points * all);
    for column in basis.columns.column_iter() {
        push_weighted(&mut rows, column.as_slice(), &output.weights, 1.0);
    }
    for column in basis.columns.column_iter() {
        let (re, im) = column.as_slice().split_at(points);
        let parts = || re.iter().zip(im).zip(&output.weighted);
        rows.extend(parts().map(|((re, im), value)| im * value.im - re * value.re));
        rows.extend(parts().map(|((re, im), value)| -re * value.im - im * value.re));
    }
    rows.extend(output.weighted.iter().map(|value| -value.re));
    rows.extend(output.weighted.iter().map(|value| -value.im));
    let products = products(&rows, 2 * points);
    let (own_part, rest) = (products.view((0, 0), (own, own)), own + 1);
    let shared = products.view((0, own), (own, rest));
    let scale = DVector::from_fn(own, |i, _| 1.0 / own_part[(i, i)].sqrt());
    let mut scaled = DMatrix::from_fn(own, own, |i, j| own_part[(i, j)] * scale[i] * scale[j]);
    for i in 0..own {
        scaled[(i, i)] += ROUNDING;
    }
    let mut shared = shared.into_owned();
    for (mut row, scale) in shared.row_iter_mut().zip(&scale) {
        row *= *scale;
    }
    let eliminated = scaled.cholesky()?.l().solve_lower_triangular(&shared)?;
    Some(products.view((own, own), (rest, rest)) - eliminated.tr_mul(&eliminated))
}

fn solved(normal: &DMatrix<f64>, right: &DVector<f64>) -> Option<DVector<f64>> {
    let n = normal.nrows();
    let scale = DVector::from_fn(n, |i, _| 1.0 / normal[(i, i)].sqrt());
    let mut scaled = DMatrix::from_fn(n, n, |i, j| normal[(i, j)] * scale[i] * scale[j]);
    for i in 0..n {
        scaled[(i, i)] += ROUNDING;
    }
    let found = scaled.cholesky()?.solve(&right.component_mul(&scale)).component_mul(&scale);
    found.iter().all(|v| v.is_finite()).then_some(found)
}

/// Zeros of `1 + Σ (c_k·ω_k² + e_k·ω_k·s)/D_k`: eigenvalues of the poles' oscillators with σ fed back. Those
/// to the right go to the left; real ones are paired.
fn zeros(poles: &[Pole], sigma: &DVector<f64>) -> Option<Vec<Pole>> {
    let n = 2 * poles.len();
    let mut matrix = DMatrix::zeros(n, n);
    for (k, pole) in poles.iter().enumerate() {
        let w = pole.omega_rad_s;
        matrix[(2 * k, 2 * k + 1)] = w;
        matrix[(2 * k + 1, 2 * k)] = -w;
        matrix[(2 * k + 1, 2 * k + 1)] = -2.0 * pole.damping_ratio * w;
        for (column, coefficient) in sigma.iter().enumerate() {
            matrix[(2 * k + 1, column)] -= w * coefficient;
        }
    }
    let mut found = Vec::new();
    let mut real = Vec::new();
    for z in eigenvalues(&matrix)? {
        let omega_rad_s = z.norm();
        if z.im.abs() <= REAL * omega_rad_s {
            real.push(z.re.abs());
        } else if z.im > 0.0 {
            let damping_ratio = (z.re.abs() / omega_rad_s).max(LEAST_DAMPING);
            found.push(Pole { omega_rad_s, damping_ratio });
        }
    }
    real.sort_by(f64::total_cmp);
    found.extend(real.chunks_exact(2).map(|pair| {
        let omega_rad_s = (pair[0] * pair[1]).sqrt();
        Pole { omega_rad_s, damping_ratio: 1.0 }
    }));
    found.sort_by(|a, b| a.omega_rad_s.total_cmp(&b.omega_rad_s));
    (found.len() == poles.len() && found.iter().all(|p| p.omega_rad_s > 0.0)).then_some(found)
}
