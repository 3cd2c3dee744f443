//! The linear part of the motor's equation (14).

use num_complex::Complex64;

use crate::friction::DriveError;

/// A motor: the linear part of `K·i = J·θ̈_m + V·θ̇_m + C_t + CF`.
///
/// i is the current \[A\], θ_m the motor's angle \[rad\], C_t the coupling torque and CF the friction torque \[N·m\]. A
/// positive current drives in the direction of positive angles.
///
/// ```
/// use lissom::drive::Motor;
/// let motor = Motor::builder()
///     .inertia_kg_m2(2e-3)
///     .viscous_nm_s_per_rad(1e-3)
///     .torque_constant_nm_per_a(0.2)
///     .build()?;
/// assert_eq!(motor.inertia_kg_m2(), 2e-3);
/// assert!(Motor::builder().inertia_kg_m2(-2e-3).build().is_err());
/// # Ok::<(), lissom::drive::DriveError>(())
/// ```
///
/// # Source
/// `[Feliu1989, eq. (14)]`
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Motor {
    inertia_kg_m2: f64,
    viscous_nm_s_per_rad: f64,
    torque_constant_nm_per_a: f64,
}

impl Motor {
    /// Builds a motor from J \[kg·m²\], V \[N·m·s/rad\] and K \[N·m/A\].
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

    /// Starts a builder, which sets the quantities of a motor by name.
    pub fn builder() -> MotorBuilder {
        MotorBuilder {
            inertia_kg_m2: None,
            viscous_nm_s_per_rad: 0.0,
            torque_constant_nm_per_a: 1.0,
        }
    }

    /// Inertia J of the motor's side \[kg·m²\], positive.
    pub fn inertia_kg_m2(&self) -> f64 {
        self.inertia_kg_m2
    }

    /// Viscous friction V \[N·m·s/rad\], not negative.
    pub fn viscous_nm_s_per_rad(&self) -> f64 {
        self.viscous_nm_s_per_rad
    }

    /// Torque constant K \[N·m/A\], positive.
    pub fn torque_constant_nm_per_a(&self) -> f64 {
        self.torque_constant_nm_per_a
    }

    /// Torque per angle of the motor alone, `J·s² + V·s` \[N·m/rad\], at the complex frequency s \[1/s\].
    pub fn impedance(&self, s: Complex64) -> Complex64 {
        s * (s * self.inertia_kg_m2 + self.viscous_nm_s_per_rad)
    }
}

/// Builder of a [`Motor`]: see [`Motor::builder`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotorBuilder {
    inertia_kg_m2: Option<f64>,
    viscous_nm_s_per_rad: f64,
    torque_constant_nm_per_a: f64,
}

impl From<Motor> for MotorBuilder {
    fn from(motor: Motor) -> Self {
        let Motor { inertia_kg_m2, viscous_nm_s_per_rad, torque_constant_nm_per_a } = motor;
        let inertia_kg_m2 = Some(inertia_kg_m2);
        Self { inertia_kg_m2, viscous_nm_s_per_rad, torque_constant_nm_per_a }
    }
}

impl MotorBuilder {
    /// Sets the inertia J of the motor's side \[kg·m²\]. It is required.
    #[must_use]
    pub fn inertia_kg_m2(mut self, inertia_kg_m2: f64) -> Self {
        self.inertia_kg_m2 = Some(inertia_kg_m2);
        self
    }

    /// Sets viscous friction V \[N·m·s/rad\]; 0 by default.
    #[must_use]
    pub fn viscous_nm_s_per_rad(mut self, viscous_nm_s_per_rad: f64) -> Self {
        self.viscous_nm_s_per_rad = viscous_nm_s_per_rad;
        self
    }

    /// Sets the torque constant K \[N·m/A\]; 1 by default, so that currents are torques in N·m.
    #[must_use]
    pub fn torque_constant_nm_per_a(mut self, torque_constant_nm_per_a: f64) -> Self {
        self.torque_constant_nm_per_a = torque_constant_nm_per_a;
        self
    }

    /// Builds the motor.
    ///
    /// # Errors
    /// [`DriveError::NotGiven`] without an inertia, otherwise as [`Motor::new`].
    pub fn build(self) -> Result<Motor, DriveError> {
        let quantity = "inertia_kg_m2";
        let inertia_kg_m2 = self.inertia_kg_m2.ok_or(DriveError::NotGiven { quantity })?;
        Motor::new(inertia_kg_m2, self.viscous_nm_s_per_rad, self.torque_constant_nm_per_a)
    }
}
