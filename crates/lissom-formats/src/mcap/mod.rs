//! MCAP files with messages of ROS 2, or with messages in JSON.
//!
//! The types of ROS 2 messages are read from the definitions in the file, `.msg` or IDL.
//!
//! Each number of a message is a channel, `/topic/field/x`. The time of a topic is `/topic/time`, in seconds from the first
//! stamp of the file: the stamp in the header of its messages, else their log time. The file is read from its beginning, so
//! that it needs no index and no end. One chunk is in memory, compressed and expanded.

mod cdr;
mod chunk;
mod idl;
mod json_message;
mod message;
mod message_type;
mod topic;

use std::collections::HashMap;
use std::rc::Rc;

use crate::channel_ref::Wanted;
use crate::collected::{Collected, LeftOut};
use crate::cursor::Cursor;
use crate::format::Format;
use crate::format_error::FormatError;
use crate::log_data::LogData;
use crate::source::Source;
use crate::stream::{Input, Stream};
use message::{MessageReader, UNDEFINED};
use message_type::{Definitions, plain};
use topic::Topic;

/// First bytes of a file.
pub(crate) const MCAP: &[u8] = b"\x89MCAP0\r\n";

const SCHEMA: u8 = 3;
const CHANNEL: u8 = 4;
const MESSAGE: u8 = 5;
const CHUNK: u8 = 6;
const DATA_END: u8 = 15;

const ENCODINGS: LeftOut = LeftOut {
    what: "messages that are neither of ROS 2 nor in JSON",
    way_out: "export the topics as CSV, or convert them: mcap convert FILE log.mcap",
};

/// A schema of a file.
struct Schema {
    name: String,
    encoding: String,
    definitions: Option<Rc<Definitions>>,
}

/// How the messages of a channel are read.
enum Encoding {
    Ros2 { reader: MessageReader, definitions: Rc<Definitions> },
    Json,
}

impl Encoding {
    /// Whether the last part of the name of a channel may be this one.
    fn has_field(&self, name: &str) -> bool {
        match self {
            // In brackets may be any name of a place.
            Self::Ros2 { definitions, .. } => {
                name.ends_with(']') || topic::is_time(name) || definitions.have_field(name)
            }
            Self::Json => true,
        }
    }
}

/// A channel of a file: the place of its topic.
struct ChannelReader {
    topic: usize,
    encoding: Encoding,
}

/// What was read of a file.
#[derive(Default)]
struct Reader {
    schemas: HashMap<u16, Schema>,
    /// `None` if the messages of the channel are left out.
    channels: HashMap<u16, Option<ChannelReader>>,
    topics: Vec<Topic>,
    /// The topic of a name and a schema.
    places: HashMap<(String, String), usize>,
}

/// Reads a file.
pub(crate) fn read(source: &Source, wanted: Wanted) -> Result<LogData, FormatError> {
    let mut found = Collected::of(wanted);
    let mut reader = Reader::default();
    let mut stream = source.stream(MCAP.len() as u64);
    loop {
        let place = stream.place();
        let Some((kind, length)) = header(&mut stream)? else {
            reader.cut(source, place, &mut found)?;
            break;
        };
        if kind == DATA_END {
            break;
        }
        if !matches!(kind, CHUNK | SCHEMA | CHANNEL | MESSAGE) {
            stream.skip(length as u64)?;
            continue;
        }
        let Some(content) = stream.next_bytes(length)? else { break };
        if kind == CHUNK {
            reader.chunk(content, place, &mut found)?;
        } else {
            reader.record(kind, content, &mut found)?;
        }
    }
    topic::collect(reader.topics, &mut found)?;
    found.finish(Format::Mcap)
}

/// Type and length of the next record; `None` if the file ends before its end.
fn header(stream: &mut Stream) -> Result<Option<(u8, usize)>, FormatError> {
    /// Bytes before the content of a record.
    const BYTES: usize = 9;
    let Some(bytes) = stream.next_bytes(BYTES)? else { return Ok(None) };
    let mut cursor = Cursor::new(bytes, false);
    let header = cursor.u8().zip(cursor.u64());
    Ok(header
        .filter(|(_, length)| *length <= stream.left())
        .map(|(kind, length)| (kind, length as usize)))
}

/// Type and content of the next record; `None` if the file ends before its end.
fn record<'a>(cursor: &mut Cursor<'a>) -> Option<(u8, &'a [u8])> {
    let mut next = *cursor;
    let kind = next.u8()?;
    let length = usize::try_from(next.u64()?).ok()?;
    let content = next.take(length)?;
    *cursor = next;
    Some((kind, content))
}

fn text(cursor: &mut Cursor) -> Option<String> {
    let length = cursor.count_u32()?;
    Some(String::from_utf8_lossy(cursor.take(length)?).into_owned())
}

impl Reader {
    /// Reads what there is of the record at the end of a file that has no end.
    fn cut(
        &mut self,
        source: &Source,
        place: u64,
        found: &mut Collected,
    ) -> Result<(), FormatError> {
        found.note(format!(
            "the file has no end, as after a recording that was interrupted: it is read to byte {place}"
        ));
        // Of a chunk that is cut off, the first messages may be there.
        if *source.bytes(place..place + 1)? == [CHUNK] {
            let content = source.bytes(place + 9..u64::MAX)?;
            if let Some(records) = chunk::first_records(&content, found)? {
                self.records(&records, found)?;
                found.release_bytes(records.len());
            }
        }
        Ok(())
    }

    /// Reads the records in a chunk.
    fn chunk(
        &mut self,
        content: &[u8],
        place: u64,
        found: &mut Collected,
    ) -> Result<(), FormatError> {
        let records = match chunk::records(content, found) {
            Ok(records) => records,
            Err(error @ FormatError::TooLarge { .. }) => return Err(error),
            Err(error) => {
                found.note(format!("the chunk at byte {place} is left out: {error}"));
                return Ok(());
            }
        };
        self.records(&records, found)?;
        found.release_bytes(records.len());
        Ok(())
    }

    fn records(&mut self, bytes: &[u8], found: &mut Collected) -> Result<(), FormatError> {
        let mut cursor = Cursor::new(bytes, false);
        while let Some((kind, content)) = record(&mut cursor) {
            self.record(kind, content, found)?;
        }
        Ok(())
    }

    fn record(
        &mut self,
        kind: u8,
        content: &[u8],
        found: &mut Collected,
    ) -> Result<(), FormatError> {
        let mut cursor = Cursor::new(content, false);
        let read = match kind {
            SCHEMA => self.schema(&mut cursor),
            CHANNEL => self.channel(&mut cursor, found),
            MESSAGE => return self.message(&mut cursor, found),
            _ => Some(()),
        };
        if read.is_none() {
            found.note("a damaged description of a topic is left out");
        }
        Ok(())
    }

    fn schema(&mut self, cursor: &mut Cursor) -> Option<()> {
        let number = cursor.u16()?;
        if self.schemas.contains_key(&number) {
            return Some(());
        }
        let (name, encoding) = (text(cursor)?, text(cursor)?);
        let data = text(cursor)?;
        let definitions = match encoding.as_str() {
            "ros2msg" => Definitions::of_text(&name, &data),
            "ros2idl" => idl::definitions(&data),
            _ => None,
        };
        let definitions = definitions.map(Rc::new);
        self.schemas.insert(number, Schema { name, encoding, definitions });
        Some(())
    }

    fn channel(&mut self, cursor: &mut Cursor, found: &mut Collected) -> Option<()> {
        let number = cursor.u16()?;
        if self.channels.contains_key(&number) {
            return Some(());
        }
        let schema = cursor.u16()?;
        let (topic, encoding) = (text(cursor)?, text(cursor)?);
        let schema = self.schemas.get(&schema);
        let name = schema.map_or("", |schema| &schema.name);
        let encoding = match (encoding.as_str(), schema) {
            ("json", _) => Ok(Encoding::Json),
            ("cdr", Some(schema)) if schema.encoding.starts_with("ros2") => {
                let definitions = schema.definitions.clone().ok_or(&UNDEFINED);
                definitions.and_then(|definitions| {
                    let reader = MessageReader::new(&plain(&schema.name), &definitions)?;
                    Ok(Encoding::Ros2 { reader, definitions })
                })
            }
            _ => Err(&ENCODINGS),
        };
        let encoding = match encoding {
            Ok(encoding) => encoding,
            Err(why) => {
                found.leave_out(&topic, why);
                self.channels.insert(number, None);
                return Some(());
            }
        };
        let is_wanted = found.wanted.has_in(&topic, |name| encoding.has_field(name));
        let key = (topic, name.to_owned());
        let topics = &mut self.topics;
        let place = *self.places.entry(key).or_insert_with_key(|(topic, _)| {
            topics.push(Topic::new(topic.clone(), is_wanted));
            topics.len() - 1
        });
        self.channels.insert(number, Some(ChannelReader { topic: place, encoding }));
        Some(())
    }

    fn message(&mut self, cursor: &mut Cursor, found: &mut Collected) -> Result<(), FormatError> {
        let header = |cursor: &mut Cursor| {
            Some((cursor.u16()?, cursor.u32()?, cursor.u64()?, cursor.u64()?))
        };
        let Some((number, _, log_time_ns, _)) = header(cursor) else {
            found.note("a damaged message is left out");
            return Ok(());
        };
        let Some(channel) = self.channels.get_mut(&number) else {
            found.note("messages of a topic without a description are left out");
            return Ok(());
        };
        let Some(channel) = channel else { return Ok(()) };
        let Some(topic) = self.topics.get_mut(channel.topic) else { return Ok(()) };
        match &mut channel.encoding {
            Encoding::Ros2 { reader, definitions } => {
                reader.read(cursor.rest(), log_time_ns, definitions, topic, found)
            }
            Encoding::Json => json_message::read(cursor.rest(), log_time_ns, topic, found),
        }
    }
}
