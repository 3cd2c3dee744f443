//! How well a model of the torque predicts windows that were left out of its fit.

use nalgebra::DVector;
use statrs::distribution::{ContinuousCDF as _, StudentsT};

use crate::identify::methods::friction_law::blocks::{BlockRows, Gram};
use crate::identify::methods::friction_law::thresholds::{
    BETTER_CHANCE, BLOCKS_LEAST, SAVED_LEAST,
};

/// Parts of the campaign, in the order of time, that are left out one after another.
const FOLDS: usize = 10;
/// Stretches of the campaign, of both directions each, that are dealt to two halves in turn.
const STRETCHES: usize = 8;
/// Groups of windows in each of the ways to leave out a kind of motion.
const BY_SPEED: usize = 6;
const BY_TRAVEL: usize = 4;
/// Most groups of runs.
const MOST_RUNS: usize = 12;

/// Sums of the rows of a campaign, divided as predictions need them.
pub(super) struct Divided {
    total: Gram,
    blocks: Vec<Gram>,
    folds: Vec<Gram>,
    kinds: Vec<Gram>,
    halves: [Gram; 2],
}

/// Squared residuals of each block, which was left out of the fit.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct ByBlock {
    /// Beyond what noise of the sensors adds in expectation.
    beyond_noise: Vec<f64>,
    /// All of it.
    all: Vec<f64>,
}

impl ByBlock {
    fn push(&mut self, block: &Gram, columns: &[usize], value: &DVector<f64>) {
        self.beyond_noise.push(block.squared(columns, value));
        self.all.push(block.squared_with_noise(columns, value));
    }

    /// Sum over all blocks, noise included.
    pub(super) fn all(&self) -> f64 {
        self.all.iter().sum()
    }

    /// All times a factor.
    pub(super) fn scaled(mut self, factor: f64) -> Self {
        self.beyond_noise.iter_mut().chain(&mut self.all).for_each(|left| *left *= factor);
        self
    }
}

/// Squared residuals on what was left out of the fit.
#[derive(Debug, Clone)]
pub(super) struct LeftOut {
    pub(super) by_block: ByBlock,
    /// Sum over the kinds of motion, each left out, beyond noise.
    kinds: f64,
}

impl Divided {
    pub(super) fn of(rows: &BlockRows) -> Self {
        let (blocks, width) = (rows.blocks.len(), rows.width() + 1);
        let of_kinds = |groups: usize, group: fn(usize) -> usize| {
            let each = rows.kinds.iter().enumerate();
            Gram::by_group(groups, width, each.map(|(kind, sums)| (group(kind), sums)))
        };
        let of_blocks = |groups: usize, group: &dyn Fn(usize) -> usize| {
            let each = rows.blocks.iter().enumerate();
            Gram::by_group(groups, width, each.map(|(block, sums)| (group(block), sums)))
        };
        let mut kinds = of_kinds(BY_SPEED, |kind| kind / 4 * 2 + kind % 2);
        kinds.extend(of_kinds(BY_TRAVEL, |kind| kind % 4));
        let runs = rows.runs();
        if runs > 1 {
            let groups = runs.min(MOST_RUNS);
            kinds.extend(of_blocks(groups, &|block| rows.run_of_block[block] * groups / runs));
        }
        let halves = of_blocks(2, &|block| Self::half(block, blocks));
        let [even, odd] = [0, 1].map(|i| halves[i].clone());
        Self {
            total: rows.total(),
            blocks: rows.blocks.clone(),
            folds: of_blocks(FOLDS, &|block| Self::fold(block, blocks)),
            kinds,
            halves: [even, odd],
        }
    }

    /// Which part of the campaign a block belongs to.
    fn fold(block: usize, blocks: usize) -> usize {
        block * FOLDS.min(blocks) / blocks.max(1)
    }

    /// Which half a block belongs to.
    pub(super) fn half(block: usize, blocks: usize) -> usize {
        block * STRETCHES.min(blocks / 2) / blocks.max(1) % 2
    }

    /// Sums of all rows.
    pub(super) fn total(&self) -> &Gram {
        &self.total
    }

    /// Sums of the rows of a half.
    pub(super) fn of_half(&self, half: usize) -> &Gram {
        &self.halves[half]
    }

    /// Predictions of parts and of kinds of motion that were left out.
    pub(super) fn left_out(&self, columns: &[usize]) -> Option<LeftOut> {
        let blocks = self.blocks.len();
        let mut by_block = ByBlock::default();
        for (fold, part) in self.folds.iter().enumerate().filter(|(_, part)| part.rows() > 0) {
            let value = self.total.without(part).values(columns)?;
            let own = |block: &usize| Self::fold(*block, blocks) == fold;
            for block in (0..blocks).filter(own) {
                by_block.push(&self.blocks[block], columns, &value);
            }
        }
        let mut kinds = 0.0;
        for part in self.kinds.iter().filter(|part| part.rows() > 0) {
            let rest = self.total.without(part);
            if rest.rows() > 0 {
                kinds += part.squared(columns, &rest.values(columns)?);
            }
        }
        Some(LeftOut { by_block, kinds })
    }

    /// What some values leave of each block.
    pub(super) fn left_by(&self, columns: &[usize], value: &DVector<f64>) -> ByBlock {
        let mut found = ByBlock::default();
        self.blocks.iter().for_each(|block| found.push(block, columns, value));
        found
    }

    /// Predictions of each half by a fit of the other, whose columns were chosen there: `columns` of either half.
    pub(super) fn across_halves(&self, columns: [&[usize]; 2]) -> Option<ByBlock> {
        let fits: Vec<DVector<f64>> =
            (0..2).map(|half| self.halves[half].values(columns[half])).collect::<Option<_>>()?;
        let blocks = self.blocks.len();
        let mut found = ByBlock::default();
        for block in 0..blocks {
            let fitted = 1 - Self::half(block, blocks);
            found.push(&self.blocks[block], columns[fitted], &fits[fitted]);
        }
        Some(found)
    }
}

/// By how much one model predicts better than another, block by block.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Improvement {
    /// Squared residual that it saves, as a share of that without it \[1\].
    pub(super) saved: f64,
    /// Mean over its standard error, the least over the ways to join neighbouring blocks \[1\].
    pub(super) standard_errors: f64,
    /// Whether that is worth a term, and more than two standard errors, for the number of blocks by Student's t.
    pub(super) is_sure: bool,
}

impl Improvement {
    /// Of the squared residuals `with` some amplitudes more over those `without` them.
    ///
    /// What a block saves counts as a share of its own residual: in a sweep the residuals of the fast blocks are many times
    /// those of the slow ones. Neighbouring blocks are joined, two, four and more together, as long as there are enough of
    /// them: residuals that belong together over longer times make the standard error larger.
    pub(super) fn between(without: &ByBlock, with: &ByBlock, amplitudes: usize) -> Self {
        let pairs = without.beyond_noise.iter().zip(&with.beyond_noise);
        let each: Vec<(f64, f64)> =
            pairs.map(|(a, b)| a - b).zip(without.all.iter().copied()).collect();
        let sums = |some: &[(f64, f64)]| {
            some.iter().fold((0.0, 0.0), |(saved, all), (a, b)| (saved + a, all + b))
        };
        let (saved, all) = sums(&each);
        let saved = saved / all.max(f64::MIN_POSITIVE);
        let worth = saved > SAVED_LEAST * amplitudes as f64;
        let is_sure = each.len() >= BLOCKS_LEAST && worth;
        let mut found = Self { saved, standard_errors: f64::INFINITY, is_sure };
        let mut together = 1;
        while each.len() / together >= BLOCKS_LEAST {
            let joined = each.chunks(together).map(|some| {
                let (saved, all) = sums(some);
                saved / all.max(f64::MIN_POSITIVE)
            });
            let joined: Vec<f64> = joined.collect();
            let n = joined.len() as f64;
            let mean = joined.iter().sum::<f64>() / n;
            let square: f64 = joined.iter().map(|d| (d - mean).powi(2)).sum();
            let ratio = mean / (square / (n * (n - 1.0))).sqrt().max(f64::MIN_POSITIVE);
            let enough = StudentsT::new(0.0, 1.0, n - 1.0)
                .map_or(f64::INFINITY, |t| t.inverse_cdf(1.0 - BETTER_CHANCE));
            found.is_sure &= ratio > enough;
            found.standard_errors = found.standard_errors.min(ratio);
            together *= 2;
        }
        found
    }
}

impl LeftOut {
    /// Whether kinds of motion that were left out are predicted better than by another model.
    pub(super) fn is_better_across_kinds(&self, other: &Self) -> bool {
        self.kinds < other.kinds
    }
}
