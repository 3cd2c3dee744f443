//! The table `[signals]`.

use lissom_core::record::{Axis, CommandQuantity, Hold, Tip, TipQuantity};

use super::campaign_error::CampaignError;
use super::campaign_file::ReadOptions;
use crate::config::{ConfigError, Rule, Table, Value};
use crate::io_error::Error;
use crate::log::{ColumnRef, LogOptions};
use crate::units::{Dimension, UnitError};

/// The source of each channel.
pub(super) struct Signals {
    pub(super) time: TimeSource,
    pub(super) decimal_comma: bool,
    /// Row with the names of the columns, from 1.
    pub(super) header_row: Option<usize>,
    /// Rows at the top of a log that do not count.
    pub(super) skip_rows: usize,
    /// The column with the number or name of the run, if a log has several.
    pub(super) run: Option<ColumnRef>,
    pub(super) axis: Axis,
    pub(super) command: CommandSource,
    pub(super) motor: Reading,
    /// Whether the motor's channel is its speed.
    pub(super) motor_speed: bool,
    /// The motor's speed, in addition to its angle.
    pub(super) speed: Option<Reading>,
    pub(super) tips: Vec<(Tip, TipSource)>,
    /// The log of the motor, if it is not that of the run.
    pub(super) motor_log: Option<OwnLog>,
    /// The log of each tip, if it is not that of the run.
    pub(super) tip_logs: Vec<Option<OwnLog>>,
    /// Whether gravity of a load moves the motor.
    pub(super) gravity: bool,
}

impl Signals {
    /// How to read the logs of runs.
    pub(super) fn log_options(&self, options: &ReadOptions) -> LogOptions {
        LogOptions {
            max_rows: options.max_rows,
            decimal_comma: self.decimal_comma,
            header_row: self.header_row,
            skip_rows: self.skip_rows,
        }
    }
}

pub(super) enum TimeSource {
    /// Time stamps, and their unit [s].
    Stamps(ColumnRef, f64),
    /// A sample time [s].
    Steps(f64),
}

impl TimeSource {
    /// The column of the stamps.
    pub(super) fn column(&self) -> Option<&ColumnRef> {
        match self {
            Self::Stamps(column, _) => Some(column),
            Self::Steps(_) => None,
        }
    }
}

/// The log of a signal that is not in the log of its run.
pub(super) struct OwnLog {
    /// The file, in which `{run}` may stand for the name of the run's log.
    pub(super) file: String,
    /// Its time, if it is not as in the log of the run.
    pub(super) time: Option<TimeSource>,
    /// Whether both logs have the same clock.
    pub(super) shared_clock: bool,
}

pub(super) struct CommandSource {
    pub(super) reading: Reading,
    pub(super) kind: CommandKind,
    pub(super) hold: Hold,
    /// Whether the file says that it does not know.
    pub(super) hold_assumed: bool,
}

/// Kind of a command. For the library, torques and goals are commands of their own unit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum CommandKind {
    Current,
    Voltage,
    /// A torque [N·m], or a force [N] on a linear axis.
    Effort,
    /// A position goal of a servo.
    Goal,
    Unknown,
}

impl CommandKind {
    pub(super) fn quantity(self) -> CommandQuantity {
        match self {
            Self::Current => CommandQuantity::Current,
            Self::Voltage => CommandQuantity::Voltage,
            Self::Goal => CommandQuantity::PositionError,
            Self::Effort => CommandQuantity::Effort,
            Self::Unknown => CommandQuantity::Arbitrary,
        }
    }

    /// The kind in words, for messages.
    pub(super) fn name(self, axis: Axis) -> &'static str {
        match (self, axis) {
            (Self::Current, _) => "a current",
            (Self::Voltage, _) => "a voltage",
            (Self::Effort, Axis::Rotary) => "a torque",
            (Self::Effort, Axis::Linear) => "a force",
            (Self::Goal, _) => "a position goal",
            (Self::Unknown, _) => "of unknown unit",
        }
    }
}

/// A column, and the conversion of its numbers to SI: gain·raw + offset.
pub(super) struct Reading {
    pub(super) column: ColumnRef,
    pub(super) gain: f64,
    pub(super) offset: f64,
}

pub(super) enum TipSource {
    Column(Reading),
    Camera { x: ColumnRef, y: ColumnRef, origin: [f64; 2], scale: f64 },
}

pub(super) fn signals(table: &Table<'_>) -> Result<Signals, Error> {
    table.only(&[
        "time",
        "sample_time",
        "run",
        "current",
        "voltage",
        "command",
        "motor",
        "speed",
        "tips",
        "decimal",
        "header_row",
        "skip_rows",
    ])?;
    let time = match table.one_of(&["time", "sample_time"])? {
        None => return Err(none_of(table, &["time", "sample_time"]).into()),
        Some((0, value)) => stamps(&value.table()?)?,
        Some((_, value)) => TimeSource::Steps(value.positive(Dimension::TIME)?),
    };
    let decimal = table.get("decimal").map(|v| v.choice(&[".", ","])).transpose()?;
    let kinds = ["current", "voltage", "command"];
    let Some((kind, value)) = table.one_of(&kinds)? else {
        return Err(none_of(table, &kinds).into());
    };
    let command_table = value.table()?;
    let motor_table = table.need("motor")?.table()?;
    let motor_log = own_log(&motor_table)?;
    let (axis, motor, motor_speed) = motor(&motor_table)?;
    if motor_speed && motor_log.is_some() {
        return Err(CampaignError::OwnLogOfSpeed { place: motor_table.place() }.into());
    }
    let speed = table.get("speed").map(|v| speed(&v, axis, motor_speed)).transpose()?;
    let command = command(&command_table, kind, axis)?;
    if motor_speed && command.kind == CommandKind::Goal {
        return Err(CampaignError::GoalWithSpeed { place: command_table.place() }.into());
    }
    let mut tip_logs = Vec::new();
    let tips = match table.get("tips") {
        None => Vec::new(),
        Some(value) => {
            let items =
                value.list("a list of tips, as in [{ column = \"theta_t\", unit = \"rad\" }]")?;
            for item in &items {
                tip_logs.push(own_log(&item.table()?)?);
            }
            let several = items.len() > 1;
            let tip = |(index, item): (usize, &Value<'_>)| {
                let name = if several { format!("tip {}", index + 1) } else { "tip".to_owned() };
                tip(&item.table()?, axis, name)
            };
            items.iter().enumerate().map(tip).collect::<Result<Vec<_>, _>>()?
        }
    };
    let decimal_comma = decimal == Some(1);
    let row = |key: &str, least| {
        let value = table.get(key).map(|v| v.whole(least, 1_000_000)).transpose();
        value.map(|v| v.and_then(|v| usize::try_from(v).ok()))
    };
    let (header_row, skip_rows) = (row("header_row", 1)?, row("skip_rows", 0)?);
    let run = table.get("run").map(|value| column(&value)).transpose()?;
    Ok(Signals {
        time,
        decimal_comma,
        header_row,
        skip_rows: skip_rows.unwrap_or(0),
        run,
        axis,
        command,
        motor,
        motor_speed,
        speed,
        tips,
        motor_log,
        tip_logs,
        gravity: false,
    })
}

/// Keys of a signal in a log of its own.
const OWN_LOG: [&str; 4] = ["file", "time", "sample_time", "clock"];

/// The log of a signal, if it has one of its own.
fn own_log(table: &Table<'_>) -> Result<Option<OwnLog>, Error> {
    let Some(file) = table.get("file") else {
        for key in &OWN_LOG[1..] {
            if let Some(value) = table.get(key) {
                return Err(CampaignError::NoOwnLog { place: value.place() }.into());
            }
        }
        return Ok(None);
    };
    let time = match table.get("time") {
        Some(_) => table.one_of(&["time", "sample_time"])?.map(|(_, v)| stamps(&v.table()?)),
        None => {
            table.get("sample_time").map(|v| v.positive(Dimension::TIME).map(TimeSource::Steps))
        }
    };
    let clock = table.get("clock").map(|v| v.choice(&["own", "shared"])).transpose()?;
    let file = file.text()?.to_owned();
    Ok(Some(OwnLog { file, time: time.transpose()?, shared_clock: clock == Some(1) }))
}

fn none_of(table: &Table<'_>, keys: &[&'static str]) -> ConfigError {
    ConfigError::NoneOf { place: table.place(), keys: keys.to_vec() }
}

fn stamps(table: &Table<'_>) -> Result<TimeSource, ConfigError> {
    table.only(&["column", "unit", "scale"])?;
    let unit_s = table.need("unit")?.unit(Dimension::TIME)?;
    let scale = table.get("scale").map(|v| v.positive(Dimension::NUMBER)).transpose()?;
    Ok(TimeSource::Stamps(column(&table.need("column")?)?, unit_s * scale.unwrap_or(1.0)))
}

pub(crate) fn column(value: &Value<'_>) -> Result<ColumnRef, ConfigError> {
    match value.as_text() {
        Some(name) => Ok(ColumnRef::Name(name.to_owned())),
        None => Ok(ColumnRef::Number(usize::try_from(value.whole(1, 100_000)?).unwrap_or(1))),
    }
}

fn scale(table: &Table<'_>) -> Result<f64, ConfigError> {
    let Some(value) = table.get("scale") else {
        return Ok(1.0);
    };
    match value.number()? {
        0.0 => Err(value.range(Rule::NotZero)),
        scale => Ok(scale),
    }
}

/// Reads a column whose unit has the size `unit_size` in SI.
fn reading(table: &Table<'_>, unit_size: f64) -> Result<Reading, ConfigError> {
    let offset = table.get("offset").map(|v| v.number()).transpose()?;
    Ok(Reading {
        column: column(&table.need("column")?)?,
        gain: scale(table)? * unit_size,
        offset: offset.unwrap_or(0.0) * unit_size,
    })
}

fn command(table: &Table<'_>, key: usize, axis: Axis) -> Result<CommandSource, Error> {
    let keys = ["column", "unit", "scale", "offset", "hold", "quantity"];
    table.only(if key == 2 { &keys } else { &keys[..5] })?;
    let goal =
        key == 2 && table.get("quantity").map(|v| v.choice(&["goal"])).transpose()?.is_some();
    let unit = table.need("unit")?;
    let (size, found) = unit.any_unit()?;
    let effort = match axis {
        Axis::Rotary => Dimension::TORQUE,
        Axis::Linear => Dimension::FORCE,
    };
    let kind = match found {
        _ if goal => {
            let unit_text = unit.text()?.trim();
            let length = axis == Axis::Linear && found == Dimension::LENGTH;
            let angle = axis == Axis::Rotary && found == Dimension::NUMBER;
            if !(length || angle && !["1", "%"].contains(&unit_text)) {
                let (place, unit) = (unit.place(), unit_text.to_owned());
                return Err(
                    CampaignError::GoalUnit { place, unit, position: position(axis) }.into()
                );
            }
            CommandKind::Goal
        }
        Dimension::CURRENT if key != 1 => CommandKind::Current,
        Dimension::VOLTAGE if key != 0 => CommandKind::Voltage,
        Dimension::NUMBER if key == 2 || unit.text()?.trim() == "1" => CommandKind::Unknown,
        found if key == 2 && found == effort => CommandKind::Effort,
        _ if key == 2 => {
            let effort = CommandKind::Effort.name(axis);
            return Err(CampaignError::CommandUnit { place: unit.place(), found, effort }.into());
        }
        _ => {
            let expected = if key == 0 { Dimension::CURRENT } else { Dimension::VOLTAGE };
            return Err(wrong_unit(&unit, found, expected).into());
        }
    };
    let choice = table.need("hold")?.choice(&["sampled", "measured", "unknown"])?;
    let hold = if choice == 0 { Hold::Sampled } else { Hold::Measured };
    Ok(CommandSource { reading: reading(table, size)?, kind, hold, hold_assumed: choice == 2 })
}

/// What the motor's channel measures.
fn position(axis: Axis) -> &'static str {
    match axis {
        Axis::Rotary => "an angle",
        Axis::Linear => "a length",
    }
}

/// Reads the axis, the motor's column, and whether it is a speed.
fn motor(table: &Table<'_>) -> Result<(Axis, Reading, bool), Error> {
    table.only(&[&["column", "unit", "scale", "offset", "quantity"], &OWN_LOG[..]].concat())?;
    let quantity = table.get("quantity").map(|v| v.choice(&["angle", "speed"])).transpose()?;
    let wanted = quantity == Some(1);
    let unit = table.need("unit")?;
    let (size, found) = unit.any_unit()?;
    let (axis, speed) = match found {
        Dimension::NUMBER => (Axis::Rotary, false),
        Dimension::LENGTH => (Axis::Linear, false),
        Dimension::RATE => (Axis::Rotary, true),
        Dimension::VELOCITY => (Axis::Linear, true),
        _ => {
            return Err(CampaignError::MotorUnit { place: unit.place(), found }.into());
        }
    };
    if speed != wanted {
        let (place, unit) = (unit.place(), unit.text()?.trim().to_owned());
        return Err(if speed {
            CampaignError::SpeedUnit { place, unit }
        } else {
            CampaignError::NotASpeed { place, unit }
        }
        .into());
    }
    Ok((axis, reading(table, size)?, speed))
}

/// Reads the motor's speed, in addition to its angle.
fn speed(value: &Value<'_>, axis: Axis, motor_speed: bool) -> Result<Reading, Error> {
    let table = value.table()?;
    if motor_speed {
        return Err(CampaignError::TwoSpeeds { place: table.place() }.into());
    }
    table.only(&["column", "unit", "scale", "offset"])?;
    let size = table.need("unit")?.unit(match axis {
        Axis::Rotary => Dimension::RATE,
        Axis::Linear => Dimension::VELOCITY,
    })?;
    Ok(reading(&table, size)?)
}

fn wrong_unit(unit: &Value<'_>, found: Dimension, expected: Dimension) -> ConfigError {
    let text = unit.as_text().unwrap_or_default().to_owned();
    unit.unit_error(UnitError::Dimension { text, found, expected })
}

fn tip(table: &Table<'_>, axis: Axis, default_name: String) -> Result<(Tip, TipSource), Error> {
    let name = table.get("name").map(|v| v.text()).transpose()?;
    let name = name.map_or(default_name, str::to_owned);
    if table.get("x").is_some() || table.get("y").is_some() {
        let tip = Tip { name, quantity: TipQuantity::Angle, calibrated: true };
        return Ok((tip, camera(table, axis)?));
    }
    let keys =
        ["name", "column", "unit", "scale", "offset", "quantity", "radius", "x", "y", "origin"];
    table.only(&[&keys[..], &OWN_LOG[..]].concat())?;
    let quantity = quantity(table)?;
    let unit = table.need("unit")?;
    let (size, found) = unit.any_unit()?;
    let calibrated = unit.text()?.trim() != "1";
    let acceleration = quantity == TipQuantity::Acceleration;
    // The dimension that needs no radius, and for a rotary axis the one that needs a radius.
    let (direct, by_radius) = match (axis, acceleration) {
        (Axis::Rotary, false) => (Dimension::NUMBER, Some(Dimension::LENGTH)),
        (Axis::Rotary, true) => (Dimension::ANGULAR_ACCELERATION, Some(Dimension::ACCELERATION)),
        (Axis::Linear, false) => (Dimension::LENGTH, None),
        (Axis::Linear, true) => (Dimension::ACCELERATION, None),
    };
    let radius = table.get("radius");
    let size = if calibrated && Some(found) == by_radius {
        let Some(radius) = radius else {
            return Err(CampaignError::NoRadius { place: table.place(), found }.into());
        };
        size / radius.positive(Dimension::LENGTH)?
    } else if calibrated && found != direct {
        return Err(wrong_unit(&unit, found, direct).into());
    } else if let Some(radius) = radius {
        return Err(CampaignError::NeedlessRadius { place: radius.place() }.into());
    } else {
        size
    };
    Ok((Tip { name, quantity, calibrated }, TipSource::Column(reading(table, size)?)))
}

fn quantity(table: &Table<'_>) -> Result<TipQuantity, ConfigError> {
    let Some(value) = table.get("quantity") else {
        return Ok(TipQuantity::Angle);
    };
    Ok(match value.choice(&["angle", "deflection", "acceleration"])? {
        0 => TipQuantity::Angle,
        1 => TipQuantity::Deflection,
        _ => TipQuantity::Acceleration,
    })
}

fn camera(table: &Table<'_>, axis: Axis) -> Result<TipSource, Error> {
    table.one_of(&["column", "x"])?;
    let keys = ["name", "x", "y", "unit", "origin", "scale", "quantity"];
    table.only(&[&keys[..], &OWN_LOG[..]].concat())?;
    if axis == Axis::Linear {
        return Err(CampaignError::CameraOnLinear { place: table.place() }.into());
    }
    if quantity(table)? != TipQuantity::Angle {
        return Err(CampaignError::CameraQuantity { place: table.place() }.into());
    }
    let origin = match table.get("origin") {
        None => [0.0; 2],
        Some(value) => match &value.list("a list of x and y")?[..] {
            [x, y] => [x.number()?, y.number()?],
            _ => return Err(value.kind("a list of x and y").into()),
        },
    };
    Ok(TipSource::Camera {
        x: column(&table.need("x")?)?,
        y: column(&table.need("y")?)?,
        origin,
        scale: scale(table)?,
    })
}
