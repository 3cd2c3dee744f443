//! Tests whether a mode has another frequency in the log: one frequency is changed at a time,
//! and the residuals are compared.

use crate::identify::found_arm::FoundArm;
use crate::identify::output_error::{Masks, masks};
use crate::identify::validation::motion_fit::{FollowedLog, PredictedStretch, followed, logged};
use crate::identify::validation::thresholds::{MODE_MOVED_BY, MODE_MOVED_LEAVES};
use crate::record::Campaign;
use crate::replay::ModalArm;

/// Relative change of a frequency over which the motion's own change is taken.
const PROBE: f64 = 1e-3;
/// A frequency is moved by no more than this share at a time…
const LARGEST_STEP: f64 = 0.1;
/// …so many times…
const STEPS: usize = 4;
/// …or until less than this share of the squared residual goes by it.
const STILL: f64 = 0.01;

/// What changes together with the frequency of a mode.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum MovedBy {
    /// Only the frequency: another load; the stiffness of the mode is unchanged.
    Load,
    /// The stiffness of the mode, in proportion to the square of its frequency: a stiffer or softer beam.
    Stiffness,
}

/// A mode that has another frequency in the log.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MovedMode {
    /// Index of the mode, from 0.
    pub mode: usize,
    /// What changes with the frequency: another load, or another stiffness of the beam.
    pub by: MovedBy,
    /// Frequency in the result \[rad/s\].
    pub omega_rad_s: f64,
    /// Frequency that describes the log \[rad/s\].
    pub of_log_rad_s: f64,
    /// Squared residual with this frequency divided by that of the result's arm \[1\]; each channel is weighted with
    /// its own residual.
    pub residual_ratio: f64,
}

/// The mode whose frequency, moved, explains most of what is left of the motion `at` that time; `None` where
/// moving one leaves more than half of the squared residual.
///
/// Gauss-Newton on one frequency; initial states are found anew each time, and nothing is taken from the linear model
/// but the next step: what is left is that of the arm so moved.
pub(super) fn moved_mode(
    found: &FoundArm,
    campaign: &Campaign,
    at: &FollowedLog,
) -> Option<MovedMode> {
    let weights: Vec<f64> = at.horizon.channels.iter().map(|c| c.residual_rms.powi(-2)).collect();
    if weights.iter().any(|w| !w.is_finite()) {
        return None;
    }
    let search = ModeSearch { campaign, masks: masks(campaign), weights, at };
    let modes = 0..found.arm.modes.len();
    let ways = modes.flat_map(|mode| [(mode, MovedBy::Load), (mode, MovedBy::Stiffness)]);
    let moved = ways.filter_map(|(mode, by)| search.moved(&found.arm, mode, by));
    let tells = |m: &MovedMode| {
        let moved = (m.of_log_rad_s / m.omega_rad_s - 1.0).abs();
        m.residual_ratio < MODE_MOVED_LEAVES && moved > MODE_MOVED_BY
    };
    moved.filter(tells).min_by(|a, b| a.residual_ratio.total_cmp(&b.residual_ratio))
}

struct ModeSearch<'a> {
    campaign: &'a Campaign,
    masks: Vec<Masks>,
    weights: Vec<f64>,
    at: &'a FollowedLog,
}

impl ModeSearch<'_> {
    fn moved(&self, arm: &ModalArm, mode: usize, by: MovedBy) -> Option<MovedMode> {
        let omega_rad_s = arm.modes[mode].omega_rad_s;
        let with = |share: f64| {
            let mut arm = arm.clone();
            arm.modes[mode].omega_rad_s *= share;
            if by == MovedBy::Stiffness {
                arm.modes[mode].stiffness_nm_per_rad *= share * share;
            }
            followed(&arm, self.campaign, self.at.horizon.length_s, &self.at.windows)
        };
        let whole = self.left(&self.at.stretches, &self.at.stretches)?;
        let (mut share, mut left) = (1.0, whole);
        let mut stretches = self.at.stretches.clone();
        for _ in 0..STEPS {
            let Some(probed) = with(share * (1.0 + PROBE)) else { break };
            let Some(step) = self.step(&stretches, &probed.stretches) else { break };
            let further = share * (1.0 + step.clamp(-LARGEST_STEP, LARGEST_STEP));
            let Some(next) = with(further) else { break };
            let Some(less) = self.left(&next.stretches, &self.at.stretches) else { break };
            if less >= left {
                break;
            }
            let still = left - less < STILL * whole;
            (share, left, stretches) = (further, less, next.stretches);
            if still {
                break;
            }
        }
        (left < whole).then_some(MovedMode {
            mode,
            by,
            omega_rad_s,
            of_log_rad_s: share * omega_rad_s,
            residual_ratio: left / whole,
        })
    }

    /// Relative change of the frequency that the residual asks for.
    fn step(&self, now: &[PredictedStretch], probed: &[PredictedStretch]) -> Option<f64> {
        let (mut with_residual, mut squares) = (0.0, 0.0);
        self.each(now, probed, |weight, y, now, probed| {
            let slope = (probed - now) / PROBE;
            with_residual += weight * (y - now) * slope;
            squares += weight * slope * slope;
        })?;
        let step = with_residual / squares;
        step.is_finite().then_some(step)
    }

    /// Squared residual, weighted, of the same stretches as `like`.
    fn left(&self, stretches: &[PredictedStretch], like: &[PredictedStretch]) -> Option<f64> {
        let mut sum = 0.0;
        self.each(stretches, like, |weight, y, p, _| sum += weight * (y - p).powi(2))?;
        sum.is_finite().then_some(sum)
    }

    /// Calls `add` with weight, reading and both predictions of every sample; `None` where these are not of the same
    /// stretches.
    fn each(
        &self,
        a: &[PredictedStretch],
        b: &[PredictedStretch],
        mut add: impl FnMut(f64, f64, f64, f64),
    ) -> Option<()> {
        let same = |(a, b): (&PredictedStretch, &PredictedStretch)| {
            a.run == b.run && a.first == b.first && a.channels[0].len() == b.channels[0].len()
        };
        if a.len() != b.len() || !a.iter().zip(b).all(same) {
            return None;
        }
        for (a, b) in a.iter().zip(b) {
            for (channel, weight) in self.weights.iter().enumerate() {
                let read = logged(self.campaign, a, channel);
                let mask = self.masks[a.run][channel].as_ref();
                let both = a.channels[channel].iter().zip(&b.channels[channel]);
                for ((y, (p, q)), k) in read.iter().zip(both).zip(a.first..) {
                    if mask.is_none_or(|m| m[k]) {
                        add(*weight, *y, *p, *q);
                    }
                }
            }
        }
        Some(())
    }
}
