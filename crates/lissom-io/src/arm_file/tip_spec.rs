//! The table `[tip]`: what acts on the arm's tip, and changes of the payload.

use lissom_core::beam::Payload;
use lissom_core::rig::{Harmonic, RigError, Signal, TipWorld, Wall};

use super::arm_error::unusable;
use super::beam_spec::payload;
use crate::config::{ConfigError, Table, Value};
use crate::units::Dimension;

/// What acts on the tip.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TipSpec {
    /// Forces, friction and walls.
    pub world: TipWorld,
    /// Times \[s\] from the start of a run at which the payload changes, with the new payload.
    pub payloads: Vec<(f64, Payload)>,
}

pub(super) fn tip(table: &Table<'_>) -> Result<TipSpec, ConfigError> {
    table.only("force torque viscous coulomb walls payloads")?;
    let force = table.optional("force", |v| signal(v, Dimension::FORCE))?;
    let torque = table.optional("torque", |v| signal(v, Dimension::TORQUE))?;
    let viscous = table.not_negative("viscous", Dimension::VISCOUS_LINEAR)?;
    let world = TipWorld {
        force: force.unwrap_or_default(),
        torque: torque.unwrap_or_default(),
        viscous_n_s_per_m: viscous.unwrap_or(0.0),
        coulomb_n: table.not_negative("coulomb", Dimension::FORCE)?.unwrap_or(0.0),
        walls: table.items("walls", "a list of walls", |v| wall(&v.table()?))?,
    };
    let change = |v: &Value<'_>| change(&v.table()?);
    let payloads = table.items("payloads", "a list of payloads, each with `at`", change)?;
    Ok(TipSpec { world, payloads })
}

fn wall(table: &Table<'_>) -> Result<Wall, ConfigError> {
    table.only("angle stiffness side")?;
    let side = table.optional("side", |v| v.choice(&["ahead", "behind"]))?;
    Ok(Wall {
        angle_rad: table.need("angle")?.quantity(Dimension::NUMBER)?,
        stiffness_n_per_m: table.need("stiffness")?.positive(Dimension::STIFFNESS)?,
        ahead: side != Some(1),
    })
}

fn change(table: &Table<'_>) -> Result<(f64, Payload), ConfigError> {
    table.only("at mass inertia offset")?;
    let at = table.need("at")?.positive(Dimension::TIME)?;
    // Without any of these keys the payload is removed.
    let bare = ["mass", "inertia", "offset"].iter().all(|key| table.get(key).is_none());
    Ok((at, if bare { Payload::default() } else { payload(table)? }))
}

/// Reads a quantity over the time from the start of a run: a constant, `offset + amplitude·sin(ω·t + phase)`, or times and
/// values.
fn signal(value: &Value<'_>, dimension: Dimension) -> Result<Signal, ConfigError> {
    let failed = |source: RigError| unusable(value.place(), source);
    let Some(table) = value.as_table() else {
        return Signal::constant(value.quantity(dimension)?).map_err(failed);
    };
    if table.get("times").is_none() {
        table.only("amplitude frequency omega_rad_s phase offset")?;
        // The mean is a cosine of frequency zero.
        let mean = Harmonic {
            amplitude: table.any("offset", dimension)?.unwrap_or(0.0),
            omega_rad_s: 0.0,
            phase_rad: std::f64::consts::FRAC_PI_2,
        };
        let swing = Harmonic {
            amplitude: table.need("amplitude")?.quantity(dimension)?,
            omega_rad_s: omega(&table)?,
            phase_rad: table.any("phase", Dimension::NUMBER)?.unwrap_or(0.0),
        };
        return Signal::harmonics(&[swing, mean]).map_err(failed);
    }
    table.only("times values hold")?;
    let times = table.items("times", "a list", |v| v.quantity(Dimension::TIME))?;
    let all = table.need("values")?;
    let values = table.items("values", "a list", |v| v.quantity(dimension))?;
    if times.is_empty() {
        return Err(table.need("times")?.empty());
    }
    if times.len() != values.len() {
        return Err(all.kind("a list as long as `times`"));
    }
    let rows: Vec<(f64, f64)> = times.into_iter().zip(values).collect();
    match table.optional("hold", |v| v.choice(&["steps", "lines"]))? {
        Some(1) => Signal::lines(&rows),
        _ => Signal::steps(&rows),
    }
    .map_err(failed)
}

/// Reads a frequency: `frequency` with a unit such as Hz or rad/s, or `omega_rad_s`.
pub(crate) fn omega(table: &Table<'_>) -> Result<f64, ConfigError> {
    match table.one_of(&["frequency", "omega_rad_s"])? {
        Some((0, value)) => value.positive(Dimension::RATE),
        Some((_, value)) => value.positive(Dimension::NUMBER),
        None => Err(table.none_of(&["frequency", "omega_rad_s"])),
    }
}
