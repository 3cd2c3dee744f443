//! The table `[tip]`: what acts on the arm's tip, and changes of the payload.

use lissom_core::beam::Payload;
use lissom_core::rig::Wall;

use super::beam_spec::payload;
use crate::config::{ConfigError, Table, Value};
use crate::units::Dimension;

/// What acts on the tip.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TipSpec {
    /// Force F(t) \[N\].
    pub force: Option<SignalSpec>,
    /// Torque T(t) \[N·m\].
    pub torque: Option<SignalSpec>,
    /// Viscous friction \[N·s/m\].
    pub viscous_n_s_per_m: f64,
    /// Coulomb friction \[N\].
    pub coulomb_n: f64,
    /// Walls.
    pub walls: Vec<Wall>,
    /// Times \[s\] from the start of a run at which the payload changes, with the new payload.
    pub payloads: Vec<(f64, Payload)>,
}

/// A quantity over the time from the start of a run.
#[derive(Debug, Clone, PartialEq)]
pub enum SignalSpec {
    /// A constant.
    Constant(f64),
    /// `offset + amplitude·sin(ω·t + phase)`.
    Sine {
        /// Mean.
        offset: f64,
        /// Amplitude.
        amplitude: f64,
        /// ω \[rad/s\].
        omega_rad_s: f64,
        /// Phase \[rad\].
        phase_rad: f64,
    },
    /// Times \[s\] and values.
    Table {
        /// The rows.
        rows: Vec<(f64, f64)>,
        /// Whether values are interpolated by straight lines; otherwise each value is held.
        lines: bool,
    },
}

pub(super) fn tip(table: &Table<'_>) -> Result<TipSpec, ConfigError> {
    table.only("force torque viscous coulomb walls payloads")?;
    Ok(TipSpec {
        force: table.optional("force", |v| signal(v, Dimension::FORCE))?,
        torque: table.optional("torque", |v| signal(v, Dimension::TORQUE))?,
        viscous_n_s_per_m: table.not_negative("viscous", Dimension::VISCOUS_LINEAR)?.unwrap_or(0.0),
        coulomb_n: table.not_negative("coulomb", Dimension::FORCE)?.unwrap_or(0.0),
        walls: table.items("walls", "a list of walls", |v| wall(&v.table()?))?,
        payloads: table
            .items("payloads", "a list of payloads, each with `at`", |v| change(&v.table()?))?,
    })
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

fn signal(value: &Value<'_>, dimension: Dimension) -> Result<SignalSpec, ConfigError> {
    let Some(table) = value.as_table() else {
        return value.quantity(dimension).map(SignalSpec::Constant);
    };
    if table.get("times").is_none() {
        table.only("amplitude frequency omega_rad_s phase offset")?;
        return Ok(SignalSpec::Sine {
            offset: table.any("offset", dimension)?.unwrap_or(0.0),
            amplitude: table.need("amplitude")?.quantity(dimension)?,
            omega_rad_s: omega(&table)?,
            phase_rad: table.any("phase", Dimension::NUMBER)?.unwrap_or(0.0),
        });
    }
    table.only("times values hold")?;
    let column = |key, dimension| -> Result<Vec<f64>, ConfigError> {
        table.need(key)?.list("a list")?.iter().map(|v| v.quantity(dimension)).collect()
    };
    let times = column("times", Dimension::TIME)?;
    let values = column("values", dimension)?;
    if times.is_empty() {
        return Err(table.need("times")?.empty());
    }
    if times.len() != values.len() {
        return Err(table.need("values")?.kind("a list as long as `times`"));
    }
    let hold = table.optional("hold", |v| v.choice(&["steps", "lines"]))?;
    Ok(SignalSpec::Table { rows: times.into_iter().zip(values).collect(), lines: hold == Some(1) })
}

/// Reads a frequency: `frequency` with a unit such as Hz or rad/s, or `omega_rad_s`.
pub(crate) fn omega(table: &Table<'_>) -> Result<f64, ConfigError> {
    match table.one_of(&["frequency", "omega_rad_s"])? {
        Some((0, value)) => value.positive(Dimension::RATE),
        Some((_, value)) => value.positive(Dimension::NUMBER),
        None => Err(table.none_of(&["frequency", "omega_rad_s"])),
    }
}
