//! Data logs of WPILib (`.wpilog`): records of many entries, each with its own time stamp.
//!
//! Every entry of numbers has a time channel `name/time`. The places of arrays are `name[1]`, `name[2]`, ..., the fields of
//! structs `name/field`.

mod layout;

use std::collections::HashMap;

use serde_json::Value;

use layout::{Layout, Leaf, Schemas};

use crate::channel_ref::Wanted;
use crate::collected::{Collected, LeftOut};
use crate::cursor::Cursor;
use crate::format::Format;
use crate::format_error::FormatError;
use crate::log_data::{Channel, Clock, LogData};
use crate::number::Number;
use crate::source::Source;
use crate::stream::{Input, Stream};

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
    /// Number of its records.
    rows: usize,
    /// Whether a channel of it may be wanted: then the times are kept. `None` before the first record.
    is_wanted: Option<bool>,
    times_s: Vec<f64>,
    /// Each number of each item.
    places: Vec<Place>,
}

/// A number of an item.
struct Place {
    name: String,
    /// Whether its values are read.
    is_wanted: bool,
    values: Vec<f64>,
}

/// What the number of an entry stands for.
enum Open {
    /// The entry at this place.
    Entry(usize),
    /// The schema of the struct of this name.
    Schema(String),
}

/// A record of a log.
struct Record {
    entry: u32,
    stamp: u64,
    /// Number of bytes of the payload.
    size: usize,
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
pub(crate) fn read(source: &Source, wanted: Wanted) -> Result<LogData, FormatError> {
    /// Bytes before the extra header.
    const BEGIN: usize = WPILOG.len() + 6;
    let mut found = Collected::of(wanted);
    let damaged = || FormatError::content("header", "the header of the WPILib log is damaged");
    let mut stream = source.stream(0);
    let begin = stream.next_bytes(BEGIN.min(source.length() as usize))?.unwrap_or_default();
    let mut cursor = Cursor::new(begin.strip_prefix(WPILOG).unwrap_or_default(), false);
    let version = cursor.u16().ok_or_else(damaged)?;
    if version >> 8 != 1 {
        let reason = format!("version {} of WPILib logs is not read, only 1", version >> 8);
        return Err(FormatError::content("header", reason));
    }
    let extra = cursor.u32().ok_or_else(damaged)?;
    stream.skip(u64::from(extra))?.ok_or_else(damaged)?;
    let mut entries = Entries::default();
    while stream.left() > 0 {
        let record = record(&mut stream)?.filter(|record| record.size as u64 <= stream.left());
        let Some(record) = record else {
            found.note("the file ends inside a record, which is left out");
            break;
        };
        if record.entry != 0 && !entries.open.contains_key(&record.entry) {
            stream.skip(record.size as u64)?;
            continue;
        }
        let Some(payload) = stream.next_bytes(record.size)? else { break };
        if record.entry != 0 {
            entries.append(&record, payload, &mut found)?;
        } else if entries.control(payload, &mut found).is_none() {
            found.note("a damaged control record is left out");
        }
    }
    for entry in entries.all {
        entry.collect(&mut found);
    }
    found.finish(Format::WpiLog)
}

/// The next record up to its payload; `None` if the file ends before.
fn record(stream: &mut Stream) -> Result<Option<Record>, FormatError> {
    let Some(&[lengths]) = stream.next_bytes(1)? else { return Ok(None) };
    let [entry, size, stamp] =
        [lengths & 3, lengths >> 2 & 3, lengths >> 4 & 7].map(|length| usize::from(length) + 1);
    let Some(header) = stream.next_bytes(entry + size + stamp)? else { return Ok(None) };
    let number = |from: usize, length: usize| {
        let bytes = header.iter().skip(from).take(length);
        bytes.rev().fold(0, |sum, byte| sum << 8 | u64::from(*byte))
    };
    let (size, stamp) = (number(entry, size), number(entry + size, stamp));
    let record = Record { entry: number(0, entry) as u32, stamp, size: size as usize };
    Ok(Some(record))
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
            let (rows, is_wanted) = (0, None);
            self.all.push(Entry { name, unit, of, layout, rows, is_wanted, times_s, places });
        }
        self.open.insert(number, Open::Entry(place));
    }

    /// Appends the values of a record.
    fn append(
        &mut self,
        record: &Record,
        payload: &[u8],
        found: &mut Collected,
    ) -> Result<(), FormatError> {
        let place = match self.open.get(&record.entry) {
            Some(Open::Entry(place)) => *place,
            Some(Open::Schema(name)) => {
                let schema = String::from_utf8_lossy(payload).into_owned();
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
        entry.append(record, payload, found)
    }
}

impl Entry {
    /// Appends the values of a record.
    fn append(
        &mut self,
        record: &Record,
        payload: &[u8],
        found: &mut Collected,
    ) -> Result<(), FormatError> {
        let Some(layout) = &self.layout else { return Ok(()) };
        let items = payload.len() / layout.size;
        if items * layout.size != payload.len() || (!layout.is_array && items != 1) {
            found.leave_out(&self.name, &UNFIT);
            return Ok(());
        }
        let count = items.saturating_mul(layout.leaves.len());
        if count > MOST_PLACES {
            found.leave_out(&self.name, &LONG);
            return Ok(());
        }
        let rows = self.rows;
        let keeps_times =
            *self.is_wanted.get_or_insert_with(|| layout.is_wanted(&self.name, found.wanted));
        for k in self.places.len()..count {
            let name = layout.name(&self.name, k);
            let is_wanted = keeps_times && found.wanted.has(&name);
            found.take_bytes(if is_wanted { rows * size_of::<f64>() } else { name.len() })?;
            let values = if is_wanted { vec![f64::NAN; rows] } else { Vec::new() };
            self.places.push(Place { name, is_wanted, values });
        }
        let wanted = self.places.iter().filter(|place| place.is_wanted).count();
        found.take_bytes((wanted + usize::from(keeps_times)) * size_of::<f64>())?;
        let items = (0..self.places.len()).step_by(layout.leaves.len());
        let leaves =
            items.zip(0..).flat_map(|(_, item)| layout.leaves.iter().map(move |l| (item, l)));
        let places = self.places.iter_mut().zip(leaves).filter(|(place, _)| place.is_wanted);
        for (Place { values, .. }, (item, leaf)) in places {
            let bytes = payload.get(item * layout.size + leaf.offset..).unwrap_or_default();
            let size = leaf.number.size();
            Number::new(leaf.number, false).append(values, bytes, size, 1);
            // An array that is shorter than others has no value here.
            values.resize(rows + 1, f64::NAN);
        }
        self.rows += 1;
        if keeps_times {
            self.times_s.push(record.stamp as f64 / STAMPS_PER_S);
        }
        Ok(())
    }

    /// Appends its channels, with their clock before them.
    fn collect(self, found: &mut Collected) {
        if self.places.is_empty() {
            return;
        }
        let clock = found.channels.len();
        let mut time = Channel::of(time_name(&self.name), self.times_s);
        time.unit = Some("s".to_owned());
        found.channels.push(time);
        for place in self.places {
            let mut channel = Channel::of(place.name, place.values);
            channel.unit.clone_from(&self.unit);
            channel.clock = Clock::Channel(clock);
            found.channels.push(channel);
        }
    }
}

fn time_name(entry: &str) -> String {
    format!("{entry}/time")
}

impl Layout {
    /// Name of a channel of an entry.
    fn name(&self, entry: &str, k: usize) -> String {
        let leaves = self.leaves.len();
        let place = if self.is_array { format!("[{}]", k / leaves + 1) } else { String::new() };
        let path = self.leaves.get(k % leaves).map_or("", |leaf| &leaf.path);
        let slash = if path.is_empty() { "" } else { "/" };
        format!("{entry}{place}{slash}{path}")
    }

    /// Whether a channel of an entry may be wanted.
    fn is_wanted(&self, entry: &str, wanted: Wanted) -> bool {
        let has_leaf = |(k, leaf): (usize, &Leaf)| match (self.is_array, leaf.path.is_empty()) {
            (false, _) => wanted.has(&self.name(entry, k)),
            (true, true) => wanted.has_place(entry, ""),
            (true, false) => wanted.has_place(entry, &format!("/{}", leaf.path)),
        };
        wanted.has(&time_name(entry)) || self.leaves.iter().enumerate().any(has_leaf)
    }
}
