//! References: signals over time, for the control loop or for the open drive.

use super::{Chirp, Multisine, Sine, Square, Sweep, Table};
use crate::rig::RigError;
use crate::rig::error::finite;

/// A reference: an angle \[rad\] for the control loop, or a current \[A\] for the open drive, over time.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Reference {
    /// A sine, `A·sin(ω0·t)`.
    Sine(Sine),
    /// Odd harmonics with random phases.
    Multisine(Multisine),
    /// A square wave, `±A`.
    Square(Square),
    /// A sine whose frequency rises or falls.
    Chirp(Chirp),
    /// Values at given times.
    Table(Table),
    /// A signal that grows at a constant rate, `v·t`: see [`ramp`](Self::ramp).
    Ramp {
        /// Rate v \[rad/s or A/s\].
        rate_per_s: f64,
    },
    /// A constant value: see [`hold`](Self::hold).
    Hold {
        /// The value \[rad or A\].
        value: f64,
    },
}

impl Reference {
    /// A sine, `A·sin(ω0·t)`, from its frequency \[rad/s\] and amplitude \[rad or A\].
    ///
    /// # Errors
    /// [`RigError::NotPositive`] if one of them is not positive and finite.
    pub fn sine(omega_rad_s: f64, amplitude: f64) -> Result<Self, RigError> {
        Sine::new(omega_rad_s, amplitude).map(Self::Sine)
    }

    /// A square wave: `+A` in the first half of each period `2π/ω0`, `−A` in the second.
    ///
    /// # Errors
    /// [`RigError::NotPositive`] if a number is not positive and finite.
    pub fn square(omega_rad_s: f64, amplitude: f64) -> Result<Self, RigError> {
        Square::new(omega_rad_s, amplitude).map(Self::Square)
    }

    /// A chirp of amplitude `amplitude` \[rad or A\] from one frequency to another \[rad/s\] within `duration_s`.
    ///
    /// # Errors
    /// [`RigError::NotPositive`] if a number is not positive and finite.
    pub fn chirp(
        sweep: Sweep,
        (from_rad_s, to_rad_s): (f64, f64),
        amplitude: f64,
        duration_s: f64,
    ) -> Result<Self, RigError> {
        Chirp::new(sweep, (from_rad_s, to_rad_s), amplitude, duration_s).map(Self::Chirp)
    }

    /// A motion at constant velocity \[rad/s\], to measure friction against velocity.
    ///
    /// # Errors
    /// [`RigError::NotFinite`] if the rate is not finite.
    ///
    /// # Source
    /// `[Feliu1989, Section 6.2.2, Figure 8]`
    pub fn ramp(rate_per_s: f64) -> Result<Self, RigError> {
        Ok(Self::Ramp { rate_per_s: finite("rate_per_s", rate_per_s)? })
    }

    /// A constant value \[rad or A\], for a free vibration or a rest.
    ///
    /// # Errors
    /// [`RigError::NotFinite`] if the value is not finite.
    pub fn hold(value: f64) -> Result<Self, RigError> {
        Ok(Self::Hold { value: finite("value", value)? })
    }

    /// Value at a time \[s\], in rad or A.
    pub fn value(&self, time_s: f64) -> f64 {
        match self {
            Self::Sine(sine) => sine.value(time_s),
            Self::Multisine(multisine) => multisine.value(time_s),
            Self::Square(square) => square.value(time_s),
            Self::Chirp(chirp) => chirp.value(time_s),
            Self::Table(table) => table.value(time_s),
            Self::Ramp { rate_per_s } => rate_per_s * time_s,
            Self::Hold { value } => *value,
        }
    }

    /// Period \[s\]; `None` if the signal is not periodic.
    pub fn period_s(&self) -> Option<f64> {
        let omega_rad_s = match self {
            Self::Sine(sine) => sine.omega_rad_s(),
            Self::Multisine(multisine) => multisine.omega_rad_s(),
            Self::Square(square) => square.omega_rad_s(),
            _ => return None,
        };
        Some(std::f64::consts::TAU / omega_rad_s)
    }

    /// Highest frequency of the reference \[rad/s\] (the fundamental frequency of a square wave); `None` for tables,
    /// ramps and constants.
    pub fn highest_rad_s(&self) -> Option<f64> {
        match self {
            Self::Sine(sine) => Some(sine.omega_rad_s()),
            Self::Multisine(multisine) => Some(multisine.highest_rad_s()),
            Self::Square(square) => Some(square.omega_rad_s()),
            Self::Chirp(chirp) => Some(chirp.highest_rad_s()),
            _ => None,
        }
    }

    /// Largest magnitude within `duration_s` from the start \[rad or A\].
    pub fn amplitude(&self, duration_s: f64) -> f64 {
        match self {
            Self::Sine(sine) => sine.amplitude(),
            Self::Multisine(multisine) => multisine.amplitude(),
            Self::Square(square) => square.amplitude(),
            Self::Chirp(chirp) => chirp.amplitude(),
            Self::Table(table) => table.amplitude(),
            Self::Ramp { rate_per_s } => (rate_per_s * duration_s).abs(),
            Self::Hold { value } => value.abs(),
        }
    }
}

impl From<Sine> for Reference {
    fn from(signal: Sine) -> Self {
        Self::Sine(signal)
    }
}

impl From<Multisine> for Reference {
    fn from(signal: Multisine) -> Self {
        Self::Multisine(signal)
    }
}

impl From<Square> for Reference {
    fn from(signal: Square) -> Self {
        Self::Square(signal)
    }
}

impl From<Chirp> for Reference {
    fn from(signal: Chirp) -> Self {
        Self::Chirp(signal)
    }
}

impl From<Table> for Reference {
    fn from(signal: Table) -> Self {
        Self::Table(signal)
    }
}
