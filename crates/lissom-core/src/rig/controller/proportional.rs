//! Proportional control of the motor's angle.

use super::{Controller, Sensed};
use crate::rig::RigError;
use crate::rig::error::not_negative;

/// Proportional control, `i = k_p·e`, with the error e = reference − sensed motor angle \[rad\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Proportional {
    proportional_a_per_rad: f64,
}

impl Proportional {
    /// Builds the controller from its gain k_p \[A/rad\].
    ///
    /// # Errors
    /// [`RigError::Negative`] if the gain is negative or not finite.
    pub fn new(proportional_a_per_rad: f64) -> Result<Self, RigError> {
        let gain = not_negative("proportional_a_per_rad", proportional_a_per_rad)?;
        Ok(Self { proportional_a_per_rad: gain })
    }
}

impl Controller for Proportional {
    fn current_a(&mut self, now: &Sensed<'_>) -> f64 {
        self.proportional_a_per_rad * (now.reference_rad - now.motor_rad)
    }

    fn reset(&mut self) {}
}
