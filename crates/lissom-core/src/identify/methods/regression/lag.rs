//! Lag of the angle behind the command, as a first-order filter or as a delay.

use crate::identify::methods::regression::missing::MissingTerm;
use crate::identify::methods::regression::motor_columns::{DRY, MotorColumns};
use crate::identify::methods::regression::motor_rows::MotorRows;
use crate::identify::methods::regression::normal::{NormalSums, Term};
use crate::identify::methods::regression::thresholds::{
    LAG_EXPLAINS, LAG_SAMPLES_MOST, LAG_SHAPE_TOLD,
};
use crate::identify::prepare::run_noise::RunNoise;
use crate::identify::thresholds::LAG_HALF_SAMPLE;
use crate::record::{Campaign, Hold, Run};

/// Steps of the search, each over half of the range of the one before.
const ROUNDS: usize = 5;
/// Times that are tried in a step.
const TRIED: usize = 5;

/// Form of a lag of the logged angle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LagShape {
    /// A first-order filter; the time is its time constant.
    Filter,
    /// A delay.
    Delay,
    /// The logs do not distinguish the two.
    Either,
}

/// A lag of the angle behind the command; negative if the command lags behind the angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AngleLag {
    /// Time constant or delay \[s\].
    pub time_s: f64,
    /// The same time in samples.
    pub samples: f64,
    /// Filter or delay.
    pub shape: LagShape,
    /// Residual with the lag divided by the residual without it \[1\].
    pub residual_ratio: f64,
}

impl AngleLag {
    /// Whether it is the difference between a held and a measured command.
    pub(crate) fn is_half_a_sample(&self) -> bool {
        (self.samples.abs() / 0.5 - 1.0).abs() < LAG_HALF_SAMPLE
    }

    /// The same with a longer time.
    #[must_use]
    pub(crate) fn longer_by(self, more_s: f64) -> Self {
        let time_s = self.time_s + more_s;
        Self { time_s, samples: self.samples * time_s / self.time_s, ..self }
    }

    /// The campaign with commands that are as late as the angle.
    pub(crate) fn late(&self, campaign: &Campaign) -> Campaign {
        let runs: Vec<&Run> = campaign.runs.iter().collect();
        delayed(campaign, &runs, self.shape, self.time_s)
    }
}

/// The lag with the smallest residual, up to three times the delay that the equation is `missing`: the command is filtered or
/// delayed as the angle was, or taken earlier for a negative delay. `None` if the residual does not fall to
/// [`LAG_EXPLAINS`].
pub(super) fn angle_lag(
    campaign: &Campaign,
    noise: &[RunNoise],
    missing: &MissingTerm,
) -> Option<AngleLag> {
    let terms = MotorColumns::of(campaign).terms(Term::Signed(DRY));
    let first_s = missing.value;
    let mut samples = 0;
    let few = |run: &&Run| {
        let before = samples;
        samples += run.len();
        before < LAG_SAMPLES_MOST
    };
    let runs: Vec<&Run> = campaign.runs.iter().take_while(few).collect();
    let left = |shape: LagShape, time_s: f64| -> f64 {
        let late = delayed(campaign, &runs, shape, time_s);
        let clusters = MotorRows::of(&late, noise).clusters(missing.window_s);
        let sums = NormalSums::of(&clusters, &terms);
        sums.and_then(|s| s.relative_residual()).unwrap_or(f64::INFINITY)
    };
    let without = left(LagShape::Delay, 0.0);
    let best = |shape: LagShape| least(first_s, |time_s| left(shape, time_s));
    let delay = best(LagShape::Delay);
    // A filter does not look ahead.
    let filter = if first_s > 0.0 { best(LagShape::Filter) } else { (0.0, f64::INFINITY) };
    let (shape, found) = if filter.1 < LAG_SHAPE_TOLD * delay.1 {
        (LagShape::Filter, filter)
    } else if first_s > 0.0 && delay.1 < LAG_SHAPE_TOLD * filter.1 {
        (LagShape::Delay, delay)
    } else {
        (LagShape::Either, if filter.1 < delay.1 { filter } else { delay })
    };
    let residual_ratio = found.1 / without;
    let samples = found.0 / runs.first()?.sample_time_s();
    (residual_ratio < LAG_EXPLAINS).then_some(AngleLag {
        time_s: found.0,
        samples,
        shape,
        residual_ratio,
    })
}

/// The time from zero to three times `first_s` with the least of `left`, and that.
fn least(first_s: f64, left: impl Fn(f64) -> f64) -> (f64, f64) {
    let (mut middle, mut half) = (1.5 * first_s, 1.5 * first_s.abs());
    let mut best = (0.0, f64::INFINITY);
    for _ in 0..ROUNDS {
        let step = 2.0 * half / (TRIED - 1) as f64;
        for i in 0..TRIED {
            let time_s = middle - half + i as f64 * step;
            let time_s = if first_s > 0.0 { time_s.max(0.0) } else { time_s.min(0.0) };
            let found = left(time_s);
            if found < best.1 {
                best = (time_s, found);
            }
        }
        (middle, half) = (best.0, step);
    }
    best
}

/// The campaign with its commands filtered or delayed.
fn delayed(campaign: &Campaign, runs: &[&Run], shape: LagShape, time_s: f64) -> Campaign {
    let runs = runs.iter().map(|run| {
        let command = match shape {
            LagShape::Filter => filtered(run, campaign.channels.command.hold, time_s),
            LagShape::Delay | LagShape::Either => shifted(run, time_s),
        };
        run.with_command(|k, _| command[k])
    });
    Campaign {
        channels: campaign.channels.clone(),
        runs: runs.collect(),
        gravity: campaign.gravity,
        mgl_nm: campaign.mgl_nm,
        hold_assumed: campaign.hold_assumed,
    }
}

/// A first-order low-pass of the command, its mean over each sample where it is held.
fn filtered(run: &Run, hold: Hold, time_s: f64) -> Vec<f64> {
    let ratio = run.sample_time_s() / time_s.max(f64::MIN_POSITIVE);
    let decay = (-ratio).exp();
    // Mean of e^{−t/T} over a sample.
    let mean = if ratio > 1e-9 { (1.0 - decay) / ratio } else { 1.0 };
    let command = run.command();
    let mut state = command[0];
    let mut out = Vec::with_capacity(command.len());
    for k in 0..command.len() {
        match hold {
            Hold::Sampled => {
                out.push(command[k] + (state - command[k]) * mean);
                state = command[k] + (state - command[k]) * decay;
            }
            Hold::Measured => {
                // Straight from sample to sample.
                if k > 0 {
                    let slope = command[k] - command[k - 1];
                    state = command[k] - slope * mean + (state - command[k - 1]) * decay;
                }
                out.push(state);
            }
        }
    }
    out
}

/// The command of `time_s` before, straight between samples.
fn shifted(run: &Run, time_s: f64) -> Vec<f64> {
    let command = run.command();
    let at = |k: usize| {
        let last = (command.len() - 1) as f64;
        let place = (k as f64 - time_s / run.sample_time_s()).clamp(0.0, last);
        let before = place as usize;
        let share = place - before as f64;
        let after = (before + 1).min(command.len() - 1);
        command[before] + share * (command[after] - command[before])
    };
    (0..command.len()).map(at).collect()
}
