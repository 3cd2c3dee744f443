//! PID control of the motor's angle.

use super::derivative::Derivative;
use super::{Controller, Pd, Sensed};
use crate::rig::RigError;
use crate::rig::error::not_negative;

/// PID control, `i = k_p·e_k + I_k + k_d·(e_k − e_{k−1})/T` with `I_k = I_{k−1} + k_i·T·e_k`, the error e = reference −
/// sensed motor angle \[rad\] and the time T between two actions \[s\].
///
/// Anti-windup by conditional integration: the integral stays constant while the current asked for exceeds the limit of
/// the amplifier and the error would increase it further.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pid {
    pd: Pd,
    integral_a_per_rad_s: f64,
    derivative: Derivative,
    integral_a: f64,
}

impl Pid {
    /// Adds an integral gain k_i \[A/(rad·s)\] to a [`Pd`], whose filter is kept.
    ///
    /// # Errors
    /// [`RigError::Negative`] if the gain is negative or not finite.
    pub fn new(pd: Pd, integral_a_per_rad_s: f64) -> Result<Self, RigError> {
        Ok(Self {
            pd,
            integral_a_per_rad_s: not_negative("integral_a_per_rad_s", integral_a_per_rad_s)?,
            derivative: pd.filter_s().map_or_else(Derivative::default, Derivative::filtered),
            integral_a: 0.0,
        })
    }

    /// Present value of the integral I \[A\].
    pub fn integral_a(&self) -> f64 {
        self.integral_a
    }
}

impl Controller for Pid {
    fn current_a(&mut self, now: &Sensed<'_>) -> f64 {
        let error = now.reference_rad - now.motor_rad;
        let rest = self.pd.proportional_a_per_rad() * error
            + self.derivative.of(self.pd.derivative_a_s_per_rad(), error, now.period_s);
        let integral = self.integral_a + self.integral_a_per_rad_s * now.period_s * error;
        let demand = rest + integral;
        if demand.abs() > now.limit_a && demand * error > 0.0 {
            return rest + self.integral_a;
        }
        self.integral_a = integral;
        demand
    }

    fn reset(&mut self) {
        self.derivative.reset();
        self.integral_a = 0.0;
    }

    /// As of the [`Pd`], and the integral's k_p/k_i.
    fn memory_s(&self) -> f64 {
        let integral = if self.integral_a_per_rad_s > 0.0 {
            self.pd.proportional_a_per_rad() / self.integral_a_per_rad_s
        } else {
            0.0
        };
        self.pd.memory_s().max(integral)
    }
}
