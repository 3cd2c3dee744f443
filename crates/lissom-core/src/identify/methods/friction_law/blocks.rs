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

/// Parts of the campaign whose sums are made at the same time.
const PARTS: usize = 8;

/// Windows of one block and one kind of motion.
#[derive(Debug, Clone)]
struct Unit {
    run: usize,
    block: usize,
    /// Direction × third of the speeds × half of the travel.
    kind: usize,
    rows: Range<usize>,
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

    fn add(&mut self, other: &Self) {
        self.products += &other.products;
        self.noise += &other.noise;
        self.rows += other.rows;
    }

    /// Sums of some, each of a group.
    pub(super) fn by_group<'a>(
        groups: usize,
        width: usize,
        each: impl Iterator<Item = (usize, &'a Self)>,
    ) -> Vec<Self> {
        let mut sums = vec![Self::zeros(width); groups];
        each.for_each(|(group, one)| sums[group].add(one));
        sums
    }

    /// With `more` columns before the right side, of products that are not known yet.
    fn widened(&mut self, more: usize) {
        let at = self.products.ncols() - 1;
        for sums in [&mut self.products, &mut self.noise] {
            let taken = std::mem::take(sums);
            *sums = taken.insert_columns(at, more, 0.0).insert_rows(at, more, 0.0);
        }
    }

    /// With the first `width` columns and the right side.
    fn narrowed(&mut self, width: usize) {
        let gone = self.products.ncols() - 1 - width;
        for sums in [&mut self.products, &mut self.noise] {
            let taken = std::mem::take(sums);
            *sums = taken.remove_columns(width, gone).remove_rows(width, gone);
        }
    }

    /// Adds products of some columns, and what noise adds to them.
    fn add_products(&mut self, pairs: &[(usize, usize)], sums: &[[f64; 2]]) {
        for (&(i, j), [product, noise]) in pairs.iter().zip(sums) {
            self.products[(i, j)] += product;
            self.noise[(i, j)] += noise;
            if i != j {
                self.products[(j, i)] += product;
                self.noise[(j, i)] += noise;
            }
        }
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
    units: Vec<Unit>,
    /// Sums of each block; they are in the order of time, run after run.
    pub(super) blocks: Vec<Gram>,
    /// The run of each.
    pub(super) run_of_block: Vec<usize>,
    /// Sums of each kind of motion.
    pub(super) kinds: Vec<Gram>,
    /// Where each row is among the sampled windows.
    order: Vec<usize>,
    signs: Vec<f64>,
    /// Where the noise of each column comes from: a column of a row's noise, and how it acts.
    noisy: Vec<Option<(usize, Acts)>>,
}

impl BlockRows {
    /// The columns of the line: J, V, C, offset, κ_i, g_s, g_c.
    pub(super) fn of(sampled: &Sampled<'_>, cut: &Cut) -> Self {
        let (units, order) = units(sampled, cut);
        let signs: Vec<f64> = order.iter().map(|&i| sampled.places()[i].sign).collect();
        let own = MotorColumns::of(sampled.campaign).count();
        let equation = sampled.equation_rows();
        let right = order.iter().map(|&i| equation[i * (own + 1) + own]).collect();
        let (columns, noisy) = (Vec::new(), Vec::new());
        let mut kinds = vec![Gram::zeros(1); Cut::KINDS];
        let mut blocks = vec![Gram::zeros(1); units.last().map_or(0, |unit| unit.block + 1)];
        let mut run_of_block = vec![0; blocks.len()];
        for unit in &units {
            kinds[unit.kind].rows += unit.rows.len();
            blocks[unit.block].rows += unit.rows.len();
            run_of_block[unit.block] = unit.run;
        }
        let mut found =
            Self { columns, right, units, blocks, run_of_block, kinds, order, signs, noisy };
        found.sum(sampled, &[(0, 0)]);
        let mut line: Vec<_> = (0..own).map(|i| Regressor::Own(i, Acts::Alike)).collect();
        line.insert(PLACE_COULOMB, Regressor::Own(PLACE_COULOMB, Acts::Against));
        found.add(sampled, &line, &[]);
        found
    }

    /// Number of runs.
    pub(super) fn runs(&self) -> usize {
        self.run_of_block.last().map_or(0, |last| last + 1)
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
        let (mut place, old) = (0, self.width());
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
        self.grams().for_each(|gram| gram.widened(further.len()));
        let right = self.width();
        let with_own = |i: usize| (0..=i).chain([right]).map(move |j| (i, j));
        let pairs: Vec<(usize, usize)> = (old..right).flat_map(with_own).collect();
        self.sum(sampled, &pairs);
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
    pub(super) fn truncate(&mut self, width: usize) {
        self.columns.truncate(width);
        self.noisy.truncate(width);
        self.grams().for_each(|gram| gram.narrowed(width));
    }

    fn grams(&mut self) -> impl Iterator<Item = &mut Gram> {
        self.blocks.iter_mut().chain(&mut self.kinds)
    }

    /// Adds the products of pairs of columns, the right side last, to the sums of blocks and kinds.
    fn sum(&mut self, sampled: &Sampled<'_>, pairs: &[(usize, usize)]) {
        let Self { columns, right, units, noisy, signs, .. } = &*self;
        let all: Vec<&[f64]> = columns.iter().chain([right]).map(Vec::as_slice).collect();
        let of_unit = |unit: &Unit, add: &mut dyn FnMut(usize, [f64; 2])| {
            let of_row = sampled.noise_of_row(unit.run);
            let (range, sign) = (unit.rows.clone(), signs[unit.rows.start]);
            let source = |i: usize| match noisy.get(i) {
                Some(source) => source.map(|(c, acts)| (c, acts.factor(sign))),
                None => Some((of_row.ncols() - 1, 1.0)),
            };
            let sources: Vec<_> = (0..all.len()).map(source).collect();
            for (place, &(i, j)) in pairs.iter().enumerate() {
                let product = dot(&all[i][range.clone()], &all[j][range.clone()]);
                let noise = sources[i].zip(sources[j]);
                let noise = noise.map_or(0.0, |((a, f), (b, g))| f * g * of_row[(a, b)]);
                add(place, [product, noise * range.len() as f64]);
            }
        };
        let by_block: Vec<&[Unit]> = units.chunk_by(|a, b| a.block == b.block).collect();
        let none = vec![[0.0; 2]; pairs.len()];
        let of_part = |part: &[&[Unit]]| {
            let mut kinds = vec![none.clone(); Cut::KINDS];
            let mut blocks = vec![none.clone(); part.len()];
            for (block, units) in blocks.iter_mut().zip(part) {
                for unit in *units {
                    of_unit(unit, &mut |place, [product, noise]| {
                        for sums in [&mut block[place], &mut kinds[unit.kind][place]] {
                            sums[0] += product;
                            sums[1] += noise;
                        }
                    });
                }
            }
            (blocks, kinds)
        };
        let parts = by_block.par_chunks(by_block.len().div_ceil(PARTS).max(1)).map(of_part);
        let mut block = 0;
        for (blocks, kinds) in parts.collect::<Vec<_>>() {
            for sums in blocks {
                self.blocks[block].add_products(pairs, &sums);
                block += 1;
            }
            for (gram, sums) in self.kinds.iter_mut().zip(kinds) {
                gram.add_products(pairs, &sums);
            }
        }
    }

    /// Sums of all rows.
    pub(super) fn total(&self) -> Gram {
        let mut sum = Gram::zeros(self.width() + 1);
        self.kinds.iter().for_each(|kind| sum.add(kind));
        sum
    }

    /// Least squares of some columns, with a covariance by the scatter between blocks.
    pub(super) fn solved(&self, columns: &[usize]) -> Option<Solution> {
        let sums = self.total().sums(columns)?;
        let (blocks, run_of) = (&self.blocks, &self.run_of_block);
        let runs = self.runs();
        solve_sums(&sums, |ScoredEstimates { value, out, taken }| {
            let p = columns.len();
            let mut by_cluster = DMatrix::zeros(p, blocks.len());
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
                if blocks.len() <= FEW_CLUSTERS {
                    normals.push(normal);
                }
            }
            Scores { by_cluster, by_run, normals }
        })
    }

    /// With some columns, times what is known of them, taken off the right side.
    pub(super) fn less(&self, known: &[(usize, f64)]) -> Self {
        let mut found = self.clone();
        found.grams().for_each(|gram| *gram = gram.less(known));
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

/// The units of the sampled windows, and the windows in their order.
///
/// A block is a group of neighbouring slip phases of one run; of few phases each is cut into parts.
fn units(sampled: &Sampled<'_>, cut: &Cut) -> (Vec<Unit>, Vec<usize>) {
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
            units.push(Unit { run, block: *block, kind: *kind, rows });
        }
        if let Some(unit) = units.last_mut() {
            unit.rows.end = at + 1;
        }
    }
    (units, keyed.into_iter().map(|(_, _, i)| i).collect())
}
