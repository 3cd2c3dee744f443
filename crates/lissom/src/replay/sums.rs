//! Squares and products of residuals and their derivatives, summed over windows.

use std::ops::RangeInclusive;

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::arm::{MOST_MODES, ModalArm};
use super::parameter::Parameter;
use super::window::Replayer;
use crate::record::Campaign;

/// A stretch of a run with its own initial state.
#[derive(Debug, Clone, PartialEq)]
pub struct Window {
    /// Index of the run.
    pub run: usize,
    /// Samples, both ends included.
    pub samples: RangeInclusive<usize>,
    /// State `[θ, θ̇, ψ_1, ψ̇_1, …]` at the first of them.
    pub start: Vec<f64>,
    /// What each tip shows where the model has zero.
    pub zeros: Vec<f64>,
}

impl Window {
    /// Number of samples.
    pub fn len(&self) -> usize {
        self.samples.end() + 1 - self.samples.start()
    }
    /// Never true.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// Sums over one window, weighted.
///
/// A row is `[∂ŷ/∂p, ∂ŷ/∂(initial state), ∂ŷ/∂(zeros), y − ŷ]/σ`.
#[derive(Debug, Clone)]
pub struct WindowSums {
    /// Σ rowᵀ·row.
    pub gram: DMatrix<f64>,
    /// Σ of derivative × residual over each block of samples: scores for a covariance.
    pub scores: Vec<DVector<f64>>,
    /// Σ of squared residuals of each channel, not weighted.
    pub squares: Vec<f64>,
    /// Samples summed.
    pub samples: usize,
}

impl WindowSums {
    /// Σ of squared weighted residuals.
    pub fn cost(&self) -> f64 {
        let last = self.gram.ncols() - 1;
        self.gram[(last, last)]
    }
}

/// What the sums are over.
#[derive(Debug, Clone, Copy)]
pub struct Sampling<'a> {
    /// Deviation of each channel's noise, motor first, then tips.
    pub sigma: &'a [f64],
    /// Samples in a block of scores.
    pub block: usize,
}

/// Replays every window with its derivatives and sums up. Windows are independent and run on all
/// threads; the order of the result is theirs.
///
/// # Panics
/// Never for an arm of at most [`MOST_MODES`] modes whose windows lie within their runs.
pub fn sums(
    arm: &ModalArm,
    parameters: &[Parameter],
    campaign: &Campaign,
    windows: &[Window],
    sampling: Sampling<'_>,
) -> Vec<WindowSums> {
    match arm.modes.len() {
        0 => sums_of::<2>(arm, parameters, campaign, windows, sampling),
        1 => sums_of::<4>(arm, parameters, campaign, windows, sampling),
        2 => sums_of::<6>(arm, parameters, campaign, windows, sampling),
        3 => sums_of::<8>(arm, parameters, campaign, windows, sampling),
        MOST_MODES => sums_of::<10>(arm, parameters, campaign, windows, sampling),
        _ => Vec::new(),
    }
}

fn sums_of<const D: usize>(
    arm: &ModalArm,
    parameters: &[Parameter],
    campaign: &Campaign,
    windows: &[Window],
    sampling: Sampling<'_>,
) -> Vec<WindowSums> {
    let replayers = replayers::<D>(arm, parameters, campaign, windows);
    windows
        .par_iter()
        .map(|window| {
            let run = &campaign.runs[window.run];
            let replayer = replayers.iter().find(|(t, _)| same(*t, run.sample_time_s()));
            let Some((_, replayer)) = replayer else { unreachable!("one for each sample time") };
            sum_up(replayer, campaign, window, sampling)
        })
        .collect()
}

fn same(a: f64, b: f64) -> bool {
    a.total_cmp(&b).is_eq()
}

/// One for each sample time among the windows' runs.
pub(super) fn replayers<'a, const D: usize>(
    arm: &'a ModalArm,
    parameters: &'a [Parameter],
    campaign: &'a Campaign,
    windows: &[Window],
) -> Vec<(f64, Replayer<'a, D>)> {
    let mut times: Vec<f64> =
        windows.iter().map(|w| campaign.runs[w.run].sample_time_s()).collect();
    times.sort_by(f64::total_cmp);
    times.dedup();
    times.into_iter().map(|t| (t, Replayer::new(arm, parameters, &campaign.channels, t))).collect()
}

/// A window's start as an array; what it lacks is zero.
pub(super) fn start<const D: usize>(window: &Window) -> [f64; D] {
    std::array::from_fn(|i| window.start.get(i).copied().unwrap_or(0.0))
}

fn sum_up<const D: usize>(
    replayer: &Replayer<'_, D>,
    campaign: &Campaign,
    window: &Window,
    sampling: Sampling<'_>,
) -> WindowSums {
    let run = &campaign.runs[window.run];
    let channels = 1 + run.tips().len();
    let unknowns = replayer.unknowns();
    let mut rows: Vec<f64> = Vec::with_capacity(sampling.block * channels * (unknowns + 1));
    let mut found = WindowSums {
        gram: DMatrix::zeros(unknowns + 1, unknowns + 1),
        scores: Vec::new(),
        squares: vec![0.0; channels],
        samples: 0,
    };
    let mut row = vec![0.0; unknowns + 1];
    replayer.walk(run, window.samples.clone(), start(window), true, |seen| {
        for channel in 0..channels {
            let predicted = replayer.output(seen, channel, Some(&mut row[..unknowns]));
            let (logged, zero) = match channel.checked_sub(1) {
                None => (run.motor()[seen.sample], 0.0),
                Some(tip) => (run.tips()[tip][seen.sample], window.zeros[tip]),
            };
            let residual = logged - predicted - zero;
            row[unknowns] = residual;
            found.squares[channel] += residual * residual;
            let weight = 1.0 / sampling.sigma[channel];
            rows.extend(row.iter().map(|v| v * weight));
        }
        found.samples += 1;
        if found.samples % sampling.block == 0 {
            found.close_block(&mut rows);
        }
    });
    found.close_block(&mut rows);
    found
}

impl WindowSums {
    /// Adds the products of the gathered rows and empties them.
    fn close_block(&mut self, rows: &mut Vec<f64>) {
        if rows.is_empty() {
            return;
        }
        let width = self.gram.ncols();
        // Rows lie one after another: columns of a matrix that is width × rows.
        let columns = nalgebra::DMatrixView::from_slice(rows, width, rows.len() / width);
        let products = columns * columns.transpose();
        self.scores.push(products.column(width - 1).rows(0, width - 1).into_owned());
        self.gram += products;
        rows.clear();
    }
}
