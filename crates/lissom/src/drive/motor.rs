//! The linear part of the motor (14).

use num_complex::Complex64;

use crate::friction::DriveError;

/// `K·i = J·θ̈_m + V·θ̇_m + C_t + CF`.
///
/// # Source
/// `[Feliu1989, eq. (14)]`
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Motor {
    /// Polar inertia J \[kg·m²\].
    pub inertia_kg_m2: f64,
    /// Dynamic (viscous) friction V \[N·m·s/rad\].
    pub viscous_nm_s_per_rad: f64,
    /// Torque constant K \[N·m/A\].
    pub torque_constant_nm_per_a: f64,
}

impl Motor {
    /// Checks the numbers.
    ///
    /// # Errors
    /// [`DriveError`] unless J, K > 0 and V ≥ 0, all finite.
    pub fn new(
        inertia_kg_m2: f64,
        viscous_nm_s_per_rad: f64,
        torque_constant_nm_per_a: f64,
    ) -> Result<Self, DriveError> {
        let positive = [
            ("inertia_kg_m2", inertia_kg_m2),
            ("torque_constant_nm_per_a", torque_constant_nm_per_a),
        ];
        for (quantity, found) in positive {
            if !(found > 0.0 && found.is_finite()) {
                return Err(DriveError::NotPositive { quantity, found });
            }
        }
        if !(viscous_nm_s_per_rad >= 0.0 && viscous_nm_s_per_rad.is_finite()) {
            return Err(DriveError::Negative {
                quantity: "viscous_nm_s_per_rad",
                found: viscous_nm_s_per_rad,
            });
        }
        Ok(Self { inertia_kg_m2, viscous_nm_s_per_rad, torque_constant_nm_per_a })
    }

    /// Torque per angle of the motor alone, `J·s² + V·s` \[N·m/rad\].
    pub fn impedance(&self, s: Complex64) -> Complex64 {
        s * (s * self.inertia_kg_m2 + self.viscous_nm_s_per_rad)
    }
}
