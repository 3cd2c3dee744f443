//! Values of MATLAB, and the channels they contain.

use crate::array::too_large;
use crate::collected::{Collected, LeftOut};
use crate::columns::Columns;
use crate::format_error::FormatError;
use crate::log_data::{Channel, Clock};

/// A value of a MATLAB file.
#[derive(Debug, Clone)]
pub(super) enum Value {
    Numbers(Columns),
    /// Real and imaginary part.
    Complex([Columns; 2]),
    /// Numbers for which the file has not enough bytes.
    TooLarge,
    Text(String),
    Cells(Vec<Value>),
    Struct(Struct),
    LeftOut(&'static LeftOut),
}

/// A struct or a struct array.
#[derive(Debug, Clone)]
pub(super) struct Struct {
    pub(super) fields: Vec<String>,
    /// The values of all fields of the first element, then those of the second.
    pub(super) values: Vec<Value>,
}

/// Appends the channels of a variable.
pub(super) fn collect(
    name: &str,
    value: &mut Value,
    found: &mut Collected,
) -> Result<(), FormatError> {
    let first = found.channels.len();
    Channels { found, first, lengths: Vec::new() }.collect(name, value)
}

/// The channels of a variable. Those that are not wanted have no values, so that their lengths are kept here.
struct Channels<'a, 'b> {
    found: &'a mut Collected<'b>,
    /// Place of the first one in the file.
    first: usize,
    /// Numbers of values.
    lengths: Vec<usize>,
}

impl Channels<'_, '_> {
    /// Appends the channels of a value.
    fn collect(&mut self, path: &str, value: &mut Value) -> Result<(), FormatError> {
        match value {
            Value::Numbers(columns) => self.push(path, columns),
            Value::Complex(parts) => parts.iter_mut().for_each(|part| self.push(path, part)),
            Value::TooLarge => return Err(too_large(path)),
            Value::Text(_) => {}
            Value::LeftOut(why) => self.found.leave_out(path, why),
            Value::Cells(cells) => {
                if self.collect_scalars(path, cells.iter()) {
                    return Ok(());
                }
                for (k, cell) in cells.iter_mut().enumerate() {
                    self.collect(&format!("{path}[{}]", k + 1), cell)?;
                }
            }
            Value::Struct(of) => of.collect(path, self)?,
        }
        Ok(())
    }

    fn push(&mut self, path: &str, columns: &mut Columns) {
        let length = columns.length;
        std::mem::take(columns).push(path, self.found);
        self.lengths.resize(self.found.channels.len() - self.first, length);
    }

    /// Appends one channel if there are several values and each is one number.
    fn collect_scalars<'v>(&mut self, path: &str, values: impl Iterator<Item = &'v Value>) -> bool {
        let scalar = |value: &Value| match value {
            Value::Numbers(columns) => columns.scalar(),
            _ => None,
        };
        let Some(values) = values.map(scalar).collect::<Option<Vec<f64>>>() else { return false };
        if values.len() < 2 {
            return false;
        }
        self.lengths.push(values.len());
        self.found.channels.push(Channel::of(path, values));
        true
    }

    /// Of a "structure with time" of Simulink, the field `time` is the clock of the field `signals`.
    fn set_clock(&mut self, path: &str, begin: usize) {
        let new = || self.found.channels.iter().enumerate().skip(begin);
        let time = new().find(|(_, c)| c.name.strip_prefix(path) == Some("/time"));
        let Some((time, of)) = time else { return };
        let is_wanted = self.found.wanted.has_at(&of.name, Some(time + 1));
        let Some(length) = self.lengths.get(time - self.first).copied() else { return };
        let signals = format!("{path}/signals");
        let lengths = self.lengths.iter().skip(begin - self.first);
        let mut is_used = is_wanted;
        for (channel, its) in self.found.channels.iter_mut().skip(begin).zip(lengths) {
            if channel.name.starts_with(&signals) && *its == length {
                channel.clock = Clock::Channel(time);
                is_used |= !channel.values.is_empty();
            }
        }
        if let Some(time) = self.found.channels.get_mut(time).filter(|_| !is_used) {
            time.values = Vec::new();
        }
    }
}

impl Struct {
    /// Path of an element of a struct array, or of the struct if there is only one.
    pub(super) fn path(path: &str, k: usize, elements: usize) -> String {
        if elements > 1 { format!("{path}[{}]", k + 1) } else { path.to_owned() }
    }

    fn is_timed(&self) -> bool {
        let has = |name: &str| self.fields.iter().any(|field| field == name);
        has("time") && has("signals")
    }

    /// Whether a field may be the clock of others.
    pub(super) fn is_clock(&self, field: &str) -> bool {
        field == "time" && self.is_timed()
    }

    fn collect(&mut self, path: &str, channels: &mut Channels) -> Result<(), FormatError> {
        let count = self.fields.len();
        if count == 0 {
            return Ok(());
        }
        // Fields that are one number in each element are one channel.
        let mut done = vec![false; count];
        for (k, (field, done)) in self.fields.iter().zip(&mut done).enumerate() {
            let values = self.values.iter().skip(k).step_by(count);
            *done = channels.collect_scalars(&format!("{path}/{field}"), values);
        }
        let elements = self.values.len().div_ceil(count);
        let is_timed = self.is_timed();
        for (k, element) in self.values.chunks_mut(count).enumerate() {
            let begin = channels.found.channels.len();
            let unit = unit(&self.fields, element);
            let path = Self::path(path, k, elements);
            for ((field, value), done) in self.fields.iter().zip(element).zip(&done) {
                if *done {
                    continue;
                }
                let first = channels.found.channels.len();
                channels.collect(&format!("{path}/{field}"), value)?;
                if unit.is_some() && DATA.contains(&lower(field).as_str()) {
                    let new = channels.found.channels.iter_mut().skip(first);
                    new.for_each(|channel| channel.unit.clone_from(&unit));
                }
            }
            if is_timed {
                channels.set_clock(&path, begin);
            }
        }
        Ok(())
    }
}

/// The unit of the data of an element, if a field states it.
fn unit(fields: &[String], element: &[Value]) -> Option<String> {
    let is_unit = |field: &String| matches!(lower(field).as_str(), "unit" | "units");
    match element.get(fields.iter().position(is_unit)?)? {
        Value::Text(unit) if !unit.is_empty() => Some(unit.clone()),
        _ => None,
    }
}

/// Names of the fields whose unit a field `unit` states.
const DATA: [&str; 3] = ["data", "value", "values"];

fn lower(name: &str) -> String {
    name.to_ascii_lowercase()
}
