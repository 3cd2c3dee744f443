//! Finds the clock of another log, such as that of a camera, from the motion that both logs show.
//!
//! A stamp s of the other log and the time t of the motor's log are related by s = offset + (1 + drift)·t. A constant
//! delay of the sensor is part of the offset. [`other_clock`] finds both in these steps:
//!
//! 1. Both signals are averaged over blocks of about 10 ms around each point, which does not shift them.
//! 2. Cross-correlation gives some offsets at which they look alike.
//! 3. From each of these, the signal is explained by the motor's motion, by least squares, with offset and drift as
//!    further unknowns. A signal of the arm follows the motor's angle by a symmetric kernel, because an undamped arm has
//!    no phase but 0 and π. Vibrations that do not follow count less: the residual is made white by an autoregressive
//!    model. A torque follows acceleration, speed, its sign, and gravity while the motor moves.
//! 4. The offset with the smallest variance of the white residual is used. If another one is nearly as good, the motion
//!    repeats. If the motion explains hardly more than the signal's own past, the logs share no motion.
//!
//! Standard errors are from the scatter between twelve blocks of time, and from the error of the models: damping of the
//! arm shifts its motion by a little.

mod coarse;
mod even_signal;
mod fit;
mod regressors;
pub(crate) mod thresholds;

pub use regressors::Follows;

use rayon::prelude::*;
use thiserror::Error;

use even_signal::EvenSignal;
use fit::{Effort, Fit, fit};
use regressors::Regressors;
use thresholds::{
    DRIFT_SHOWS, MODEL_SHIFT_S, REPEATS, SHARED_GAIN, SHARED_LEAST, VIBRATION_SHIFT_S,
};

/// Shortest and usual longest block over which signals are averaged \[s\].
const BLOCK_S: (f64, f64) = (0.01, 0.02);
/// A log has this many blocks, if they are not longer than usual, and at most this many.
const BLOCKS: (f64, f64) = (8000.0, 40_000.0);
/// Most blocks that are used in the search: those with the largest motion.
const SEARCH_BLOCKS: usize = 4000;
/// Half of the length of the kernel in the search, and in the fit \[s\].
const REACH_S: (f64, f64) = (0.5, 1.0);
/// Around an offset of the search, others are tried at these distances [s].
const AROUND_S: [f64; 8] = [-0.16, -0.12, -0.08, -0.04, 0.04, 0.08, 0.12, 0.16];
/// Offsets that are fitted in full.
const FITTED: usize = 3;
/// Most points of an even grid.
const MOST_POINTS: f64 = 8e6;
/// Fewest samples of a log.
const LEAST: usize = 50;

/// The clock of another log.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OtherClock {
    /// Stamp of the other log minus the time of the reference, in the middle of the time that both share \[s\].
    pub offset_s: f64,
    /// Standard error of the offset \[s\].
    pub offset_std_s: f64,
    /// The other clock runs faster by this share \[1\]; 0 if the logs do not show that it drifts.
    pub drift: f64,
    /// Standard error of the drift \[1\].
    pub drift_std: f64,
    /// Middle of the time that both logs share, on the reference \[s\].
    pub middle_s: f64,
    /// Share of the signal that follows the motion \[1\].
    pub explained: f64,
    /// If the motion repeats, so that other offsets fit as well: distance of the nearest of these \[s\].
    pub repeats_s: Option<f64>,
}

impl OtherClock {
    /// The time of the reference at a stamp of the other log \[s\].
    pub fn reference_s(&self, stamp_s: f64) -> f64 {
        self.middle_s + (stamp_s - self.offset_s - self.middle_s) / (1.0 + self.drift)
    }

    /// The stamp of the other log at a time of the reference \[s\].
    pub fn other_s(&self, time_s: f64) -> f64 {
        self.middle_s + self.offset_s + (1.0 + self.drift) * (time_s - self.middle_s)
    }

    fn of(found: &Fit, follows: Follows) -> Self {
        let shift_s = match follows {
            Follows::Acceleration => VIBRATION_SHIFT_S,
            Follows::Angle | Follows::Torque => MODEL_SHIFT_S,
        };
        let drift_std = found.drift_std.hypot(2.0 * shift_s / found.length_s);
        let drifts = found.drift.abs() > DRIFT_SHOWS * drift_std;
        Self {
            offset_s: found.offset_s + found.drift * found.middle_s,
            offset_std_s: found.offset_std_s.hypot(shift_s),
            drift: if drifts { found.drift } else { 0.0 },
            drift_std,
            middle_s: found.middle_s,
            explained: found.explained,
            repeats_s: None,
        }
    }
}

/// Why the clock of another log is not found.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum OtherClockError {
    /// A log has too few samples.
    #[error("a log has {found} samples, and {least} are needed")]
    FewSamples {
        /// Samples of the shorter log.
        found: usize,
        /// Fewest samples.
        least: usize,
    },
    /// The signal does not follow the motion at any offset.
    #[error("the logs share no motion")]
    NoSharedMotion {
        /// Largest share of the signal that follows the motion at some offset \[1\].
        explained: f64,
    },
}

/// A signal with its increasing time stamps.
#[derive(Debug, Clone, Copy)]
pub struct StampedSignal<'a> {
    /// Time stamps \[s\].
    pub stamps_s: &'a [f64],
    /// Values, as many.
    pub values: &'a [f64],
}

impl StampedSignal<'_> {
    /// The median step; longer if a gap would make the even grid too large.
    fn step_s(&self) -> f64 {
        let mut steps: Vec<f64> = self.stamps_s.windows(2).map(|w| w[1] - w[0]).collect();
        let middle = steps.len() / 2;
        let median_s = *steps.select_nth_unstable_by(middle, f64::total_cmp).1;
        median_s.max(self.length_s() / MOST_POINTS)
    }

    fn length_s(&self) -> f64 {
        self.stamps_s[self.stamps_s.len() - 1] - self.stamps_s[0]
    }

    fn has_motion(&self) -> bool {
        let first = self.values.first().copied().unwrap_or_default();
        self.values.iter().any(|v| (v - first).abs() > 0.0)
    }
}

/// Finds the clock of `other`, a signal that `follows` the angle \[rad or m\] of the motor in `motor`.
///
/// # Errors
/// [`OtherClockError`].
pub fn other_clock(
    motor: StampedSignal<'_>,
    other: StampedSignal<'_>,
    follows: Follows,
) -> Result<OtherClock, OtherClockError> {
    if motor.stamps_s.len() < LEAST || other.stamps_s.len() < LEAST {
        let found = motor.stamps_s.len().min(other.stamps_s.len());
        return Err(OtherClockError::FewSamples { found, least: LEAST });
    }
    if !(motor.has_motion() && other.has_motion()) {
        return Err(OtherClockError::NoSharedMotion { explained: 0.0 });
    }
    let steps = (motor.step_s(), other.step_s());
    let length_s = motor.length_s().max(other.length_s());
    let block_s = steps.0.max(steps.1).max(block_s(length_s));
    let motion = EvenSignal::of(motor.stamps_s, motor.values, steps.0, block_s);
    let signal = EvenSignal::of(other.stamps_s, other.values, steps.1, block_s).every(block_s);
    let step_s = signal.step_s;
    let whitened = follows != Follows::Torque;
    let few = signal.every(BLOCK_S.1).liveliest(SEARCH_BLOCKS);
    let search = Regressors::new(&motion, follows, few.step_s, REACH_S.0);
    let effort = Effort { steps: 4, with_drift: false, whitened };
    let searched = |offsets: Vec<f64>| {
        offsets.into_par_iter().filter_map(|offset_s| fit(&search, &few, offset_s, effort))
    };
    let mut found: Vec<Fit> = searched(coarse::offsets(&motion, &signal, follows)).collect();
    found.sort_by(|a, b| a.innovation.total_cmp(&b.innovation));
    if follows == Follows::Acceleration {
        // Vibrations follow late: the best offset may be between two that look alike.
        let best = found.iter().take(FITTED).map(|f| f.offset_s);
        let around = best.flat_map(|offset_s| AROUND_S.map(|away_s| offset_s + away_s)).collect();
        found.par_extend(searched(around));
        found.sort_by(|a, b| a.innovation.total_cmp(&b.innovation));
    }
    let mut apart: Vec<f64> = Vec::new();
    for offset_s in found.iter().map(|f| f.offset_s) {
        if apart.iter().all(|known| (known - offset_s).abs() > 1.5 * step_s) {
            apart.push(offset_s);
        }
    }
    let regressors = Regressors::new(&motion, follows, step_s, REACH_S.1);
    let effort = Effort { steps: 8, with_drift: true, whitened };
    apart.truncate(FITTED);
    let fitted = |offsets: Vec<f64>| {
        offsets.into_par_iter().filter_map(|offset_s| fit(&regressors, &signal, offset_s, effort))
    };
    let mut fits: Vec<Fit> = fitted(apart).collect();
    fits.sort_by(|a, b| a.innovation.total_cmp(&b.innovation));
    let best_s = fits.first().map(|best| best.offset_s);
    if let (Some(best_s), Some(period_s)) = (best_s, coarse::period_s(&motion, follows)) {
        fits.par_extend(fitted(vec![best_s - period_s, best_s + period_s]));
        fits.sort_by(|a, b| a.innovation.total_cmp(&b.innovation));
    }
    if let Some(best) = fits.first().map(|best| best.innovation) {
        // Of offsets that fit as well the one with the longest common time is the most probable.
        let alike = fits.partition_point(|f| f.innovation < REPEATS * best);
        fits[..alike].sort_by_key(|f| std::cmp::Reverse(f.rows));
    }
    let explained = fits.first().map_or(0.0, |best| best.explained).max(0.0);
    let Some(best) = fits.first().filter(|best| shares_motion(best)) else {
        return Err(OtherClockError::NoSharedMotion { explained });
    };
    let others = fits[1..].iter().filter(|f| f.innovation < REPEATS * best.innovation);
    let repeats_s = others
        .map(|f| (f.offset_s - best.offset_s).abs())
        .filter(|distance_s| *distance_s > 3.0 * step_s)
        .min_by(f64::total_cmp);
    Ok(OtherClock { repeats_s, ..OtherClock::of(best, follows) })
}

/// Length of the blocks of a log \[s\].
fn block_s(length_s: f64) -> f64 {
    (length_s / BLOCKS.0).clamp(BLOCK_S.0, BLOCK_S.1).max(length_s / BLOCKS.1)
}

/// Whether the motion explains more than the past of the signal does.
fn shares_motion(found: &Fit) -> bool {
    let gain = 0.5 * found.rows as f64 * (found.innovation_alone / found.innovation).ln();
    gain >= SHARED_GAIN * found.regressors as f64 && found.explained >= SHARED_LEAST
}
