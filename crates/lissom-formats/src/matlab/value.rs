//! Values of MATLAB, and the channels they contain.

use crate::array::Array;
use crate::collected::{Collected, LeftOut};
use crate::format_error::FormatError;
use crate::log_data::{Channel, Clock};

/// A value of a MATLAB file.
#[derive(Debug, Clone)]
pub(super) enum Value<'a> {
    Numbers(Array<'a>),
    /// Real and imaginary part.
    Complex([Array<'a>; 2]),
    Text(String),
    Cells(Vec<Value<'a>>),
    Struct(Struct<'a>),
    LeftOut(&'static LeftOut),
}

/// A struct or a struct array.
#[derive(Debug, Clone)]
pub(super) struct Struct<'a> {
    pub(super) fields: Vec<String>,
    /// The values of all fields of the first element, then those of the second.
    pub(super) values: Vec<Value<'a>>,
}

/// Appends the channels of a value.
pub(super) fn collect(path: &str, value: &Value, found: &mut Collected) -> Result<(), FormatError> {
    match value {
        Value::Numbers(array) => array.collect(path, found),
        Value::Complex([real, imag]) => Array::collect_complex([real, imag], path, found),
        Value::Text(_) => Ok(()),
        Value::LeftOut(why) => {
            found.leave_out(path, why);
            Ok(())
        }
        Value::Cells(cells) => {
            if collect_scalars(path, cells.iter(), found) {
                return Ok(());
            }
            for (k, cell) in cells.iter().enumerate() {
                collect(&format!("{path}[{}]", k + 1), cell, found)?;
            }
            Ok(())
        }
        Value::Struct(of) => of.collect(path, found),
    }
}

/// Appends one channel if there are several values and each is one number.
fn collect_scalars<'a>(
    path: &str,
    values: impl Iterator<Item = &'a Value<'a>>,
    found: &mut Collected,
) -> bool {
    let scalar = |value: &Value| match value {
        Value::Numbers(array) => array.scalar(),
        _ => None,
    };
    let Some(values) = values.map(scalar).collect::<Option<Vec<f64>>>() else { return false };
    if values.len() < 2 {
        return false;
    }
    found.channels.push(Channel::of(path, values));
    true
}

impl Struct<'_> {
    fn collect(&self, path: &str, found: &mut Collected) -> Result<(), FormatError> {
        let count = self.fields.len();
        if count == 0 {
            return Ok(());
        }
        // Fields that are one number in each element are one channel.
        let mut done = vec![false; count];
        for (k, (field, done)) in self.fields.iter().zip(&mut done).enumerate() {
            let values = self.values.iter().skip(k).step_by(count);
            *done = collect_scalars(&format!("{path}/{field}"), values, found);
        }
        let several = self.values.len() > count;
        for (k, element) in self.values.chunks(count).enumerate() {
            let begin = found.channels.len();
            let unit = self.unit(element);
            let path = if several { format!("{path}[{}]", k + 1) } else { path.to_owned() };
            for ((field, value), done) in self.fields.iter().zip(element).zip(&done) {
                if *done {
                    continue;
                }
                let first = found.channels.len();
                collect(&format!("{path}/{field}"), value, found)?;
                if let Some(unit) = unit.filter(|_| DATA.contains(&lower(field).as_str())) {
                    let new = found.channels.iter_mut().skip(first);
                    new.for_each(|channel| channel.unit = Some(unit.to_owned()));
                }
            }
            self.set_clock(&path, begin, found);
        }
        Ok(())
    }

    /// The unit of the data of an element, if a field states it.
    fn unit<'a>(&self, element: &'a [Value]) -> Option<&'a str> {
        let is_unit = |field: &String| matches!(lower(field).as_str(), "unit" | "units");
        let place = self.fields.iter().position(is_unit)?;
        match element.get(place)? {
            Value::Text(unit) if !unit.is_empty() => Some(unit),
            _ => None,
        }
    }

    /// Of a "structure with time" of Simulink, the field `time` is the clock of the field `signals`.
    fn set_clock(&self, path: &str, begin: usize, found: &mut Collected) {
        let has = |name: &str| self.fields.iter().any(|field| field == name);
        if !has("time") || !has("signals") {
            return;
        }
        let new = || found.channels.iter().enumerate().skip(begin);
        let Some((time, length)) = new()
            .find(|(_, c)| c.name.strip_prefix(path) == Some("/time"))
            .map(|(k, c)| (k, c.values.len()))
        else {
            return;
        };
        let signals = format!("{path}/signals");
        for channel in found.channels.iter_mut().skip(begin) {
            if channel.name.starts_with(&signals) && channel.values.len() == length {
                channel.clock = Clock::Channel(time);
            }
        }
    }
}

/// Names of the fields whose unit a field `unit` states.
const DATA: [&str; 3] = ["data", "value", "values"];

fn lower(name: &str) -> String {
    name.to_ascii_lowercase()
}
