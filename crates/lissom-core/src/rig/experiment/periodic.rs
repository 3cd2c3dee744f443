//! Sine and square wave.

use std::f64::consts::TAU;

use crate::rig::RigError;
use crate::rig::error::positive;

/// Part of a period by which an edge may come early: times are multiples of a sample time but for
/// rounding, and an edge is not to fall a sample late for it.
const EDGE: f64 = 1e-9;

/// A sine, `A·sin(ω0·t)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sine {
    omega_rad_s: f64,
    amplitude: f64,
}

impl Sine {
    /// Builds a sine from its frequency \[rad/s\] and amplitude \[rad or A\].
    ///
    /// # Errors
    /// [`RigError::NotPositive`] if one of them is not positive and finite.
    pub fn new(omega_rad_s: f64, amplitude: f64) -> Result<Self, RigError> {
        Ok(Self {
            omega_rad_s: positive("omega_rad_s", omega_rad_s)?,
            amplitude: positive("amplitude", amplitude)?,
        })
    }

    /// Frequency ω0 \[rad/s\].
    pub fn omega_rad_s(&self) -> f64 {
        self.omega_rad_s
    }
    /// Amplitude A \[rad or A\].
    pub fn amplitude(&self) -> f64 {
        self.amplitude
    }
    /// Value at a time \[s\], in rad or A.
    pub fn value(&self, time_s: f64) -> f64 {
        self.amplitude * (self.omega_rad_s * time_s).sin()
    }
}

/// A square wave: `+A` in the first half of each period, `−A` in the second.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Square {
    omega_rad_s: f64,
    amplitude: f64,
}

impl Square {
    /// Builds a square wave from its frequency \[rad/s\] and amplitude \[rad or A\].
    ///
    /// # Errors
    /// [`RigError::NotPositive`] if one of them is not positive and finite.
    pub fn new(omega_rad_s: f64, amplitude: f64) -> Result<Self, RigError> {
        Ok(Self {
            omega_rad_s: positive("omega_rad_s", omega_rad_s)?,
            amplitude: positive("amplitude", amplitude)?,
        })
    }

    /// Frequency ω0 \[rad/s\].
    pub fn omega_rad_s(&self) -> f64 {
        self.omega_rad_s
    }
    /// Amplitude A \[rad or A\].
    pub fn amplitude(&self) -> f64 {
        self.amplitude
    }
    /// Value at a time \[s\], in rad or A.
    pub fn value(&self, time_s: f64) -> f64 {
        let phase = (time_s * self.omega_rad_s / TAU + EDGE).rem_euclid(1.0);
        if phase < 0.5 { self.amplitude } else { -self.amplitude }
    }
}
