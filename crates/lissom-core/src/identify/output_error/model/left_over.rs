//! The share of a residual that no sensor's noise explains.

use rand_distr::{Distribution, StandardNormal};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};

use crate::identify::output_error::engine::data::Masks;
use crate::identify::output_error::model::fit::ArmFit;
use crate::identify::prepare::channel_noise::reading;
use crate::identify::thresholds::CLEARLY_PRESENT;
use crate::record::{Campaign, Run};
use crate::replay::{Sampling, SensorNoise, Window, innovations, predict};

/// Numbers of samples over which means are taken: noise averages out, and motion that the arm lacks is slower.
const AVERAGED: [usize; 3] = [4, 16, 64];

/// Share of each channel's squared residual, motor first, that is slower than its sensor's noise and larger than
/// chance explains; zero if there is none. Where noise of the command moves the replay, it is that of the innovations.
///
/// A sensor's steps also make slow errors if the motion is slow. So the means of 4, 16 and 64 residuals are compared
/// with those that the same sensor would leave of the replayed motion itself, with its noise and without.
pub(crate) fn left_over(campaign: &Campaign, fit: &ArmFit, masks: &[Masks]) -> Vec<f64> {
    let of_windows: Vec<Vec<Slow>> = fit
        .windows
        .par_iter()
        .filter_map(|window| of_window(campaign, fit, window, masks))
        .collect();
    (0..fit.noise.len())
        .map(|channel| {
            let add = |sum: Slow, of: &Vec<Slow>| sum.and(&of[channel]);
            of_windows.iter().fold(Slow::default(), add).share(fit.command_noise > 0.0)
        })
        .collect()
}

/// Sums of squares of a channel's residuals, and of their means over each number of samples.
#[derive(Debug, Clone, Copy, Default)]
struct Slow {
    readings: usize,
    squares: f64,
    /// Of the residual, of the sensor's errors, and of the errors by its steps alone.
    means: [[f64; 3]; AVERAGED.len()],
}

impl Slow {
    fn and(mut self, other: &Self) -> Self {
        self.readings += other.readings;
        self.squares += other.squares;
        for (mine, others) in self.means.iter_mut().flatten().zip(other.means.iter().flatten()) {
            *mine += others;
        }
        self
    }

    /// Innovations are white, `are_white`, whatever part of them is noise of the command.
    fn share(&self, are_white: bool) -> f64 {
        let of = |(samples, [left, noisy, plain]): (&usize, &[f64; 3])| {
            let white = if are_white { self.squares / *samples as f64 } else { 0.0 };
            let chance = CLEARLY_PRESENT * 2.0 / (*samples as f64 * self.readings as f64).sqrt();
            (left - noisy.max(*plain).max(white)) / self.squares - chance
        };
        AVERAGED.iter().zip(&self.means).map(of).fold(0.0, f64::max)
    }
}

fn of_window(
    campaign: &Campaign,
    fit: &ArmFit,
    window: &Window,
    all_masks: &[Masks],
) -> Option<Vec<Slow>> {
    let masks = &all_masks[window.run];
    let predicted = predict(&fit.body.arm, campaign, window)?;
    let run = &campaign.runs[window.run];
    let (first, seed) = (*window.samples.start(), window.run as u64);
    let channels = predicted.channels.iter().zip(&fit.noise).enumerate();
    let errors_of = |(channel, (predicted, noise)): (usize, (&Vec<f64>, &SensorNoise))| {
        let logged = &channel_of(run, channel)[window.samples.clone()];
        let mut source = Xoshiro256PlusPlus::seed_from_u64(seed << 8 | channel as u64);
        let errors = |k: usize| {
            let normal: f64 = StandardNormal.sample(&mut source);
            let shown = |noise_added: f64| {
                reading(predicted[k] + noise_added, logged[k], noise.step) - predicted[k]
            };
            [logged[k] - predicted[k], shown(noise.sigma * normal), shown(0.0)]
        };
        (0..logged.len()).map(errors).collect::<Vec<_>>()
    };
    let mut errors: Vec<Vec<[f64; 3]>> = channels.map(errors_of).collect();
    if fit.command_noise > 0.0 {
        innovate(campaign, fit, window, all_masks, &mut errors);
    }
    let counts = |channel: usize, k: usize| masks[channel].as_ref().is_none_or(|m| m[first + k]);
    Some(errors.iter().enumerate().map(|(c, errors)| slow(errors, |k| counts(c, k))).collect())
}

/// Residuals, and those by errors of the sensors, as innovations.
fn innovate(
    campaign: &Campaign,
    fit: &ArmFit,
    window: &Window,
    masks: &[Masks],
    errors: &mut [Vec<[f64; 3]>],
) {
    let (noise, command_noise) = fit.assumed_noise();
    let sampling = Sampling { noise, blocks: &[], masks, command_noise };
    let one = |which: usize| {
        errors.iter().map(|channel| channel.iter().map(|e| e[which]).collect()).collect()
    };
    let series: Vec<Vec<Vec<f64>>> = (0..3).map(one).collect();
    let found = innovations(&fit.body.arm, campaign, window, sampling, &series);
    for (which, channels) in found.iter().enumerate() {
        for (errors, values) in errors.iter_mut().zip(channels) {
            errors.iter_mut().zip(values).for_each(|(e, value)| e[which] = *value);
        }
    }
}

fn channel_of(run: &Run, channel: usize) -> &[f64] {
    match channel.checked_sub(1) {
        None => run.motor(),
        Some(tip) => &run.tips()[tip],
    }
}

fn slow(errors: &[[f64; 3]], counts: impl Fn(usize) -> bool) -> Slow {
    let mut sums = Slow::default();
    for (_, error) in errors.iter().enumerate().filter(|(k, _)| counts(*k)) {
        sums.readings += 1;
        sums.squares += error[0] * error[0];
    }
    for (samples, means) in AVERAGED.iter().zip(&mut sums.means) {
        for (block, errors) in errors.chunks_exact(*samples).enumerate() {
            if !(0..*samples).all(|k| counts(block * samples + k)) {
                continue;
            }
            for (which, mean) in means.iter_mut().enumerate() {
                let sum: f64 = errors.iter().map(|e| e[which]).sum();
                *mean += sum * sum / *samples as f64;
            }
        }
    }
    sums
}
