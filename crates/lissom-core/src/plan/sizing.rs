//! How large a motion may be, found by simulating it.

use std::fmt;

use super::Wishes;
use super::planned_motion::{PlannedMotion, rounded};
use crate::plan::thresholds::{RANGE_USED, STUCK_MOST, TRAVEL_LEAST};
use crate::rig::{Logged, Rig, RigError, RigFinding, Sensor};

/// Sizes tried until one fits.
const TRIES: usize = 12;
/// A size is reduced to this share of what would just fit, and by no more than to a fifth at once.
const BELOW: f64 = 0.97;
/// See [`BELOW`].
const LEAST_STEP: f64 = 0.2;

/// Reason why a motion is dropped.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Unfit {
    /// The joint sticks for more than 15 % of the time, even at the largest amplitude allowed.
    Sticks,
    /// The motor moves by less than 20 steps of its sensor, even at the largest amplitude allowed.
    TooSmall,
    /// The transient does not decay within the longest wait.
    Unsettled,
    /// It exceeds the limits of current, travel or bending, even at the smallest amplitude tried.
    TooLarge,
    /// The rig cannot simulate it.
    Impossible,
}

impl fmt::Display for Unfit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Sticks => "stick for more than 15 % of the time",
            Self::TooSmall => "move the motor by less than 20 steps of its sensor",
            Self::Unsettled => "have a transient that lasts longer than the longest wait",
            Self::TooLarge => "exceed the limit of current, travel or bending at any amplitude",
            Self::Impossible => "are not possible with this rig",
        })
    }
}

/// A motion that fits, simulated.
#[derive(Debug, Clone)]
pub(super) struct Sized {
    pub(super) amplitude_rad: f64,
    pub(super) logged: Logged,
    /// Largest current \[A\].
    pub(super) peak_a: f64,
    /// Half of the way of the motor \[rad\].
    pub(super) moved_rad: f64,
}

/// What bounds all motions.
#[derive(Debug, Clone)]
pub(super) struct Limits {
    current_a: f64,
    travel_rad: f64,
    bend_rad: f64,
    /// Of each tip's angle \[rad\].
    tips_rad: Vec<f64>,
    least_rad: f64,
    pub(super) longest_s: f64,
}

impl Limits {
    pub(super) fn of(rig: &Rig, wishes: &Wishes, longest_s: f64) -> Self {
        let range = |sensor: Sensor| {
            sensor.quantiser.map_or(f64::INFINITY, |q| RANGE_USED * q.ends().1.min(-q.ends().0))
        };
        let instruments = &rig.instruments;
        Self {
            current_a: (1.0 - wishes.current_reserve) * instruments.amplifier.most_a(),
            travel_rad: wishes.travel_rad.min(range(instruments.motor)),
            bend_rad: wishes.bend_rad,
            tips_rad: (0..rig.arm.beam().len()).map(|i| range(instruments.tip(i))).collect(),
            least_rad: TRAVEL_LEAST * instruments.motor.resolution(),
            longest_s,
        }
    }

    /// The largest size of a motion that keeps to them; what is too small then is of no use.
    pub(super) fn largest(
        &self,
        rig: &Rig,
        motion: &PlannedMotion,
        record_s: f64,
    ) -> Result<Sized, Unfit> {
        let mut amplitude = rounded(self.travel_rad);
        for _ in 0..TRIES {
            let share = match self.tried(rig, motion, amplitude, record_s)? {
                Some(found) => {
                    let over = self.over(&found);
                    if over <= 1.0 {
                        return self.large_enough(found);
                    }
                    (BELOW / over).max(LEAST_STEP)
                }
                None => 0.5,
            };
            amplitude = rounded(amplitude * share);
        }
        Err(Unfit::TooLarge)
    }

    /// A motion of a given size, if it is large enough.
    pub(super) fn of_size(
        &self,
        rig: &Rig,
        motion: &PlannedMotion,
        amplitude_rad: f64,
        record_s: f64,
    ) -> Result<Sized, Unfit> {
        let found = self.tried(rig, motion, rounded(amplitude_rad), record_s)?;
        self.large_enough(found.ok_or(Unfit::TooLarge)?)
    }

    /// `None` where the loop ran away.
    fn tried(
        &self,
        rig: &Rig,
        motion: &PlannedMotion,
        amplitude_rad: f64,
        record_s: f64,
    ) -> Result<Option<Sized>, Unfit> {
        let experiment = motion
            .experiment(amplitude_rad, record_s, self.longest_s)
            .map_err(|_| Unfit::Impossible)?;
        let logged = match rig.run("", &experiment, 1) {
            Ok(logged) => logged,
            Err(RigError::Unstable { .. } | RigError::BeyondSensor { .. }) => return Ok(None),
            Err(_) => return Err(Unfit::Impossible),
        };
        let peak_a = logged.run.command().iter().fold(0.0_f64, |m, u| m.max(u.abs()));
        let motor = logged.run.motor();
        let low = motor.iter().copied().fold(f64::INFINITY, f64::min);
        let high = motor.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        Ok(Some(Sized { amplitude_rad, peak_a, moved_rad: 0.5 * (high - low), logged }))
    }

    /// By what factor a run exceeds the limit that it exceeds the most.
    fn over(&self, found: &Sized) -> f64 {
        let run = &found.logged.run;
        let largest = |values: &[f64]| values.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        let mut over = (found.peak_a / self.current_a).max(largest(run.motor()) / self.travel_rad);
        for (tip, range) in run.tips().iter().zip(&self.tips_rad) {
            let bend = tip.iter().zip(run.motor()).fold(0.0_f64, |m, (t, q)| m.max((t - q).abs()));
            over = over.max(bend / self.bend_rad).max(largest(tip) / range);
        }
        over
    }

    fn large_enough(&self, found: Sized) -> Result<Sized, Unfit> {
        let unsettled = |f: &RigFinding| matches!(f, RigFinding::NotSettled { .. });
        if found.logged.findings.iter().any(unsettled) {
            Err(Unfit::Unsettled)
        } else if found.logged.stuck_share > STUCK_MOST {
            Err(Unfit::Sticks)
        } else if found.moved_rad < self.least_rad {
            Err(Unfit::TooSmall)
        } else {
            Ok(found)
        }
    }
}
