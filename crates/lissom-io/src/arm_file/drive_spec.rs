//! The table `[drive]`: a motor and its friction.

use lissom::drive::Falloff;

use crate::config::{ConfigError, Rule, Table, Value};
use crate::units::Dimension;

/// A motor with friction, referred to the joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DriveSpec {
    /// Inertia \[kg·m²\].
    pub inertia_kg_m2: f64,
    /// Viscous friction, mean of both directions \[N·m·s/rad\].
    pub viscous_nm_s_per_rad: f64,
    /// What is more of it forward than in the mean, and less backward \[N·m·s/rad\].
    pub viscous_apart_nm_s_per_rad: f64,
    /// Torque constant \[N·m/A\].
    pub torque_constant_nm_per_a: f64,
    /// Coulomb friction in forward motion, a magnitude \[N·m\].
    pub coulomb_forward_nm: f64,
    /// Coulomb friction in backward motion, a magnitude \[N·m\].
    pub coulomb_backward_nm: f64,
    /// Friction at rest where it is another.
    pub rest: Option<RestSpec>,
    /// Friction that changes over the turn.
    pub ripple: Option<RippleSpec>,
    /// Bristles (LuGre).
    pub bristles: Option<BristlesSpec>,
}

/// Bristles below Coulomb friction, and how exactly they are solved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BristlesSpec {
    /// σ0 \[N·m/rad\].
    pub stiffness_nm_per_rad: f64,
    /// σ1 \[N·m·s/rad\].
    pub damping_nm_s_per_rad: f64,
    /// Relative tolerance of a step.
    pub tolerance: f64,
}

/// Tolerance of bristles where the file does not say.
const TOLERANCE: f64 = 1e-8;

/// Friction at rest, and the speed over which it passes into Coulomb friction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RestSpec {
    /// What holds against forward motion \[N·m\].
    pub forward_nm: f64,
    /// What holds against backward motion \[N·m\].
    pub backward_nm: f64,
    /// v_s \[rad/s\].
    pub velocity_rad_s: f64,
    /// How it falls off.
    pub falloff: Falloff,
}

/// Friction that changes over the turn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RippleSpec {
    /// Largest change by the mean \[1\].
    pub share: f64,
    /// Periods in a turn.
    pub per_turn: f64,
    /// Phase at angle zero \[rad\].
    pub phase_rad: f64,
}

pub(super) fn drive(table: &Table<'_>) -> Result<DriveSpec, ConfigError> {
    table.only(&[
        "inertia",
        "viscous",
        "torque_constant",
        "coulomb",
        "rest",
        "ripple",
        "bristles",
    ])?;
    if let Some((_, bristles)) = table.one_of(&["ripple", "bristles"])?.filter(|(i, _)| *i == 1) {
        bristles_fit(table, &bristles)?;
    }
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
    Ok(DriveSpec {
        inertia_kg_m2: table.need("inertia")?.positive(Dimension::INERTIA)?,
        viscous_nm_s_per_rad: 0.5 * (viscous_forward + viscous_backward),
        viscous_apart_nm_s_per_rad: 0.5 * (viscous_forward - viscous_backward),
        torque_constant_nm_per_a: torque_constant,
        coulomb_forward_nm: forward,
        coulomb_backward_nm: backward,
        rest: table.get("rest").map(|v| rest(&v.table()?, in_torque)).transpose()?,
        ripple: table.get("ripple").map(|v| ripple(&v.table()?)).transpose()?,
        bristles: table.get("bristles").map(|v| bristles(&v.table()?)).transpose()?,
    })
}

/// One figure for both directions, or for each.
fn by_direction(
    value: &Value<'_>,
    read: impl Fn(&Value<'_>) -> Result<f64, ConfigError>,
) -> Result<(f64, f64), ConfigError> {
    match value.as_table() {
        Some(table) => {
            table.only(&["forward", "backward"])?;
            let side = |key| read(&table.need(key)?);
            Ok((side("forward")?, side("backward")?))
        }
        None => read(value).map(|both| (both, both)),
    }
}

fn torque(value: &Value<'_>, torque_constant: f64) -> Result<f64, ConfigError> {
    let (index, size) = value.quantity_of(&[Dimension::TORQUE, Dimension::CURRENT])?;
    if size < 0.0 {
        return Err(value.range(Rule::NotNegative));
    }
    Ok(if index == 0 { size } else { size * torque_constant })
}

fn rest(
    table: &Table<'_>,
    torque: impl Fn(&Value<'_>) -> Result<f64, ConfigError>,
) -> Result<RestSpec, ConfigError> {
    table.only(&["friction", "velocity", "falloff"])?;
    let (forward_nm, backward_nm) = by_direction(&table.need("friction")?, torque)?;
    let shapes = [Falloff::Exponential, Falloff::Gaussian];
    let falloff = table.get("falloff").map(|v| v.choice(&shapes.map(Falloff::name))).transpose()?;
    Ok(RestSpec {
        forward_nm,
        backward_nm,
        velocity_rad_s: table.need("velocity")?.positive(Dimension::RATE)?,
        falloff: falloff.map_or(shapes[0], |i| shapes[i]),
    })
}

fn ripple(table: &Table<'_>) -> Result<RippleSpec, ConfigError> {
    table.only(&["share", "per_turn", "phase"])?;
    let value = table.need("share")?;
    let share = value.not_negative(Dimension::NUMBER)?;
    if share >= 1.0 {
        return Err(value.range(Rule::Below(1.0)));
    }
    let phase = table.get("phase").map(|v| v.quantity(Dimension::NUMBER));
    Ok(RippleSpec {
        share,
        per_turn: table.need("per_turn")?.positive(Dimension::NUMBER)?,
        phase_rad: phase.transpose()?.unwrap_or(0.0),
    })
}

fn bristles(table: &Table<'_>) -> Result<BristlesSpec, ConfigError> {
    table.only(&["stiffness", "damping", "tolerance"])?;
    let damping = table.get("damping").map(|v| v.not_negative(Dimension::VISCOUS_ROTARY));
    let tolerance = table.get("tolerance").map(|v| v.positive(Dimension::NUMBER)).transpose()?;
    Ok(BristlesSpec {
        stiffness_nm_per_rad: table.need("stiffness")?.positive(Dimension::TORQUE)?,
        damping_nm_s_per_rad: damping.transpose()?.unwrap_or(0.0),
        tolerance: tolerance.unwrap_or(TOLERANCE),
    })
}

/// Bristles need Coulomb friction, and the law's fall from rest is Gaussian.
fn bristles_fit(drive: &Table<'_>, bristles: &Value<'_>) -> Result<(), ConfigError> {
    if drive.get("coulomb").is_none() {
        return Err(ConfigError::Needs { place: bristles.place(), key: "drive.coulomb" });
    }
    if let Some(sides) = drive.get("viscous").filter(|v| v.as_table().is_some()) {
        return Err(sides.kind("one figure for both directions (beside `bristles`)"));
    }
    let falloff = drive.get("rest").and_then(|v| v.as_table()).and_then(|t| t.get("falloff"));
    match falloff {
        Some(value) => value.choice(&["gaussian"]).map(|_| ()),
        None => Ok(()),
    }
}
