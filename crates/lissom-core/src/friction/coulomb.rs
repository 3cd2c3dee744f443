//! Coulomb friction that may differ by direction.

use super::error::DriveError;

/// Coulomb friction with true sticking.
///
/// The torque against the motion is `forward` while θ̇_m > 0 and `−backward` while θ̇_m < 0. At rest the joint holds
/// any drive torque between `−backward` and `forward`.
///
/// # Source
/// `[Feliu1989, Section 5]`, which has one constant. Two constants are the same as one constant, their mean, and a
/// constant load, half their difference.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coulomb {
    forward: f64,
    backward: f64,
}

impl Coulomb {
    /// No friction.
    pub const NONE: Self = Self { forward: 0.0, backward: 0.0 };

    /// The same Coulomb friction in both directions, `torque` \[N·m, or N on a linear axis\].
    ///
    /// # Errors
    /// [`DriveError`] if it is negative or not finite.
    pub fn symmetric(torque: f64) -> Result<Self, DriveError> {
        Self::by_direction(torque, torque)
    }

    /// Coulomb friction for each direction \[N·m or N\], both as magnitudes.
    ///
    /// # Errors
    /// [`DriveError`] if one is negative or not finite.
    pub fn by_direction(forward: f64, backward: f64) -> Result<Self, DriveError> {
        for (quantity, found) in [("forward Coulomb", forward), ("backward Coulomb", backward)] {
            if !(found >= 0.0 && found.is_finite()) {
                return Err(DriveError::Negative { quantity, found });
            }
        }
        Ok(Self { forward, backward })
    }

    /// Friction while the motor moves forward \[N·m or N\], not negative.
    pub fn forward(&self) -> f64 {
        self.forward
    }

    /// Friction while the motor moves backward \[N·m or N\], as a magnitude, not negative.
    pub fn backward(&self) -> f64 {
        self.backward
    }

    /// The same times `factor`, which must not be negative.
    pub(crate) fn scaled(self, factor: f64) -> Self {
        Self { forward: factor * self.forward, backward: factor * self.backward }
    }

    /// Of limits that are known to be valid.
    pub(crate) fn of_limits(forward: f64, backward: f64) -> Self {
        Self { forward, backward }
    }

    /// Friction torque of a joint that slips in the direction of `sign`: `forward` if it is positive, `−backward` if it
    /// is negative \[N·m or N\].
    pub fn slipping(&self, sign: f64) -> f64 {
        if sign > 0.0 { self.forward } else { -self.backward }
    }
}
