//! TDMS files of National Instruments: segments, each with metadata and with raw data of its channels.
//!
//! A channel is `group/channel`. The waveform properties of a channel are its clock. The raw data are read in blocks, and those
//! of channels that are not wanted are skipped.

mod daqmx;
mod metadata;
mod raw_bytes;
mod raw_data;
mod raw_index;
mod scale;

use std::collections::HashMap;

use metadata::Property;
use raw_index::RawIndex;

use crate::channel_ref::Wanted;
use crate::collected::{Collected, LeftOut};
use crate::cursor::Cursor;
use crate::format::Format;
use crate::format_error::FormatError;
use crate::log_data::{Channel, Clock, LogData};
use crate::source::Source;
use crate::stream::{Input, Stream};

/// First bytes of a file and of each segment.
pub(crate) const TDMS: &[u8] = b"TDSm";
/// Bytes of the lead-in of a segment.
const LEAD_IN_BYTES: usize = 28;
/// The offset of the next segment if the program that wrote the file did not finish it.
const UNFINISHED: u64 = u64::MAX;

const HAS_METADATA: u32 = 1 << 1;
const NEW_LIST: u32 = 1 << 2;
const HAS_RAW_DATA: u32 = 1 << 3;
const IS_INTERLEAVED: u32 = 1 << 5;
const IS_BIG_ENDIAN: u32 = 1 << 6;

const SCALERS: LeftOut = LeftOut {
    what: "channels of NI-DAQmx with several scalers",
    way_out: "in Python: nptdms.TdmsFile.read(FILE).as_dataframe().to_csv(\"log.csv\")",
};
const COMPLEX: LeftOut = LeftOut {
    what: "complex numbers",
    way_out: "in Python: nptdms.TdmsFile.read(FILE)[GROUP][CHANNEL][:] has them",
};

/// A group, a channel, or the file itself.
#[derive(Default)]
struct Object {
    /// The names of the group and of the channel.
    path: Vec<String>,
    properties: HashMap<String, Property>,
    /// How its raw data are stored, as last stated.
    index: Option<RawIndex>,
    /// How its raw data are stored, if NI-DAQmx wrote them.
    daqmx: Option<daqmx::Daqmx>,
    /// Whether the present segment has raw data of it.
    has_data: bool,
    /// Whether it is in the list of objects of the present segment.
    is_listed: bool,
    /// Number of its values.
    count: u64,
    /// `None` if it is not wanted.
    values: Option<Vec<f64>>,
    has_stamps: bool,
    /// The first time stamp, from which others are counted: seconds, and fractions of 2^-64 s.
    first_stamp: Option<(i64, u64)>,
}

/// The objects of a file.
#[derive(Default)]
struct Objects {
    all: Vec<Object>,
    places: HashMap<String, usize>,
    /// The objects of the present segment, in the order of their raw data.
    listed: Vec<usize>,
    /// Objects of all segments with raw data.
    visited: u64,
}

/// A segment of a file.
struct Segment {
    flags: u32,
    metadata: Vec<u8>,
    /// Number of bytes of its raw data.
    raw_bytes: u64,
    is_complete: bool,
    /// Its end in the file.
    end: u64,
}

/// Reads a file.
pub(crate) fn read(source: &Source, wanted: Wanted) -> Result<LogData, FormatError> {
    let mut found = Collected::of(wanted);
    let mut objects = Objects::default();
    let mut stream = source.stream(0);
    let mut number = 0;
    while stream.left() > 0 {
        number += 1;
        let Some(segment) = segment(&mut stream)? else {
            found.note(format!("the file is cut off or damaged at segment {number}"));
            break;
        };
        if !segment.is_complete {
            found
                .note(format!("segment {number} was not finished: its last values may be missing"));
        }
        if objects.update(&segment, wanted).is_none() {
            found.note(format!(
                "the metadata of segment {number} are damaged; the rest is left out"
            ));
            break;
        }
        if segment.flags & HAS_RAW_DATA != 0 {
            raw_data::append(&mut objects, &segment, number, &mut stream, &mut found)?;
        }
        stream.skip(segment.end - stream.place())?;
    }
    collect(objects, &mut found);
    found.finish(Format::Tdms)
}

/// Reads the next segment up to its raw data; `None` if there is none, or not all of its metadata.
fn segment(stream: &mut Stream) -> Result<Option<Segment>, FormatError> {
    let lead_in = stream.next_bytes(LEAD_IN_BYTES)?.and_then(lead_in);
    let Some((flags, next, metadata_bytes)) = lead_in else { return Ok(None) };
    let is_complete = next != UNFINISHED && next <= stream.left();
    let bytes = next.min(stream.left());
    let end = stream.place() + bytes;
    let Some(raw_bytes) = bytes.checked_sub(metadata_bytes) else { return Ok(None) };
    let metadata = stream.next_bytes(metadata_bytes as usize)?.map(<[u8]>::to_vec);
    Ok(metadata.map(|metadata| Segment { flags, metadata, raw_bytes, is_complete, end }))
}

/// Flags of a segment, and the distances of the next segment and of the raw data from the lead-in.
fn lead_in(bytes: &[u8]) -> Option<(u32, u64, u64)> {
    let lead_in = bytes.strip_prefix(TDMS)?;
    let flags = Cursor::new(lead_in, false).u32()?;
    let mut cursor = Cursor::new(lead_in.get(8..)?, flags & IS_BIG_ENDIAN != 0);
    Some((flags, cursor.u64()?, cursor.u64()?))
}

impl Objects {
    /// Takes over the metadata of a segment; `None` if they are damaged.
    fn update(&mut self, segment: &Segment, wanted: Wanted) -> Option<()> {
        if segment.flags & HAS_METADATA == 0 {
            return Some(());
        }
        if segment.flags & NEW_LIST != 0 {
            for place in self.listed.drain(..) {
                if let Some(object) = self.all.get_mut(place) {
                    object.is_listed = false;
                }
            }
        }
        let mut cursor = Cursor::new(&segment.metadata, segment.flags & IS_BIG_ENDIAN != 0);
        let count = cursor.u32()?;
        for _ in 0..count {
            let path = metadata::text(&mut cursor)?;
            let place = self.place(path, wanted);
            let object = self.all.get_mut(place)?;
            if !object.is_listed {
                object.is_listed = true;
                self.listed.push(place);
            }
            match metadata::raw_index(&mut cursor)? {
                metadata::Index::None => object.has_data = false,
                metadata::Index::AsBefore => {
                    object.index.as_ref()?;
                    object.has_data = true;
                }
                metadata::Index::New(index) => {
                    object.index = Some(index);
                    object.has_data = true;
                }
                metadata::Index::Daqmx(index, daqmx) => {
                    object.index = Some(index);
                    object.daqmx = Some(daqmx);
                    object.has_data = true;
                }
            }
            metadata::properties(&mut cursor, &mut object.properties)?;
        }
        Some(())
    }

    /// The place of the object with this path.
    fn place(&mut self, path: String, wanted: Wanted) -> usize {
        if let Some(place) = self.places.get(&path) {
            return *place;
        }
        let mut object = Object { path: metadata::names(&path), ..Object::default() };
        object.values = wanted.has(&object.name()).then(Vec::new);
        self.all.push(object);
        self.places.insert(path, self.all.len() - 1);
        self.all.len() - 1
    }
}

/// Appends the channels.
fn collect(mut objects: Objects, found: &mut Collected) {
    let scales = objects.scales();
    for (object, scales) in objects.all.iter_mut().zip(scales) {
        let name = object.name();
        if object.count == 0 {
            continue;
        }
        let mut values = object.values.take().unwrap_or_default();
        match scales {
            None => {}
            Some(Ok(scales)) => scales.iter().for_each(|scale| scale.apply(&mut values)),
            Some(Err(unknown)) => {
                found
                    .note(format!("{name}: the values are not scaled: scale {unknown} is unknown"));
            }
        }
        let mut channel = Channel::of(name, values);
        channel.unit = object.unit();
        channel.clock = object.clock();
        found.channels.push(channel);
    }
}

impl Objects {
    /// The scales of each object: its own, those of its group, or those of the file.
    fn scales(&self) -> Vec<Option<scale::Scales>> {
        let own: HashMap<&[String], scale::Scales> = self
            .all
            .iter()
            .filter_map(|o| Some((o.path.as_slice(), scale::of(&o.properties)?)))
            .collect();
        let of = |object: &Object| {
            let path = object.path.as_slice();
            let mut parents = [Some(path), path.get(..1), Some(&[][..])].into_iter().flatten();
            parents.find_map(|path| own.get(path)).cloned()
        };
        self.all.iter().map(of).collect()
    }
}

impl Object {
    fn name(&self) -> String {
        self.path.join("/")
    }

    fn text(&self, key: &str) -> Option<&str> {
        match self.properties.get(key)? {
            Property::Text(text) if !text.is_empty() => Some(text),
            _ => None,
        }
    }

    fn number(&self, key: &str) -> Option<f64> {
        self.properties.get(key).and_then(Property::number)
    }

    fn unit(&self) -> Option<String> {
        let stamps = self.has_stamps.then_some("s");
        let unit = self.text("unit_string").or_else(|| self.text("NI_UnitDescription"));
        unit.or(stamps).map(str::to_owned)
    }

    /// The clock that the waveform properties state.
    fn clock(&self) -> Clock {
        let is_time = self.text("wf_xunit_string").is_none_or(|unit| unit == "s");
        let step_s = self.number("wf_increment").filter(|step| *step > 0.0 && step.is_finite());
        match step_s.filter(|_| is_time) {
            Some(step_s) => {
                let start_s = self.number("wf_start_offset").filter(|start| start.is_finite());
                Clock::Even { start_s: start_s.unwrap_or(0.0), step_s }
            }
            None => Clock::Unstated,
        }
    }
}
