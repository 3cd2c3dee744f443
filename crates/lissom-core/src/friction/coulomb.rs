//! Coulomb friction that may differ by direction.

use super::error::DriveError;

/// Dry friction with true sticking.
///
/// Torque against the motion: `forward` while θ̇_m > 0, `−backward` while θ̇_m < 0; at rest the
/// joint holds any drive torque between `−backward` and `forward`.
///
/// # Source
/// `[Feliu1989, Section 5]`. The source has one constant; two are the general piecewise-constant
/// law, equal to one constant and a constant load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coulomb {
    forward: f64,
    backward: f64,
}

impl Coulomb {
    /// No friction.
    pub const NONE: Self = Self { forward: 0.0, backward: 0.0 };

    /// One constant for both directions.
    ///
    /// # Errors
    /// [`DriveError`] where it is negative or not finite.
    pub fn symmetric(torque: f64) -> Result<Self, DriveError> {
        Self::by_direction(torque, torque)
    }

    /// A constant for each direction.
    ///
    /// # Errors
    /// [`DriveError`] where one is negative or not finite.
    pub fn by_direction(forward: f64, backward: f64) -> Result<Self, DriveError> {
        for (quantity, found) in [("forward Coulomb", forward), ("backward Coulomb", backward)] {
            if !(found >= 0.0 && found.is_finite()) {
                return Err(DriveError::Negative { quantity, found });
            }
        }
        Ok(Self { forward, backward })
    }

    /// While moving forward \[N·m or N\], not negative.
    pub fn forward(&self) -> f64 {
        self.forward
    }

    /// While moving backward \[N·m or N\], not negative.
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

    /// Signed friction torque while slipping in the direction of `sign`.
    pub fn slipping(&self, sign: f64) -> f64 {
        if sign > 0.0 { self.forward } else { -self.backward }
    }
}
