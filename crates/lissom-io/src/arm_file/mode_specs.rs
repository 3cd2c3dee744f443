//! The table `[beam]` of a beam that is given by its modes.

use lissom_core::beam::KnownMode;

use super::tip_spec::omega;
use crate::config::{ConfigError, Table, Value};
use crate::units::Dimension;

const MODES: &str =
    "a list of modes, as in [{ frequency = \"6.8 Hz\", coupling = \"0.5 N*m\", gains = [1] }]";
const GAINS: &str = "a list of numbers, one for each point";

pub(super) fn modes(table: &Table<'_>) -> Result<Vec<KnownMode>, ConfigError> {
    table.only("modes")?;
    let modes = table.items("modes", MODES, mode)?;
    if modes.is_empty() { Err(table.need("modes")?.kind(MODES)) } else { Ok(modes) }
}

fn mode(value: &Value<'_>) -> Result<KnownMode, ConfigError> {
    let table = value.table()?;
    table.only("frequency omega_rad_s damping_ratio coupling gains")?;
    let ratio = table.not_negative("damping_ratio", Dimension::NUMBER)?;
    let gains = table.need("gains")?.list(GAINS)?;
    Ok(KnownMode {
        omega_rad_s: omega(&table)?,
        damping_ratio: ratio.unwrap_or(0.0),
        coupling_nm_per_rad: table.need("coupling")?.positive(Dimension::TORQUE)?,
        gains: gains.iter().map(Value::number).collect::<Result<_, _>>()?,
    })
}
