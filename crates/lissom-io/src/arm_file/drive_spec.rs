//! The table `[drive]`: a motor and its friction.

use lissom_core::load::{GravityLoad, TorqueRipple};

use super::friction_spec::{FrictionSpec, by_direction};
use crate::config::{ConfigError, Rule, Table, Value};
use crate::units::Dimension;

/// A motor with friction, referred to the joint.
#[derive(Debug, Clone, PartialEq)]
pub struct DriveSpec {
    /// Inertia \[kg·m²\].
    pub inertia_kg_m2: f64,
    /// Viscous friction, mean of both directions \[N·m·s/rad\].
    pub viscous_nm_s_per_rad: f64,
    /// Torque constant \[N·m/A\].
    pub torque_constant_nm_per_a: f64,
    /// Coulomb friction in forward motion, a magnitude \[N·m\].
    pub coulomb_forward_nm: f64,
    /// Coulomb friction in backward motion, a magnitude \[N·m\].
    pub coulomb_backward_nm: f64,
    /// Friction that is not constant.
    pub friction: FrictionSpec,
    /// Torque ripples (cogging) of the motor.
    pub torque_ripples: Vec<TorqueRipple>,
}

/// Reads the table; `load` is the one of the table `[load]`.
pub(super) fn drive(
    table: &Table<'_>,
    load: Option<GravityLoad>,
) -> Result<DriveSpec, ConfigError> {
    let own = ["inertia", "viscous", "torque_constant", "coulomb", "torque_ripples"];
    table.only(&[&own[..], &FrictionSpec::KEYS[..]].concat())?;
    let torque_constant = table.need("torque_constant")?.positive(Dimension::TORQUE_PER_CURRENT)?;
    let (viscous_forward, viscous_backward) = match table.get("viscous") {
        Some(value) => by_direction(&value, |v| v.not_negative(Dimension::VISCOUS_ROTARY))?,
        None => (0.0, 0.0),
    };
    let in_torque = |value: &Value<'_>| torque(value, torque_constant);
    let (forward, backward) = match table.get("coulomb") {
        Some(value) => by_direction(&value, in_torque)?,
        None => (0.0, 0.0),
    };
    let apart = 0.5 * (viscous_forward - viscous_backward);
    Ok(DriveSpec {
        inertia_kg_m2: table.need("inertia")?.positive(Dimension::INERTIA)?,
        viscous_nm_s_per_rad: 0.5 * (viscous_forward + viscous_backward),
        torque_constant_nm_per_a: torque_constant,
        coulomb_forward_nm: forward,
        coulomb_backward_nm: backward,
        friction: FrictionSpec::read(table, load, apart, in_torque)?,
        torque_ripples: match table.get("torque_ripples") {
            Some(value) => torque_ripples(&value, in_torque)?,
            None => Vec::new(),
        },
    })
}

fn torque_ripples(
    value: &Value<'_>,
    torque: impl Fn(&Value<'_>) -> Result<f64, ConfigError>,
) -> Result<Vec<TorqueRipple>, ConfigError> {
    let expected = "a list of waves, as in [{ torque = \"0.02 N*m\", per_turn = 6 }]";
    let one = |value: &Value<'_>| {
        let table = value.table()?;
        table.only(&["torque", "per_turn", "phase"])?;
        let phase = table.get("phase").map(|v| v.quantity(Dimension::NUMBER)).transpose()?;
        let per_turn = table.need("per_turn")?.positive(Dimension::NUMBER)?;
        let size = torque(&table.need("torque")?)?;
        Ok(TorqueRipple::of_amplitude(size, per_turn, phase.unwrap_or(0.0)))
    };
    value.list(expected)?.iter().map(one).collect()
}

fn torque(value: &Value<'_>, torque_constant: f64) -> Result<f64, ConfigError> {
    let (index, size) = value.quantity_of(&[Dimension::TORQUE, Dimension::CURRENT])?;
    if size < 0.0 {
        return Err(value.range(Rule::NotNegative));
    }
    Ok(if index == 0 { size } else { size * torque_constant })
}
