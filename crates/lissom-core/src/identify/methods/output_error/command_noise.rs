//! Noise of a measured command, which a replay takes for torque.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use crate::identify::methods::output_error::model::fit::ArmFit;
use crate::identify::methods::output_error::model::fitting::Fitting;
use crate::identify::methods::output_error::thresholds::COMMAND_NOISE_TOLD;
use crate::identify::prepare::channel_noise::{channel_noise, spread};
use crate::information::inverse;
use crate::record::{Campaign, Hold, Run};
use crate::replay::Sampling;

/// Steps of the golden-section search for the logarithm of the noise, to 5 %.
const GOLDEN_STEPS: usize = 12;
/// Samples before one that tell of it, samples looked at, least number of them for each coefficient, and fits.
const ORDER: usize = 4;
const SAMPLES: usize = 8192;
const LEAST_ROWS: usize = 10;
const ROUNDS: usize = 3;
/// Least noise that is looked for, as a share of the most.
const LEAST: f64 = 1e-3;

/// Standard deviation of the acceleration that noise of a measured command makes at most in a motor of this inertia
/// \[rad/s² or m/s²\]: [`noise_of`], the median of the runs. A part of it is the answer of a
/// control loop to its sensor, which is real torque. Zero of a command that is held, which acts as it is logged.
pub(super) fn most(campaign: &Campaign, inertia_kg_m2: f64) -> f64 {
    let command = &campaign.channels.command;
    if command.hold == Hold::Sampled {
        return 0.0;
    }
    let of_run = |run: &Run| noise_of(run) * command.torque_per_unit().abs();
    let mut each: Vec<f64> = campaign.runs.par_iter().with_max_len(1).map(of_run).collect();
    each.sort_by(f64::total_cmp);
    each.get(each.len() / 2).map_or(0.0, |torque_nm| torque_nm / inertia_kg_m2.abs())
}

/// Standard deviation of white noise that moves a motor as much as the noise of a run's command. What a linear control loop answers
/// to the sensor of the angle is no noise. Rounding to steps errs alike as long as the command stays within one.
fn noise_of(run: &Run) -> f64 {
    let command = run.command();
    let noise = channel_noise(command);
    let changes = command.windows(2).filter(|pair| pair[0].total_cmp(&pair[1]).is_ne()).count();
    let stays = command.len() as f64 / changes.max(1) as f64;
    let unanswered = unanswered(command, run.motor()).unwrap_or(f64::INFINITY);
    noise.independent.min(unanswered).max(noise.step / 12.0_f64.sqrt() * stays.sqrt())
}

/// What the last commands and moves of the angle do not tell of the next command, which is linear in them if a controller makes
/// it of that angle: its standard deviation, by least squares without the largest. Noise of the command is told by no move, but
/// that of the last commands adds to it: it is at most twice too large. `None` of a run that is too short.
fn unanswered(command: &[f64], motor: &[f64]) -> Option<f64> {
    let apart = command.len().div_ceil(SAMPLES).max(1);
    let rows: Vec<usize> = (ORDER + 1..command.len()).step_by(apart).collect();
    let width = 2 * ORDER + 2;
    if rows.len() < LEAST_ROWS * width {
        return None;
    }
    let row = |k: usize| {
        let before = (1..=ORDER).map(move |i| command[k - i]);
        let moves = (0..=ORDER).map(move |i| motor[k - i] - motor[k - i - 1]);
        before.chain(moves).chain([1.0])
    };
    let all = DMatrix::from_row_iterator(rows.len(), width, rows.iter().flat_map(|k| row(*k)));
    let mut used: Vec<usize> = (0..rows.len()).collect();
    let mut left = Vec::new();
    for _ in 0..ROUNDS {
        let some = all.select_rows(&used);
        let sizes: Vec<f64> = some.column_iter().map(|c| c.norm().max(f64::MIN_POSITIVE)).collect();
        let scaled = DMatrix::from_fn(used.len(), width, |i, j| some[(i, j)] / sizes[j]);
        let right = DVector::from_fn(used.len(), |i, _| command[rows[used[i]]]);
        let value = inverse(&scaled.tr_mul(&scaled)) * scaled.tr_mul(&right);
        let told =
            |k: usize| row(k).zip(&sizes).zip(&value).map(|((x, s), v)| x / s * v).sum::<f64>();
        left = rows.iter().map(|k| (command[*k] - told(*k)).abs()).collect();
        let mut order: Vec<usize> = (0..rows.len()).collect();
        order.sort_unstable_by(|a, b| left[*a].total_cmp(&left[*b]));
        order.truncate(order.len() * 4 / 5);
        used = order;
    }
    Some(spread(&mut left))
}

impl Fitting<'_> {
    /// The most likely noise of the command for a fit, beside noise of the sensors that keeps its ratios: at most
    /// `command_noise_most`, because what is slower is no noise but what the arm lacks. Zero if it is not told from none.
    pub(super) fn likely_command_noise(&self, fit: &ArmFit) -> f64 {
        let most = self.command_noise_most;
        if most <= 0.0 {
            return 0.0;
        }
        let readings: usize = fit.windows.iter().map(|w| w.len() * fit.noise.len()).sum();
        // −2·ln of the likelihood, with the scale of all noise that is most likely.
        let unlikely = |command_noise: f64| -> (f64, f64) {
            let noise = &fit.noise;
            let sampling = Sampling { noise, blocks: &[], masks: self.masks, command_noise };
            let [cost, widened] = self.costs(fit, sampling);
            let scale = cost / readings as f64;
            (readings as f64 * scale.ln() + widened, scale.sqrt())
        };
        let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
        let (mut low, mut high) = ((LEAST * most).ln(), (most / LEAST.sqrt()).ln());
        let at = |log: f64| (unlikely(log.exp()), log);
        let (mut a, mut b) = (at(high - golden * (high - low)), at(low + golden * (high - low)));
        for _ in 0..GOLDEN_STEPS {
            if a.0.0 < b.0.0 {
                (high, b) = (b.1, a);
                a = at(high - golden * (high - low));
            } else {
                (low, a) = (a.1, b);
                b = at(low + golden * (high - low));
            }
        }
        let ((found, scale), log) = if a.0.0 < b.0.0 { a } else { b };
        let none = unlikely(0.0).0;
        if none - found < COMMAND_NOISE_TOLD { 0.0 } else { (scale * log.exp()).min(most) }
    }
}
