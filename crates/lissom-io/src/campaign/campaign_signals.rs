//! The table `[signals]`.

use lissom_core::record::{Axis, CommandQuantity, Hold, Tip, TipQuantity};

use super::campaign_file::ReadOptions;
use crate::config::{ConfigError, Table, Value};
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

pub(super) fn signals(table: &Table<'_>) -> Result<Signals, ConfigError> {
    table.only(
        "time sample_time run current voltage command motor speed tips decimal header_row skip_rows",
    )?;
    let time = time(table)?.ok_or_else(|| table.none_of(&["time", "sample_time"]))?;
    let decimal = table.optional("decimal", |v| v.choice(&[".", ","]))?;
    let kinds = ["current", "voltage", "command"];
    let Some((kind, value)) = table.one_of(&kinds)? else {
        return Err(table.none_of(&kinds));
    };
    let command_table = value.table()?;
    let motor_table = table.need("motor")?.table()?;
    let motor_log = own_log(&motor_table)?;
    let (axis, motor, motor_speed) = motor(&motor_table)?;
    if motor_speed && motor_log.is_some() {
        return Err(motor_table.error(
            ": a motor's speed must be in the log of the run; its angle may have a log of its own",
            "give the log with the motor's speed as the `file` of the run",
        ));
    }
    let speed = table.optional("speed", |v| speed(v, axis, motor_speed))?;
    let command = command(&command_table, kind, axis)?;
    if motor_speed && command.kind == CommandKind::Goal {
        return Err(command_table.error(
            ": a position goal needs the motor's position, but the log has its speed",
            "give the column of the motor's angle, or the motor current instead of the goal",
        ));
    }
    let tip_tables = table.items("tips", TIPS, Value::table)?;
    let tip_logs = tip_tables.iter().map(own_log).collect::<Result<_, _>>()?;
    let several = tip_tables.len() > 1;
    let tip = |(index, table): (usize, &Table<'_>)| {
        let name = if several { format!("tip {}", index + 1) } else { "tip".to_owned() };
        tip(table, axis, name)
    };
    let tips = tip_tables.iter().enumerate().map(tip).collect::<Result<Vec<_>, _>>()?;
    let row = |key: &str, least| {
        let value = table.optional(key, |v| v.whole(least, 1_000_000));
        value.map(|v| v.and_then(|v| usize::try_from(v).ok()))
    };
    Ok(Signals {
        time,
        decimal_comma: decimal == Some(1),
        header_row: row("header_row", 1)?,
        skip_rows: row("skip_rows", 0)?.unwrap_or(0),
        run: table.optional("run", column)?,
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

const TIPS: &str = "a list of tips, as in [{ column = \"theta_t\", unit = \"rad\" }]";

/// Keys of a signal in a log of its own.
const OWN_LOG: &str = "file time sample_time clock";

/// The log of a signal, if it has one of its own.
fn own_log(table: &Table<'_>) -> Result<Option<OwnLog>, ConfigError> {
    let Some(file) = table.get("file") else {
        return match OWN_LOG.split(' ').find_map(|key| table.get(key)) {
            None => Ok(None),
            Some(value) => Err(value.error(
                ": this belongs to a signal in a log of its own, and there is no `file`",
                "add `file`, the log that has this signal, or remove it",
            )),
        };
    };
    let time = time(table)?;
    let clock = table.optional("clock", |v| v.choice(&["own", "shared"]))?;
    Ok(Some(OwnLog { file: file.text()?.to_owned(), time, shared_clock: clock == Some(1) }))
}

/// The time stamps or the sample time of a log.
fn time(table: &Table<'_>) -> Result<Option<TimeSource>, ConfigError> {
    Ok(match table.one_of(&["time", "sample_time"])? {
        None => None,
        Some((0, value)) => Some(stamps(&value.table()?)?),
        Some((_, value)) => Some(TimeSource::Steps(value.positive(Dimension::TIME)?)),
    })
}

fn stamps(table: &Table<'_>) -> Result<TimeSource, ConfigError> {
    table.only("column unit scale")?;
    let unit_s = table.need("unit")?.unit(Dimension::TIME)?;
    let scale = table.positive("scale", Dimension::NUMBER)?;
    Ok(TimeSource::Stamps(column(&table.need("column")?)?, unit_s * scale.unwrap_or(1.0)))
}

pub(crate) fn column(value: &Value<'_>) -> Result<ColumnRef, ConfigError> {
    match value.as_text() {
        Some(name) => Ok(ColumnRef::Name(name.to_owned())),
        None => Ok(ColumnRef::Number(usize::try_from(value.whole(1, 100_000)?).unwrap_or(1))),
    }
}

fn scale(table: &Table<'_>) -> Result<f64, ConfigError> {
    let scale = table.optional("scale", |value| match value.number()? {
        0.0 => Err(value.range("other than zero")),
        scale => Ok(scale),
    })?;
    Ok(scale.unwrap_or(1.0))
}

/// Reads a column whose unit has the size `unit_size` in SI.
fn reading(table: &Table<'_>, unit_size: f64) -> Result<Reading, ConfigError> {
    let offset = table.optional("offset", Value::number)?;
    Ok(Reading {
        column: column(&table.need("column")?)?,
        gain: scale(table)? * unit_size,
        offset: offset.unwrap_or(0.0) * unit_size,
    })
}

fn command(table: &Table<'_>, key: usize, axis: Axis) -> Result<CommandSource, ConfigError> {
    let quantity = if key == 2 { "quantity" } else { "" };
    table.only(&format!("column unit scale offset hold {quantity}"))?;
    let goal = key == 2 && table.optional("quantity", |v| v.choice(&["goal"]))?.is_some();
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
                let position = if axis == Axis::Rotary { "an angle" } else { "a length" };
                return Err(unit.error(
                    format!(
                        ": a position goal is {position}, and \"{unit_text}\" is not a unit of {position}"
                    ),
                    "give \"rad\" or \"deg\" for a rotary axis, \"m\" or \"mm\" for a linear one; \
                     counts: unit = \"rad\" with scale = rad per count",
                ));
            }
            CommandKind::Goal
        }
        Dimension::CURRENT if key != 1 => CommandKind::Current,
        Dimension::VOLTAGE if key != 0 => CommandKind::Voltage,
        Dimension::NUMBER if key == 2 || unit.text()?.trim() == "1" => CommandKind::Unknown,
        found if key == 2 && found == effort => CommandKind::Effort,
        _ if key == 2 => {
            let effort = CommandKind::Effort.name(axis);
            return Err(unit.error(
                format!(
                    ": the command is measured in {found}, which is neither a current, a voltage nor {effort}"
                ),
                "give \"A\", \"V\" or \"N*m\" (\"N\" on a linear axis), or \"1\" for a command of \
                 unknown unit",
            ));
        }
        _ => {
            let expected = if key == 0 { Dimension::CURRENT } else { Dimension::VOLTAGE };
            return Err(wrong_unit(&unit, found, expected));
        }
    };
    let choice = table.need("hold")?.choice(&["sampled", "measured", "unknown"])?;
    let hold = if choice == 0 { Hold::Sampled } else { Hold::Measured };
    Ok(CommandSource { reading: reading(table, size)?, kind, hold, hold_assumed: choice == 2 })
}

/// Reads the axis, the motor's column, and whether it is a speed.
fn motor(table: &Table<'_>) -> Result<(Axis, Reading, bool), ConfigError> {
    table.only(&format!("column unit scale offset quantity {OWN_LOG}"))?;
    let quantity = table.optional("quantity", |v| v.choice(&["angle", "speed"]))?;
    let wanted = quantity == Some(1);
    let unit = table.need("unit")?;
    let (size, found) = unit.any_unit()?;
    let (axis, speed) = match found {
        Dimension::NUMBER => (Axis::Rotary, false),
        Dimension::LENGTH => (Axis::Linear, false),
        Dimension::RATE => (Axis::Rotary, true),
        Dimension::VELOCITY => (Axis::Linear, true),
        _ => {
            return Err(unit.error(
                format!(
                    ": the motor is measured in {found}, which is neither an angle nor a length"
                ),
                "give \"rad\" or \"deg\" for a rotary axis, \"m\" or \"mm\" for a linear one; counts: \
                 unit = \"rad\" with scale = rad per count; speeds: \"rpm\" with quantity = \"speed\"",
            ));
        }
    };
    if speed != wanted {
        let text = unit.text()?.trim();
        return Err(if speed {
            unit.error(
                format!(
                    ": \"{text}\" is a unit of speed, but the motor's `quantity` is not \"speed\""
                ),
                "add `quantity = \"speed\"`: the angle is then integrated from the speed",
            )
        } else {
            unit.error(
                format!(
                    ": \"{text}\" is not a unit of speed, but the motor's `quantity` is \"speed\""
                ),
                "give \"rad/s\", \"deg/s\" or \"rpm\" for a rotary axis, \"m/s\" for a linear one, or \
                 remove `quantity` if the channel is an angle",
            )
        });
    }
    Ok((axis, reading(table, size)?, speed))
}

/// Reads the motor's speed, in addition to its angle.
fn speed(value: &Value<'_>, axis: Axis, motor_speed: bool) -> Result<Reading, ConfigError> {
    let table = value.table()?;
    if motor_speed {
        let hint = "remove `speed`, or give the angle as `motor`";
        return Err(table.error(": the motor's channel is a speed already", hint));
    }
    table.only("column unit scale offset")?;
    let size = table.need("unit")?.unit(match axis {
        Axis::Rotary => Dimension::RATE,
        Axis::Linear => Dimension::VELOCITY,
    })?;
    reading(&table, size)
}

fn wrong_unit(unit: &Value<'_>, found: Dimension, expected: Dimension) -> ConfigError {
    let text = unit.as_text().unwrap_or_default().to_owned();
    unit.unit_error(&UnitError::Dimension { text, found, expected })
}

fn tip(
    table: &Table<'_>,
    axis: Axis,
    default_name: String,
) -> Result<(Tip, TipSource), ConfigError> {
    let name = table.optional("name", Value::text)?.map_or(default_name, str::to_owned);
    if table.get("x").is_some() || table.get("y").is_some() {
        let tip = Tip { name, quantity: TipQuantity::Angle, calibrated: true };
        return Ok((tip, camera(table, axis)?));
    }
    table.only(&format!("name column unit scale offset quantity radius x y origin {OWN_LOG}"))?;
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
            return Err(table.error(
                format!(": {found} at a tip of a rotary axis needs `radius`"),
                "give the distance of the sensor from the joint and what it measures, as in \
                 quantity = \"deflection\", radius = \"0.45 m\"",
            ));
        };
        size / radius.positive(Dimension::LENGTH)?
    } else if calibrated && found != direct {
        return Err(wrong_unit(&unit, found, direct));
    } else if let Some(radius) = radius {
        return Err(radius.error(": a radius does not apply to this tip", "remove `radius`"));
    } else {
        size
    };
    Ok((Tip { name, quantity, calibrated }, TipSource::Column(reading(table, size)?)))
}

fn quantity(table: &Table<'_>) -> Result<TipQuantity, ConfigError> {
    let words = ["angle", "deflection", "acceleration"];
    Ok(match table.optional("quantity", |v| v.choice(&words))? {
        None | Some(0) => TipQuantity::Angle,
        Some(1) => TipQuantity::Deflection,
        _ => TipQuantity::Acceleration,
    })
}

fn camera(table: &Table<'_>, axis: Axis) -> Result<TipSource, ConfigError> {
    table.one_of(&["column", "x"])?;
    table.only(&format!("name x y unit origin scale quantity {OWN_LOG}"))?;
    if axis == Axis::Linear {
        return Err(table.error(
            ": x and y of a camera give an angle, but the motor is measured in metres",
            "give one column with a unit of length",
        ));
    }
    if quantity(table)? != TipQuantity::Angle {
        return Err(table.error(
            ": x and y of a camera can only give the angle of the radius to the point",
            "remove `quantity`",
        ));
    }
    let origin = table.optional("origin", |value| match &value.list("a list of x and y")?[..] {
        [x, y] => Ok([x.number()?, y.number()?]),
        _ => Err(value.kind("a list of x and y")),
    })?;
    Ok(TipSource::Camera {
        x: column(&table.need("x")?)?,
        y: column(&table.need("y")?)?,
        origin: origin.unwrap_or_default(),
        scale: scale(table)?,
    })
}
