//! Time from the instant of the sensors until the current acts.

use std::collections::VecDeque;

use crate::rig::RigError;
use crate::rig::error::not_negative;

/// Longest delay, in samples.
const SAMPLES_MOST: f64 = 1e6;

/// A delay within this part of a sample of a whole number of samples is that number: such are
/// rounding errors of decimal times.
const WHOLE: f64 = 1e-9;

/// A constant delay of the command, caused by conversion, computation or communication.
///
/// It may have any length, also more than a sample: the command of the instant `t_k` acts from `t_k + d` to
/// `t_{k+1} + d`. Before the first command the current is zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Delay {
    delay_s: f64,
}

impl Delay {
    /// Builds a delay \[s\], zero or positive.
    ///
    /// # Errors
    /// [`RigError::Negative`] if it is negative or not finite.
    pub fn new(delay_s: f64) -> Result<Self, RigError> {
        Ok(Self { delay_s: not_negative("delay_s", delay_s)? })
    }

    /// The delay \[s\].
    pub fn delay_s(&self) -> f64 {
        self.delay_s
    }
}

/// Commands on their way to the motor.
#[derive(Debug, Clone)]
pub(in crate::rig) struct DelayLine {
    /// Oldest first: the one that acts at the start of the sample, then the one after it.
    waiting: VecDeque<f64>,
    /// How long within a sample the older one goes on \[s\].
    late_s: f64,
    rest_s: f64,
}

impl DelayLine {
    /// # Errors
    /// [`RigError::TooLong`] for delays of more than a million samples.
    pub(in crate::rig) fn new(delay: Option<Delay>, sample_time_s: f64) -> Result<Self, RigError> {
        let samples = delay.map_or(0.0, |d| d.delay_s) / sample_time_s;
        if samples > SAMPLES_MOST {
            return Err(RigError::TooLong { quantity: "the delay", samples, most: SAMPLES_MOST });
        }
        let (whole, late) = match samples.round() {
            near if (samples - near).abs() <= WHOLE => (near, 0.0),
            _ => (samples.floor(), samples.fract() * sample_time_s),
        };
        let length = whole as usize + usize::from(late > 0.0);
        let mut waiting = VecDeque::with_capacity(length + 1);
        waiting.resize(length, 0.0);
        Ok(Self { waiting, late_s: late, rest_s: sample_time_s - late })
    }

    /// Takes the command of an instant; gives the commands that act until the next one, each with
    /// its duration \[s\].
    pub(in crate::rig) fn push(&mut self, command: f64) -> [(f64, f64); 2] {
        self.waiting.push_back(command);
        let first = self.waiting.pop_front().unwrap_or(command);
        let second = self.waiting.front().copied().unwrap_or(command);
        if self.late_s > 0.0 {
            [(first, self.late_s), (second, self.rest_s)]
        } else {
            [(first, self.rest_s), (first, 0.0)]
        }
    }

    /// The durations that [`push`](Self::push) gives \[s\].
    pub(in crate::rig) fn durations_s(&self) -> [f64; 2] {
        [self.rest_s, self.late_s]
    }
}
