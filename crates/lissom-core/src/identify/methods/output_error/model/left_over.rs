//! The share of a residual that no sensor's noise explains.

use rand_distr::{Distribution, StandardNormal};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};

use crate::identify::methods::output_error::engine::data::Masks;
use crate::identify::methods::output_error::model::fit::ArmFit;
use crate::identify::prepare::channel_noise::reading;
use crate::identify::thresholds::CLEARLY_PRESENT;
use crate::record::{Campaign, Run};
use crate::replay::{SensorNoise, Window, predict};

/// Numbers of samples over which means are taken: noise averages out, and motion that the arm lacks is slower.
const AVERAGED: [usize; 3] = [4, 16, 64];

/// Share of each channel's squared residual, motor first, that is slower than its sensor's noise and larger than
/// chance explains; zero if there is none.
///
/// A sensor's steps also make slow errors if the motion is slow. So the means of 4, 16 and 64 residuals are compared
/// with those that the same sensor would leave of the replayed motion itself, with its noise and without.
pub(crate) fn left_over(campaign: &Campaign, fit: &ArmFit, masks: &[Masks]) -> Vec<f64> {
    let of_windows: Vec<Vec<Slow>> = fit
        .windows
        .par_iter()
        .filter_map(|window| of_window(campaign, fit, window, &masks[window.run]))
        .collect();
    (0..fit.noise.len())
        .map(|channel| {
            let add = |sum: Slow, of: &Vec<Slow>| sum.and(&of[channel]);
            of_windows.iter().fold(Slow::default(), add).share()
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

    fn share(&self) -> f64 {
        let of = |(samples, [left, noisy, plain]): (&usize, &[f64; 3])| {
            let chance = CLEARLY_PRESENT * 2.0 / (*samples as f64 * self.readings as f64).sqrt();
            (left - noisy.max(*plain)) / self.squares - chance
        };
        AVERAGED.iter().zip(&self.means).map(of).fold(0.0, f64::max)
    }
}

fn of_window(
    campaign: &Campaign,
    fit: &ArmFit,
    window: &Window,
    masks: &Masks,
) -> Option<Vec<Slow>> {
    let predicted = predict(&fit.body.arm, campaign, window)?;
    let run = &campaign.runs[window.run];
    let (first, seed) = (*window.samples.start(), window.run as u64);
    let channels = predicted.channels.iter().zip(&fit.noise).enumerate();
    let of_channel = |(channel, (predicted, noise)): (usize, (&Vec<f64>, &SensorNoise))| {
        let logged = &channel_of(run, channel)[window.samples.clone()];
        let counts = |k: usize| masks[channel].as_ref().is_none_or(|mask| mask[first + k]);
        let mut source = Xoshiro256PlusPlus::seed_from_u64(seed << 8 | channel as u64);
        let errors = |k: usize| {
            let normal: f64 = StandardNormal.sample(&mut source);
            let shown = |noise_added: f64| {
                reading(predicted[k] + noise_added, logged[k], noise.step) - predicted[k]
            };
            [logged[k] - predicted[k], shown(noise.sigma * normal), shown(0.0)]
        };
        slow(&(0..logged.len()).map(errors).collect::<Vec<_>>(), counts)
    };
    Some(channels.map(of_channel).collect())
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
