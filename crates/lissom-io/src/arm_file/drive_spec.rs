//! The table `[drive]`: a motor and its friction.

use lissom_core::drive::{Coulomb, DriveError, Motor};
use lissom_core::load::{GravityLoad, TorqueRipple};

use super::arm_error::unusable;
use super::friction_spec::{FrictionSpec, by_direction};
use crate::config::{ConfigError, Table, Value};
use crate::units::Dimension;

/// A motor with friction, referred to the joint.
#[derive(Debug, Clone, PartialEq)]
pub struct DriveSpec {
    /// The motor; its viscous friction is the mean of both directions.
    pub motor: Motor,
    /// Coulomb friction.
    pub coulomb: Coulomb,
    /// Half the difference of forward and backward viscous friction \[N·m·s/rad\].
    pub viscous_apart_nm_s_per_rad: f64,
    /// Friction with what is not constant.
    pub friction: FrictionSpec,
    /// Torque ripples (cogging) of the motor.
    pub torque_ripples: Vec<TorqueRipple>,
}

/// Reads the table; `load` is the one of the table `[load]`.
pub(super) fn drive(
    table: &Table<'_>,
    load: Option<GravityLoad>,
) -> Result<DriveSpec, ConfigError> {
    table.only(
        "inertia viscous torque_constant coulomb torque_ripples rest ripple root with_load bristles",
    )?;
    let torque_constant = table.need("torque_constant")?.positive(Dimension::TORQUE_PER_CURRENT)?;
    let viscous = |v: &Value<'_>| v.not_negative(Dimension::VISCOUS_ROTARY);
    let viscous = table.optional("viscous", |v| by_direction(v, viscous))?;
    let (viscous_forward, viscous_backward) = viscous.unwrap_or_default();
    let in_torque = |value: &Value<'_>| torque(value, torque_constant);
    let coulomb = table.optional("coulomb", |v| by_direction(v, in_torque))?;
    let (forward, backward) = coulomb.unwrap_or_default();
    let failed = |source: DriveError| unusable(table.place(), source);
    let inertia = table.need("inertia")?.positive(Dimension::INERTIA)?;
    let viscous = 0.5 * (viscous_forward + viscous_backward);
    let coulomb = Coulomb::by_direction(forward, backward).map_err(failed)?;
    let apart = 0.5 * (viscous_forward - viscous_backward);
    Ok(DriveSpec {
        motor: Motor::new(inertia, viscous, torque_constant).map_err(failed)?,
        coulomb,
        viscous_apart_nm_s_per_rad: apart,
        friction: FrictionSpec::read(table, coulomb, load, apart, in_torque)?,
        torque_ripples: table.items("torque_ripples", WAVES, |value| {
            let table = value.table()?;
            table.only("torque per_turn phase")?;
            let phase = table.any("phase", Dimension::NUMBER)?;
            let per_turn = table.need("per_turn")?.positive(Dimension::NUMBER)?;
            let size = in_torque(&table.need("torque")?)?;
            Ok(TorqueRipple::of_amplitude(size, per_turn, phase.unwrap_or(0.0)))
        })?,
    })
}

const WAVES: &str = "a list of waves, as in [{ torque = \"0.02 N*m\", per_turn = 6 }]";

fn torque(value: &Value<'_>, torque_constant: f64) -> Result<f64, ConfigError> {
    let (index, size) = value.quantity_of(&[Dimension::TORQUE, Dimension::CURRENT])?;
    if size < 0.0 {
        return Err(value.range("zero or greater"));
    }
    Ok(if index == 0 { size } else { size * torque_constant })
}
