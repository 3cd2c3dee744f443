//! The interface of the engines that simulate the motion of an arm.

use super::RigError;

/// Motion of an arm under a torque that is constant over each step.
pub trait Motion {
    /// State `[θ_m, θ̇_m, θ_i.., θ̇_i..]` \[rad, rad/s\].
    fn state(&self) -> &[f64];

    /// Advances by `duration_s` under a constant motor torque \[N·m\].
    ///
    /// # Errors
    /// [`RigError`] if the motion cannot be computed.
    fn advance(&mut self, torque_nm: f64, duration_s: f64) -> Result<(), RigError>;

    /// Sets the factor of the joint's dry friction \[1\], relative to the friction at the start, from now on.
    ///
    /// # Errors
    /// [`RigError::Unsupported`] if the friction of this engine cannot change;
    /// [`RigError::Negative`] for a negative factor.
    fn scale_friction(&mut self, factor: f64) -> Result<(), RigError> {
        let _ = factor;
        Err(RigError::Unsupported { what: "friction that changes during a motion of this engine" })
    }

    /// Total time for which the joint stuck \[s\].
    fn stuck_s(&self) -> f64;

    /// Relative tolerance of the solution; `None` if it is exact to rounding.
    fn tolerance(&self) -> Option<f64>;
}
