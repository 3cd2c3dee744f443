//! The windows' rows in blocks of neighbouring strokes, and sums of their products by block and kind of motion.

use std::ops::Range;

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use crate::identify::methods::friction_law::law_term::Column;
use crate::identify::methods::friction_law::rows::{Cut, Sampled};
use crate::identify::methods::regression::thresholds::{BLOCKS_WANTED, FEW_CLUSTERS, FEW_PHASES};
use crate::identify::methods::regression::{
    MotorColumns, NormalSums, PLACE_COULOMB, ScoredEstimates, Scores, Solution, solve_sums,
    values_of,
};

/// Most blocks: with more, neighbouring strokes share one from the beginning.
const MOST_BLOCKS: usize = 96;

/// In which direction of motion a regressor acts, and with which sign.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Acts {
    /// In both directions alike, as a load does.
    Alike,
    /// Against the motion, as friction does.
    Against,
    /// Forward only.
    Forward,
    /// Backward only.
    Backward,
}

impl Acts {
    fn factor(self, sign: f64) -> f64 {
        match self {
            Self::Alike => 1.0,
            Self::Against => sign,
            Self::Forward => f64::from(sign > 0.0),
            Self::Backward => f64::from(sign < 0.0),
        }
    }
}

/// A regressor beyond those of the line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Regressor {
    /// `∫w·f` of a function of speed, angle or command.
    Function(Column, Acts),
    /// A column of the motor's equation.
    Own(usize, Acts),
    /// A column of the motor's equation times the time since the middle of the campaign, as a share of the campaign.
    Drift(usize, Acts),
    /// Size of the torque, as the line gives it: that of the log has its noise.
    Size(Acts),
}

/// Windows of one block and one kind of motion.
#[derive(Debug, Clone)]
pub(super) struct Unit {
    pub(super) run: usize,
    pub(super) block: usize,
    /// Direction × third of the speeds × half of the travel.
    pub(super) kind: usize,
    rows: Range<usize>,
    gram: Gram,
}

/// Products of columns, the right side last, and what noise of the sensors adds to them in expectation.
#[derive(Debug, Clone)]
pub(super) struct Gram {
    products: DMatrix<f64>,
    noise: DMatrix<f64>,
    rows: usize,
}

impl Gram {
    pub(super) fn zeros(width: usize) -> Self {
        let zeros = DMatrix::zeros(width, width);
        Self { products: zeros.clone(), noise: zeros, rows: 0 }
    }

    pub(super) fn add(&mut self, other: &Self) {
        self.products += &other.products;
        self.noise += &other.noise;
        self.rows += other.rows;
    }

    /// Without the rows of a part of it.
    pub(super) fn without(&self, part: &Self) -> Self {
        Self {
            products: &self.products - &part.products,
            noise: &self.noise - &part.noise,
            rows: self.rows - part.rows,
        }
    }

    /// Normal equations of some columns.
    fn sums(&self, columns: &[usize]) -> Option<NormalSums> {
        let p = columns.len();
        let last = self.products.ncols() - 1;
        let of = |m: &DMatrix<f64>| DMatrix::from_fn(p, p, |i, j| m[(columns[i], columns[j])]);
        let with_right = |m: &DMatrix<f64>| DVector::from_fn(p, |i, _| m[(columns[i], last)]);
        // What noise adds to the products with the right side is taken out of these at once.
        let right = with_right(&self.products) - with_right(&self.noise);
        let power = self.products[(last, last)];
        NormalSums::new(of(&self.products), of(&self.noise), right, power, self.rows)
    }

    /// Least squares of some columns.
    pub(super) fn values(&self, columns: &[usize]) -> Option<DVector<f64>> {
        values_of(&self.sums(columns)?)
    }

    /// ‖y − X·q‖² beyond the noise that the sensors add to it in expectation.
    pub(super) fn squared(&self, columns: &[usize], value: &DVector<f64>) -> f64 {
        self.left(columns, value, 1.0)
    }

    /// ‖y − X·q‖².
    pub(super) fn squared_with_noise(&self, columns: &[usize], value: &DVector<f64>) -> f64 {
        self.left(columns, value, 0.0)
    }

    /// ‖y − X·q‖² less a multiple of what noise adds to it.
    fn left(&self, columns: &[usize], value: &DVector<f64>, noise: f64) -> f64 {
        let last = self.products.ncols() - 1;
        let of = |i: usize, j: usize| self.products[(i, j)] - noise * self.noise[(i, j)];
        let mut sum = of(last, last);
        for (i, a) in columns.iter().zip(value) {
            sum -= 2.0 * a * of(*i, last);
            sum += columns.iter().zip(value).map(|(j, b)| a * b * of(*i, *j)).sum::<f64>();
        }
        sum
    }

    /// With some columns, times what is known of them, taken off the right side.
    pub(super) fn less(&self, known: &[(usize, f64)]) -> Self {
        let right = self.products.ncols() - 1;
        let mut taken = DMatrix::identity(right + 1, right + 1);
        for (column, value) in known {
            taken[(*column, right)] = -value;
        }
        let of = |sums: &DMatrix<f64>| taken.transpose() * sums * &taken;
        Self { products: of(&self.products), noise: of(&self.noise), rows: self.rows }
    }

    /// Σ y².
    pub(super) fn power(&self) -> f64 {
        let last = self.products.ncols() - 1;
        self.products[(last, last)]
    }

    /// Number of rows.
    pub(super) fn rows(&self) -> usize {
        self.rows
    }
}

/// Rows of windows in order of their units, column by column.
#[derive(Debug, Clone)]
pub(super) struct BlockRows {
    columns: Vec<Vec<f64>>,
    right: Vec<f64>,
    pub(super) units: Vec<Unit>,
    /// Number of blocks; they are in the order of time, run after run.
    pub(super) blocks: usize,
    /// Where each row is among the sampled windows.
    order: Vec<usize>,
    signs: Vec<f64>,
    /// Where the noise of each column comes from: a column of a row's noise, and how it acts.
    noisy: Vec<Option<(usize, Acts)>>,
}

impl BlockRows {
    /// The columns of the line: J, V, C, offset, κ_i, g_s, g_c.
    pub(super) fn of(sampled: &Sampled<'_>, cut: &Cut) -> Self {
        let (units, order, blocks) = units(sampled, cut);
        let signs: Vec<f64> = order.iter().map(|&i| sampled.places()[i].sign).collect();
        let own = MotorColumns::of(sampled.campaign).count();
        let equation = sampled.equation_rows();
        let right = order.iter().map(|&i| equation[i * (own + 1) + own]).collect();
        let (columns, noisy) = (Vec::new(), Vec::new());
        let mut found = Self { columns, right, units, blocks, order, signs, noisy };
        let mut line: Vec<_> = (0..own).map(|i| Regressor::Own(i, Acts::Alike)).collect();
        line.insert(PLACE_COULOMB, Regressor::Own(PLACE_COULOMB, Acts::Against));
        found.add(sampled, &line, &[]);
        found
    }

    /// Number of columns.
    pub(super) fn width(&self) -> usize {
        self.columns.len()
    }

    /// Adds columns, and their products; hats over speed have these `knots`.
    pub(super) fn add(&mut self, sampled: &Sampled<'_>, further: &[Regressor], knots: &[f64]) {
        let function = |r: &Regressor| match r {
            Regressor::Function(column, _) => Some(*column),
            _ => None,
        };
        let functions: Vec<Column> = further.iter().filter_map(function).collect();
        let values = sampled.columns(&functions, knots);
        let equation = sampled.equation_rows();
        let lag = MotorColumns::of(sampled.campaign).count();
        let own = |window: usize, column: usize| equation[window * (lag + 1) + column];
        let sizes = self.sizes(lag + 1, further);
        let mut place = 0;
        for regressor in further {
            let at_row = |at: usize, i: usize, acts: Acts| -> f64 {
                acts.factor(self.signs[at])
                    * match *regressor {
                        Regressor::Function(..) => values.row(i)[place],
                        Regressor::Own(column, _) => own(i, column),
                        Regressor::Drift(column, _) => sampled.elapsed(i) * own(i, column),
                        Regressor::Size(_) => sizes[at],
                    }
            };
            let (acts, source) = match *regressor {
                Regressor::Function(column, acts) => (acts, (column == Column::Lag).then_some(lag)),
                Regressor::Own(column, acts) => (acts, Some(column)),
                Regressor::Drift(_, acts) | Regressor::Size(acts) => (acts, None),
            };
            let rows = self.order.iter().enumerate();
            self.columns.push(rows.map(|(at, &i)| at_row(at, i, acts)).collect());
            self.noisy.push(source.map(|column| (column, acts)));
            place += usize::from(function(regressor).is_some());
        }
        self.sum(sampled);
    }

    /// Size of the torque that the line of `width` columns gives in each row; empty if no regressor needs it.
    fn sizes(&self, width: usize, further: &[Regressor]) -> Vec<f64> {
        let line: Vec<usize> = (0..width).collect();
        let needed = further.iter().any(|r| matches!(r, Regressor::Size(_)));
        let value = needed.then(|| self.total().values(&line)).flatten();
        let of = |at: usize, value: &DVector<f64>| -> f64 {
            line.iter().zip(value).map(|(c, v)| self.columns[*c][at] * v).sum::<f64>().abs()
        };
        let rows = 0..self.right.len();
        rows.map(|at| value.as_ref().map_or(0.0, |value| of(at, value))).collect()
    }

    /// Drops the columns from `width` on.
    pub(super) fn truncate(&mut self, sampled: &Sampled<'_>, width: usize) {
        self.columns.truncate(width);
        self.noisy.truncate(width);
        self.sum(sampled);
    }

    fn sum(&mut self, sampled: &Sampled<'_>) {
        let Self { columns, right, noisy, signs, .. } = &*self;
        let all: Vec<&[f64]> = columns.iter().chain([right]).map(Vec::as_slice).collect();
        let grams: Vec<Gram> = self
            .units
            .par_iter()
            .map(|unit| {
                let known = &unit.gram;
                let range = unit.rows.clone();
                let old = known.products.ncols().saturating_sub(1).min(columns.len());
                let last = all.len() - 1;
                let place = |i: usize| if i == last { known.products.ncols() - 1 } else { i };
                let is_known = |i: usize| known.rows > 0 && (i < old || i == last);
                let mut products = DMatrix::zeros(all.len(), all.len());
                for i in 0..all.len() {
                    for j in 0..=i {
                        let value = if is_known(i) && is_known(j) {
                            known.products[(place(i), place(j))]
                        } else {
                            dot(&all[i][range.clone()], &all[j][range.clone()])
                        };
                        (products[(i, j)], products[(j, i)]) = (value, value);
                    }
                }
                let of_row = sampled.noise_of_row(unit.run);
                let sign = signs[range.start];
                let source = |i: usize| match noisy.get(i) {
                    Some(source) => source.map(|(c, acts)| (c, acts.factor(sign))),
                    None => Some((of_row.ncols() - 1, 1.0)),
                };
                let noise = DMatrix::from_fn(all.len(), all.len(), |i, j| {
                    let both = source(i).zip(source(j));
                    both.map_or(0.0, |((a, f), (b, g))| f * g * of_row[(a, b)] * range.len() as f64)
                });
                Gram { products, noise, rows: range.len() }
            })
            .collect();
        for (unit, gram) in self.units.iter_mut().zip(grams) {
            unit.gram = gram;
        }
    }

    /// Sums of the units of each group; units of no group are left out.
    pub(super) fn groups(
        &self,
        groups: usize,
        group: impl Fn(&Unit) -> Option<usize>,
    ) -> Vec<Gram> {
        let mut sums = vec![Gram::zeros(self.width() + 1); groups];
        for unit in &self.units {
            if let Some(group) = group(unit) {
                sums[group].add(&unit.gram);
            }
        }
        sums
    }

    /// Sums of all rows.
    pub(super) fn total(&self) -> Gram {
        let mut sum = Gram::zeros(self.width() + 1);
        self.units.iter().for_each(|unit| sum.add(&unit.gram));
        sum
    }

    /// Least squares of some columns, with a covariance by the scatter between blocks.
    pub(super) fn solved(&self, columns: &[usize]) -> Option<Solution> {
        let sums = self.total().sums(columns)?;
        let blocks = self.groups(self.blocks, |unit| Some(unit.block));
        let mut run_of = vec![0; self.blocks];
        self.units.iter().for_each(|unit| run_of[unit.block] = unit.run);
        let runs = run_of.iter().max().map_or(0, |last| last + 1);
        solve_sums(&sums, |ScoredEstimates { value, out, taken }| {
            let p = columns.len();
            let mut by_cluster = DMatrix::zeros(p, self.blocks);
            let mut by_run = DMatrix::zeros(p, runs);
            let mut normals = Vec::new();
            for (at, block) in blocks.iter().enumerate() {
                let last = block.products.ncols() - 1;
                let normal =
                    DMatrix::from_fn(p, p, |i, j| block.products[(columns[i], columns[j])]);
                let noise = DMatrix::from_fn(p, p, |i, j| block.noise[(columns[i], columns[j])]);
                let right = DVector::from_fn(p, |i, _| {
                    block.products[(columns[i], last)] - block.noise[(columns[i], last)]
                });
                let score = right - &normal * value + out * (noise * taken);
                by_cluster.set_column(at, &score);
                let mut of_run = by_run.column_mut(run_of[at]);
                of_run += score;
                if self.blocks <= FEW_CLUSTERS {
                    normals.push(normal);
                }
            }
            Scores { by_cluster, by_run, normals }
        })
    }

    /// With some columns, times what is known of them, taken off the right side.
    pub(super) fn less(&self, known: &[(usize, f64)]) -> Self {
        let mut found = self.clone();
        for unit in &mut found.units {
            unit.gram = unit.gram.less(known);
        }
        found
    }

    /// What each sampled window leaves of its right side, in the order of the windows.
    pub(super) fn left(&self, columns: &[usize], value: &DVector<f64>) -> Vec<f64> {
        let mut found = vec![0.0; self.order.len()];
        for (at, window) in self.order.iter().enumerate() {
            let explained: f64 =
                columns.iter().zip(value).map(|(c, v)| self.columns[*c][at] * v).sum();
            found[*window] = self.right[at] - explained;
        }
        found
    }

    /// The block of each sampled window.
    pub(super) fn block_of_windows(&self) -> Vec<usize> {
        let mut found = vec![0; self.order.len()];
        for unit in &self.units {
            for at in unit.rows.clone() {
                found[self.order[at]] = unit.block;
            }
        }
        found
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    const LANES: usize = 8;
    let mut sums = [0.0; LANES];
    let (a, rest_a) = a.as_chunks::<LANES>();
    let (b, rest_b) = b.as_chunks::<LANES>();
    for (a, b) in a.iter().zip(b) {
        for lane in 0..LANES {
            sums[lane] += a[lane] * b[lane];
        }
    }
    let rest: f64 = rest_a.iter().zip(rest_b).map(|(a, b)| a * b).sum();
    sums.iter().sum::<f64>() + rest
}

/// The units of the sampled windows, the windows in their order, and the number of blocks.
///
/// A block is a group of neighbouring slip phases of one run; of few phases each is cut into parts.
fn units(sampled: &Sampled<'_>, cut: &Cut) -> (Vec<Unit>, Vec<usize>, usize) {
    let places = sampled.places();
    let phases = places.last().map_or(0, |place| place.phase + 1);
    let together = phases.div_ceil(MOST_BLOCKS).max(1);
    let parts = if phases < FEW_PHASES { BLOCKS_WANTED.div_ceil(phases.max(1)) } else { 1 };
    let mut count = vec![0usize; phases];
    for place in places {
        count[place.phase] += 1;
    }
    let mut keyed: Vec<(usize, usize, usize)> = Vec::with_capacity(places.len());
    let (mut block, mut in_block, mut in_phase) = (0, 0, 0);
    for (i, place) in places.iter().enumerate() {
        if let Some(before) = i.checked_sub(1).map(|i| &places[i]) {
            in_phase += 1;
            let new_phase = before.phase != place.phase;
            let of_phase = count[place.phase].div_ceil(parts).max(1);
            if new_phase {
                in_phase = 0;
                in_block += 1;
            }
            let part = !new_phase && in_phase % of_phase == 0;
            if before.run != place.run || part || new_phase && in_block >= together {
                (block, in_block) = (block + 1, 0);
            }
        }
        keyed.push((block, cut.kind(place), i));
    }
    keyed.sort_unstable();
    let mut units: Vec<Unit> = Vec::new();
    for (at, (block, kind, i)) in keyed.iter().enumerate() {
        let same = units.last().is_some_and(|unit| (unit.block, unit.kind) == (*block, *kind));
        if !same {
            let (run, rows) = (places[*i].run, at..at);
            units.push(Unit { run, block: *block, kind: *kind, rows, gram: Gram::zeros(0) });
        }
        if let Some(unit) = units.last_mut() {
            unit.rows.end = at + 1;
        }
    }
    let blocks = keyed.last().map_or(0, |(block, _, _)| block + 1);
    (units, keyed.into_iter().map(|(_, _, i)| i).collect(), blocks)
}
