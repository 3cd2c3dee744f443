//! Simulation under the logged command, compared with the logged motion.

use crate::identify::output_error::{Masks, follow, masks};
use crate::identify::validation::thresholds::FITS_PERCENT;
use crate::record::{Campaign, Run};
use crate::replay::{ModalArm, Window, predict};

/// Fewest samples of a horizon.
const LEAST_SAMPLES: f64 = 100.0;
/// Most horizons.
const MOST: usize = 5;
/// Horizons are 1 or 3 times a power of ten: this close to a run's length they say nothing more.
const APART: f64 = 1.5;

/// Prediction of motion over one length of time.
#[derive(Debug, Clone, PartialEq)]
pub struct Horizon {
    /// Longest time that is predicted from one initial state \[s\].
    pub length_s: f64,
    /// Whether runs are predicted from beginning to end.
    pub whole_runs: bool,
    /// Number of predicted parts of runs.
    pub windows: usize,
    /// Result of each channel: motor, then tips.
    pub channels: Vec<ChannelFit>,
}

/// Accuracy of a channel's prediction, over the readings within the range of its sensor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ChannelFit {
    /// Root mean square of logged minus predicted values, in the unit of the channel.
    pub residual_rms: f64,
    /// Fit `100·(1 − ‖y − ŷ‖/‖y − ȳ‖)`, with the mean ȳ of each run \[%\].
    pub fit_percent: f64,
}

/// A part of a run, predicted from one initial state.
#[derive(Debug, Clone, PartialEq)]
pub struct PredictedStretch {
    /// Index of the run.
    pub run: usize,
    /// Index of its first sample.
    pub first: usize,
    /// Predicted readings of motor and then tips, one per sample.
    pub channels: Vec<Vec<f64>>,
}

/// A horizon with what it was judged by.
pub(super) struct FollowedLog {
    pub(super) horizon: Horizon,
    pub(super) windows: Vec<Window>,
    pub(super) stretches: Vec<PredictedStretch>,
}

/// Lengths to predict over, the longest first: whole runs, or `longest_s`, then 1 and 3 times powers of
/// ten below.
pub(super) fn lengths_s(campaign: &Campaign, longest_s: Option<f64>) -> Vec<f64> {
    let durations = campaign.runs.iter().map(|r| r.len() as f64 * r.sample_time_s());
    let longest = longest_s.unwrap_or_else(|| durations.fold(0.0, f64::max));
    let sample_s = campaign.runs.iter().map(Run::sample_time_s).fold(0.0, f64::max);
    let least = LEAST_SAMPLES * sample_s;
    let mut lengths = vec![longest];
    let mut decade = 10_f64.powf(longest.log10().floor());
    while lengths.len() < MOST && 3.0 * decade >= least {
        let below = [3.0 * decade, decade];
        lengths.extend(below.into_iter().filter(|l| *l >= least && *l * APART <= longest));
        decade /= 10.0;
    }
    lengths.truncate(MOST);
    lengths
}

/// Predicts every run over stretches of `length_s`, which begin where `shorter` ones have come to;
/// `None` where no stretch can be begun.
pub(super) fn followed(
    arm: &ModalArm,
    campaign: &Campaign,
    length_s: f64,
    shorter: &[Window],
) -> Option<FollowedLog> {
    FollowedLog::of(arm, campaign, length_s, follow(arm, campaign, length_s, shorter))
}

/// The motion over the longest time over which every channel fits, otherwise over the shortest time. Longer times begin
/// where shorter ones have come to, but only the times from the longest down to the chosen one are predicted and compared.
///
/// `None` where no stretch can be begun.
pub(super) fn longest_fitting(arm: &ModalArm, campaign: &Campaign) -> Option<FollowedLog> {
    let mut begun: Vec<(f64, Vec<Window>)> = Vec::new();
    for length_s in lengths_s(campaign, None).into_iter().rev() {
        let shorter = begun.last().map_or(&[][..], |(_, windows)| windows);
        let windows = follow(arm, campaign, length_s, shorter);
        if !windows.is_empty() {
            begun.push((length_s, windows));
        }
    }
    let mut shortest = None;
    for (length_s, windows) in begun.into_iter().rev() {
        let followed = FollowedLog::of(arm, campaign, length_s, windows);
        if followed.as_ref().is_some_and(FollowedLog::fits) {
            return followed;
        }
        shortest = followed.or(shortest);
    }
    shortest
}

impl FollowedLog {
    fn of(
        arm: &ModalArm,
        campaign: &Campaign,
        length_s: f64,
        windows: Vec<Window>,
    ) -> Option<Self> {
        let stretch = |w: &Window| {
            let channels = predict(arm, campaign, w)?.channels;
            Some(PredictedStretch { run: w.run, first: *w.samples.start(), channels })
        };
        let stretches: Vec<PredictedStretch> = windows.iter().filter_map(stretch).collect();
        if stretches.is_empty() {
            return None;
        }
        let masks = masks(campaign);
        let channels =
            (0..=campaign.channels.tips.len()).map(|c| fit(campaign, &masks, &stretches, c));
        let whole_runs = campaign
            .runs
            .iter()
            .all(|r| r.len() as f64 * r.sample_time_s() <= length_s * (1.0 + 1e-9));
        let horizon = Horizon {
            length_s,
            whole_runs,
            windows: stretches.len(),
            channels: channels.collect(),
        };
        Some(Self { horizon, windows, stretches })
    }

    /// Whether every channel fits.
    pub(super) fn fits(&self) -> bool {
        self.horizon.channels.iter().all(|c| c.fit_percent >= FITS_PERCENT)
    }

    /// Whether the predicted motion is finite.
    pub(super) fn is_finite(&self) -> bool {
        self.horizon.channels.iter().all(|c| c.residual_rms.is_finite())
    }
}

/// The samples of a channel that a stretch predicts.
pub(super) fn logged<'a>(
    campaign: &'a Campaign,
    stretch: &PredictedStretch,
    channel: usize,
) -> &'a [f64] {
    let run = &campaign.runs[stretch.run];
    let samples = match channel.checked_sub(1) {
        None => run.motor(),
        Some(tip) => &run.tips()[tip],
    };
    &samples[stretch.first..stretch.first + stretch.channels[channel].len()]
}

fn fit(
    campaign: &Campaign,
    masks: &[Masks],
    stretches: &[PredictedStretch],
    channel: usize,
) -> ChannelFit {
    let (mut left, mut power, mut number) = (0.0, 0.0, 0_usize);
    for of_run in stretches.chunk_by(|a, b| a.run == b.run) {
        let pairs = || {
            of_run.iter().flat_map(|s| {
                logged(campaign, s, channel)
                    .iter()
                    .zip(&s.channels[channel])
                    .zip(s.first..)
                    .filter(|(_, k)| masks[s.run][channel].as_ref().is_none_or(|m| m[*k]))
                    .map(|(pair, _)| pair)
            })
        };
        let samples = pairs().count();
        let mean = pairs().map(|(y, _)| y).sum::<f64>() / samples.max(1) as f64;
        left += pairs().map(|(y, p)| (y - p).powi(2)).sum::<f64>();
        power += pairs().map(|(y, _)| (y - mean).powi(2)).sum::<f64>();
        number += samples;
    }
    let residual_rms = (left / number.max(1) as f64).sqrt();
    let fit_percent = if power > 0.0 { 100.0 * (1.0 - (left / power).sqrt()) } else { 0.0 };
    ChannelFit { residual_rms, fit_percent }
}
