//! PD control of the motor's angle.

use super::derivative::Derivative;
use super::{Controller, Sensed};
use crate::rig::RigError;
use crate::rig::error::not_negative;

/// PD control, `i = k_p·e_k + k_d·(e_k − e_{k−1})/T`, with the error e = reference − sensed motor angle \[rad\] and the
/// time T between two actions \[s\].
///
/// ```
/// # use lissom::rig::{Controller, Pd, Sensed};
/// let mut pd = Pd::new(8.0, 0.2)?; // A/rad, A·s/rad
/// let at = |motor_rad| Sensed { time_s: 0.0, period_s: 0.01, reference_rad: 0.0, motor_rad, tips_rad: &[], limit_a: 4.0 };
/// assert_eq!(pd.current_a(&at(0.1)), -0.8); // no difference yet
/// assert!((pd.current_a(&at(0.2)) + 1.6 + 2.0).abs() < 1e-12);
/// # Ok::<(), lissom::rig::RigError>(())
/// ```
///
/// # Source
/// `[Feliu1989, Section 5.1]`. The 1989 report prints no gains, and its controller has no filter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pd {
    proportional_a_per_rad: f64,
    derivative_a_s_per_rad: f64,
    derivative: Derivative,
}

impl Pd {
    /// Builds the controller from its gains k_p \[A/rad\] and k_d \[A·s/rad\].
    ///
    /// # Errors
    /// [`RigError::Negative`] if a gain is negative or not finite.
    pub fn new(proportional_a_per_rad: f64, derivative_a_s_per_rad: f64) -> Result<Self, RigError> {
        Ok(Self {
            proportional_a_per_rad: not_negative("proportional_a_per_rad", proportional_a_per_rad)?,
            derivative_a_s_per_rad: not_negative("derivative_a_s_per_rad", derivative_a_s_per_rad)?,
            derivative: Derivative::default(),
        })
    }

    /// Adds a first-order filter with the time constant τ \[s\] to the derivative:
    /// `d_k = (τ·d_{k−1} + k_d·(e_k − e_{k−1}))/(τ + T)`.
    ///
    /// # Errors
    /// [`RigError::Negative`] if the time constant is negative or not finite.
    pub fn with_filter(mut self, filter_s: f64) -> Result<Self, RigError> {
        self.derivative = Derivative::filtered(not_negative("filter_s", filter_s)?);
        Ok(self)
    }

    /// Proportional gain k_p \[A/rad\].
    pub fn proportional_a_per_rad(&self) -> f64 {
        self.proportional_a_per_rad
    }
    /// Derivative gain k_d \[A·s/rad\].
    pub fn derivative_a_s_per_rad(&self) -> f64 {
        self.derivative_a_s_per_rad
    }
    /// Time constant τ of the filter of the derivative \[s\], if there is a filter.
    pub fn filter_s(&self) -> Option<f64> {
        self.derivative.filter_s
    }
}

impl Controller for Pd {
    fn current_a(&mut self, now: &Sensed<'_>) -> f64 {
        let error = now.reference_rad - now.motor_rad;
        self.proportional_a_per_rad * error
            + self.derivative.of(self.derivative_a_s_per_rad, error, now.period_s)
    }

    fn reset(&mut self) {
        self.derivative.reset();
    }

    /// The zero at −k_p/k_d, towards which the slow pole of a stiff loop goes, and the filter.
    fn memory_s(&self) -> f64 {
        let zero = if self.proportional_a_per_rad > 0.0 {
            self.derivative_a_s_per_rad / self.proportional_a_per_rad
        } else {
            0.0
        };
        zero.max(self.derivative.memory_s())
    }
}
