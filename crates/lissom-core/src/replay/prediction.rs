//! Prediction of sensor readings under a logged command.

use super::late_tips::LateTips;
use super::modal_arm::{MOST_MODES, ModalArm};
use super::sums::{Sampling, Window, advance, filter_of, replayers, start};
use crate::record::Campaign;

/// Predicted readings over one window.
#[derive(Debug, Clone, PartialEq)]
pub struct Prediction {
    /// Readings of the motor and then of each tip, one per sample, in the unit of the channel. The first readings of a
    /// tip with a lag belong to motion before the window; they are copied from the log.
    pub channels: Vec<Vec<f64>>,
    /// Torque of friction against the motor, its mean from each sample to the next
    /// \[N·m\]; one value less than samples.
    pub friction_nm: Vec<f64>,
    /// Time for which the joint sticks \[s\].
    pub stuck_s: f64,
    /// State at the last sample, `[θ, θ̇, ψ_1, ψ̇_1, …]`.
    pub end: Vec<f64>,
}

/// Replays one window without derivatives; `None` for an arm with more than [`MOST_MODES`] modes.
pub fn predict(arm: &ModalArm, campaign: &Campaign, window: &Window) -> Option<Prediction> {
    match arm.modes.len() {
        0 => predict_of::<2>(arm, campaign, window),
        1 => predict_of::<4>(arm, campaign, window),
        2 => predict_of::<6>(arm, campaign, window),
        3 => predict_of::<8>(arm, campaign, window),
        MOST_MODES => predict_of::<10>(arm, campaign, window),
        _ => None,
    }
}

/// Innovations of a window, in standard deviations, for each of some series of residuals (by channel and sample). An innovation is
/// a reading minus its prediction from the readings before, where noise of the command moves the replay. It is zero for readings of
/// late tips and for readings that are masked.
pub fn innovations(
    arm: &ModalArm,
    campaign: &Campaign,
    window: &Window,
    sampling: Sampling<'_>,
    series: &[Vec<Vec<f64>>],
) -> Vec<Vec<Vec<f64>>> {
    match arm.modes.len() {
        0 => innovations_of::<2>(arm, campaign, window, sampling, series),
        1 => innovations_of::<4>(arm, campaign, window, sampling, series),
        2 => innovations_of::<6>(arm, campaign, window, sampling, series),
        3 => innovations_of::<8>(arm, campaign, window, sampling, series),
        MOST_MODES => innovations_of::<10>(arm, campaign, window, sampling, series),
        _ => Vec::new(),
    }
}

fn innovations_of<const D: usize>(
    arm: &ModalArm,
    campaign: &Campaign,
    window: &Window,
    sampling: Sampling<'_>,
    series: &[Vec<Vec<f64>>],
) -> Vec<Vec<Vec<f64>>> {
    let replayers = replayers::<D>(arm, &[], campaign, std::slice::from_ref(window), true);
    let Some((_, replayer)) = replayers.first() else { return Vec::new() };
    let run = &campaign.runs[window.run];
    let (first, samples) = (*window.samples.start(), window.len());
    let of = |residuals: &Vec<Vec<f64>>| {
        let mut found = vec![vec![0.0; samples]; residuals.len()];
        let mut filter = filter_of(replayer, sampling);
        let late = LateTips::new(replayer, window.samples.clone(), false);
        replayer.walk(run, window.samples.clone(), start(window), false, |seen| {
            advance(&mut filter, seen, window);
            let Some(beyond) = &mut filter else { return };
            for (channel, mask) in sampling.masks[window.run].iter().enumerate() {
                if !late.is_in_time(channel) || mask.as_ref().is_some_and(|m| !m[seen.sample]) {
                    continue;
                }
                let variance = sampling.noise[channel].deviation().powi(2);
                let residual = residuals[channel][seen.sample - first];
                let told = beyond.of(&replayer.shown(seen, channel), residual, variance);
                found[channel][seen.sample - first] = told.value / told.variance.sqrt();
                beyond.learn(&told, &mut seen.motion.tangents, None);
            }
        });
        found
    };
    series.iter().map(of).collect()
}

fn predict_of<const D: usize>(
    arm: &ModalArm,
    campaign: &Campaign,
    window: &Window,
) -> Option<Prediction> {
    let replayers = replayers::<D>(arm, &[], campaign, std::slice::from_ref(window), false);
    let (_, replayer) = replayers.first()?;
    let run = &campaign.runs[window.run];
    let first = *window.samples.start();
    let logged = |channel: &[f64]| channel[window.samples.clone()].to_vec();
    let mut channels = vec![logged(run.motor())];
    channels.extend(run.tips().iter().map(|tip| logged(tip)));
    let mut impulse = Vec::with_capacity(window.len());
    let mut late = LateTips::new(replayer, window.samples.clone(), false);
    let motion = replayer.walk(run, window.samples.clone(), start(window), false, |seen| {
        for (channel, values) in channels.iter_mut().enumerate() {
            let zero = channel.checked_sub(1).map_or(0.0, |tip| window.zeros[tip]);
            if let Some((sample, predicted)) = late.output(replayer, seen, channel, None) {
                values[sample - first] = predicted + zero;
            }
        }
        impulse.push(seen.motion.friction_impulse.unwrap_or(0.0));
    });
    let mean = |w: &[f64]| (w[1] - w[0]) / run.sample_time_s();
    let friction_nm = impulse.windows(2).map(mean).collect();
    Some(Prediction { channels, friction_nm, stuck_s: motion.stuck_s, end: motion.x.to_vec() })
}
