//! Data logs of WPILib (`.wpilog`): records of many entries, each with its own time stamp.
//!
//! Every entry of numbers has a time channel `name/time`. The places of arrays are `name[1]`, `name[2]`, ..., the fields of
//! structs `name/field`.

mod entry;
mod layout;

use std::collections::HashMap;

use serde_json::Value;

use entry::Entry;
use layout::Schemas;

use crate::channel_ref::Wanted;
use crate::collected::{Collected, LeftOut};
use crate::cursor::Cursor;
use crate::format::Format;
use crate::format_error::FormatError;
use crate::log_data::LogData;
use crate::source::Source;
use crate::stream::{Input, Stream};

/// First bytes of a log.
pub(crate) const WPILOG: &[u8] = b"WPILOG";
const START: u8 = 0;
const FINISH: u8 = 1;
const SET_METADATA: u8 = 2;

const STRUCTS: LeftOut = LeftOut {
    what: "entries of types that are not known",
    way_out: "export them as CSV with AdvantageScope",
};
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
            self.all.push(Entry::new(key, unit, layout));
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
        entry.append(record.stamp, payload, found)
    }
}
