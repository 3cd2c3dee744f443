//! The table `[rig]`: sampling, sensors, amplifier, controller.

use lissom_core::rig::{
    ControlLaw, Delay, Instruments, IntegerPd, Noise, Pd, Pid, Quantiser, RigError, Sensor, Word,
};

use super::arm_error::unusable;
use crate::config::{ConfigError, Table, Value};
use crate::units::Dimension;

/// A test rig with a sampled controller.
#[derive(Debug, Clone, PartialEq)]
pub struct RigSpec {
    /// Sampling, sensors and amplifier. Without sensors of the tips, these are as the motor's.
    pub instruments: Instruments,
    /// The motor's position controller.
    pub controller: Option<ControlLaw>,
    /// Number of point masses for a beam with mass along it.
    pub masses: Option<usize>,
}

/// Largest number of samples between two actions or rows.
const EVERY_MOST: i64 = 1_000_000;
/// Largest number of point masses for a beam with mass along it.
const MASSES_MOST: i64 = 150;

pub(super) fn rig(table: &Table<'_>) -> Result<RigSpec, ConfigError> {
    table.only(
        "sample_time control_every log_every current_limit dead_band current_converter delay \
         motor_sensor tip_sensors controller masses",
    )?;
    let failed = |source: RigError| unusable(table.place(), source);
    let count = |key, most| -> Result<Option<usize>, ConfigError> {
        let count = table.optional(key, |v| v.whole(1, most))?;
        Ok(count.and_then(|c| usize::try_from(c).ok()))
    };
    let sample_time_s = table.need("sample_time")?.positive(Dimension::TIME)?;
    let mut made = Instruments::ideal(sample_time_s).map_err(failed)?;
    made.control_every = count("control_every", EVERY_MOST)?.unwrap_or(1);
    made.log_every = count("log_every", EVERY_MOST)?.unwrap_or(1);
    if let Some(limit_a) = table.positive("current_limit", Dimension::CURRENT)? {
        made.amplifier = made.amplifier.with_limit(limit_a).map_err(failed)?;
    }
    if let Some(dead_band_a) = table.not_negative("dead_band", Dimension::CURRENT)? {
        made.amplifier = made.amplifier.with_dead_band(dead_band_a).map_err(failed)?;
    }
    if let Some(converter) = table.optional("current_converter", Value::table)? {
        converter.only("bits range")?;
        made.amplifier = made.amplifier.with_converter(quantiser(&converter, Dimension::CURRENT)?);
    }
    if let Some(delay_s) = table.not_negative("delay", Dimension::TIME)? {
        made.delay = Some(Delay::new(delay_s).map_err(failed)?);
    }
    made.motor = table.optional("motor_sensor", sensor)?.unwrap_or(Sensor::IDEAL);
    let tips = table.optional("tip_sensors", |v| v.one_or_list().iter().map(sensor).collect())?;
    made.tips = tips.unwrap_or_else(|| vec![made.motor]);
    let controller = table.optional("controller", |v| controller(&v.table()?, &made))?;
    Ok(RigSpec { instruments: made, controller, masses: count("masses", MASSES_MOST)? })
}

/// Reads the equal steps of a converter.
fn quantiser(table: &Table<'_>, expected: Dimension) -> Result<Quantiser, ConfigError> {
    let bits = u32::try_from(table.need("bits")?.whole(1, 32)?).unwrap_or(32);
    let range = table.need("range")?.positive(expected)?;
    Quantiser::new(bits, range).map_err(|source| unusable(table.place(), source))
}

fn sensor(value: &Value<'_>) -> Result<Sensor, ConfigError> {
    let table = value.table()?;
    table.only("bits range counts_per_turn noise")?;
    let failed = |source: RigError| unusable(table.place(), source);
    let steps = table.one_of(&["bits", "counts_per_turn"])?;
    let quantiser = match steps {
        Some((0, _)) => Some(quantiser(&table, Dimension::NUMBER)?),
        Some((_, counts)) => {
            let counts = counts.whole(1, i64::from(u32::MAX))?;
            let counts = u32::try_from(counts).unwrap_or(u32::MAX);
            Some(Quantiser::encoder(counts).map_err(failed)?)
        }
        None => None,
    };
    if let Some(range) = table.get("range").filter(|_| table.get("bits").is_none()) {
        return Err(range.needs("bits"));
    }
    let noise = table.positive("noise", Dimension::NUMBER)?;
    Ok(Sensor { noise: noise.map(Noise::new).transpose().map_err(failed)?, quantiser })
}

fn controller(table: &Table<'_>, instruments: &Instruments) -> Result<ControlLaw, ConfigError> {
    table.only("proportional derivative integral filter integers")?;
    let failed = |source: RigError| unusable(table.place(), source);
    for other in ["integral", "filter"] {
        table.one_of(&["integers", other])?;
    }
    let proportional = table.need("proportional")?.not_negative(Dimension::CURRENT)?;
    let derivative = table.not_negative("derivative", Dimension::TORQUE_PER_VOLTAGE)?;
    let mut pd = Pd::new(proportional, derivative.unwrap_or(0.0)).map_err(failed)?;
    if let Some(filter_s) = table.not_negative("filter", Dimension::TIME)? {
        pd = pd.with_filter(filter_s).map_err(failed)?;
    }
    if let Some(integers) = table.optional("integers", Value::table)? {
        return integer(&integers, &pd, instruments);
    }
    Ok(match table.not_negative("integral", Dimension::CURRENT_RATE)? {
        Some(integral) => Pid::new(pd, integral).map_err(failed)?.into(),
        None => pd.into(),
    })
}

/// Integer arithmetic of a control computer.
fn integer(
    table: &Table<'_>,
    pd: &Pd,
    instruments: &Instruments,
) -> Result<ControlLaw, ConfigError> {
    table.only("word binary_point")?;
    let value = table.need("word")?;
    let word = match value.whole(16, 32)? {
        16 => Word::Short,
        32 => Word::Long,
        _ => return Err(value.range("16 or 32")),
    };
    let point = table.need("binary_point")?.whole(0, i64::from(word.bits()) - 1)?;
    let point = u32::try_from(point).unwrap_or(0);
    let made = || {
        let steps = |of: Option<Quantiser>, what| of.ok_or(RigError::NeedsSteps { what });
        let input = steps(instruments.motor.quantiser, "motor_sensor")?;
        let output = steps(instruments.amplifier.converter(), "current_converter")?;
        IntegerPd::new(pd, instruments.control_time_s(), input, output, word, point)
    };
    Ok(made().map_err(|source| unusable(table.place(), source))?.into())
}
