//! The true parameters of a simulated campaign.

use lissom::arm::Arm;
use num_complex::Complex64;

use crate::arm::clamped_modes;
use crate::campaign::Campaign;

/// The parameters of the simulated arm.
#[derive(Debug, Clone)]
pub struct Truth {
    /// Friction at speed, mean of both directions \[N·m\]; with another law the nearest equivalent.
    pub coulomb_nm: f64,
    /// The same forward and backward \[N·m\].
    pub coulomb_by_direction_nm: [f64; 2],
    /// V \[N·m·s/rad\], mean of both directions.
    pub viscous_nm_s_per_rad: f64,
    /// J \[kg·m²\].
    pub inertia_kg_m2: f64,
    /// h_{n+1} of (15) \[N·m/rad\].
    pub coupling_nm_per_rad: f64,
    /// Undamped frequency \[rad/s\] and damping ratio of each mode, motor clamped, ascending.
    pub modes: Vec<(f64, f64)>,
    arm: Arm,
}

impl Truth {
    /// The truth of a campaign.
    pub fn of(campaign: &Campaign) -> Self {
        let rig = &campaign.definition.rig;
        let arm = &rig.arm;
        Self {
            coulomb_nm: crate::campaign::sliding(rig),
            coulomb_by_direction_nm: [arm.coulomb.forward(), arm.coulomb.backward()],
            viscous_nm_s_per_rad: arm.motor.viscous_nm_s_per_rad(),
            inertia_kg_m2: arm.motor.inertia_kg_m2(),
            coupling_nm_per_rad: arm.dynamics().coupling_motor,
            modes: clamped_modes(arm.beam().poles()),
            arm: arm.clone(),
        }
    }

    /// Motor angle per current without Coulomb friction \[rad/A\].
    pub fn response(&self, omega_rad_s: f64) -> Complex64 {
        self.arm.motor_response(omega_rad_s)
    }
}
