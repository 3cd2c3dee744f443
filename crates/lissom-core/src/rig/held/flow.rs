//! What blocks of two states do in a given time under a held torque, and how far they can stray.

use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;

use super::blocks::{Blocks, Rates};

/// Below this size of z the functions of [`phi`] are summed as series, with [`TERMS`]…
const SERIES: f64 = 1.0;
/// …terms and one: 1/20! is 4e-19. Below [`SHORT`] half of them will do: 0.08⁹/11! is 3e-18.
const TERMS: usize = 17;
const SHORT: f64 = 0.08;

/// Two states of an arm, what a torque does to them, and their part in what is watched: the
/// motor's velocity while it slips, the coupling torque while it sticks.
#[derive(Debug, Clone, Copy)]
pub(in crate::rig) struct ModalBlock {
    pub(in crate::rig) rates: Rates,
    /// ẏ per torque \[1/(N·m)\].
    pub(in crate::rig) gain: [f64; 2],
    pub(in crate::rig) read: [f64; 2],
    /// Of each part: the most that is watched of it per |ẏ| \[1\], and the size of its rate \[1/s\].
    pub(in crate::rig) sizes: [(f64, f64); 2],
}

/// A phase, slip or stick, as blocks.
#[derive(Debug, Clone)]
pub(in crate::rig) struct Flow {
    pub(in crate::rig) blocks: Vec<ModalBlock>,
    /// Blocks' states to the phase's and back.
    pub(in crate::rig) basis: DMatrix<f64>,
    pub(in crate::rig) inverse: DMatrix<f64>,
}

/// A [`ModalBlock`] over a given time t.
#[derive(Debug, Clone, Copy, Default)]
pub(in crate::rig) struct ArmPart {
    /// e^{Λ·t} by rows.
    turn: [f64; 4],
    /// y after t from rest, per torque.
    push: [f64; 2],
    read: [f64; 2],
    /// ∫ of what is watched, per state…
    sum: [f64; 2],
    /// …and per torque.
    sum_push: f64,
    /// Λ by rows.
    rate: [f64; 4],
    gain: [f64; 2],
    /// Most that the watched departs from the straight line through its ends, per |ẏ|.
    stray: [f64; 2],
}

/// What [`step`] finds out beside the states.
#[derive(Debug, Clone, Copy)]
pub(in crate::rig) struct Moved {
    /// What is watched, at the end.
    pub(in crate::rig) watched: f64,
    /// Its integral, without the torque's part.
    pub(in crate::rig) sum: f64,
    /// The most that it departs from the straight line through both ends.
    pub(in crate::rig) stray: f64,
}

impl Flow {
    pub(in crate::rig) fn new(
        a: &DMatrix<f64>,
        push: &DVector<f64>,
        read: &DVector<f64>,
    ) -> Option<Self> {
        let Blocks { rates, basis, inverse } = Blocks::new(a)?;
        let (gain, read) = (&inverse * push, basis.tr_mul(read));
        let blocks = rates
            .iter()
            .enumerate()
            .map(|(i, rates)| {
                ModalBlock::new(
                    *rates,
                    [gain[2 * i], gain[2 * i + 1]],
                    [read[2 * i], read[2 * i + 1]],
                )
            })
            .collect();
        Some(Self { blocks, basis, inverse })
    }

    /// States of the phase to states of the blocks.
    pub(in crate::rig) fn enter(&self, z: &[f64], y: &mut [[f64; 2]]) {
        combine(&self.inverse, z, y.as_flattened_mut());
    }

    /// States of the blocks to states of the phase.
    pub(in crate::rig) fn leave(&self, y: &[[f64; 2]], z: &mut [f64]) {
        combine(&self.basis, y.as_flattened(), z);
    }

    /// A row on the phase's states as one on the blocks'.
    pub(in crate::rig) fn row(&self, row: &DVector<f64>) -> Vec<[f64; 2]> {
        self.basis.tr_mul(row).as_slice().as_chunks::<2>().0.to_vec()
    }
}

impl ModalBlock {
    fn new(rates: Rates, gain: [f64; 2], read: [f64; 2]) -> Self {
        let sizes = match rates {
            Rates::Oscillating(mu) => [(read[0].hypot(read[1]), mu.norm()); 2],
            Rates::Apart(one, other) => [(read[0].abs(), one.abs()), (read[1].abs(), other.abs())],
        };
        Self { rates, gain, read, sizes }
    }

    /// Over `time_s`.
    pub(in crate::rig) fn over(&self, time_s: f64) -> ArmPart {
        let ([g1, g2], [c1, c2]) = (self.gain, self.read);
        let (turn, push, sum, sum_push, rate);
        match self.rates {
            Rates::Oscillating(mu) => {
                let [once, twice] = phi(mu * time_s);
                let e = 1.0 + mu * time_s * once;
                let (once, twice) = (once * time_s, twice * time_s * time_s);
                let gain = Complex64::new(g1, g2);
                let read = Complex64::new(c1, -c2);
                let (pushed, summed) = (once * gain, read * once);
                turn = [e.re, -e.im, e.im, e.re];
                push = [pushed.re, pushed.im];
                sum = [summed.re, -summed.im];
                sum_push = (read * twice * gain).re;
                rate = [mu.re, -mu.im, mu.im, mu.re];
            }
            Rates::Apart(one, other) => {
                let [a, b] = [one, other].map(|rate| phi(Complex64::from(rate * time_s)));
                let (a1, b1) = (a[0].re * time_s, b[0].re * time_s);
                let square = time_s * time_s;
                turn = [1.0 + one * a1, 0.0, 0.0, 1.0 + other * b1];
                push = [a1 * g1, b1 * g2];
                sum = [c1 * a1, c2 * b1];
                sum_push = (c1 * a[1].re * g1 + c2 * b[1].re * g2) * square;
                rate = [one, 0.0, 0.0, other];
            }
        }
        let stray = self.stray(time_s);
        ArmPart { turn, push, read: self.read, sum, sum_push, rate, gain: self.gain, stray }
    }

    /// A part of ẏ that decays at rate λ, |λ| = r, makes the watched depart from its chord by
    /// `c·r·t²/8` at most, as its second derivative is c·r, and by twice its own size 2·c/r.
    fn stray(&self, time_s: f64) -> [f64; 2] {
        self.sizes.map(|(c, r)| c * chord(r, time_s))
    }
}

/// `out = M·x`, column by column as they lie in memory.
fn combine(m: &DMatrix<f64>, x: &[f64], out: &mut [f64]) {
    out.fill(0.0);
    for (column, x) in m.column_iter().zip(x) {
        out.iter_mut().zip(column.iter()).for_each(|(out, m)| *out += m * x);
    }
}

/// Most that a part with unit rate of change at the start, decaying at |λ| = `rate`, departs from
/// its chord within `time_s`.
fn chord(rate: f64, time_s: f64) -> f64 {
    (rate * time_s * time_s / 8.0).min(2.0 / rate)
}

/// `φ₁(z) = (e^z − 1)/z` and `φ₂(z) = (φ₁(z) − 1)/z`, exact to rounding from z = 0 on.
///
/// # Source
/// `[HochbruckOstermann2010, Section 2.1]`
pub(in crate::rig) fn phi(z: Complex64) -> [Complex64; 2] {
    let size = z.re.abs().max(z.im.abs());
    if size < SERIES {
        // φ₂ = Σ z^k/(k+2)!, and φ₁ = 1 + z·φ₂.
        let terms = if size < SHORT { TERMS / 2 } else { TERMS };
        let mut twice = Complex64::ZERO;
        for inverse in INVERSE_FACTORIALS[2..terms + 3].iter().rev() {
            twice = twice * z + inverse;
        }
        return [1.0 + z * twice, twice];
    }
    let (sin, cos) = z.im.sin_cos();
    let half = (0.5 * z.im).sin();
    let (grown, less) = (z.re.exp(), z.re.exp_m1());
    // e^z − 1 free of cancellation.
    let change = Complex64::new(less * cos - 2.0 * half * half, grown * sin);
    let once = change / z;
    [once, (once - 1.0) / z]
}

/// 1/k!.
const INVERSE_FACTORIALS: [f64; TERMS + 3] = {
    let mut all = [1.0; TERMS + 3];
    let mut k = 1;
    let mut factorial = 1.0;
    while k < all.len() {
        factorial *= k as f64;
        all[k] = 1.0 / factorial;
        k += 1;
    }
    all
};

/// Moves the states on by the parts' time under `torque`.
#[inline]
pub(in crate::rig) fn step(
    parts: &[ArmPart],
    y: &[[f64; 2]],
    torque: f64,
    next: &mut [[f64; 2]],
) -> Moved {
    let mut moved = Moved { watched: 0.0, sum: 0.0, stray: 0.0 };
    for ((p, y), next) in parts.iter().zip(y).zip(next) {
        let [a, b] = *y;
        let rate =
            |row: usize| a * p.rate[2 * row] + b * p.rate[2 * row + 1] + torque * p.gain[row];
        moved.stray += rate(0).abs() * p.stray[0] + rate(1).abs() * p.stray[1];
        moved.sum += a * p.sum[0] + b * p.sum[1];
        let turned = |row: usize| a * p.turn[2 * row] + b * p.turn[2 * row + 1];
        *next = [turned(0) + torque * p.push[0], turned(1) + torque * p.push[1]];
        moved.watched += next[0] * p.read[0] + next[1] * p.read[1];
    }
    moved
}

/// ∫ of what is watched per torque.
pub(in crate::rig) fn sum_push(parts: &[ArmPart]) -> f64 {
    parts.iter().map(|p| p.sum_push).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// φ₁ and φ₂ are exact to some roundings.
    const ROUNDING: f64 = 4e-16;

    #[test]
    fn phi_on_both_sides_of_its_branches() {
        // mpmath: phi1 and phi2 at z, 20 digits.
        let cases =
            [((0.0, 0.0), (1.0, 0.0), (0.5, 0.0)), PHI_SHORT, PHI_SERIES, PHI_CLOSED, PHI_FAR];
        for ((re, im), once, twice) in cases {
            let [a, b] = phi(Complex64::new(re, im));
            for (found, (re, im)) in [(a, once), (b, twice)] {
                let expected = Complex64::new(re, im);
                assert!(
                    (found - expected).norm() < ROUNDING * expected.norm(),
                    "{found} {expected}"
                );
            }
        }
    }

    type Case = ((f64, f64), (f64, f64), (f64, f64));
    const PHI_SHORT: Case = (
        (-0.01, 0.02),
        (0.994_950_457_744_328_8, 0.009_933_251_994_713_56),
        (0.498_320_924_901_967_17, 0.003_316_650_332_578_281_7),
    );
    const PHI_SERIES: Case = (
        (-0.1, 0.4),
        (0.927_076_881_114_356_6, 0.184_704_650_553_398_4),
        (0.477_495_130_058_374_74, 0.062_934_014_699_514_9),
    );
    const PHI_CLOSED: Case = (
        (-0.2, 1.1),
        (0.742_680_113_231_448, 0.436_446_257_514_268_85),
        (0.425_243_888_495_524_86, 0.156_610_099_154_042_73),
    );
    const PHI_FAR: Case = (
        (-3.0, 40.0),
        (0.002_848_660_451_908_674, 0.025_616_472_737_922_145),
        (0.002_496_030_409_049_82, 0.024_741_581_208_023_55),
    );
}
