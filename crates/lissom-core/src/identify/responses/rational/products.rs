//! Products of tall matrices.

#![expect(clippy::inline_always, reason = "compiled for wide registers as one")]

use nalgebra::DMatrix;
use pulp::{Arch, Simd, WithSimd};

/// Columns multiplied by columns at a time: their sums stay in registers.
const TILE: usize = 3;
/// Rows taken at a time: a tile's columns stay in the nearest cache beside all others'.
const BLOCK: usize = 512;

/// `Aᵀ·A` of the matrix whose columns of `rows` each stand one after another.
///
/// One half is multiplied and no column copied, where `gemm` multiplies both halves and packs the columns before:
/// of few columns that takes longer (`evidence/rational` has the times of whole fits). Nor has it transposed views,
/// of which `gemm` reads beyond the last column where there are five or fewer (nalgebra 0.34.2).
pub(super) fn products(a: &[f64], rows: usize) -> DMatrix<f64> {
    let columns: Vec<&[f64]> = a.chunks_exact(rows).collect();
    let mut sums = DMatrix::zeros(columns.len(), columns.len());
    Arch::new().dispatch(Adding { columns: &columns, sums: &mut sums });
    sums.fill_lower_triangle_with_upper_triangle();
    sums
}

/// Adds the products of columns to the upper triangle of their sums.
struct Adding<'a> {
    columns: &'a [&'a [f64]],
    sums: &'a mut DMatrix<f64>,
}

impl WithSimd for Adding<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let (columns, sums) = (self.columns, self.sums);
        let count = columns.len();
        let rows = columns.first().map_or(0, |c| c.len());
        for first in (0..rows).step_by(BLOCK) {
            // Beyond the last column stands the last.
            let tile = |place: usize| -> [&[f64]; TILE] {
                let column = |i: usize| columns[(place + i).min(count - 1)];
                std::array::from_fn(|i| &column(i)[first..rows.min(first + BLOCK)])
            };
            for right in (0..count).step_by(TILE) {
                for left in (0..=right).step_by(TILE) {
                    let found = across(simd, tile(left), tile(right));
                    for (i, row) in (left..count).zip(found) {
                        for (j, product) in (right..count).zip(row) {
                            sums[(i, j)] += product;
                        }
                    }
                }
            }
        }
    }
}

/// Products of each of some columns with each of others.
#[inline(always)]
fn across<S: Simd>(simd: S, left: [&[f64]; TILE], right: [&[f64]; TILE]) -> [[f64; TILE]; TILE] {
    let (left, right) = (left.map(S::as_simd_f64s), right.map(S::as_simd_f64s));
    let whole = left[0].0.len();
    let (a, b) = (left.map(|c| &c.0[..whole]), right.map(|c| &c.0[..whole]));
    let mut sums = [[simd.splat_f64s(0.0); TILE]; TILE];
    for k in 0..whole {
        for i in 0..TILE {
            for j in 0..TILE {
                sums[i][j] = simd.mul_add_e_f64s(a[i][k], b[j][k], sums[i][j]);
            }
        }
    }
    let rest =
        |i: usize, j: usize| -> f64 { left[i].1.iter().zip(right[j].1).map(|(a, b)| a * b).sum() };
    std::array::from_fn(|i| std::array::from_fn(|j| simd.reduce_sum_f64s(sums[i][j]) + rest(i, j)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn they_are_those_of_the_transposed_matrix() {
        for (rows, columns) in [(7, 6), (400, 3), (4, 7), (1, 1), (513, 2), (600, 41)] {
            let a = DMatrix::from_fn(rows, columns, |i, j| (0.7 * i as f64 + 1.3 * j as f64).sin());
            let found = products(a.as_slice(), rows);
            assert!((found - a.transpose() * &a).amax() < 1e-12 * rows as f64);
        }
    }
}
