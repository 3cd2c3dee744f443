//! Lag of the angle behind the command, as a first-order filter or as a delay.

use crate::identify::thresholds::LAG_HALF_SAMPLE;
use crate::record::{Campaign, CommandQuantity, Hold, Run, shifted};

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
    /// Standard error of the time \[s\].
    pub std_s: f64,
}

impl AngleLag {
    /// Whether it is the difference between a held and a measured command.
    pub(crate) fn is_half_a_sample(&self) -> bool {
        (self.samples.abs() / 0.5 - 1.0).abs() < LAG_HALF_SAMPLE
    }

    /// Whether all of the command's torque is late by a delay: not that of a filter, and not where a servo's goal alone is late.
    pub(crate) fn is_delay_of(&self, campaign: &Campaign) -> bool {
        let goal = campaign.channels.command.quantity == CommandQuantity::PositionError;
        self.shape != LagShape::Filter && !goal
    }

    /// The campaign with commands that are as late as the angle.
    pub(crate) fn late(&self, campaign: &Campaign) -> Campaign {
        delayed(campaign, self.shape, self.time_s)
    }
}

/// The campaign with its commands filtered or delayed; of a servo's position error only the goal is late.
pub(crate) fn delayed(campaign: &Campaign, shape: LagShape, time_s: f64) -> Campaign {
    let command = &campaign.channels.command;
    let late = |run: &Run| {
        let samples = time_s / run.sample_time_s();
        let in_time = |k: usize| match command.quantity {
            CommandQuantity::PositionError => command.hold.acting(run.motor(), k),
            _ => 0.0,
        };
        let goal: Vec<f64> =
            run.command().iter().enumerate().map(|(k, u)| u + in_time(k)).collect();
        let late = match shape {
            LagShape::Filter => filtered(&goal, command.hold, samples),
            LagShape::Delay | LagShape::Either => shifted(&goal, samples),
        };
        run.with_command(|k, _| late[k] - in_time(k))
    };
    Campaign {
        channels: campaign.channels.clone(),
        runs: campaign.runs.iter().map(late).collect(),
        gravity: campaign.gravity,
        mgl_nm: campaign.mgl_nm,
        hold_assumed: campaign.hold_assumed,
    }
}

/// A first-order low-pass of the command with a time constant in samples, its mean over each sample where it is held.
fn filtered(command: &[f64], hold: Hold, samples: f64) -> Vec<f64> {
    let ratio = 1.0 / samples.max(f64::MIN_POSITIVE);
    let decay = (-ratio).exp();
    // Mean of e^{−t/T} over a sample.
    let mean = if ratio > 1e-9 { (1.0 - decay) / ratio } else { 1.0 };
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
