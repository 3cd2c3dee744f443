//! Friction in the table `[drive]` that is not constant.

use lissom_core::drive::{Coulomb, DriveError, DryFriction, Falloff, LuGre};
use lissom_core::load::GravityLoad;
use lissom_core::rig::JointFriction;

use super::arm_error::unusable;
use super::load_spec;
use crate::config::{ConfigError, Table, Value};
use crate::units::Dimension;

/// Friction of a joint.
#[derive(Debug, Clone, PartialEq)]
pub struct FrictionSpec {
    /// Dry friction; with bristles, their torque in steady motion.
    pub law: DryFriction,
    /// Bristles of the LuGre model, and the relative tolerance of a step of their solution.
    pub bristles: Option<(LuGre, f64)>,
}

/// Tolerance of bristles, if the file does not give one.
const TOLERANCE: f64 = 1e-8;

impl FrictionSpec {
    /// Reads the keys of `[drive]`; `sliding` is Coulomb friction at speed, `load` the one of the table `[load]`.
    pub(super) fn read(
        drive: &Table<'_>,
        sliding: Coulomb,
        load: Option<GravityLoad>,
        viscous_apart_nm_s_per_rad: f64,
        torque: impl Fn(&Value<'_>) -> Result<f64, ConfigError>,
    ) -> Result<Self, ConfigError> {
        let failed = |source: DriveError| unusable(drive.place(), source);
        for term in ["ripple", "root", "with_load"] {
            drive.one_of(&[term, "bristles"])?;
        }
        if let Some(bristles) = drive.get("bristles") {
            bristles_fit(drive, &bristles)?;
        }
        let mut law = DryFriction::from(sliding);
        // Without `rest` the speed of bristles has no effect.
        let (mut at_rest, mut velocity) = (sliding, 1.0);
        if let Some(table) = drive.optional("rest", Value::table)? {
            table.only("friction velocity falloff")?;
            let (forward, backward) = by_direction(&table.need("friction")?, &torque)?;
            at_rest = Coulomb::by_direction(forward, backward).map_err(failed)?;
            velocity = table.need("velocity")?.positive(Dimension::RATE)?;
            let shapes = [Falloff::Exponential, Falloff::Gaussian];
            let falloff = table.optional("falloff", |v| v.choice(&shapes.map(Falloff::name)))?;
            let falloff = falloff.unwrap_or(usize::from(drive.get("bristles").is_some()));
            law = law.with_rest(at_rest, velocity, shapes[falloff]).map_err(failed)?;
        }
        if let Some(table) = drive.optional("ripple", Value::table)? {
            table.only("share per_turn phase")?;
            let value = table.need("share")?;
            let share = value.not_negative(Dimension::NUMBER)?;
            if share >= 1.0 {
                return Err(value.range("below 1"));
            }
            let per_turn = table.need("per_turn")?.positive(Dimension::NUMBER)?;
            let phase_rad = table.any("phase", Dimension::NUMBER)?.unwrap_or(0.0);
            law = law.with_ripple(share, per_turn, phase_rad).map_err(failed)?;
        }
        if let Some(table) = drive.optional("root", Value::table)? {
            table.only("friction velocity")?;
            let velocity = table.need("velocity")?.positive(Dimension::RATE)?;
            let root = torque(&table.need("friction")?)? / velocity.sqrt();
            law = law.with_root(root).map_err(failed)?;
        }
        if let Some(value) = drive.get("with_load") {
            let (coefficient, load) = with_load(&value, load)?;
            law = law.with_load(coefficient, load).map_err(failed)?;
        }
        let law = law.with_viscous_apart(viscous_apart_nm_s_per_rad).map_err(failed)?;
        let bristles = drive.optional("bristles", |value| {
            let table = value.table()?;
            table.only("stiffness damping tolerance")?;
            let stiffness = table.need("stiffness")?.positive(Dimension::TORQUE)?;
            let damping = table.not_negative("damping", Dimension::VISCOUS_ROTARY)?;
            let tolerance = table.positive("tolerance", Dimension::NUMBER)?.unwrap_or(TOLERANCE);
            let made = LuGre::new(stiffness, damping.unwrap_or(0.0), sliding, at_rest, velocity);
            Ok((made.map_err(failed)?, tolerance))
        })?;
        Ok(Self { law, bristles })
    }

    /// The friction of the joint.
    pub(crate) fn joint(&self) -> JointFriction {
        match self.bristles {
            Some((law, tolerance)) => JointFriction::Bristles { law, tolerance },
            None if self.law.is_constant() => JointFriction::Arm,
            None => JointFriction::Dry(self.law.clone()),
        }
    }
}

/// Reads one value for both directions, or one for each.
pub(super) fn by_direction(
    value: &Value<'_>,
    read: impl Fn(&Value<'_>) -> Result<f64, ConfigError>,
) -> Result<(f64, f64), ConfigError> {
    match value.as_table() {
        Some(table) => {
            table.only("forward backward")?;
            let side = |key| read(&table.need(key)?);
            Ok((side("forward")?, side("backward")?))
        }
        None => read(value).map(|both| (both, both)),
    }
}

/// A coefficient, with the load of the table `[load]` or its own.
fn with_load(
    value: &Value<'_>,
    load: Option<GravityLoad>,
) -> Result<(f64, GravityLoad), ConfigError> {
    let Some(table) = value.as_table() else {
        let coefficient = value.not_negative(Dimension::NUMBER)?;
        return Ok((coefficient, load.ok_or_else(|| value.needs("load"))?));
    };
    table.only("coefficient gravity_torque phase")?;
    let coefficient = table.need("coefficient")?.not_negative(Dimension::NUMBER)?;
    Ok((coefficient, load_spec::keys(&table)?.gravity()))
}

/// Checks that bristles have Coulomb friction, and a Gaussian falloff from rest.
fn bristles_fit(drive: &Table<'_>, bristles: &Value<'_>) -> Result<(), ConfigError> {
    if drive.get("coulomb").is_none() {
        return Err(bristles.needs("drive.coulomb"));
    }
    if let Some(sides) = drive.get("viscous").filter(|v| v.as_table().is_some()) {
        return Err(sides.kind("one number for both directions (with `bristles`)"));
    }
    let falloff = drive.get("rest").and_then(|v| v.as_table()).and_then(|t| t.get("falloff"));
    falloff.map_or(Ok(()), |value| value.choice(&["gaussian"]).map(|_| ()))
}
