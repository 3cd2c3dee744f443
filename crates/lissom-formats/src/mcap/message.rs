//! Reads messages of ROS 2 by their definition.
//!
//! An array of numbers has a channel for each place, `position[1]`; where the message names the places in an array of texts
//! before it, `position[elbow]`.

use super::cdr::Cdr;
use super::message_type::{Count, Definitions, Field, Item};
use super::topic::Topic;
use crate::collected::{Collected, LeftOut};
use crate::format_error::FormatError;
use crate::number::NumberType;

/// Deepest nesting of messages.
const MOST_DEPTH: usize = 32;
/// Most fields of a message, with those of the messages inside it.
const MOST_FIELDS: usize = 4096;
/// Most places of an array that become channels.
const MOST_PLACES: usize = 256;
/// Most bytes behind a message: padding.
const MOST_PADDING: usize = 7;

pub(super) const UNDEFINED: LeftOut = LeftOut {
    what: "messages without a definition that can be read",
    way_out: "export the topics as CSV",
};
const DEEP: LeftOut = LeftOut {
    what: "messages with more than 4096 fields, or nested too deep",
    way_out: "export the topics as CSV",
};
const LONG: LeftOut = LeftOut {
    what: "arrays of more than 256 places",
    way_out: "publish the places that are needed as a topic of their own",
};
const UNFIT: LeftOut = LeftOut {
    what: "messages that do not fit their definition",
    way_out: "record the topic again if the values matter",
};

/// A field, and the channels that it became.
#[derive(Debug)]
enum Place {
    Number {
        kind: NumberType,
        path: String,
        column: Option<usize>,
    },
    Text,
    /// The stamp in the header.
    Stamp,
    Message(Vec<Place>),
    Array(Array),
}

#[derive(Debug)]
struct Array {
    path: String,
    item: Item,
    count: Count,
    /// Whether its texts name the places of the arrays behind it.
    has_names: bool,
    /// Its places, with their labels.
    places: Vec<(String, Place)>,
}

/// Reads the messages of a topic.
#[derive(Debug)]
pub(super) struct MessageReader {
    root: Place,
}

/// Why a message is not read.
enum Wrong {
    Message,
    File(FormatError),
}

impl From<FormatError> for Wrong {
    fn from(error: FormatError) -> Self {
        Self::File(error)
    }
}

impl MessageReader {
    /// A reader of the message `name`.
    pub(super) fn new(name: &str, of: &Definitions) -> Result<Self, &'static LeftOut> {
        let mut builder = Builder { of, left: MOST_FIELDS };
        let root = builder.item(&Item::Message(name.to_owned()), "", 0)?;
        Ok(Self { root })
    }

    /// Reads a message into the columns of its topic.
    pub(super) fn read(
        &mut self,
        bytes: &[u8],
        log_time_ns: u64,
        of: &Definitions,
        topic: &mut Topic,
        found: &mut Collected,
    ) -> Result<(), FormatError> {
        let Some(cdr) = Cdr::new(bytes) else {
            found.leave_out(&topic.name, &UNFIT);
            return Ok(());
        };
        let (names, stamp_ns) = (Vec::new(), None);
        let mut message = Message { cdr, of, names, stamp_ns, is_muted: false, topic, found };
        match message.read(&mut self.root) {
            Ok(()) if message.cdr.left() <= MOST_PADDING => {
                let stamp_ns = message.stamp_ns;
                topic.complete(log_time_ns, stamp_ns, found)
            }
            Err(Wrong::File(error)) => Err(error),
            Ok(()) | Err(Wrong::Message) => {
                topic.forget();
                found.leave_out(&topic.name, &UNFIT);
                Ok(())
            }
        }
    }
}

/// Makes the places of fields.
struct Builder<'a> {
    of: &'a Definitions,
    left: usize,
}

impl Builder<'_> {
    fn item(&mut self, item: &Item, path: &str, depth: usize) -> Result<Place, &'static LeftOut> {
        self.left = self.left.checked_sub(1).filter(|_| depth <= MOST_DEPTH).ok_or(&DEEP)?;
        match item {
            Item::Number(kind) => {
                Ok(Place::Number { kind: *kind, path: path.to_owned(), column: None })
            }
            Item::Text => Ok(Place::Text),
            Item::WideText => Err(&UNDEFINED),
            Item::Message(name) if is_time(name) && matches!(path, "header/stamp" | "stamp") => {
                Ok(Place::Stamp)
            }
            Item::Message(name) => {
                let fields = self.of.message(name).ok_or(&UNDEFINED)?;
                if fields.is_empty() {
                    // An empty message has one byte.
                    return Ok(Place::Message(vec![Place::Array(Array {
                        path: String::new(),
                        item: Item::Number(NumberType::U8),
                        count: Count::Fixed(1),
                        has_names: false,
                        places: Vec::new(),
                    })]));
                }
                let fields = fields.iter().map(|field| self.field(field, path, depth + 1));
                Ok(Place::Message(fields.collect::<Result<_, _>>()?))
            }
        }
    }

    fn field(
        &mut self,
        field: &Field,
        path: &str,
        depth: usize,
    ) -> Result<Place, &'static LeftOut> {
        let name = &field.name;
        let path = if path.is_empty() { name.clone() } else { format!("{path}/{name}") };
        if field.count == Count::One {
            return self.item(&field.item, &path, depth);
        }
        // A wrong definition is found here, not in the first message.
        self.item(&field.item, &path, depth)?;
        let has_names = field.item == Item::Text && (name == "name" || name.ends_with("names"));
        let (item, count, places) = (field.item.clone(), field.count, Vec::new());
        Ok(Place::Array(Array { path, item, count, has_names, places }))
    }
}

fn is_time(name: &str) -> bool {
    name == "builtin_interfaces/Time"
}

/// A message that is read.
struct Message<'a, 'b, 'w> {
    cdr: Cdr<'a>,
    of: &'b Definitions,
    /// Names of the places of arrays.
    names: Vec<String>,
    stamp_ns: Option<i64>,
    /// Whether the numbers are skipped.
    is_muted: bool,
    topic: &'b mut Topic,
    found: &'b mut Collected<'w>,
}

impl Message<'_, '_, '_> {
    fn read(&mut self, place: &mut Place) -> Result<(), Wrong> {
        match place {
            Place::Number { kind, path, column } => {
                let value = self.cdr.number(*kind).ok_or(Wrong::Message)?;
                if self.is_muted || path.is_empty() {
                    return Ok(());
                }
                if column.is_none() {
                    *column = self.topic.column(path, self.found)?;
                }
                if let Some(column) = *column {
                    self.topic.set(column, value);
                }
            }
            Place::Text => {
                self.cdr.text().ok_or(Wrong::Message)?;
            }
            Place::Stamp => {
                let sec = self.cdr.u32().ok_or(Wrong::Message)?.cast_signed();
                let nanosec = self.cdr.u32().ok_or(Wrong::Message)?;
                self.stamp_ns = Some(i64::from(sec) * 1_000_000_000 + i64::from(nanosec));
            }
            Place::Message(fields) => {
                let outer = self.names.clone();
                for field in fields {
                    self.read(field)?;
                }
                self.names = outer;
            }
            Place::Array(array) => self.array(array)?,
        }
        Ok(())
    }

    fn array(&mut self, array: &mut Array) -> Result<(), Wrong> {
        let count = match array.count {
            Count::One => 1,
            Count::Fixed(count) => count,
            Count::Any => self.cdr.length().ok_or(Wrong::Message)?,
        };
        if array.item == Item::Text {
            return self.texts(count, array.has_names);
        }
        let is_hidden = self.is_muted || array.path.is_empty();
        if count > MOST_PLACES && !is_hidden {
            let path = format!("{}/{}", self.topic.name, array.path);
            self.found.leave_out(&path, &LONG);
        }
        if count <= MOST_PLACES && !is_hidden {
            for k in 0..count {
                let place = self.place(array, k, count)?;
                let Some((_, place)) = array.places.get_mut(place) else { continue };
                self.read(place)?;
            }
            return Ok(());
        }
        if let Item::Number(kind) = array.item {
            return self.cdr.skip(kind, count).ok_or(Wrong::Message);
        }
        let mut place = self.new_place(&array.item, &array.path)?;
        let was_muted = std::mem::replace(&mut self.is_muted, true);
        for _ in 0..count {
            self.read(&mut place)?;
        }
        self.is_muted = was_muted;
        Ok(())
    }

    /// Index of the place with the name of item `k`, or with its number.
    fn place(&mut self, array: &mut Array, k: usize, count: usize) -> Result<usize, Wrong> {
        let name = self.names.get(k).filter(|_| self.names.len() == count);
        let label = name.cloned().unwrap_or_else(|| (k + 1).to_string());
        let is_it = |place: &(String, Place)| place.0 == label;
        if array.places.get(k).is_some_and(is_it) {
            return Ok(k);
        }
        if let Some(place) = array.places.iter().position(is_it) {
            return Ok(place);
        }
        let place = self.new_place(&array.item, &format!("{}[{label}]", array.path))?;
        array.places.push((label, place));
        Ok(array.places.len() - 1)
    }

    fn new_place(&mut self, item: &Item, path: &str) -> Result<Place, Wrong> {
        let mut builder = Builder { of: self.of, left: MOST_FIELDS };
        let place = builder.item(item, path, 0).map_err(|_| Wrong::Message)?;
        self.found.take_bytes((MOST_FIELDS - builder.left) * size_of::<Place>() + path.len())?;
        Ok(place)
    }

    fn texts(&mut self, count: usize, have_names: bool) -> Result<(), Wrong> {
        let mut names = Vec::new();
        for _ in 0..count {
            let text = self.cdr.text().ok_or(Wrong::Message)?;
            if have_names && count <= MOST_PLACES {
                names.push(text.to_owned());
            }
        }
        if have_names {
            self.names = names;
        }
        Ok(())
    }
}
