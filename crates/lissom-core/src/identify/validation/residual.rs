//! Tests whether a residual is white, and whether it is correlated with the command.

use rayon::prelude::*;
use statrs::distribution::{ChiSquared, ContinuousCDF as _};

use crate::identify::output_error::{Masks, masks};
use crate::identify::prepare::channel_noise::channel_noise;
use crate::identify::thresholds::NORMAL_95;
use crate::identify::validation::motion_fit::{PredictedStretch, logged};
use crate::identify::validation::thresholds::AT_SENSOR_NOISE;
use crate::record::{Campaign, Run};

/// Lags looked at, to either side.
const LAGS: usize = 25;
/// Lags over which the band of the cross-correlation gathers the colour of both signals, at most…
const COLOUR: usize = 500;
/// …and as a share of a stretch.
const COLOUR_SHARE: usize = 4;

/// Residual of one channel, and its tests.
///
/// ```text
/// r_k = Σ e_t·e_{t+k}/Σ e_t²                       band ±1.96/√N
/// Q   = N·(N + 2)·Σ_{k=1}^{25} r_k²/(N − k)        χ² of 25 degrees of freedom if e is white
/// c_k = Σ e_{t+k}·u_t/√(Σe²·Σu²)                   band ±1.96·√(Σ_j r_j·ρ_j/N), ρ of the command
/// ```
///
/// e is the residual, u the command, N the number of samples and ρ_j the autocorrelation of the command.
///
/// # Source
/// `[LjungBox1978]` for Q; `[Ljung1999, Section 16.6]` for both tests and the band of c_k.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ChannelResidual {
    /// Number of samples N.
    pub samples: usize,
    /// Root mean square of the residual, in the unit of the channel.
    pub rms: f64,
    /// Step of the sensor, in the unit of the channel; 0 if its samples show none.
    pub sensor_step: f64,
    /// Noise of the sensor itself, in the unit of the channel; at least its step divided by √12.
    pub sensor_noise: f64,
    /// Autocorrelation r_0 to r_25.
    pub autocorrelation: Vec<f64>,
    /// Half width of its 95 % band.
    pub autocorrelation_band: f64,
    /// Ljung-Box statistic Q.
    pub ljung_box: f64,
    /// Probability that white noise gives a Q at least as large.
    pub white_probability: f64,
    /// Cross-correlation c_−25 to c_25 with the command; at positive lags the residual comes after the command.
    pub cross_correlation: Vec<f64>,
    /// Half width of its 95 % band.
    pub cross_correlation_band: f64,
}

impl ChannelResidual {
    /// Lags of the cross-correlation, in samples.
    pub fn lags(&self) -> Vec<isize> {
        let half = (self.cross_correlation.len() / 2).cast_signed();
        (-half..=half).collect()
    }

    /// Whether the residual exceeds the noise of the sensor by more than half.
    pub fn is_beyond_noise(&self) -> bool {
        self.rms >= AT_SENSOR_NOISE * self.sensor_noise
    }

    /// Share of the lags at which the cross-correlation is outside its band \[1\].
    pub fn outside(&self) -> f64 {
        let beyond = |c: &&f64| c.abs() > self.cross_correlation_band;
        self.cross_correlation.iter().filter(beyond).count() as f64
            / self.cross_correlation.len() as f64
    }
}

/// Tests every channel over all stretches; empty without a stretch.
pub(super) fn channel_residuals(
    campaign: &Campaign,
    stretches: &[PredictedStretch],
) -> Vec<ChannelResidual> {
    let channels = if stretches.is_empty() { 0 } else { campaign.channels.tips.len() + 1 };
    let channels = (0..channels).into_par_iter().with_max_len(1);
    channels.map(|channel| channel_residual(campaign, stretches, channel)).collect()
}

/// Tests channel `channel` over all stretches.
fn channel_residual(
    campaign: &Campaign,
    stretches: &[PredictedStretch],
    channel: usize,
) -> ChannelResidual {
    let masks = masks(campaign);
    let pairs: Vec<Pair> =
        stretches.iter().map(|s| Pair::new(campaign, &masks, s, channel)).collect();
    let samples: usize = pairs.iter().map(|p| p.residual.len()).sum();
    let n = samples as f64;
    let power = |of: fn(&Pair) -> &[f64]| -> f64 {
        pairs.iter().flat_map(of).map(|x| x * x).sum::<f64>().max(f64::MIN_POSITIVE)
    };
    let (left, driven) = (power(|p| &p.residual), power(|p| &p.command));
    let sum = |a: fn(&Pair) -> &[f64], b: fn(&Pair) -> &[f64], lag: usize| -> f64 {
        pairs.iter().map(|p| product(a(p), b(p), lag)).sum()
    };
    let own = |lag: usize| sum(|p| &p.residual, |p| &p.residual, lag) / left;
    let of_command = |lag: usize| sum(|p| &p.command, |p| &p.command, lag) / driven;
    let autocorrelation: Vec<f64> = (0..=LAGS).map(own).collect();
    let ljung_box = (1..=LAGS)
        .map(|k| n * (n + 2.0) * autocorrelation[k].powi(2) / (n - k as f64).max(1.0))
        .sum::<f64>();
    let after = |lag: usize| sum(|p| &p.residual, |p| &p.command, lag);
    let before = |lag: usize| sum(|p| &p.command, |p| &p.residual, lag);
    let scale = (left * driven).sqrt();
    let cross = (1..=LAGS).rev().map(before).chain((0..=LAGS).map(after));
    let shortest = pairs.iter().map(|p| p.residual.len()).max().unwrap_or(0);
    let colour = (shortest / COLOUR_SHARE).min(COLOUR);
    let both: f64 = 1.0 + 2.0 * (1..=colour).map(|k| own(k) * of_command(k)).sum::<f64>();
    let (sensor_step, sensor_noise) = sensor(campaign, channel);
    ChannelResidual {
        samples,
        rms: (left / n.max(1.0)).sqrt(),
        sensor_step,
        sensor_noise,
        autocorrelation_band: NORMAL_95 / n.max(1.0).sqrt(),
        white_probability: ChiSquared::new(LAGS as f64).map_or(f64::NAN, |chi| chi.sf(ljung_box)),
        autocorrelation,
        ljung_box,
        cross_correlation: cross.map(|c| c / scale).collect(),
        cross_correlation_band: NORMAL_95 * (both.max(0.0) / n.max(1.0)).sqrt(),
    }
}

/// Residual and command of a stretch, each about its mean over the stretch.
struct Pair {
    residual: Vec<f64>,
    command: Vec<f64>,
}

impl Pair {
    /// A reading at the end of its sensor's range leaves nothing.
    fn new(
        campaign: &Campaign,
        masks: &[Masks],
        stretch: &PredictedStretch,
        channel: usize,
    ) -> Self {
        let run = &campaign.runs[stretch.run];
        let logged = logged(campaign, stretch, channel).iter();
        let counts = |k: usize| masks[stretch.run][channel].as_ref().is_none_or(|m| m[k]);
        let residual = logged
            .zip(&stretch.channels[channel])
            .zip(stretch.first..)
            .map(|((y, p), k)| if counts(k) { y - p } else { 0.0 })
            .collect();
        let n = stretch.channels[channel].len();
        Self {
            residual: centred(residual),
            command: centred(run.command()[stretch.first..stretch.first + n].to_vec()),
        }
    }
}

fn centred(mut x: Vec<f64>) -> Vec<f64> {
    let mean = x.iter().sum::<f64>() / x.len().max(1) as f64;
    for v in &mut x {
        *v -= mean;
    }
    x
}

/// Σ a_{t+lag}·b_t.
fn product(a: &[f64], b: &[f64], lag: usize) -> f64 {
    a.iter().skip(lag).zip(b).map(|(x, y)| x * y).sum()
}

/// Step and noise of a channel's sensor: medians over the runs.
fn sensor(campaign: &Campaign, channel: usize) -> (f64, f64) {
    let samples = |run: &'_ Run| match channel.checked_sub(1) {
        None => channel_noise(run.motor()),
        Some(tip) => channel_noise(&run.tips()[tip]),
    };
    let found: Vec<_> = campaign.runs.iter().map(samples).collect();
    let median = |mut x: Vec<f64>| {
        x.sort_by(f64::total_cmp);
        x[x.len() / 2]
    };
    let steps = found.iter().map(|f| f.step).collect();
    (median(steps), median(found.iter().map(|f| f.std).collect()))
}
