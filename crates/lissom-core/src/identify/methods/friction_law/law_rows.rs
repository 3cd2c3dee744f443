//! The windows' rows by slip phase and kind of stretch, and least squares of them.
#![expect(clippy::inline_always, reason = "compiled for wide registers as one")]

use std::ops::Range;
use std::sync::Arc;

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use crate::identify::methods::friction_law::law_term::Column;
use crate::identify::methods::friction_law::rows::{Cut, Sampled, WindowPlace};
use crate::identify::methods::regression::{
    Cluster, NormalSums, ScoredEstimates, Scores, Solution, Term, solve_sums,
};

/// Kinds of stretches.
pub(super) const KINDS: usize = 12;
/// Phases are dealt to this many folds.
pub(super) const FOLDS: usize = 5;

/// Rows that are copied one after the other.
const PART: usize = 1024;

/// Phases whose scores are found one after the other.
const PHASES_TOGETHER: usize = 64;

/// Windows of one slip phase that are of one kind.
#[derive(Debug, Clone)]
pub(super) struct PhaseBlock {
    run: usize,
    pub(super) sign: f64,
    /// Number of the phase.
    pub(super) phase: usize,
    /// Direction × third of the speeds × half of the travel.
    pub(super) kind: usize,
    rows: Range<usize>,
}

impl PhaseBlock {
    pub(super) fn fold(&self) -> usize {
        self.phase % FOLDS
    }
}

/// Rows of windows in order of their blocks, and sums of these.
#[derive(Debug, Clone)]
pub(super) struct LawRows {
    frame: Arc<Frame>,
    width: usize,
    values: Vec<f64>,
    /// Sums by fold and kind.
    classes: Vec<Cluster>,
}

/// What rows of the same windows have in common.
#[derive(Debug)]
struct Frame {
    blocks: Vec<PhaseBlock>,
    /// Where each row is in the sampled windows.
    order: Vec<usize>,
    /// What the sensors' noise adds to the products of a row of each run, in its first columns.
    noise: Vec<DMatrix<f64>>,
}

impl LawRows {
    pub(super) fn of(sampled: &Sampled<'_>, columns: &[Column], knots: &[f64], cut: &Cut) -> Self {
        let table = sampled.rows(columns, knots);
        let (blocks, order) = in_blocks(table.places, cut);
        let values = filled(order.len(), table.width, |at, row| table.row(order[at]).copy_to(row));
        let runs = 0..sampled.campaign.runs.len();
        let noise = runs.map(|run| sampled.noise_of_row(run).clone()).collect();
        let frame = Arc::new(Frame { blocks, order, noise });
        Self::with_values(frame, table.width, values)
    }

    /// The same with further columns, before the right side.
    pub(super) fn with_columns(&self, sampled: &Sampled<'_>, columns: &[Column]) -> Self {
        let further = sampled.columns(columns, &[]);
        let (own, width) = (self.width - 1, self.width + columns.len());
        let values = filled(self.frame.order.len(), width, |at, longer| {
            let row = self.row(at);
            longer[..own].copy_from_slice(&row[..own]);
            longer[own..width - 1].copy_from_slice(further.row(self.frame.order[at]));
            longer[width - 1] = row[own];
        });
        Self::with_values(Arc::clone(&self.frame), width, values)
    }

    /// The columns `kept` with further ones, before the right side.
    pub(super) fn narrowed(
        &self,
        sampled: &Sampled<'_>,
        kept: &[usize],
        columns: &[Column],
    ) -> Self {
        let further = sampled.columns(columns, &[]);
        let width = kept.len() + columns.len() + 1;
        let values = filled(self.frame.order.len(), width, |at, narrow| {
            let row = self.row(at);
            for (value, column) in narrow.iter_mut().zip(kept) {
                *value = row[*column];
            }
            narrow[kept.len()..width - 1].copy_from_slice(further.row(self.frame.order[at]));
            narrow[width - 1] = row[self.width - 1];
        });
        Self::with_values(Arc::clone(&self.frame), width, values)
    }

    /// The same with some columns as others of the same windows have them: `(place, other)`.
    pub(super) fn exchanged(&self, others: &Self, exchanged: &[(usize, usize)]) -> Self {
        let values = filled(self.frame.order.len(), self.width, |at, row| {
            row.copy_from_slice(self.row(at));
            for (place, other) in exchanged {
                row[*place] = others.row(at)[*other];
            }
        });
        Self::with_values(Arc::clone(&self.frame), self.width, values)
    }

    fn with_values(frame: Arc<Frame>, width: usize, values: Vec<f64>) -> Self {
        let mut found = Self { frame, width, values, classes: Vec::new() };
        found.classes = found.class_sums();
        found
    }

    fn row(&self, at: usize) -> &[f64] {
        &self.values[at * self.width..(at + 1) * self.width]
    }

    /// What every sampled window, in the order of these, leaves of its right side.
    pub(super) fn left(&self, terms: &[Term], value: &DVector<f64>) -> Vec<f64> {
        let mut found = vec![0.0; self.frame.order.len()];
        for block in self.blocks() {
            let taken = weights(terms, value, block.sign);
            let order = &self.frame.order[block.rows.clone()];
            for (row, window) in self.rows(block).zip(order) {
                found[*window] = left(row, &taken);
            }
        }
        found
    }

    /// Least squares with a covariance by phases.
    pub(super) fn solved(&self, terms: &[Term]) -> Option<Solution> {
        let sums = NormalSums::of(&self.classes, terms)?;
        solve_sums(&sums, |estimates| self.scores(terms, estimates))
    }

    /// ‖y − X·q‖/‖y‖ of [`Self::solved`].
    pub(super) fn relative_residual(&self, terms: &[Term]) -> Option<f64> {
        NormalSums::of(&self.classes, terms)?.relative_residual()
    }

    pub(super) fn blocks(&self) -> &[PhaseBlock] {
        &self.frame.blocks
    }

    /// Sums of the blocks of each group.
    pub(super) fn sums(&self, groups: usize, group: impl Fn(&PhaseBlock) -> usize) -> Vec<Cluster> {
        let blocks = self.blocks().iter().map(|block| (group(block), block));
        self.group_sums(groups, blocks.collect())
    }

    /// Sums of each group of blocks, of which the groups' numbers are given.
    fn group_sums(&self, groups: usize, mut blocks: Vec<(usize, &PhaseBlock)>) -> Vec<Cluster> {
        blocks.sort_by_key(|(group, _)| *group);
        pulp::Arch::new().dispatch(Sums { rows: self, blocks: &blocks, groups })
    }

    fn class_sums(&self) -> Vec<Cluster> {
        let of_fold = |fold: usize| {
            let blocks = self.blocks().iter().filter(|b| b.fold() == fold);
            self.group_sums(KINDS, blocks.map(|block| (block.kind, block)).collect())
        };
        (0..FOLDS).into_par_iter().flat_map_iter(of_fold).collect()
    }

    /// Sums by fold and kind: those of fold f and kind k are number `f·KINDS + k`.
    pub(super) fn classes(&self) -> &[Cluster] {
        &self.classes
    }

    /// ‖y − X·q‖² of a block, of whose columns X·q takes so much.
    pub(super) fn squared(&self, block: &PhaseBlock, taken: &[(usize, f64)]) -> f64 {
        self.rows(block).map(|row| left(row, taken).powi(2)).sum()
    }

    /// The same with some columns, times what is known of them, taken off the right side.
    pub(super) fn without(&self, known: &[(usize, f64)]) -> Self {
        let mut found = self.clone();
        let right = self.width - 1;
        for row in found.values.chunks_exact_mut(self.width) {
            row[right] -= known.iter().map(|(column, value)| row[*column] * value).sum::<f64>();
        }
        found.classes = found.class_sums();
        found
    }

    #[inline(always)]
    fn rows(&self, block: &PhaseBlock) -> impl Iterator<Item = &[f64]> {
        let Range { start, end } = block.rows;
        self.values[start * self.width..end * self.width].chunks_exact(self.width)
    }

    /// Scores by phase.
    fn scores(&self, terms: &[Term], estimates: &ScoredEstimates) -> Scores {
        let p = terms.len();
        let sides = [-1.0, 1.0].map(|sign| {
            let factors: Vec<(usize, f64)> =
                terms.iter().map(|t| (t.column(), t.factor(sign))).collect();
            let of_noise: Vec<DVector<f64>> =
                self.frame.noise.iter().map(|noise| of_noise(noise, &factors, estimates)).collect();
            (weights(terms, &estimates.value, sign), factors, of_noise)
        });
        let phases: Vec<&[PhaseBlock]> =
            self.blocks().chunk_by(|a, b| a.phase == b.phase).collect();
        let mut by_cluster = DMatrix::zeros(p, phases.len());
        let columns = by_cluster.as_mut_slice().par_chunks_mut(p);
        let of_phase = |(score, blocks): (&mut [f64], &&[PhaseBlock])| {
            let (run, sign) = (blocks[0].run, blocks[0].sign);
            let (taken, factors, of_noise) = &sides[usize::from(sign > 0.0)];
            let mut count = 0.0;
            for row in blocks.iter().flat_map(|block| self.rows(block)) {
                let left = left(row, taken);
                for (score, (column, factor)) in score.iter_mut().zip(factors) {
                    *score += factor * row[*column] * left;
                }
                count += 1.0;
            }
            let of_noise = of_noise[run].iter();
            score.iter_mut().zip(of_noise).for_each(|(score, noise)| *score += count * noise);
        };
        columns.zip(&phases).with_min_len(PHASES_TOGETHER).for_each(of_phase);
        let mut by_run = DMatrix::zeros(p, self.frame.noise.len());
        for (blocks, score) in phases.iter().zip(by_cluster.column_iter()) {
            let mut of_run = by_run.column_mut(blocks[0].run);
            of_run += score;
        }
        Scores { by_cluster, by_run, normals: Vec::new() }
    }
}

/// Sums of some blocks by their groups, compiled for the widest registers that there are.
struct Sums<'a> {
    rows: &'a LawRows,
    /// Group and block, ascending in the group.
    blocks: &'a [(usize, &'a PhaseBlock)],
    groups: usize,
}

impl pulp::WithSimd for Sums<'_> {
    type Output = Vec<Cluster>;

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) -> Vec<Cluster> {
        let Self { rows, blocks, groups } = self;
        let width = rows.width;
        let mut sums = vec![Cluster::new(0, 0.0, width); groups];
        let none = vec![0.0; width];
        for of_group in blocks.chunk_by(|(a, _), (b, _)| a == b) {
            let sum = &mut sums[of_group[0].0];
            for (_, block) in of_group {
                (sum.sign, sum.rows) = (block.sign, sum.rows + block.rows.len());
                let of_row = &rows.frame.noise[block.run];
                let own = of_row.nrows();
                let mut noise = sum.noise.view_mut((0, 0), (own, own));
                noise.zip_apply(of_row, |sum, of_row| *sum += of_row * block.rows.len() as f64);
            }
            let products = sum.products.as_mut_slice();
            let mut rows = of_group.iter().flat_map(|(_, block)| rows.rows(block));
            while let Some(first) = rows.next() {
                let [b, c, d] = [rows.next(), rows.next(), rows.next()];
                let others = [b, c, d].map(|row| row.unwrap_or(&none));
                add_products(products, first, others);
            }
        }
        for sum in &mut sums {
            sum.products.fill_upper_triangle_with_lower_triangle();
        }
        sums
    }
}

/// Adds the products of four rows at once to the lower triangle of a sum, column by column.
#[inline(always)]
fn add_products(products: &mut [f64], a: &[f64], [b, c, d]: [&[f64]; 3]) {
    for (i, column) in products.chunks_exact_mut(a.len()).enumerate() {
        let [by_a, by_b, by_c, by_d] = [a[i], b[i], c[i], d[i]];
        let rows = a[i..].iter().zip(&b[i..]).zip(&c[i..]).zip(&d[i..]);
        for (sum, (((a, b), c), d)) in column[i..].iter_mut().zip(rows) {
            // In the order of the rows, as if they were added one by one.
            *sum = *sum + by_a * a + by_b * b + by_c * c + by_d * d;
        }
    }
}

/// A table of rows, each filled with `fill`.
fn filled(rows: usize, width: usize, fill: impl Fn(usize, &mut [f64]) + Sync) -> Vec<f64> {
    let mut values = vec![0.0; rows * width];
    let parts = values.par_chunks_mut(PART * width).enumerate();
    parts.for_each(|(part, values)| {
        let rows = values.chunks_exact_mut(width).enumerate();
        rows.for_each(|(i, row)| fill(part * PART + i, row));
    });
    values
}

/// The blocks of windows in these places, and the numbers of the rows in their order.
fn in_blocks(places: &[WindowPlace], cut: &Cut) -> (Vec<PhaseBlock>, Vec<usize>) {
    let mut blocks: Vec<PhaseBlock> = Vec::new();
    let mut first_of_phase = 0;
    let mut placed: Vec<(usize, usize)> = Vec::with_capacity(places.len());
    for (i, place) in places.iter().enumerate() {
        let kind = cut.kind(place);
        if blocks.last().is_some_and(|b| b.phase != place.phase) {
            first_of_phase = blocks.len();
        }
        let same = blocks[first_of_phase..].iter().position(|b| b.kind == kind);
        let at = same.map_or(blocks.len(), |i| first_of_phase + i);
        if at == blocks.len() {
            let (run, sign, phase) = (place.run, place.sign, place.phase);
            blocks.push(PhaseBlock { run, sign, phase, kind, rows: 0..0 });
        }
        blocks[at].rows.end += 1;
        placed.push((at, i));
    }
    let mut first = 0;
    for block in &mut blocks {
        block.rows = first..first + block.rows.end;
        first = block.rows.end;
    }
    placed.sort_by_key(|(block, _)| *block);
    (blocks, placed.into_iter().map(|(_, row)| row).collect())
}

/// What terms take of each column in a direction.
pub(super) fn weights(terms: &[Term], value: &DVector<f64>, sign: f64) -> Vec<(usize, f64)> {
    terms.iter().zip(value).map(|(t, v)| (t.column(), t.factor(sign) * v)).collect()
}

/// What a row leaves of its right side.
fn left(row: &[f64], taken: &[(usize, f64)]) -> f64 {
    row[row.len() - 1] - taken.iter().map(|(column, weight)| row[*column] * weight).sum::<f64>()
}

/// What the noise of a row adds to the score of its phase.
fn of_noise(
    noise: &DMatrix<f64>,
    factors: &[(usize, f64)],
    estimates: &ScoredEstimates,
) -> DVector<f64> {
    let own = |(column, _): &&(usize, f64)| *column < noise.ncols();
    let with = |(i, factor): (usize, f64)| -> f64 {
        let of =
            |((j, other), taken): (&(usize, f64), &f64)| noise[(i, *j)] * other * factor * taken;
        let columns = factors.iter().zip(estimates.taken.iter());
        columns.filter(|(column, _)| own(column)).map(of).sum()
    };
    let each = factors.iter().map(|of| if own(&of) { with(*of) } else { 0.0 });
    &estimates.out * DVector::from_iterator(factors.len(), each)
}
