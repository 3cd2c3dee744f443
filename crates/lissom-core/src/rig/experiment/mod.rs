//! Experiments: what the rig is asked to do, from where, and what is logged.

mod chirp;
mod multisine;
mod periodic;
mod reference;
mod table;
#[cfg(test)]
mod tests;

pub use chirp::{Chirp, Sweep};
pub use multisine::Multisine;
pub use periodic::{Sine, Square};
pub use reference::Reference;
pub use table::{Table, TableHold};

use super::RigError;
use super::error::{finite, not_negative, positive};
use crate::arm::Arm;

/// What drives the arm.
#[derive(Debug, Clone, PartialEq)]
pub enum Drive {
    /// The loop, with a reference for the motor's angle \[rad\].
    Angle(Reference),
    /// The open drive: a current \[A\]. There is no controller.
    Current(Reference),
}

impl Drive {
    /// The signal.
    pub fn reference(&self) -> &Reference {
        match self {
            Self::Angle(reference) | Self::Current(reference) => reference,
        }
    }
}

/// Where the arm is when the experiment starts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Start {
    /// At rest, straight, at angle zero.
    Rest,
    /// Let go at rest, the motor at angle zero and the tip pushed aside by a force F_n \[N\]:
    /// `q − θ_m = −E⁻¹·f·F_n` of [`BeamDynamics`](crate::beam::BeamDynamics).
    Deflected {
        /// The force before the release \[N\].
        tip_force_n: f64,
    },
}

impl Start {
    /// The state, `[θ_m, θ̇_m, θ_i.., θ̇_i..]`.
    ///
    /// # Errors
    /// [`RigError::NotFinite`] for the force, [`RigError::Unsupported`] for a rigid joint, [`RigError::Deflection`] where the statics cannot be
    /// solved.
    pub fn state(&self, arm: &Arm) -> Result<Vec<f64>, RigError> {
        let mut state = vec![0.0; arm.state_len()];
        if let Self::Deflected { tip_force_n } = *self {
            finite("tip_force_n", tip_force_n)?;
            if arm.beam().is_empty() {
                let what = "a start with the tip pushed aside, on a rigid joint,";
                return Err(RigError::Unsupported { what });
            }
            let dynamics = arm.dynamics();
            let push = &dynamics.force * -tip_force_n;
            let deflection = dynamics.elastic.clone().lu().solve(&push);
            let deflection = deflection
                .filter(|d| d.iter().all(|v| v.is_finite()))
                .ok_or(RigError::Deflection { tip_force_n })?;
            state[2..2 + dynamics.len()].copy_from_slice(deflection.as_slice());
        }
        Ok(state)
    }
}

/// What happens between the start and the log's first sample.
///
/// A periodic reference runs meanwhile. Any other is held at its first value and begins with the
/// log; where that value is zero and the start at rest, there is nothing to wait for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Settle {
    /// The log begins at once.
    AtOnce,
    /// A fixed time \[s\].
    Wait {
        /// The time \[s\].
        wait_s: f64,
    },
    /// Until the transient has gone: what is left of it is at most `tolerance` times the amplitude,
    /// or at most a step (or the deviation of the noise) of the coarsest sensor.
    Detected {
        /// What may be left, relative to the larger of the reference's amplitude and the start's
        /// deflection; for an open drive to what the motor moves by in a period \[1\].
        tolerance: f64,
        /// The longest time to wait \[s\].
        longest_s: f64,
    },
}

impl Settle {
    /// Detection to 1e-4 of the amplitude, within 1000 s.
    pub const DETECTED: Self = Self::Detected { tolerance: 1e-4, longest_s: 1000.0 };
}

/// One experiment.
///
/// ```
/// # use lissom::rig::{Drive, Experiment, Reference, Settle, Start};
/// let sine = Experiment::sine(2.0, 0.5, 20.0)?; // rad/s, rad, s
/// assert_eq!(sine.settle, Settle::DETECTED);
/// let release = Experiment::new(Drive::Current(Reference::hold(0.0)?), 60.0)?
///     .starting(Start::Deflected { tip_force_n: 0.1 })
///     .settling(Settle::AtOnce);
/// # Ok::<(), lissom::rig::RigError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Experiment {
    /// What drives the arm.
    pub drive: Drive,
    /// Where it starts.
    pub start: Start,
    /// How the transient goes.
    pub settle: Settle,
    /// Time that is logged \[s\].
    pub record_s: f64,
}

impl Experiment {
    /// An experiment from rest whose settling is detected.
    ///
    /// # Errors
    /// [`RigError::NotPositive`] for the time.
    pub fn new(drive: Drive, record_s: f64) -> Result<Self, RigError> {
        let record_s = positive("record_s", record_s)?;
        Ok(Self { drive, start: Start::Rest, settle: Settle::DETECTED, record_s })
    }

    /// The loop follows `A·sin(ω0·t)`: the report's experiment.
    ///
    /// # Errors
    /// [`RigError::NotPositive`].
    ///
    /// # Source
    /// `[Feliu1989, Section 5.1]`
    pub fn sine(omega_rad_s: f64, amplitude_rad: f64, record_s: f64) -> Result<Self, RigError> {
        Self::new(Drive::Angle(Reference::sine(omega_rad_s, amplitude_rad)?), record_s)
    }

    /// The same with another way to settle.
    #[must_use]
    pub fn settling(mut self, settle: Settle) -> Self {
        self.settle = settle;
        self
    }

    /// The same from another start.
    #[must_use]
    pub fn starting(mut self, start: Start) -> Self {
        self.start = start;
        self
    }

    /// Checks what the fields allow.
    pub(super) fn check(&self) -> Result<(), RigError> {
        positive("record_s", self.record_s)?;
        match self.settle {
            Settle::AtOnce => {}
            Settle::Wait { wait_s } => {
                not_negative("wait_s", wait_s)?;
            }
            Settle::Detected { tolerance, longest_s } => {
                positive("tolerance", tolerance)?;
                not_negative("longest_s", longest_s)?;
            }
        }
        Ok(())
    }
}
