//! A state matrix as independent blocks of two.

use nalgebra::{DMatrix, DVector, Schur};
use num_complex::Complex64;

/// Largest departure of the blocks from the matrix, relative to its largest entry.
const DECOMPOSED: f64 = 1e-12;
/// Largest product of the norms of the basis and its inverse, per state: beyond it roundings grow
/// by more than two decades. Nearly critical damping does that.
const CONDITION: f64 = 100.0;
/// Rounds of inverse iteration; two suffice from eigenvalues that are exact to rounding.
const ITERATIONS: usize = 3;
/// Rates up to this share of the largest are rounding of zero.
const ROUNDING: f64 = 1e-13;

/// What two states do that nothing else acts on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::rig) enum Rates {
    /// `d/dt (a + j·b) = μ·(a + j·b)` \[1/s\].
    Oscillating(Complex64),
    /// Each by itself \[1/s\].
    Apart(f64, f64),
}

/// A real matrix as `B·diag(blocks)·B⁻¹`.
#[derive(Debug, Clone)]
pub(in crate::rig) struct Blocks {
    pub(in crate::rig) rates: Vec<Rates>,
    /// B: states of the blocks to those of the matrix. The last column is zero where their number
    /// is odd.
    pub(in crate::rig) basis: DMatrix<f64>,
    pub(in crate::rig) inverse: DMatrix<f64>,
}

impl Blocks {
    /// `None` where the eigenvectors are too nearly parallel, or a state grows.
    ///
    /// # Source
    /// Eigenvalues by Schur's form, vectors by inverse iteration `[GolubVanLoan2013, 7.6]`, and the
    /// blocks of B⁻¹·A·B, whose other entries show how exact they are.
    pub(in crate::rig) fn new(a: &DMatrix<f64>) -> Option<Self> {
        let m = a.nrows();
        let size = a.amax();
        let schur = Schur::try_new(a.clone(), f64::EPSILON, 100 * m.max(10))?;
        let values = schur.complex_eigenvalues();
        let mut pairs: Vec<Complex64> = values.iter().copied().filter(|v| v.im > 0.0).collect();
        let mut alone: Vec<f64> = values.iter().filter(|v| v.im == 0.0).map(|v| v.re).collect();
        if 2 * pairs.len() + alone.len() != m {
            return None;
        }
        pairs.sort_by(|p, q| p.im.total_cmp(&q.im));
        alone.sort_by(f64::total_cmp);
        let mut columns: Vec<DVector<f64>> = Vec::with_capacity(m);
        for value in &alone {
            columns.push(eigenvector(a, Complex64::from(*value), size)?.map(|x| x.re));
        }
        for value in &pairs {
            let vector = eigenvector(a, *value, size)?;
            columns.push(vector.map(|x| x.re));
            columns.push(vector.map(|x| -x.im));
        }
        let square = DMatrix::from_columns(&columns);
        let inverse = square.clone().try_inverse()?;
        if square.norm() * inverse.norm() > CONDITION * m as f64 {
            return None;
        }
        let mut made = &inverse * a * &square;
        let mut rates = Vec::with_capacity(m.div_ceil(2));
        for pair in 0..alone.len().div_ceil(2) {
            let mut rate = |i: usize| {
                if i < alone.len() { std::mem::take(&mut made[(i, i)]) } else { 0.0 }
            };
            rates.push(Rates::Apart(rate(2 * pair), rate(2 * pair + 1)));
        }
        for pair in 0..pairs.len() {
            let i = alone.len() + 2 * pair;
            let re = 0.5 * (made[(i, i)] + made[(i + 1, i + 1)]);
            let im = 0.5 * (made[(i + 1, i)] - made[(i, i + 1)]);
            for (row, column, rate) in
                [(i, i, re), (i + 1, i + 1, re), (i + 1, i, im), (i, i + 1, -im)]
            {
                made[(row, column)] -= rate;
            }
            rates.push(Rates::Oscillating(Complex64::new(re, im)));
        }
        if made.amax() > DECOMPOSED * size {
            return None;
        }
        for rate in &mut rates {
            match rate {
                Rates::Oscillating(mu) => mu.re = decaying(mu.re, size)?,
                Rates::Apart(one, other) => {
                    *one = decaying(*one, size)?;
                    *other = decaying(*other, size)?;
                }
            }
        }
        // Single states stand before the pairs: an odd one gets an empty neighbour.
        let odd = alone.len() % 2;
        let at = alone.len();
        let basis = if odd == 1 { square.insert_column(at, 0.0) } else { square };
        let inverse = if odd == 1 { inverse.insert_row(at, 0.0) } else { inverse };
        Some(Self { rates, basis, inverse })
    }
}

/// A rate that does not grow: dampers only take.
fn decaying(rate: f64, size: f64) -> Option<f64> {
    (rate <= ROUNDING * size).then_some(rate.min(0.0))
}

/// Unit vector x with A·x = λ·x and real xᵀ·x, real where λ is.
fn eigenvector(a: &DMatrix<f64>, value: Complex64, size: f64) -> Option<DVector<Complex64>> {
    let m = a.nrows();
    // Beside the eigenvalue by some roundings: the system stays solvable.
    let shift = value + Complex64::new(4.0 * f64::EPSILON * size, 0.0);
    let system = DMatrix::from_fn(m, m, |i, j| {
        Complex64::from(a[(i, j)]) - if i == j { shift } else { Complex64::ZERO }
    });
    let lu = system.lu();
    let mut x =
        DVector::from_fn(m, |i, _| Complex64::new(1.0 + (1.9 * i as f64).sin(), 0.3 * i as f64));
    for _ in 0..ITERATIONS {
        x = lu.solve(&x)?;
        let norm = x.norm();
        if !(norm.is_finite() && norm > 0.0) {
            return None;
        }
        x.unscale_mut(norm);
    }
    let square: Complex64 = x.iter().map(|x| x * x).sum();
    let turn = Complex64::from_polar(1.0, -0.5 * square.arg());
    // Equal parts of the pair get unit size.
    let scale = if value.im == 0.0 { 1.0 } else { std::f64::consts::SQRT_2 };
    Some(x.map(|x| x * turn * scale))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// B·diag·B⁻¹ gives the matrix back to this, relatively.
    const BACK: f64 = 1e-13;

    fn rebuilt(blocks: &Blocks) -> DMatrix<f64> {
        let m = 2 * blocks.rates.len();
        let mut diagonal = DMatrix::zeros(m, m);
        for (i, rates) in blocks.rates.iter().enumerate() {
            let (a, b) = (2 * i, 2 * i + 1);
            match rates {
                Rates::Oscillating(mu) => {
                    diagonal[(a, a)] = mu.re;
                    diagonal[(b, b)] = mu.re;
                    diagonal[(a, b)] = -mu.im;
                    diagonal[(b, a)] = mu.im;
                }
                Rates::Apart(one, other) => {
                    diagonal[(a, a)] = *one;
                    diagonal[(b, b)] = *other;
                }
            }
        }
        &blocks.basis * diagonal * &blocks.inverse
    }

    #[test]
    fn pairs_single_rates_and_an_odd_one() {
        let a = DMatrix::from_row_slice(
            5,
            5,
            &[
                -0.5, 0.1, 0.0, 2.0, 1.0, //
                0.1, -0.2, 0.0, -3.0, 0.0, //
                0.0, 0.0, -9.0, 0.0, 1.5, //
                -2.0, 3.0, 0.0, 0.0, 0.0, //
                -1.0, 0.0, -1.5, 0.0, 0.0,
            ],
        );
        let blocks = Blocks::new(&a).unwrap();
        assert!((rebuilt(&blocks) - &a).amax() < BACK * a.amax());
    }

    #[test]
    fn critical_damping_is_left_to_others() {
        // s² + 2·s + 1.
        let a = DMatrix::from_row_slice(2, 2, &[-2.0, -1.0, 1.0, 0.0]);
        assert!(Blocks::new(&a).is_none());
    }

    #[test]
    fn what_grows_is_left_to_others() {
        assert!(Blocks::new(&DMatrix::from_element(1, 1, 1.0)).is_none());
    }
}
