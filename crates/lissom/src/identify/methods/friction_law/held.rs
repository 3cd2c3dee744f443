//! How well a law describes what it was not found from.

use nalgebra::{DMatrix, DVector};

use crate::identify::methods::friction_law::rows::{KINDS, PhaseBlock};
use crate::identify::methods::regression::{Cluster, Term, solve};

/// Phases are dealt to this many folds.
const FOLDS: usize = 5;

/// Squared residuals on what was left out.
pub(super) struct Held {
    /// Of each block, with its phase left out.
    pub(super) each: Vec<f64>,
    /// Sum, with each kind of stretch left out.
    pub(super) stretches: f64,
}

impl Held {
    pub(super) fn of(blocks: &[PhaseBlock], terms: &[Term]) -> Option<Self> {
        let each = left_out(blocks, terms, FOLDS, |b| b.phase % FOLDS)?;
        let stretches = left_out(blocks, terms, KINDS, |b| b.kind)?.iter().sum();
        Some(Self { each, stretches })
    }

    pub(super) fn phases(&self) -> f64 {
        self.each.iter().sum()
    }

    /// By how many deviations `other` is better, block by block.
    pub(super) fn paired(&self, other: &Self) -> f64 {
        let n = self.each.len() as f64;
        let better: Vec<f64> = self.each.iter().zip(&other.each).map(|(a, b)| a - b).collect();
        let mean = better.iter().sum::<f64>() / n;
        let square: f64 = better.iter().map(|b| (b - mean).powi(2)).sum();
        mean / (square / (n * (n - 1.0))).sqrt().max(f64::MIN_POSITIVE)
    }
}

/// Squared residual of every block with the figures of the groups that it is not in.
fn left_out(
    blocks: &[PhaseBlock],
    terms: &[Term],
    groups: usize,
    group: impl Fn(&PhaseBlock) -> usize,
) -> Option<Vec<f64>> {
    let figures = without_each(blocks, terms, groups, &group)?;
    let cost = |b: &PhaseBlock| {
        let value = figures[group(b)].as_ref();
        value.map_or(0.0, |v| squared(&b.cluster.products, terms, v, b.cluster.sign))
    };
    Some(blocks.iter().map(cost).collect())
}

/// Figures with one group of blocks after another left out; `None` of groups without blocks.
pub(super) fn without_each(
    blocks: &[PhaseBlock],
    terms: &[Term],
    groups: usize,
    group: impl Fn(&PhaseBlock) -> usize,
) -> Option<Vec<Option<DVector<f64>>>> {
    let width = blocks.first()?.cluster.products.ncols();
    let empty = || [1.0, -1.0].map(|sign| Cluster::new(0, sign, width));
    let mut sums: Vec<[Cluster; 2]> = vec![empty(); groups];
    let mut all = empty();
    for b in blocks {
        let side = usize::from(b.cluster.sign < 0.0);
        sums[group(b)][side].merge(&b.cluster);
        all[side].merge(&b.cluster);
    }
    let without = |own: &[Cluster; 2]| {
        let mut others = all.clone();
        for (others, own) in others.iter_mut().zip(own) {
            others.products -= &own.products;
            others.noise -= &own.noise;
            others.rows -= own.rows;
        }
        Some(solve(&others, terms)?.value)
    };
    let one = |own: &[Cluster; 2]| {
        let rows: usize = own.iter().map(|c| c.rows).sum();
        if rows == 0 { Some(None) } else { without(own).map(Some) }
    };
    sums.iter().map(one).collect()
}

/// ‖y − X·q‖² from the products of a block.
fn squared(products: &DMatrix<f64>, terms: &[Term], value: &DVector<f64>, sign: f64) -> f64 {
    let right = products.ncols() - 1;
    let mut q = DVector::zeros(products.ncols());
    for (t, v) in terms.iter().zip(value.iter()) {
        q[t.column()] += t.factor(sign) * v;
    }
    q[right] = -1.0;
    q.dot(&(products * &q)).max(0.0)
}
