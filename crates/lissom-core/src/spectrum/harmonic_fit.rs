//! Least squares of a signal on its mean, a line and harmonics, with sums by tables.
#![expect(clippy::inline_always, reason = "compiled for wide registers as one")]

use crate::registers::widest;
use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;

/// Samples in a block. Within a block the waves are from a table; from block to block they turn.
const BLOCK: usize = 64;
/// Sums kept side by side: a single one would wait for each addition.
const LANES: usize = 8;

/// Columns 1, a line from −1 to 1, cos kω0t, sin kω0t for n samples, and the inverse of their normal matrix.
pub(super) struct HarmonicFit {
    n: usize,
    phase_step: f64,
    /// cos and sin of each harmonic at the samples of a block.
    waves: Vec<[f64; BLOCK]>,
    inverse: DMatrix<f64>,
}

/// What a fit leaves of a signal.
pub(super) struct Residual {
    /// Σ e².
    pub(super) power: f64,
    /// Σ (Σ a·e)(Σ a·e)ᵀ over stretches of one period, a the columns.
    pub(super) middle: DMatrix<f64>,
    /// Number of these stretches.
    pub(super) stretches: usize,
}

impl HarmonicFit {
    /// Of `n` samples with harmonics 1..=`count`. `None` where the columns are too many or dependent.
    pub(super) fn new(n: usize, phase_step: f64, count: usize) -> Option<Self> {
        if n < 2 + 2 * count + 2 {
            return None;
        }
        let inverse = normal(n, phase_step, count).cholesky()?.inverse();
        let mut waves = vec![[0.0; BLOCK]; 2 * count];
        let samples: Vec<Vec<_>> =
            (0..BLOCK).map(|k| powers(phase_step * k as f64).take(count).collect()).collect();
        for (h, [cosine, sine]) in waves.as_chunks_mut::<2>().0.iter_mut().enumerate() {
            for ((c, s), z) in cosine.iter_mut().zip(sine).zip(&samples) {
                (*c, *s) = (z[h].re, z[h].im);
            }
        }
        Some(Self { n, phase_step, waves, inverse })
    }

    pub(super) fn inverse(&self) -> &DMatrix<f64> {
        &self.inverse
    }

    /// The coefficient of each column.
    pub(super) fn solution(&self, samples: &[f64]) -> DVector<f64> {
        let right = widest(|| self.right_side(samples));
        &self.inverse * right
    }

    /// What coefficients leave, with the stretches of `period` samples where it is given.
    pub(super) fn residual(
        &self,
        samples: &[f64],
        solution: &DVector<f64>,
        period: Option<usize>,
    ) -> Residual {
        widest(|| self.left(samples, solution, period))
    }

    fn columns(&self) -> usize {
        2 + self.waves.len()
    }

    /// The line at sample `k`.
    fn line(&self, k: usize) -> f64 {
        2.0 * k as f64 / (self.n - 1) as f64 - 1.0
    }

    /// Adds Σ a·x of at most [`BLOCK`] samples from number `from` on.
    #[inline(always)]
    fn add_products(&self, from: usize, x: &[f64], sums: &mut [f64]) {
        let (mut sum, mut moment) = (0.0, 0.0);
        for (k, x) in x.iter().enumerate() {
            sum += x;
            moment += x * k as f64;
        }
        sums[0] += sum;
        sums[1] += self.line(from) * sum + 2.0 / (self.n - 1) as f64 * moment;
        let waves = self.waves.as_chunks::<2>().0.iter();
        let turns = powers(self.phase_step * from as f64);
        for ((sums, [cos, sin]), turn) in
            sums[2..].as_chunks_mut::<2>().0.iter_mut().zip(waves).zip(turns)
        {
            let z = turn * Complex64::new(dot(cos, x), dot(sin, x));
            sums[0] += z.re;
            sums[1] += z.im;
        }
    }

    /// `x` without what the coefficients explain of it, in `left`, for at most [`BLOCK`] samples.
    #[inline(always)]
    fn leave(&self, from: usize, x: &[f64], solution: &[f64], left: &mut [f64]) {
        let (start, slope) = (self.line(from), 2.0 / (self.n - 1) as f64);
        let (constant, slope) = (solution[0] + solution[1] * start, solution[1] * slope);
        for (k, (left, x)) in left.iter_mut().zip(x).enumerate() {
            *left = x - (constant + slope * k as f64);
        }
        let waves = self.waves.as_chunks::<2>().0.iter();
        let turns = powers(self.phase_step * from as f64);
        for ((s, [cos, sin]), turn) in solution[2..].as_chunks::<2>().0.iter().zip(waves).zip(turns)
        {
            // s₀·Re(z·w) + s₁·Im(z·w) with w the wave in the block.
            let (a, b) = (s[0] * turn.re + s[1] * turn.im, s[1] * turn.re - s[0] * turn.im);
            for ((left, cos), sin) in left.iter_mut().zip(cos).zip(sin) {
                *left -= a * cos + b * sin;
            }
        }
    }
}

impl HarmonicFit {
    /// Σ a·x over all samples.
    #[inline(always)]
    fn right_side(&self, samples: &[f64]) -> DVector<f64> {
        let mut sums = DVector::zeros(self.columns());
        for (block, x) in samples.chunks(BLOCK).enumerate() {
            self.add_products(block * BLOCK, x, sums.as_mut_slice());
        }
        sums
    }

    /// See [`Self::residual`].
    #[inline(always)]
    fn left(&self, samples: &[f64], solution: &DVector<f64>, period: Option<usize>) -> Residual {
        let columns = self.columns();
        let mut found =
            Residual { power: 0.0, middle: DMatrix::zeros(columns, columns), stretches: 0 };
        let mut scores: DVector<f64> = DVector::zeros(columns);
        let mut left = [0.0; BLOCK];
        let whole = period.unwrap_or(samples.len());
        for (number, stretch) in samples.chunks(whole).enumerate() {
            scores.fill(0.0);
            for (block, x) in stretch.chunks(BLOCK).enumerate() {
                let (from, left) = (number * whole + block * BLOCK, &mut left[..x.len()]);
                self.leave(from, x, solution.as_slice(), left);
                found.power += dot(left, left);
                if period.is_some() {
                    self.add_products(from, left, scores.as_mut_slice());
                }
            }
            if period.is_some() {
                found.middle.ger(1.0, &scores, &scores, 1.0);
            }
            found.stretches += 1;
        }
        found
    }
}

/// e^{jφ}, e^{2jφ}, …
#[inline(always)]
fn powers(phase: f64) -> impl Iterator<Item = Complex64> {
    let (sin, cos) = phase.sin_cos();
    let turn = Complex64::new(cos, sin);
    std::iter::successors(Some(turn), move |z| Some(z * turn))
}

/// Σ a·b over the shorter of two slices.
#[inline(always)]
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let n = a.len().min(b.len());
    let ((a, a_rest), (b, b_rest)) = (a[..n].as_chunks::<LANES>(), b[..n].as_chunks::<LANES>());
    let mut lanes = [0.0; LANES];
    for (a, b) in a.iter().zip(b) {
        for lane in 0..LANES {
            lanes[lane] += a[lane] * b[lane];
        }
    }
    let rest: f64 = a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum();
    lanes.iter().sum::<f64>() + rest
}

/// The normal matrix of all columns, in closed form: products of waves are waves of the sum and the difference of
/// their frequencies.
fn normal(n: usize, phase_step: f64, count: usize) -> DMatrix<f64> {
    let samples = n as f64;
    let (sums, moments): (Vec<Complex64>, Vec<Complex64>) =
        (0..=2 * count).map(|m| sums_of_wave(n, phase_step * m as f64)).unzip();
    let mut normal = DMatrix::zeros(2 + 2 * count, 2 + 2 * count);
    normal[(0, 0)] = samples;
    normal[(1, 1)] = samples * (samples + 1.0) / (3.0 * (samples - 1.0));
    for h in 1..=count {
        let (c, s) = (2 * h, 2 * h + 1);
        normal[(c, 0)] = sums[h].re;
        normal[(s, 0)] = sums[h].im;
        normal[(c, 1)] = moments[h].re;
        normal[(s, 1)] = moments[h].im;
        for l in 1..=h {
            let (plus, minus) = (sums[h + l], sums[h - l]);
            normal[(c, 2 * l)] = 0.5 * (minus.re + plus.re);
            normal[(c, 2 * l + 1)] = 0.5 * (plus.im - minus.im);
            normal[(s, 2 * l)] = 0.5 * (plus.im + minus.im);
            normal[(s, 2 * l + 1)] = 0.5 * (minus.re - plus.re);
        }
    }
    normal.fill_upper_triangle_with_lower_triangle();
    normal
}

/// `Σ e^{jψk}` and `Σ l_k·e^{jψk}` over samples 0..n, l the line from −1 to 1.
fn sums_of_wave(n: usize, psi: f64) -> (Complex64, Complex64) {
    let (samples, middle) = (n as f64, 0.5 * (n - 1) as f64);
    if psi == 0.0 {
        return (Complex64::from(samples), Complex64::ZERO);
    }
    let (half_sin, half_cos) = (0.5 * psi).sin_cos();
    if samples * half_sin.abs() < 1.0 {
        // Hardly a wave: the closed form divides by zero.
        return (0..n).fold((Complex64::ZERO, Complex64::ZERO), |(sum, moment), k| {
            let z = Complex64::from_polar(1.0, psi * k as f64);
            (sum + z, moment + z * (k as f64 / middle - 1.0))
        });
    }
    // About the middle: D(ψ) = sin(nψ/2)/sin(ψ/2), and −j·D′(ψ).
    let (sin, cos) = (0.5 * samples * psi).sin_cos();
    let derivative = 0.5 * (samples * cos * half_sin - sin * half_cos) / (half_sin * half_sin);
    let turn = Complex64::from_polar(1.0, psi * middle);
    (turn * (sin / half_sin), turn * Complex64::new(0.0, -derivative / middle))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Columns one by one, and what direct sums of them give.
    #[test]
    fn sums_by_tables_are_the_sums() {
        for (n, phase_step, count) in
            [(20, 0.3, 3), (64, 0.02, 2), (1000, 0.31, 9), (777, 2.2, 1), (30, 2.09, 3)]
        {
            let row = |k: usize| {
                let line = 2.0 * k as f64 / (n - 1) as f64 - 1.0;
                let waves = powers(phase_step * k as f64).take(count).flat_map(|z| [z.re, z.im]);
                DVector::from_iterator(2 + 2 * count, [1.0, line].into_iter().chain(waves))
            };
            let direct = (0..n).map(|k| row(k) * row(k).transpose()).sum::<DMatrix<f64>>();
            let off = (normal(n, phase_step, count) - &direct).amax();
            assert!(off < 1e-12 * n as f64, "{n} {phase_step} {count}: {off}");

            let Some(fit) = HarmonicFit::new(n, phase_step, count) else { continue };
            let x: Vec<f64> = (0..n).map(|k| (k * k % 17) as f64 - 5.0).collect();
            let right = widest(|| fit.right_side(&x));
            let expected = (0..n).map(|k| row(k) * x[k]).sum::<DVector<f64>>();
            assert!((right - &expected).amax() < 1e-11 * n as f64, "{n} {phase_step} {count}");

            let weights = DVector::from_fn(2 + 2 * count, |i, _| (i as f64).cos());
            let e: Vec<f64> = (0..n).map(|k| x[k] - row(k).dot(&weights)).collect();
            let found = fit.residual(&x, &weights, Some(70));
            let power: f64 = e.iter().map(|e| e * e).sum();
            assert!((found.power / power - 1.0).abs() < 1e-12);
            assert_eq!(found.stretches, n.div_ceil(70));
            let mut middle = DMatrix::zeros(2 + 2 * count, 2 + 2 * count);
            for from in (0..n).step_by(70) {
                let score: DVector<f64> = (from..n.min(from + 70)).map(|k| row(k) * e[k]).sum();
                middle += &score * score.transpose();
            }
            assert!((found.middle - &middle).amax() < 1e-10 * middle.amax());
        }
    }
}
