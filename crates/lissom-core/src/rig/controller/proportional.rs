//! Proportional position loop.

use super::{Controller, Sensed};
use crate::rig::RigError;
use crate::rig::error::not_negative;

/// `i = k_p·e`, e the reference less the sensed motor angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Proportional {
    proportional_a_per_rad: f64,
}

impl Proportional {
    /// A gain k_p \[A/rad\].
    ///
    /// # Errors
    /// [`RigError::Negative`].
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
