//! Noise of a measured command, which a replay takes for torque.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use crate::identify::output_error::model::fit::ArmFit;
use crate::identify::output_error::model::fitting::Fitting;
use crate::identify::output_error::thresholds::COMMAND_NOISE_TOLD;
use crate::identify::prepare::channel_noise::{channel_noise, spread};
use crate::information::inverse;
use crate::record::{Campaign, Hold, Run};
use crate::replay::Sampling;
use crate::spectrum::minimum;

/// The noise is found to this share of it.
const FOUND_TO: f64 = 0.05;
/// Order of the linear prediction of a command, samples used for it, their least number per coefficient, and rounds of the fit.
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

/// Standard deviation of white noise with the same effect on a motor as the noise of a run's command: the part of the command that
/// a linear control loop on the angle does not explain. The error of rounding to steps is constant while the command stays within
/// one step, so it counts for as many samples.
fn noise_of(run: &Run) -> f64 {
    let command = run.command();
    let noise = channel_noise(command);
    let changes = command.windows(2).filter(|pair| pair[0].total_cmp(&pair[1]).is_ne()).count();
    let stays = command.len() as f64 / changes.max(1) as f64;
    let unpredicted = unpredicted(command, run.motor()).unwrap_or(f64::INFINITY);
    noise.independent.min(unpredicted).max(noise.step / 12.0_f64.sqrt() * stays.sqrt())
}

/// Standard deviation of the error of a linear prediction of the command from the last four commands and the last five differences
/// of the angle, by least squares without the largest fifth of the errors. A controller's answer to the angle is predicted, noise is
/// not; noise of the last commands adds to the error, which is at most about twice the noise. `None` for a run that is too short.
fn unpredicted(command: &[f64], motor: &[f64]) -> Option<f64> {
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
    /// Maximum-likelihood noise of the command for a fit; the ratios of the sensors' noise are kept. It is at most
    /// `command_noise_most`: a larger value would be an error of the model. Zero if the likelihood does not require it.
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
        let (low, high) = ((LEAST * most).ln(), (most / LEAST.sqrt()).ln());
        let likely = minimum(|log| unlikely(log.exp()).0, low, high, FOUND_TO).exp();
        let (found, scale) = unlikely(likely);
        let none = unlikely(0.0).0;
        if none - found < COMMAND_NOISE_TOLD { 0.0 } else { (scale * likely).min(most) }
    }
}
