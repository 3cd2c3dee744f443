//! The table `[load]`: gravity of an unbalanced load on a rigid joint.

use lissom_core::load::GravityLoad;

use crate::config::{ConfigError, Table};
use crate::units::Dimension;

/// An unbalanced load. Its gravity needs the torque `m·g·l·sin(θ + φ)` of the motor, with θ the motor's angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadSpec {
    /// m·g·l: the largest torque \[N·m\].
    pub gravity_torque_nm: f64,
    /// φ \[rad\]: the load hangs at θ = −φ.
    pub phase_rad: f64,
}

impl LoadSpec {
    /// The torque as coefficients of sin θ and cos θ.
    pub fn gravity(&self) -> GravityLoad {
        GravityLoad::of_amplitude(self.gravity_torque_nm, self.phase_rad)
    }
}

pub(super) fn load(table: &Table<'_>) -> Result<LoadSpec, ConfigError> {
    table.only("gravity_torque phase")?;
    keys(table)
}

/// The keys of a load.
pub(super) fn keys(table: &Table<'_>) -> Result<LoadSpec, ConfigError> {
    let phase = table.any("phase", Dimension::NUMBER)?;
    Ok(LoadSpec {
        gravity_torque_nm: table.need("gravity_torque")?.positive(Dimension::TORQUE)?,
        phase_rad: phase.unwrap_or(0.0),
    })
}
