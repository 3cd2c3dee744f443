//! Friction in the table `[drive]` that is not constant.

use lissom_core::drive::{Coulomb, DriveError, DryFriction, Falloff, LuGre};
use lissom_core::load::GravityLoad;
use lissom_core::replay::WithLoad;
use lissom_core::rig::JointFriction;

use super::load_spec;
use crate::config::{ConfigError, Table, Value};
use crate::units::Dimension;

/// Friction of a joint in addition to Coulomb friction by direction and one viscous coefficient.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrictionSpec {
    /// Half the difference of forward and backward viscous friction \[N·m·s/rad\].
    pub viscous_apart_nm_s_per_rad: f64,
    /// Friction at rest, if it differs from Coulomb friction.
    pub rest: Option<RestSpec>,
    /// Friction that changes over the turn.
    pub ripple: Option<RippleSpec>,
    /// A \[N·m/√(rad/s)\]: friction that grows with the square root of speed.
    pub root_nm_per_root_rad_s: Option<f64>,
    /// Friction that grows with the torque of gravity.
    pub with_load: Option<WithLoad>,
    /// Bristles (LuGre).
    pub bristles: Option<BristlesSpec>,
}

/// Bristles of the LuGre model, and the tolerance of their solution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BristlesSpec {
    /// σ0 \[N·m/rad\].
    pub stiffness_nm_per_rad: f64,
    /// σ1 \[N·m·s/rad\].
    pub damping_nm_s_per_rad: f64,
    /// Relative tolerance of a step.
    pub tolerance: f64,
}

/// Tolerance of bristles, if the file does not give one.
const TOLERANCE: f64 = 1e-8;

/// Friction at rest, and the speed over which it passes into Coulomb friction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RestSpec {
    /// Largest torque that friction holds against forward motion \[N·m\].
    pub forward_nm: f64,
    /// Largest torque that friction holds against backward motion \[N·m\].
    pub backward_nm: f64,
    /// v_s \[rad/s\].
    pub velocity_rad_s: f64,
    /// How friction changes over this speed.
    pub falloff: Falloff,
}

/// Friction that changes over the turn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RippleSpec {
    /// Largest change divided by the mean Coulomb friction \[1\].
    pub share: f64,
    /// Periods in a turn.
    pub per_turn: f64,
    /// Phase at angle zero \[rad\].
    pub phase_rad: f64,
}

impl FrictionSpec {
    /// Reads the keys; `load` is the one of the table `[load]`.
    pub(super) fn read(
        drive: &Table<'_>,
        load: Option<GravityLoad>,
        viscous_apart_nm_s_per_rad: f64,
        torque: impl Fn(&Value<'_>) -> Result<f64, ConfigError>,
    ) -> Result<Self, ConfigError> {
        for term in ["ripple", "root", "with_load"] {
            drive.one_of(&[term, "bristles"])?;
        }
        if let Some(bristles) = drive.get("bristles") {
            bristles_fit(drive, &bristles)?;
        }
        Ok(Self {
            viscous_apart_nm_s_per_rad,
            root_nm_per_root_rad_s: drive.optional("root", |v| root(&v.table()?, &torque))?,
            with_load: drive.optional("with_load", |v| with_load(v, load))?,
            rest: drive.optional("rest", |v| rest(&v.table()?, torque))?,
            ripple: drive.optional("ripple", |v| ripple(&v.table()?))?,
            bristles: drive.optional("bristles", |v| bristles(&v.table()?))?,
        })
    }

    /// Builds the friction of the joint; `sliding` is Coulomb friction at speed.
    pub(crate) fn joint(&self, sliding: Coulomb) -> Result<JointFriction, DriveError> {
        if let Some(bristles) = &self.bristles {
            let rest = match &self.rest {
                Some(rest) => Coulomb::by_direction(rest.forward_nm, rest.backward_nm)?,
                None => sliding,
            };
            // Without `rest` the speed has no effect.
            let velocity = self.rest.map_or(1.0, |rest| rest.velocity_rad_s);
            let (stiffness, damping) =
                (bristles.stiffness_nm_per_rad, bristles.damping_nm_s_per_rad);
            let law = LuGre::new(stiffness, damping, sliding, rest, velocity)?;
            return Ok(JointFriction::Bristles { law, tolerance: bristles.tolerance });
        }
        let mut law = DryFriction::from(sliding);
        if let Some(rest) = &self.rest {
            let limits = Coulomb::by_direction(rest.forward_nm, rest.backward_nm)?;
            law = law.with_rest(limits, rest.velocity_rad_s, rest.falloff)?;
        }
        if let Some(ripple) = &self.ripple {
            law = law.with_ripple(ripple.share, ripple.per_turn, ripple.phase_rad)?;
        }
        if let Some(root) = self.root_nm_per_root_rad_s {
            law = law.with_root(root)?;
        }
        if let Some(term) = self.with_load {
            law = law.with_load(term.coefficient, term.load)?;
        }
        law = law.with_viscous_apart(self.viscous_apart_nm_s_per_rad)?;
        Ok(if law.is_constant() { JointFriction::Arm } else { JointFriction::Dry(law) })
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

fn rest(
    table: &Table<'_>,
    torque: impl Fn(&Value<'_>) -> Result<f64, ConfigError>,
) -> Result<RestSpec, ConfigError> {
    table.only("friction velocity falloff")?;
    let (forward_nm, backward_nm) = by_direction(&table.need("friction")?, torque)?;
    let shapes = [Falloff::Exponential, Falloff::Gaussian];
    let falloff = table.optional("falloff", |v| v.choice(&shapes.map(Falloff::name)))?;
    Ok(RestSpec {
        forward_nm,
        backward_nm,
        velocity_rad_s: table.need("velocity")?.positive(Dimension::RATE)?,
        falloff: falloff.map_or(shapes[0], |i| shapes[i]),
    })
}

fn ripple(table: &Table<'_>) -> Result<RippleSpec, ConfigError> {
    table.only("share per_turn phase")?;
    let value = table.need("share")?;
    let share = value.not_negative(Dimension::NUMBER)?;
    if share >= 1.0 {
        return Err(value.range("below 1"));
    }
    Ok(RippleSpec {
        share,
        per_turn: table.need("per_turn")?.positive(Dimension::NUMBER)?,
        phase_rad: table.any("phase", Dimension::NUMBER)?.unwrap_or(0.0),
    })
}

/// A of friction that is `friction` at the speed `velocity`.
fn root(
    table: &Table<'_>,
    torque: impl Fn(&Value<'_>) -> Result<f64, ConfigError>,
) -> Result<f64, ConfigError> {
    table.only("friction velocity")?;
    let velocity = table.need("velocity")?.positive(Dimension::RATE)?;
    Ok(torque(&table.need("friction")?)? / velocity.sqrt())
}

/// A coefficient, with the load of the table `[load]` or its own.
fn with_load(value: &Value<'_>, load: Option<GravityLoad>) -> Result<WithLoad, ConfigError> {
    let needs = || value.needs("load");
    let Some(table) = value.as_table() else {
        let coefficient = value.not_negative(Dimension::NUMBER)?;
        return Ok(WithLoad { coefficient, load: load.ok_or_else(needs)? });
    };
    table.only("coefficient gravity_torque phase")?;
    let coefficient = table.need("coefficient")?.not_negative(Dimension::NUMBER)?;
    Ok(WithLoad { coefficient, load: load_spec::keys(&table)?.gravity() })
}

fn bristles(table: &Table<'_>) -> Result<BristlesSpec, ConfigError> {
    table.only("stiffness damping tolerance")?;
    let damping = table.not_negative("damping", Dimension::VISCOUS_ROTARY)?;
    let tolerance = table.positive("tolerance", Dimension::NUMBER)?;
    Ok(BristlesSpec {
        stiffness_nm_per_rad: table.need("stiffness")?.positive(Dimension::TORQUE)?,
        damping_nm_s_per_rad: damping.unwrap_or(0.0),
        tolerance: tolerance.unwrap_or(TOLERANCE),
    })
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
