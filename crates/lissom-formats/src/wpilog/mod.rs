//! Data logs of WPILib (`.wpilog`): records of many entries, each with its own time stamp.
//!
//! Every entry of numbers has a time channel `name/time`. The places of arrays are `name[1]`, `name[2]`, ..., the fields of
//! structs `name/field`.

mod layout;

use std::collections::HashMap;

use serde_json::Value;

use layout::{Layout, Schemas};

use crate::collected::{Collected, LeftOut};
use crate::cursor::Cursor;
use crate::format::Format;
use crate::format_error::FormatError;
use crate::log_data::{Channel, Clock, LogData};
use crate::number::Number;

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
    what: "entries of types that are not known",
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
    /// Name of its type.
    of: String,
    layout: Option<Layout>,
    times_s: Vec<f64>,
    /// The values of each number of each item.
    places: Vec<Vec<f64>>,
}

/// What the number of an entry stands for.
enum Open {
    /// The entry at this place.
    Entry(usize),
    /// The schema of the struct of this name.
    Schema(String),
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
    places: HashMap<(String, String), usize>,
    /// What a number stands for, until it is used for another entry.
    open: HashMap<u32, Open>,
    schemas: Schemas,
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

/// Whether entries of this type are texts, or describe other types.
fn is_text(name: &str) -> bool {
    matches!(name, "string" | "string[]" | "json" | "photonstructschema")
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
                let entry = match self.open.get(&number) {
                    Some(Open::Entry(place)) => self.all.get_mut(*place),
                    _ => None,
                };
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
        if of == "structschema" {
            let name = name.rsplit("struct:").next().unwrap_or_default().to_owned();
            self.open.insert(number, Open::Schema(name));
            return;
        }
        let is_struct = of.starts_with("struct:");
        let layout = layout::of(of, &self.schemas);
        if layout.is_none() && !is_struct {
            if !is_text(of) {
                found.leave_out(&name, &STRUCTS);
            }
            return;
        }
        let key = (name, of.to_owned());
        let place = *self.places.entry(key.clone()).or_insert(self.all.len());
        if let Some(entry) = self.all.get_mut(place) {
            entry.unit = unit.or(entry.unit.take());
        } else {
            let ((name, of), times_s, places) = (key, Vec::new(), Vec::new());
            self.all.push(Entry { name, unit, of, layout, times_s, places });
        }
        self.open.insert(number, Open::Entry(place));
    }

    /// Appends the values of a record.
    fn append(&mut self, record: &Record, found: &mut Collected) -> Result<(), FormatError> {
        let place = match self.open.get(&record.entry) {
            Some(Open::Entry(place)) => *place,
            Some(Open::Schema(name)) => {
                let schema = String::from_utf8_lossy(record.payload).into_owned();
                self.schemas.insert(name.clone(), schema);
                return Ok(());
            }
            None => return Ok(()),
        };
        let Some(entry) = self.all.get_mut(place) else { return Ok(()) };
        if entry.layout.is_none() {
            // The schema is in the log before the first record, or not at all.
            entry.layout = layout::of(&entry.of, &self.schemas);
        }
        if entry.layout.is_none() {
            self.open.remove(&record.entry);
            found.leave_out(&entry.name, &STRUCTS);
            return Ok(());
        }
        entry.append(record, found)
    }
}

impl Entry {
    /// Appends the values of a record.
    fn append(&mut self, record: &Record, found: &mut Collected) -> Result<(), FormatError> {
        let Some(layout) = &self.layout else { return Ok(()) };
        let items = record.payload.len() / layout.size;
        if items * layout.size != record.payload.len() || (!layout.is_array && items != 1) {
            found.leave_out(&self.name, &UNFIT);
            return Ok(());
        }
        let count = items.saturating_mul(layout.leaves.len());
        if count > MOST_PLACES {
            found.leave_out(&self.name, &LONG);
            return Ok(());
        }
        let rows = self.times_s.len();
        let new = count.saturating_sub(self.places.len());
        found.take_bytes((new * rows + self.places.len() + new + 1) * size_of::<f64>())?;
        self.places.extend((0..new).map(|_| vec![f64::NAN; rows]));
        let items = (0..self.places.len()).step_by(layout.leaves.len());
        let leaves =
            items.zip(0..).flat_map(|(_, item)| layout.leaves.iter().map(move |l| (item, l)));
        for (place, (item, leaf)) in self.places.iter_mut().zip(leaves) {
            let bytes = record.payload.get(item * layout.size + leaf.offset..).unwrap_or_default();
            let size = leaf.number.size();
            Number::new(leaf.number, false).append(place, bytes, size, 1);
            // An array that is shorter than others has no value here.
            place.resize(rows + 1, f64::NAN);
        }
        self.times_s.push(record.stamp as f64 / STAMPS_PER_S);
        Ok(())
    }

    /// Appends its channels, with their clock before them.
    fn collect(self, found: &mut Collected) {
        let Some(layout) = self.layout.filter(|_| !self.places.is_empty()) else { return };
        let clock = found.channels.len();
        let mut time = Channel::of(format!("{}/time", self.name), self.times_s);
        time.unit = Some("s".to_owned());
        found.channels.push(time);
        let leaves = layout.leaves.len();
        for (k, values) in self.places.into_iter().enumerate() {
            let place =
                if layout.is_array { format!("[{}]", k / leaves + 1) } else { String::new() };
            let path = layout.leaves.get(k % leaves).map_or("", |leaf| &leaf.path);
            let slash = if path.is_empty() { "" } else { "/" };
            let mut channel = Channel::of(format!("{}{place}{slash}{path}", self.name), values);
            channel.unit.clone_from(&self.unit);
            channel.clock = Clock::Channel(clock);
            found.channels.push(channel);
        }
    }
}
