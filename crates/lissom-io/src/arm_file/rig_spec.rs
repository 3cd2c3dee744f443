//! The table `[rig]`: sampling, sensors, amplifier, controller.

use lissom_core::rig::Word;

use crate::config::{ConfigError, Rule, Table, Value};
use crate::units::Dimension;

/// A sampled control rig.
#[derive(Debug, Clone, PartialEq)]
pub struct RigSpec {
    /// Sample time \[s\].
    pub sample_time_s: f64,
    /// The controller acts at one sample in so many.
    pub control_every: usize,
    /// One sample in so many is logged.
    pub log_every: usize,
    /// Magnitude at which the current saturates \[A\].
    pub current_limit_a: Option<f64>,
    /// Demands up to this give no current \[A\].
    pub dead_band_a: Option<f64>,
    /// The D/A converter of the current.
    pub current_converter: Option<ConverterSpec>,
    /// Time from the sensors' instant to the current's acting \[s\].
    pub delay_s: Option<f64>,
    /// The motor's angle sensor.
    pub motor_sensor: Option<SensorSpec>,
    /// The sensors of the masses' angles; `None`: as the motor's.
    pub tip_sensors: Option<Vec<SensorSpec>>,
    /// The motor's position controller.
    pub controller: Option<ControllerSpec>,
    /// Point masses that stand for a beam with mass along it.
    pub masses: Option<usize>,
}

/// A converter of equal steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConverterSpec {
    /// Bits.
    pub bits: u32,
    /// From the lowest to the highest value \[A\].
    pub range_a: f64,
}

/// A sensor of an angle.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SensorSpec {
    /// Its steps; `None`: none.
    pub steps: Option<SensorSteps>,
    /// Standard deviation of its noise \[rad\]; `None`: none.
    pub noise_rad: Option<f64>,
}

/// Steps of a sensor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SensorSteps {
    /// A converter.
    Bits {
        /// Bits of a reading.
        bits: u32,
        /// Angle over which all readings occur once \[rad\].
        range_rad: f64,
    },
    /// An encoder's counts in a turn.
    CountsPerTurn(u32),
}

/// A controller from angle to current.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ControllerSpec {
    /// Proportional gain \[A/rad\].
    pub proportional_a_per_rad: f64,
    /// Derivative gain \[A·s/rad\].
    pub derivative_a_s_per_rad: f64,
    /// Integral gain \[A/(rad·s)\].
    pub integral_a_per_rad_s: Option<f64>,
    /// Time constant of the derivative's filter \[s\].
    pub filter_s: Option<f64>,
    /// Integer arithmetic.
    pub integers: Option<IntegerSpec>,
}

/// The integers of a control computer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct IntegerSpec {
    /// Their length.
    pub word: Word,
    /// Bits of the gains behind the binary point.
    pub binary_point: u32,
}

/// Most samples between two actions or rows.
const EVERY_MOST: i64 = 1_000_000;
/// Most point masses that stand for a distributed beam.
const MASSES_MOST: i64 = 150;

pub(super) fn rig(table: &Table<'_>) -> Result<RigSpec, ConfigError> {
    table.only(&[
        "sample_time",
        "control_every",
        "log_every",
        "current_limit",
        "dead_band",
        "current_converter",
        "delay",
        "motor_sensor",
        "tip_sensors",
        "controller",
        "masses",
    ])?;
    let count = |key, most| -> Result<Option<usize>, ConfigError> {
        let count = table.get(key).map(|v| v.whole(1, most)).transpose()?;
        Ok(count.and_then(|c| usize::try_from(c).ok()))
    };
    let limit = table.get("current_limit").map(|v| v.positive(Dimension::CURRENT));
    let dead_band = table.get("dead_band").map(|v| v.not_negative(Dimension::CURRENT));
    let delay = table.get("delay").map(|v| v.not_negative(Dimension::TIME));
    let tips = table.get("tip_sensors").map(|v| v.one_or_list().iter().map(sensor).collect());
    Ok(RigSpec {
        sample_time_s: table.need("sample_time")?.positive(Dimension::TIME)?,
        control_every: count("control_every", EVERY_MOST)?.unwrap_or(1),
        log_every: count("log_every", EVERY_MOST)?.unwrap_or(1),
        current_limit_a: limit.transpose()?,
        dead_band_a: dead_band.transpose()?,
        current_converter: table
            .get("current_converter")
            .map(|v| converter(&v.table()?))
            .transpose()?,
        delay_s: delay.transpose()?,
        motor_sensor: table.get("motor_sensor").map(|v| sensor(&v)).transpose()?,
        tip_sensors: tips.transpose()?,
        controller: table.get("controller").map(|v| controller(&v.table()?)).transpose()?,
        masses: count("masses", MASSES_MOST)?,
    })
}

fn bits(table: &Table<'_>) -> Result<u32, ConfigError> {
    Ok(u32::try_from(table.need("bits")?.whole(1, 32)?).unwrap_or(32))
}

fn converter(table: &Table<'_>) -> Result<ConverterSpec, ConfigError> {
    table.only(&["bits", "range"])?;
    let range_a = table.need("range")?.positive(Dimension::CURRENT)?;
    Ok(ConverterSpec { bits: bits(table)?, range_a })
}

fn sensor(value: &Value<'_>) -> Result<SensorSpec, ConfigError> {
    let table = value.table()?;
    table.only(&["bits", "range", "counts_per_turn", "noise"])?;
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
        return Err(ConfigError::Needs { place: range.place(), key: "bits" });
    }
    let noise = table.get("noise").map(|v| v.positive(Dimension::NUMBER));
    Ok(SensorSpec { steps, noise_rad: noise.transpose()? })
}

fn controller(table: &Table<'_>) -> Result<ControllerSpec, ConfigError> {
    table.only(&["proportional", "derivative", "integral", "filter", "integers"])?;
    let gain = |key, dimension| table.get(key).map(|v| v.not_negative(dimension)).transpose();
    let derivative = gain("derivative", Dimension::TORQUE_PER_VOLTAGE)?;
    let integral = gain("integral", Dimension::CURRENT_RATE)?;
    let filter = gain("filter", Dimension::TIME)?;
    let integers = match table.get("integers") {
        None => None,
        Some(value) => {
            if let Some(other) = ["integral", "filter"].into_iter().find(|k| table.get(k).is_some())
            {
                let place = table.place();
                return Err(ConfigError::Clash { place, first: "integers", second: other });
            }
            Some(integer(&value.table()?)?)
        }
    };
    Ok(ControllerSpec {
        proportional_a_per_rad: table.need("proportional")?.not_negative(Dimension::CURRENT)?,
        derivative_a_s_per_rad: derivative.unwrap_or(0.0),
        integral_a_per_rad_s: integral,
        filter_s: filter,
        integers,
    })
}

fn integer(table: &Table<'_>) -> Result<IntegerSpec, ConfigError> {
    table.only(&["word", "binary_point"])?;
    let value = table.need("word")?;
    let word = match value.whole(16, 32)? {
        16 => Word::Short,
        32 => Word::Long,
        _ => return Err(value.range(Rule::OneOf(16, 32))),
    };
    let most = i64::from(word.bits()) - 1;
    let point = table.need("binary_point")?.whole(0, most)?;
    Ok(IntegerSpec { word, binary_point: u32::try_from(point).unwrap_or(0) })
}
