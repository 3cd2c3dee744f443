//! Residual torque that a correct arm would have: it comes from the steps and noise of its sensors,
//! and from averaging in windows.

use rand_distr::{Distribution as _, StandardNormal};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng as _;

use crate::identify::prepare::channel_noise::{channel_noise, reading};
use crate::identify::validation::motion_fit::{FollowedLog, PredictedStretch, logged};
use crate::identify::validation::torque::{TorquePrediction, torque};
use crate::identify::validation::torque_arm::TorqueArm;
use crate::record::{Campaign, Run, TimeBase};
use crate::replay::Window;

/// Seed of the noise that is added.
const SEED: u64 = 1;

/// The torque of the arm's own motion under the logged command, with the noise and the
/// steps of the log's sensors, under a window of `window_s`.
///
/// `None` where no stretch followed holds a window.
pub(super) fn expected(
    found: TorqueArm<'_>,
    campaign: &Campaign,
    followed: &FollowedLog,
    window_s: f64,
) -> Option<TorquePrediction> {
    let mut source = Xoshiro256PlusPlus::seed_from_u64(SEED);
    let mut shown = |run: &Run, stretch: &PredictedStretch, channel: usize| -> Vec<f64> {
        let noise = channel_noise(match channel.checked_sub(1) {
            None => run.motor(),
            Some(tip) => &run.tips()[tip],
        });
        // Steps are made by rounding: what is added has the rest.
        let rest = (noise.std * noise.std - noise.step * noise.step / 12.0).max(0.0).sqrt();
        let of_sample = |(value, one): (&f64, &f64)| {
            let normal: f64 = StandardNormal.sample(&mut source);
            reading(value + rest * normal, *one, noise.step)
        };
        stretch.channels[channel]
            .iter()
            .zip(logged(campaign, stretch, channel))
            .map(of_sample)
            .collect()
    };
    let (mut runs, mut zeros) = (Vec::new(), Vec::new());
    for stretch in &followed.stretches {
        let begins = |w: &&Window| w.run == stretch.run && *w.samples.start() == stretch.first;
        let window = followed.windows.iter().find(begins)?;
        let run = &campaign.runs[stretch.run];
        let mut channels = (0..stretch.channels.len()).map(|c| shown(run, stretch, c));
        let motor = channels.next()?;
        let command = run.command()[stretch.first..stretch.first + motor.len()].to_vec();
        let time = TimeBase::uniform(0.0, run.sample_time_s());
        if let Ok(own) = Run::new(run.name(), time, command, motor, channels.collect()) {
            runs.push(own);
            zeros.push(window.zeros.clone());
        }
    }
    let own = Campaign::new(campaign.channels.clone(), runs).ok()?;
    torque(found, &own, &zeros, Some(window_s))
}
