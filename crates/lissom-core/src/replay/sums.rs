//! Sums of squares and products of residuals and their derivatives, over windows.

use std::ops::RangeInclusive;

use nalgebra::{Const, DMatrix, DMatrixView, Dyn, MatrixView};
use rayon::prelude::*;

use super::innovations::Innovations;
use super::late_tips::LateTips;
use super::losses::Losses;
use super::modal_arm::{MOST_MODES, ModalArm};
use super::noise::SensorNoise;
use super::parameter::Parameter;
use super::window::{Replayer, Seen};
use crate::friction::Mode;
use crate::record::{Campaign, Run};

/// Most numbers in the rows that are gathered before their products are summed: they stay near the
/// processor.
const MOST_NUMBERS: usize = 8192;

/// A stretch of a run that is replayed from its own initial state.
#[derive(Debug, Clone, PartialEq)]
pub struct Window {
    /// Index of the run in its campaign.
    pub run: usize,
    /// Range of samples, both ends included.
    pub samples: RangeInclusive<usize>,
    /// State `[θ, θ̇, ψ_1, ψ̇_1, …]` at the first sample.
    pub start: Vec<f64>,
    /// Zero of each tip: its reading where the model's angle is zero, in the unit of the channel.
    pub zeros: Vec<f64>,
}

impl Window {
    /// Number of samples.
    pub fn len(&self) -> usize {
        self.samples.end() + 1 - self.samples.start()
    }
    /// Never true: a window has samples.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// What a channel shows beyond what was predicted of it, the tip's zero taken out.
    fn residual(&self, run: &Run, channel: usize, sample: usize, predicted: f64) -> f64 {
        match channel.checked_sub(1) {
            None => run.motor()[sample] - predicted,
            Some(tip) => run.tips()[tip][sample] - predicted - self.zeros[tip],
        }
    }
}

/// Weighted sums over one window.
///
/// A row is `[∂ŷ/∂p, ∂ŷ/∂(initial state), ∂ŷ/∂(zeros), s/c]·√c`, with the slope s and the curvature c of
/// the channel's cost. Without sensor steps these are the derivatives and the residual, divided by the
/// standard deviation of the noise.
#[derive(Debug, Clone)]
pub struct WindowSums {
    /// Σ rowᵀ·row.
    pub gram: DMatrix<f64>,
    /// The same sum over the samples of each block, if [`Sampling::blocks`] are given.
    pub blocks: Vec<DMatrix<f64>>,
    /// Sum of squared residuals of each channel, without weights.
    pub squares: Vec<f64>,
    /// Number of readings of each channel that count.
    pub readings: Vec<usize>,
    /// Sum of `−2·ln` of the probabilities of the readings, relative to the most probable readings. If sensors have no
    /// steps, it is the sum of squared residuals divided by the variance of the noise.
    pub cost: f64,
    /// Sum of the squared slopes of the channels' costs, per variance of the noise.
    pub slopes: f64,
    /// Sum of their curvatures; on average equal to `slopes` if the noise is as assumed.
    pub curvatures: f64,
    /// Number of samples.
    pub samples: usize,
}

/// Weights and selections for the sums.
#[derive(Debug, Clone, Copy)]
pub struct Sampling<'a> {
    /// Noise of each channel, motor first, then tips.
    pub noise: &'a [SensorNoise],
    /// How the samples of each run are grouped to blocks; empty if no sums by block are needed.
    pub blocks: &'a [Blocks],
    /// For each run and channel, which readings count; `None` if all count.
    pub masks: &'a [Vec<Option<Vec<bool>>>],
    /// Standard deviation of the acceleration of the motor that noise of the measured command makes in one sample
    /// \[rad/s² or m/s²\]; zero if what is logged is what acts. Steps of sensors are then counted as noise.
    pub command_noise: f64,
}

/// How the samples of a run are grouped to blocks whose residuals are correlated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Blocks {
    /// Number of samples per block.
    pub samples: f64,
    /// Number of samples per period. In a periodic motion the steps of a sensor give the same errors at the same phase
    /// of every period, so these samples belong to the same block. `None` for motions that are not periodic.
    pub period: Option<f64>,
}

impl Blocks {
    fn of(&self, sample: usize, first: usize) -> usize {
        let at = match self.period {
            Some(period) => (sample as f64).rem_euclid(period),
            None => (sample - first) as f64,
        };
        (at / self.samples) as usize
    }
}

/// Replays every window with its derivatives, and computes the sums. Windows are independent and are computed on all
/// threads; results are in the order of the windows.
///
/// # Panics
/// Never for an arm of at most [`MOST_MODES`] modes whose windows are within their runs.
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

/// What a window costs, without derivatives.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct WindowCost {
    /// [`WindowSums::cost`].
    pub cost: f64,
    /// `Σ ln(S/σ²)`, by which noise of the command makes readings less certain; zero without it.
    pub widened: f64,
}

/// Costs of the windows, without derivatives; takes a fifth of the time of [`sums`].
pub fn costs(
    arm: &ModalArm,
    campaign: &Campaign,
    windows: &[Window],
    sampling: Sampling<'_>,
) -> Vec<WindowCost> {
    match arm.modes.len() {
        0 => costs_of::<2>(arm, campaign, windows, sampling),
        1 => costs_of::<4>(arm, campaign, windows, sampling),
        2 => costs_of::<6>(arm, campaign, windows, sampling),
        3 => costs_of::<8>(arm, campaign, windows, sampling),
        MOST_MODES => costs_of::<10>(arm, campaign, windows, sampling),
        _ => Vec::new(),
    }
}

fn costs_of<const D: usize>(
    arm: &ModalArm,
    campaign: &Campaign,
    windows: &[Window],
    sampling: Sampling<'_>,
) -> Vec<WindowCost> {
    let noisy = sampling.command_noise > 0.0;
    let replayers = replayers::<D>(arm, &[], campaign, windows, noisy);
    let losses = losses(sampling);
    let of_window = |window: &Window| {
        let run = &campaign.runs[window.run];
        let mut cost = WindowCost::default();
        let replayer = replayer_of(&replayers, run);
        let mut late = LateTips::new(replayer, window.samples.clone(), false);
        let mut beyond = filter_of(replayer, sampling);
        replayer.walk(run, window.samples.clone(), start(window), false, |seen| {
            advance(&mut beyond, seen, window);
            for (channel, mask) in sampling.masks[window.run].iter().enumerate() {
                let counts = |sample: usize| counts(mask.as_ref(), sample);
                if late.is_in_time(channel) && !counts(seen.sample) {
                    continue;
                }
                let told = late.output(replayer, seen, channel, None);
                let Some((sample, predicted)) = told.filter(|t| counts(t.0)) else { continue };
                let residual = window.residual(run, channel, sample, predicted);
                let Some(beyond) = &mut beyond else {
                    cost.cost += losses[channel].cost(residual);
                    continue;
                };
                let variance = sampling.noise[channel].deviation().powi(2);
                let told = beyond.of(&replayer.shown(seen, channel), residual, variance);
                cost.cost += told.value * told.value / told.variance;
                cost.widened += (told.variance / variance).ln();
                if late.is_in_time(channel) {
                    beyond.learn(&told, &mut seen.motion.tangents, None);
                }
            }
        });
        cost
    };
    windows.par_iter().with_max_len(1).map(of_window).collect()
}

/// Those of each channel.
fn losses(sampling: Sampling<'_>) -> Vec<Losses> {
    sampling.noise.iter().copied().map(Losses::new).collect()
}

/// The one made for the run's sample time.
fn replayer_of<'a, 'b, const D: usize>(
    replayers: &'b [(f64, Replayer<'a, D>)],
    run: &Run,
) -> &'b Replayer<'a, D> {
    let found = replayers.iter().find(|(t, _)| t.total_cmp(&run.sample_time_s()).is_eq());
    let Some((_, replayer)) = found else { unreachable!("one for each sample time") };
    replayer
}

fn counts(mask: Option<&Vec<bool>>, sample: usize) -> bool {
    mask.is_none_or(|m| m[sample])
}

fn sums_of<const D: usize>(
    arm: &ModalArm,
    parameters: &[Parameter],
    campaign: &Campaign,
    windows: &[Window],
    sampling: Sampling<'_>,
) -> Vec<WindowSums> {
    let noisy = sampling.command_noise > 0.0;
    let replayers = replayers::<D>(arm, parameters, campaign, windows, noisy);
    let losses = losses(sampling);
    // One by one: in groups a thread would be left with one while the others have none.
    windows
        .par_iter()
        .with_max_len(1)
        .map(|window| {
            let replayer = replayer_of(&replayers, &campaign.runs[window.run]);
            sum_up(replayer, campaign, window, sampling, &losses)
        })
        .collect()
}

/// One for each sample time among the windows' runs.
pub(super) fn replayers<'a, const D: usize>(
    arm: &'a ModalArm,
    parameters: &'a [Parameter],
    campaign: &'a Campaign,
    windows: &[Window],
    with_units: bool,
) -> Vec<(f64, Replayer<'a, D>)> {
    let mut times: Vec<f64> =
        windows.iter().map(|w| campaign.runs[w.run].sample_time_s()).collect();
    times.sort_by(f64::total_cmp);
    times.dedup();
    let of = |t: f64| (t, Replayer::new(arm, parameters, &campaign.channels, t, with_units));
    times.into_iter().map(of).collect()
}

/// A window's start as an array; what it lacks is zero.
pub(super) fn start<const D: usize>(window: &Window) -> [f64; D] {
    std::array::from_fn(|i| window.start.get(i).copied().unwrap_or(0.0))
}

/// The filter of a window, if noise of the command moves its replay.
pub(super) fn filter_of<const D: usize>(
    replayer: &Replayer<'_, D>,
    sampling: Sampling<'_>,
) -> Option<Innovations<D>> {
    let noise = sampling.command_noise;
    (noise > 0.0).then(|| Innovations::new(noise, replayer.sample_time_s(), replayer.units()))
}

/// Moves the filter on to the sample that is seen.
pub(super) fn advance<const D: usize>(
    beyond: &mut Option<Innovations<D>>,
    seen: &mut Seen<'_, D>,
    window: &Window,
) {
    if let Some(beyond) = beyond
        && seen.sample > *window.samples.start()
    {
        let slips = seen.motion.mode != Mode::Stick;
        beyond.advance(&mut seen.motion.tangents, slips);
    }
}

fn sum_up<const D: usize>(
    replayer: &Replayer<'_, D>,
    campaign: &Campaign,
    window: &Window,
    sampling: Sampling<'_>,
    losses: &[Losses],
) -> WindowSums {
    let run = &campaign.runs[window.run];
    let channels = 1 + run.tips().len();
    let unknowns = replayer.unknowns();
    let mut rows: Vec<f64> = Vec::new();
    let mut found = WindowSums {
        gram: DMatrix::zeros(unknowns + 1, unknowns + 1),
        blocks: Vec::new(),
        squares: vec![0.0; channels],
        readings: vec![0; channels],
        cost: 0.0,
        slopes: 0.0,
        curvatures: 0.0,
        samples: 0,
    };
    let mut row = replayer.row();
    let blocks = sampling.blocks.get(window.run);
    let masks = &sampling.masks[window.run];
    let first = *window.samples.start();
    let mut block = None;
    let mut late = LateTips::new(replayer, window.samples.clone(), true);
    let mut beyond = filter_of(replayer, sampling);
    replayer.walk(run, window.samples.clone(), start(window), true, |seen| {
        advance(&mut beyond, seen, window);
        let own = blocks.map(|b| b.of(seen.sample, first));
        if own != block || rows.len() > MOST_NUMBERS {
            found.add(&mut rows, block);
            block = own;
        }
        for (channel, mask) in masks.iter().enumerate() {
            let counts = |sample: usize| counts(mask.as_ref(), sample);
            if late.is_in_time(channel) && !counts(seen.sample) {
                continue;
            }
            let told = late.output(replayer, seen, channel, Some(&mut row));
            let Some((sample, predicted)) = told.filter(|t| counts(t.0)) else { continue };
            let residual = window.residual(run, channel, sample, predicted);
            found.readings[channel] += 1;
            let variance = sampling.noise[channel].deviation().powi(2);
            let (loss, variance) = match &mut beyond {
                None => {
                    found.squares[channel] += residual * residual;
                    (losses[channel].loss(residual), variance)
                }
                Some(beyond) => {
                    let told = beyond.of(&replayer.shown(seen, channel), residual, variance);
                    if late.is_in_time(channel) {
                        beyond.learn(&told, &mut seen.motion.tangents, Some(&row));
                    }
                    found.squares[channel] += told.value.powi(2) * variance / told.variance;
                    (told.loss(), told.variance)
                }
            };
            found.cost += loss.cost;
            found.slopes += loss.slope * loss.slope * variance;
            found.curvatures += loss.curvature * variance;
            let root = loss.curvature.sqrt();
            row[unknowns] = loss.slope / loss.curvature;
            rows.extend(row[..=unknowns].iter().map(|v| v * root));
        }
        found.samples += 1;
    });
    found.add(&mut rows, block);
    for block in &found.blocks {
        found.gram += block;
    }
    found
}

impl WindowSums {
    /// Sums for fewer parameters: those at the indices `kept` among the first `shared`, and all unknowns of the window.
    #[must_use]
    pub fn of(&self, kept: &[usize], shared: usize) -> Self {
        let columns: Vec<usize> = kept.iter().copied().chain(shared..self.gram.ncols()).collect();
        let some = |m: &DMatrix<f64>| m.select_rows(&columns).select_columns(&columns);
        let blocks = self.blocks.iter().map(some).collect();
        Self { gram: some(&self.gram), blocks, ..self.clone() }
    }

    /// Adds the products of the gathered rows, which are of one block if of any, and empties them.
    fn add(&mut self, rows: &mut Vec<f64>, block: Option<usize>) {
        if rows.is_empty() {
            return;
        }
        let width = self.gram.ncols();
        // Rows lie one after another: columns of a matrix that is width × rows.
        let (count, unit, wide) = (rows.len() / width, Const::<1>, Dyn(width));
        let columns = DMatrixView::from_slice(rows, width, count);
        let transposed =
            MatrixView::from_slice_with_strides_generic(rows, Dyn(count), wide, wide, unit);
        let sums = match block {
            None => &mut self.gram,
            Some(block) => {
                if self.blocks.len() <= block {
                    self.blocks.resize(block + 1, DMatrix::zeros(width, width));
                }
                &mut self.blocks[block]
            }
        };
        sums.gemm(1.0, &columns, &transposed, 1.0);
        rows.clear();
    }
}
