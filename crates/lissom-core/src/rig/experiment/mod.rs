//! Experiments: the reference, the initial state, the settling and the duration of a log.

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

/// The input that drives the arm.
#[derive(Debug, Clone, PartialEq)]
pub enum Drive {
    /// The control loop, with a reference for the motor's angle \[rad\].
    Angle(Reference),
    /// The open drive, with a current \[A\]. There is no controller.
    Current(Reference),
}

impl Drive {
    /// The signal of the reference.
    pub fn reference(&self) -> &Reference {
        match self {
            Self::Angle(reference) | Self::Current(reference) => reference,
        }
    }
}

/// State of the arm when the experiment starts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Start {
    /// At rest, straight, at angle zero.
    Rest,
    /// At rest, with the motor at angle zero and the tip deflected by a force F_n \[N\], which is released at the
    /// start: `q − θ_m = −Â⁻¹·Q̂·F_n` with the matrices of [`BeamDynamics`](crate::beam::BeamDynamics).
    Deflected {
        /// The force before the release \[N\].
        tip_force_n: f64,
    },
}

impl Start {
    /// The initial state, `[θ_m, θ̇_m, θ_i.., θ̇_i..]` \[rad, rad/s\].
    ///
    /// # Errors
    /// [`RigError::NotFinite`] for the force, [`RigError::Unsupported`] for a rigid joint, [`RigError::Deflection`] if
    /// the statics cannot be solved.
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

/// Settling: what happens between the start and the first sample of the log.
///
/// A periodic reference runs during this time. Any other reference stays at its first value and begins with the log. If
/// that value is zero and the arm starts at rest, there is no wait.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Settle {
    /// The log begins at once.
    AtOnce,
    /// The log begins after a fixed time.
    Wait {
        /// The time \[s\].
        wait_s: f64,
    },
    /// The log begins when the transient has decayed: its remainder is at most `tolerance` times the amplitude, or at
    /// most one step (or one standard deviation of the noise) of the coarsest sensor.
    Detected {
        /// Largest remainder of the transient \[1\], relative to the amplitude of the reference or the initial
        /// deflection, whichever is larger; for an open drive, relative to the travel of the motor in one period.
        tolerance: f64,
        /// Longest time to wait \[s\].
        longest_s: f64,
    },
}

impl Settle {
    /// Wait until the transient is 1e-4 of the amplitude, at most 1000 s.
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
    /// The input that drives the arm.
    pub drive: Drive,
    /// Initial state.
    pub start: Start,
    /// What happens between the start and the first sample of the log.
    pub settle: Settle,
    /// Length of the log \[s\].
    pub record_s: f64,
}

impl Experiment {
    /// An experiment that starts at rest and waits until the transient has decayed ([`Settle::DETECTED`]).
    ///
    /// # Errors
    /// [`RigError::NotPositive`] for the length of the log.
    pub fn new(drive: Drive, record_s: f64) -> Result<Self, RigError> {
        let record_s = positive("record_s", record_s)?;
        Ok(Self { drive, start: Start::Rest, settle: Settle::DETECTED, record_s })
    }

    /// The control loop follows `A·sin(ω0·t)`: the experiment of the 1989 report.
    ///
    /// # Errors
    /// [`RigError::NotPositive`] if a number is not positive and finite.
    ///
    /// # Source
    /// `[Feliu1989, Section 5.1]`
    pub fn sine(omega_rad_s: f64, amplitude_rad: f64, record_s: f64) -> Result<Self, RigError> {
        Self::new(Drive::Angle(Reference::sine(omega_rad_s, amplitude_rad)?), record_s)
    }

    /// The control loop follows a reference \[rad\]: a [`Reference`], or a [`Multisine`], [`Table`], [`Chirp`],
    /// [`Square`] or [`Sine`].
    ///
    /// ```
    /// # use lissom::rig::{Experiment, Multisine, Table, TableHold};
    /// let lines = Multisine::new(0.5, &[1, 3, 5, 7, 9], 0.4, 7)?; // rad/s, lines, rad, seed
    /// let excited = Experiment::angle(lines, 60.0)?;
    /// let corners = Table::new(vec![0.0, 1.0, 2.0], vec![0.0, 0.5, 0.0], TableHold::Linear)?; // s, rad
    /// let moved = Experiment::angle(corners, 3.0)?;
    /// # Ok::<(), lissom::rig::RigError>(())
    /// ```
    ///
    /// # Errors
    /// [`RigError::NotPositive`] for the length of the log.
    pub fn angle(reference: impl Into<Reference>, record_s: f64) -> Result<Self, RigError> {
        Self::new(Drive::Angle(reference.into()), record_s)
    }

    /// The open drive gets a current \[A\] over time, without a controller.
    ///
    /// # Errors
    /// [`RigError::NotPositive`] for the length of the log.
    pub fn current(reference: impl Into<Reference>, record_s: f64) -> Result<Self, RigError> {
        Self::new(Drive::Current(reference.into()), record_s)
    }

    /// The control loop follows a sine whose frequency goes exponentially from one frequency to another \[rad/s\]
    /// during the log (a sweep).
    ///
    /// ```
    /// # use lissom::rig::Experiment;
    /// let sweep = Experiment::chirp((1.0, 60.0), 0.2, 30.0)?; // rad/s, rad, s
    /// # Ok::<(), lissom::rig::RigError>(())
    /// ```
    ///
    /// # Errors
    /// [`RigError::NotPositive`] if a number is not positive and finite.
    pub fn chirp(
        from_to_rad_s: (f64, f64),
        amplitude_rad: f64,
        record_s: f64,
    ) -> Result<Self, RigError> {
        Self::angle(
            Chirp::new(Sweep::Logarithmic, from_to_rad_s, amplitude_rad, record_s)?,
            record_s,
        )
    }

    /// The control loop follows a square wave: `+A` in the first half of each period `2π/ω0`, `−A` in the second.
    ///
    /// # Errors
    /// [`RigError::NotPositive`] if a number is not positive and finite.
    pub fn square(omega_rad_s: f64, amplitude_rad: f64, record_s: f64) -> Result<Self, RigError> {
        Self::angle(Square::new(omega_rad_s, amplitude_rad)?, record_s)
    }

    /// Returns this experiment with another settling.
    #[must_use]
    pub fn settling(mut self, settle: Settle) -> Self {
        self.settle = settle;
        self
    }

    /// Returns this experiment with another initial state.
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
