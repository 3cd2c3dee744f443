//! What moves under a motor torque, whatever moves it on.

use super::RigError;

/// An arm in motion under a torque that is held.
pub trait Motion {
    /// State `[θ_m, θ̇_m, θ_i.., θ̇_i..]` \[rad, rad/s\].
    fn state(&self) -> &[f64];

    /// Moves on by `duration_s` under a constant motor torque \[N·m\].
    ///
    /// # Errors
    /// [`RigError`] where the motion cannot be followed.
    fn advance(&mut self, torque_nm: f64, duration_s: f64) -> Result<(), RigError>;

    /// Multiplies the dry friction of the joint, as it was given, by `factor` from now on.
    ///
    /// # Errors
    /// [`RigError::Unsupported`] where the engine's friction is fixed, [`RigError::Negative`].
    fn scale_friction(&mut self, factor: f64) -> Result<(), RigError> {
        let _ = factor;
        Err(RigError::Unsupported { what: "friction that changes during a motion of this engine" })
    }

    /// Total time that the joint has spent sticking \[s\].
    fn stuck_s(&self) -> f64;

    /// Relative tolerance to which the motion is solved: `None` where it is exact but for rounding.
    fn tolerance(&self) -> Option<f64>;
}
