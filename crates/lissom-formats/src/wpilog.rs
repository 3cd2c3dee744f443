//! Data logs of WPILib (`.wpilog`): records of many entries, each with its own time stamp.
//!
//! Every entry of numbers has a time channel `name/time`. The places of arrays are `name[1]`, `name[2]`, ...

use std::collections::HashMap;

use serde_json::Value;

use crate::collected::{Collected, LeftOut};
use crate::cursor::Cursor;
use crate::format::Format;
use crate::format_error::FormatError;
use crate::log_data::{Channel, Clock, LogData};
use crate::number::{Number, NumberType};

/// First bytes of a log.
pub(crate) const WPILOG: &[u8] = b"WPILOG";
/// Most places of an array.
const MOST_PLACES: usize = 4096;
/// Time stamps count microseconds.
const STAMPS_PER_S: f64 = 1e6;

const START: u8 = 0;
const FINISH: u8 = 1;
const SET_METADATA: u8 = 2;

const STRUCTS: LeftOut = LeftOut {
    what: "structs and other entries that are no numbers",
    way_out: "export them as CSV with AdvantageScope",
};
const LONG: LeftOut =
    LeftOut { what: "arrays of more than 4096 places", way_out: "log parts of the arrays" };
const UNFIT: LeftOut = LeftOut {
    what: "records whose size does not fit their type",
    way_out: "copy the file again if the values matter",
};

/// An entry of a log, with its values.
struct Entry {
    name: String,
    unit: Option<String>,
    of: EntryType,
    times_s: Vec<f64>,
    /// The values of each place; one place if it is no array.
    places: Vec<Vec<f64>>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
struct EntryType {
    number: NumberType,
    is_array: bool,
}

/// A record of a log.
struct Record<'a> {
    entry: u32,
    stamp: u64,
    payload: &'a [u8],
}

/// Entries while the log is read.
#[derive(Default)]
struct Entries {
    all: Vec<Entry>,
    /// The entry of a name and a type.
    places: HashMap<(String, EntryType), usize>,
    /// The entry that a number stands for, until the number is used for another.
    open: HashMap<u32, usize>,
}

/// Reads a log.
pub(crate) fn read(bytes: &[u8]) -> Result<LogData, FormatError> {
    let mut found = Collected::new();
    let damaged = || FormatError::content("header", "the header of the WPILib log is damaged");
    let mut cursor = Cursor::new(bytes.strip_prefix(WPILOG).unwrap_or_default(), false);
    let version = cursor.u16().ok_or_else(damaged)?;
    if version >> 8 != 1 {
        let reason = format!("version {} of WPILib logs is not read, only 1", version >> 8);
        return Err(FormatError::content("header", reason));
    }
    let extra = cursor.count_u32().ok_or_else(damaged)?;
    cursor.take(extra).ok_or_else(damaged)?;
    let mut entries = Entries::default();
    while !cursor.rest().is_empty() {
        let Some(record) = record(&mut cursor) else {
            found.note("the file ends inside a record, which is left out");
            break;
        };
        if record.entry != 0 {
            entries.append(&record, &mut found)?;
        } else if entries.control(record.payload, &mut found).is_none() {
            found.note("a damaged control record is left out");
        }
    }
    for entry in entries.all {
        entry.collect(&mut found);
    }
    found.finish(Format::WpiLog)
}

/// The next record; `None` if the file ends before its end.
fn record<'a>(cursor: &mut Cursor<'a>) -> Option<Record<'a>> {
    let lengths = cursor.u8()?;
    let mut number = |length: u8| -> Option<u64> {
        let bytes = cursor.take(usize::from(length) + 1)?;
        Some(bytes.iter().rev().fold(0, |sum, byte| sum << 8 | u64::from(*byte)))
    };
    let entry = u32::try_from(number(lengths & 3)?).ok()?;
    let size = usize::try_from(number(lengths >> 2 & 3)?).ok()?;
    let stamp = number(lengths >> 4 & 7)?;
    Some(Record { entry, stamp, payload: cursor.take(size)? })
}

/// A text with its length before it.
fn text(cursor: &mut Cursor) -> Option<String> {
    let length = cursor.count_u32()?;
    Some(String::from_utf8_lossy(cursor.take(length)?).into_owned())
}

/// The unit in the metadata of an entry.
fn unit(metadata: &str) -> Option<String> {
    let metadata: Value = serde_json::from_str(metadata).ok()?;
    let unit = metadata.get("unit").or_else(|| metadata.get("units"))?.as_str()?;
    Some(unit.to_owned()).filter(|unit| !unit.is_empty())
}

impl EntryType {
    /// The type of this name; `None` if it has no numbers.
    fn of(name: &str) -> Option<Self> {
        let (number, is_array) = match name.strip_suffix("[]") {
            Some(number) => (number, true),
            None => (name, false),
        };
        let number = match number {
            "boolean" => NumberType::U8,
            "int64" => NumberType::I64,
            "float" => NumberType::F32,
            "double" => NumberType::F64,
            _ => return None,
        };
        Some(Self { number, is_array })
    }
}

/// Whether entries of this type are texts, or describe other types.
fn is_text(name: &str) -> bool {
    matches!(name, "string" | "string[]" | "json" | "structschema" | "photonstructschema")
        || name == "proto:FileDescriptorProto"
}

impl Entries {
    /// Carries out a control record; `None` if it is damaged.
    fn control(&mut self, payload: &[u8], found: &mut Collected) -> Option<()> {
        let mut cursor = Cursor::new(payload, false);
        let kind = cursor.u8()?;
        let number = cursor.u32()?;
        match kind {
            START => {
                let (name, of) = (text(&mut cursor)?, text(&mut cursor)?);
                let unit = unit(&text(&mut cursor)?);
                self.start(number, name, &of, unit, found);
            }
            FINISH => {
                self.open.remove(&number);
            }
            SET_METADATA => {
                let unit = unit(&text(&mut cursor)?);
                let entry = self.open.get(&number).and_then(|place| self.all.get_mut(*place));
                if let Some(entry) = entry {
                    entry.unit = unit.or(entry.unit.take());
                }
            }
            _ => return None,
        }
        Some(())
    }

    /// Starts an entry; one that was started before goes on.
    fn start(
        &mut self,
        number: u32,
        name: String,
        of: &str,
        unit: Option<String>,
        found: &mut Collected,
    ) {
        self.open.remove(&number);
        let Some(kind) = EntryType::of(of) else {
            if !is_text(of) {
                found.leave_out(&name, &STRUCTS);
            }
            return;
        };
        let place = *self.places.entry((name.clone(), kind)).or_insert(self.all.len());
        if let Some(entry) = self.all.get_mut(place) {
            entry.unit = unit.or(entry.unit.take());
        } else {
            let (times_s, places) = (Vec::new(), Vec::new());
            self.all.push(Entry { name, unit, of: kind, times_s, places });
        }
        self.open.insert(number, place);
    }

    /// Appends the values of a record.
    fn append(&mut self, record: &Record, found: &mut Collected) -> Result<(), FormatError> {
        let entry = self.open.get(&record.entry).and_then(|place| self.all.get_mut(*place));
        let Some(entry) = entry else { return Ok(()) };
        let size = entry.of.number.size();
        let count = record.payload.len() / size;
        if count * size != record.payload.len() || (!entry.of.is_array && count != 1) {
            found.leave_out(&entry.name, &UNFIT);
            return Ok(());
        }
        if count > MOST_PLACES {
            found.leave_out(&entry.name, &LONG);
            return Ok(());
        }
        let rows = entry.times_s.len();
        let new = count.saturating_sub(entry.places.len());
        found.take_bytes((new * rows + entry.places.len() + new + 1) * size_of::<f64>())?;
        entry.places.extend((0..new).map(|_| vec![f64::NAN; rows]));
        let number = Number::new(entry.of.number, false);
        for (k, place) in entry.places.iter_mut().enumerate() {
            number.append(place, record.payload.get(k * size..).unwrap_or_default(), size, 1);
            // An array that is shorter than others has no value here.
            place.resize(rows + 1, f64::NAN);
        }
        entry.times_s.push(record.stamp as f64 / STAMPS_PER_S);
        Ok(())
    }
}

impl Entry {
    /// Appends its channels, with their clock before them.
    fn collect(self, found: &mut Collected) {
        if self.places.is_empty() {
            return;
        }
        let clock = found.channels.len();
        let mut time = Channel::of(format!("{}/time", self.name), self.times_s);
        time.unit = Some("s".to_owned());
        found.channels.push(time);
        for (k, values) in self.places.into_iter().enumerate() {
            let place = if self.of.is_array { format!("[{}]", k + 1) } else { String::new() };
            let mut channel = Channel::of(format!("{}{place}", self.name), values);
            channel.unit.clone_from(&self.unit);
            channel.clock = Clock::Channel(clock);
            found.channels.push(channel);
        }
    }
}
