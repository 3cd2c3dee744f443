//! The statics of (1)-(5): bending moments at the joints from deflections, by three moments.
//!
//! With M_j = EI·y″ at joint j (0 at the clamp, n at the tip), continuity of the slope at each
//! joint gives `R·M = D·y`: R is tridiagonal with a dominant diagonal, D takes second differences.
//! The stiffness against deflections is K = Dᵀ·R⁻¹·D. The entries of R⁻¹ and of D alternate in
//! sign like the squares of a chessboard, so that every sum here adds terms of one sign: each
//! entry is exact to a few roundings, however unlike the spans are. (The inverse of the
//! flexibility, the usual way, loses ten digits at 200 equal spans.)
//!
//! # Source
//! `[Feliu1989, eqs. (1)-(5)]`, eliminated as Clapeyron's theorem of three moments.

use nalgebra::DMatrix;

use super::Span;

/// Moments at the joints of a clamped beam whose tip is free, or turns with a payload.
#[derive(Debug, Clone)]
pub(super) struct ThreeMoment {
    length: Vec<f64>,
    rigidity: Vec<f64>,
    hub_radius: f64,
    /// Whether the tip's slope is given (unknown M_n) or its torque (M_n known).
    tip_slope: bool,
    /// R⁻¹.
    inverse: DMatrix<f64>,
}

impl ThreeMoment {
    pub(super) fn new(spans: &[Span], hub_radius: f64, tip_slope: bool) -> Self {
        let length: Vec<f64> = spans.iter().map(|s| s.length_m).collect();
        let rigidity: Vec<f64> = spans.iter().map(|s| s.flexural_rigidity_n_m2).collect();
        let n = length.len();
        let size = n + usize::from(tip_slope);
        let third = |i: usize| length[i] / (3.0 * rigidity[i]);
        let diagonal: Vec<f64> = (0..size)
            .map(|j| {
                let inner = if j > 0 { third(j - 1) } else { 0.0 };
                inner + if j < n { third(j) } else { 0.0 }
            })
            .collect();
        let beside: Vec<f64> = (1..size).map(|j| 0.5 * third(j - 1)).collect();
        let inverse = inverse_tridiagonal(&diagonal, &beside);
        Self { length, rigidity, hub_radius, tip_slope, inverse }
    }

    /// Number of joints whose moment is unknown.
    pub(super) fn len(&self) -> usize {
        self.inverse.nrows()
    }

    /// D: slopes' jumps at each joint per deflection y_1..y_n (and the tip's slope).
    fn difference(&self, j: usize, i: usize) -> f64 {
        let n = self.length.len();
        if i == n {
            // The tip's slope.
            return if j == n { 1.0 } else { 0.0 };
        }
        // Deflection y_{i+1} bounds spans i and i+1.
        let mut sum = 0.0;
        if j == i {
            sum += 1.0 / self.length[i];
        }
        if j == i + 1 {
            sum -= 1.0 / self.length[i];
            if i + 1 < n {
                sum -= 1.0 / self.length[i + 1];
            }
        }
        if i + 1 < n && j == i + 2 {
            sum += 1.0 / self.length[i + 1];
        }
        sum
    }

    /// `R⁻¹·D`, moments per deflection.
    pub(super) fn moments(&self) -> DMatrix<f64> {
        let size = self.len();
        let columns = self.length.len() + usize::from(self.tip_slope);
        DMatrix::from_fn(size, columns, |j, i| {
            let near = i..(i + 3).min(size);
            near.map(|k| self.inverse[(j, k)] * self.difference(k, i)).sum()
        })
    }

    /// K = Dᵀ·R⁻¹·D \[N/m\] (with the tip's slope \[N, N·m\]).
    pub(super) fn stiffness(&self) -> DMatrix<f64> {
        let moments = self.moments();
        let columns = moments.ncols();
        let upper = DMatrix::from_fn(columns, columns, |i, k| {
            if k < i {
                return 0.0;
            }
            let near = i..(i + 3).min(self.len());
            near.map(|j| self.difference(j, i) * moments[(j, k)]).sum::<f64>()
        });
        DMatrix::from_fn(columns, columns, |i, k| upper[(i.min(k), i.max(k))])
    }

    /// The moment about the motor's axis per moment at joints 0 and 1, which is also the jump of
    /// slopes that a turn of the motor makes there.
    fn lever(&self) -> [f64; 2] {
        let r = self.hub_radius / self.length[0];
        [1.0 + r, -r]
    }

    /// `R⁻¹·g`: moments per turn of all masses (and the tip) about the axis, the motor held.
    pub(super) fn turn(&self) -> Vec<f64> {
        let [g0, g1] = self.lever();
        (0..self.len())
            .map(|j| {
                let second = if self.len() > 1 { g1 * self.inverse[(j, 1)] } else { 0.0 };
                g0 * self.inverse[(j, 0)] + second
            })
            .collect()
    }

    /// `gᵀ·v`: the moment about the motor's axis of moments `v` at the joints, `tip` that at joint
    /// n where it is known.
    pub(super) fn about_axis(&self, v: &[f64], tip: f64) -> f64 {
        let [g0, g1] = self.lever();
        g0 * v[0] + g1 * v.get(1).copied().unwrap_or(tip)
    }

    /// `Dᵀ·v`, per deflection.
    pub(super) fn forces(&self, v: &[f64]) -> Vec<f64> {
        let columns = self.length.len() + usize::from(self.tip_slope);
        (0..columns)
            .map(|i| {
                let near = i..(i + 3).min(self.len());
                near.map(|j| self.difference(j, i) * v[j]).sum()
            })
            .collect()
    }

    /// Moments at the joints 0 to n−1 per torque T_n at a tip whose slope is free.
    pub(super) fn tip_torque(&self) -> Vec<f64> {
        let n = self.length.len();
        let sixth = self.length[n - 1] / (6.0 * self.rigidity[n - 1]);
        (0..n).map(|j| -self.inverse[(j, n - 1)] * sixth).collect()
    }
}

/// Inverse of a symmetric tridiagonal matrix with a dominant positive diagonal.
fn inverse_tridiagonal(diagonal: &[f64], beside: &[f64]) -> DMatrix<f64> {
    let n = diagonal.len();
    // Pivots from both ends; entry (i, j), i ≤ j, is that of (j, j) times −b/pivot steps.
    let mut left = diagonal.to_vec();
    for i in 1..n {
        left[i] -= beside[i - 1] * beside[i - 1] / left[i - 1];
    }
    let mut right = diagonal.to_vec();
    for i in (0..n - 1).rev() {
        right[i] -= beside[i] * beside[i] / right[i + 1];
    }
    let mut inverse = DMatrix::zeros(n, n);
    for j in 0..n {
        // Of the three ways to write the pivot of (j, j) this one has a single subtraction.
        let tail = if j + 1 < n { beside[j] * beside[j] / right[j + 1] } else { 0.0 };
        inverse[(j, j)] = 1.0 / (left[j] - tail);
        for i in (0..j).rev() {
            inverse[(i, j)] = -beside[i] / left[i] * inverse[(i + 1, j)];
        }
        for i in 0..j {
            inverse[(j, i)] = inverse[(i, j)];
        }
    }
    inverse
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_inverse_of_a_tridiagonal_matrix() {
        let (d, b) = ([4.0, 5.0, 3.0], [1.0, 0.5]);
        let full = DMatrix::from_row_slice(3, 3, &[4.0, 1.0, 0.0, 1.0, 5.0, 0.5, 0.0, 0.5, 3.0]);
        let product = full * inverse_tridiagonal(&d, &b);
        assert!((product - DMatrix::identity(3, 3)).abs().max() < 1e-15);
    }
}
