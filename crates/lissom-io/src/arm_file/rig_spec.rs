//! The table `[rig]`: sampling, sensors, amplifier, controller.

use lissom_core::rig::Word;

use crate::config::{ConfigError, Table, Value};
use crate::units::Dimension;

/// A test rig with a sampled controller.
#[derive(Debug, Clone, PartialEq)]
pub struct RigSpec {
    /// Sample time \[s\].
    pub sample_time_s: f64,
    /// The controller acts at every n-th sample.
    pub control_every: usize,
    /// Every n-th sample is logged.
    pub log_every: usize,
    /// Magnitude at which the current saturates \[A\].
    pub current_limit_a: Option<f64>,
    /// Dead band: demands up to this magnitude give no current \[A\].
    pub dead_band_a: Option<f64>,
    /// The D/A converter of the current.
    pub current_converter: Option<ConverterSpec>,
    /// Time from the reading of the sensors to the change of the current \[s\].
    pub delay_s: Option<f64>,
    /// The motor's angle sensor.
    pub motor_sensor: Option<SensorSpec>,
    /// The sensors of the angles of the masses; `None`: the same as the motor's.
    pub tip_sensors: Option<Vec<SensorSpec>>,
    /// The motor's position controller.
    pub controller: Option<ControllerSpec>,
    /// Number of point masses for a beam with mass along it.
    pub masses: Option<usize>,
}

/// A D/A converter with equal steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConverterSpec {
    /// Number of bits.
    pub bits: u32,
    /// From the lowest to the highest value \[A\].
    pub range_a: f64,
}

/// A sensor of an angle.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SensorSpec {
    /// Its resolution; `None` without steps.
    pub steps: Option<SensorSteps>,
    /// Standard deviation of its noise \[rad\]; `None` without noise.
    pub noise_rad: Option<f64>,
}

/// Resolution of a sensor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SensorSteps {
    /// An A/D converter.
    Bits {
        /// Bits of a reading.
        bits: u32,
        /// Range of angle over which each reading occurs once \[rad\].
        range_rad: f64,
    },
    /// Counts of an encoder per turn.
    CountsPerTurn(u32),
}

/// A position controller, from angle to current.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ControllerSpec {
    /// Proportional gain \[A/rad\].
    pub proportional_a_per_rad: f64,
    /// Derivative gain \[A·s/rad\].
    pub derivative_a_s_per_rad: f64,
    /// Integral gain \[A/(rad·s)\].
    pub integral_a_per_rad_s: Option<f64>,
    /// Time constant of the filter of the derivative \[s\].
    pub filter_s: Option<f64>,
    /// Integer arithmetic of the control computer, if it has any.
    pub integers: Option<IntegerSpec>,
}

/// Integer arithmetic of a control computer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct IntegerSpec {
    /// Length of the integers.
    pub word: Word,
    /// Bits of the gains after the binary point.
    pub binary_point: u32,
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
    let count = |key, most| -> Result<Option<usize>, ConfigError> {
        let count = table.optional(key, |v| v.whole(1, most))?;
        Ok(count.and_then(|c| usize::try_from(c).ok()))
    };
    Ok(RigSpec {
        sample_time_s: table.need("sample_time")?.positive(Dimension::TIME)?,
        control_every: count("control_every", EVERY_MOST)?.unwrap_or(1),
        log_every: count("log_every", EVERY_MOST)?.unwrap_or(1),
        current_limit_a: table.positive("current_limit", Dimension::CURRENT)?,
        dead_band_a: table.not_negative("dead_band", Dimension::CURRENT)?,
        current_converter: table.optional("current_converter", |v| converter(&v.table()?))?,
        delay_s: table.not_negative("delay", Dimension::TIME)?,
        motor_sensor: table.optional("motor_sensor", sensor)?,
        tip_sensors: table
            .optional("tip_sensors", |v| v.one_or_list().iter().map(sensor).collect())?,
        controller: table.optional("controller", |v| controller(&v.table()?))?,
        masses: count("masses", MASSES_MOST)?,
    })
}

fn bits(table: &Table<'_>) -> Result<u32, ConfigError> {
    Ok(u32::try_from(table.need("bits")?.whole(1, 32)?).unwrap_or(32))
}

fn converter(table: &Table<'_>) -> Result<ConverterSpec, ConfigError> {
    table.only("bits range")?;
    let range_a = table.need("range")?.positive(Dimension::CURRENT)?;
    Ok(ConverterSpec { bits: bits(table)?, range_a })
}

fn sensor(value: &Value<'_>) -> Result<SensorSpec, ConfigError> {
    let table = value.table()?;
    table.only("bits range counts_per_turn noise")?;
    let steps = match table.one_of(&["bits", "counts_per_turn"])? {
        Some((0, _)) => Some(SensorSteps::Bits {
            bits: bits(&table)?,
            range_rad: table.need("range")?.positive(Dimension::NUMBER)?,
        }),
        Some((_, counts)) => {
            let counts = counts.whole(1, i64::from(u32::MAX))?;
            Some(SensorSteps::CountsPerTurn(u32::try_from(counts).unwrap_or(u32::MAX)))
        }
        None => None,
    };
    if let Some(range) =
        table.get("range").filter(|_| !matches!(steps, Some(SensorSteps::Bits { .. })))
    {
        return Err(range.needs("bits"));
    }
    Ok(SensorSpec { steps, noise_rad: table.positive("noise", Dimension::NUMBER)? })
}

fn controller(table: &Table<'_>) -> Result<ControllerSpec, ConfigError> {
    table.only("proportional derivative integral filter integers")?;
    let derivative = table.not_negative("derivative", Dimension::TORQUE_PER_VOLTAGE)?;
    let integral_a_per_rad_s = table.not_negative("integral", Dimension::CURRENT_RATE)?;
    let filter_s = table.not_negative("filter", Dimension::TIME)?;
    for other in ["integral", "filter"] {
        table.one_of(&["integers", other])?;
    }
    Ok(ControllerSpec {
        proportional_a_per_rad: table.need("proportional")?.not_negative(Dimension::CURRENT)?,
        derivative_a_s_per_rad: derivative.unwrap_or(0.0),
        integral_a_per_rad_s,
        filter_s,
        integers: table.optional("integers", |v| integer(&v.table()?))?,
    })
}

fn integer(table: &Table<'_>) -> Result<IntegerSpec, ConfigError> {
    table.only("word binary_point")?;
    let value = table.need("word")?;
    let word = match value.whole(16, 32)? {
        16 => Word::Short,
        32 => Word::Long,
        _ => return Err(value.range("16 or 32")),
    };
    let most = i64::from(word.bits()) - 1;
    let point = table.need("binary_point")?.whole(0, most)?;
    Ok(IntegerSpec { word, binary_point: u32::try_from(point).unwrap_or(0) })
}
