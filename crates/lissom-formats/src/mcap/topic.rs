//! The messages of a topic, and the channels they become.

use std::collections::HashMap;

use crate::collected::{Collected, LeftOut};
use crate::format_error::FormatError;
use crate::log_data::{Channel, Clock};

/// Most channels of a topic.
const MOST_COLUMNS: usize = 4096;
/// Stamps count nanoseconds.
const STAMPS_PER_S: f64 = 1e9;
/// Stamps and log times that are further apart come from different clocks \[ns\].
const SAME_CLOCK_NS: u64 = 3_600_000_000_000;

const MANY: LeftOut = LeftOut {
    what: "fields beyond the first 4096 numbers of a topic",
    way_out: "record the fields that are needed as a topic of their own",
};

/// Names of the channel of times; the second one if a field has the first one.
const TIME: [&str; 2] = ["time", "log_time"];

/// Whether a channel of times has this name.
pub(super) fn is_time(name: &str) -> bool {
    TIME.contains(&name)
}

/// A field of all messages.
#[derive(Debug)]
struct Column {
    name: String,
    /// Whether its values are kept.
    is_wanted: bool,
    values: Vec<f64>,
}

/// Times of the messages of a topic \[ns\].
#[derive(Debug, Default)]
struct Times {
    first: Option<i64>,
    /// Empty if no channel of the topic is wanted.
    all: Vec<i64>,
}

impl Times {
    fn push(&mut self, time: i64, is_kept: bool) {
        self.first = Some(self.first.map_or(time, |first| first.min(time)));
        if is_kept {
            self.all.push(time);
        }
    }
}

/// The messages of a topic.
#[derive(Debug)]
pub(super) struct Topic {
    pub(super) name: String,
    /// Whether a channel of it may be wanted.
    is_wanted: bool,
    columns: Vec<Column>,
    wanted_columns: usize,
    places: HashMap<String, usize>,
    /// Number of messages.
    rows: usize,
    log_times: Times,
    /// Of the headers; `None` if a message has none.
    stamps: Option<Times>,
    has_set_stamp: bool,
}

impl Topic {
    pub(super) fn new(name: String, is_wanted: bool) -> Self {
        Self {
            name,
            is_wanted,
            columns: Vec::new(),
            wanted_columns: 0,
            places: HashMap::new(),
            rows: 0,
            log_times: Times::default(),
            stamps: Some(Times::default()),
            has_set_stamp: false,
        }
    }

    /// The column of this name; `None` if there are too many.
    pub(super) fn column(
        &mut self,
        name: &str,
        found: &mut Collected,
    ) -> Result<Option<usize>, FormatError> {
        if let Some(place) = self.places.get(name) {
            return Ok(Some(*place));
        }
        let place = self.columns.len();
        if place >= MOST_COLUMNS {
            found.leave_out(&self.name, &MANY);
            return Ok(None);
        }
        let is_wanted = self.is_wanted && found.wanted.has(&format!("{}/{name}", self.name));
        let rows = if is_wanted { self.rows + 1 } else { 0 };
        found.take_bytes(rows * size_of::<f64>() + size_of::<Column>() + 2 * name.len())?;
        self.places.insert(name.to_owned(), place);
        self.wanted_columns += usize::from(is_wanted);
        self.columns.push(Column { name: name.to_owned(), is_wanted, values: Vec::new() });
        Ok(Some(place))
    }

    /// Sets a value of the message that is read.
    pub(super) fn set(&mut self, column: usize, value: f64) {
        let Some(column) = self.columns.get_mut(column).filter(|c| c.is_wanted) else { return };
        column.values.resize(self.rows, f64::NAN);
        column.values.push(value);
    }

    /// Forgets the values of the message that is read.
    pub(super) fn forget(&mut self) {
        let row = self.rows;
        self.columns.iter_mut().for_each(|column| column.values.truncate(row));
    }

    /// Completes the message that is read.
    pub(super) fn complete(
        &mut self,
        log_time_ns: u64,
        stamp_ns: Option<i64>,
        found: &mut Collected,
    ) -> Result<(), FormatError> {
        let times = if self.is_wanted { 3 } else { 0 };
        found.take_bytes((self.wanted_columns + times) * size_of::<f64>())?;
        self.rows += 1;
        self.log_times.push(log_time_ns.cast_signed(), self.is_wanted);
        match (&mut self.stamps, stamp_ns) {
            (Some(stamps), Some(stamp)) => {
                stamps.push(stamp, self.is_wanted);
                self.has_set_stamp |= stamp != 0;
            }
            _ => self.stamps = None,
        }
        Ok(())
    }

    /// The stamps of the headers, if all messages have one and any is set.
    fn stamps(&self) -> Option<&Times> {
        self.stamps.as_ref().filter(|_| self.has_set_stamp)
    }
}

/// Appends the channels of topics. Their times are counted from the first stamp of the file.
pub(super) fn collect(topics: Vec<Topic>, found: &mut Collected) -> Result<(), FormatError> {
    let topics: Vec<Topic> = topics.into_iter().filter(|t| !t.columns.is_empty()).collect();
    let stamps = topics.iter().filter_map(Topic::stamps).filter_map(|times| times.first).min();
    let logged = topics.iter().filter(|topic| topic.stamps().is_none());
    let logged = logged.filter_map(|topic| topic.log_times.first).min();
    let (mut stamps, mut logged) = (stamps.unwrap_or(0), logged.or(stamps).unwrap_or(0));
    if stamps == 0 {
        stamps = logged;
    }
    if stamps.abs_diff(logged) < SAME_CLOCK_NS {
        (stamps, logged) = (stamps.min(logged), stamps.min(logged));
    } else {
        found.note(
            "the stamps in the headers and the log times are of different clocks: topics without a \
             header are not synchronous with those with one",
        );
    }
    for mut topic in topics {
        let (times, origin) = match topic.stamps.take().filter(|_| topic.has_set_stamp) {
            Some(times) => (times, stamps),
            None => (std::mem::take(&mut topic.log_times), logged),
        };
        topic.log_times = Times::default();
        found.take_bytes(times.all.len() * size_of::<f64>())?;
        topic.collect(times.all, origin, found);
    }
    Ok(())
}

impl Topic {
    /// Appends its channels, with their clock before them.
    fn collect(self, times_ns: Vec<i64>, origin_ns: i64, found: &mut Collected) {
        let since = |time: i64| time.wrapping_sub(origin_ns) as f64 / STAMPS_PER_S;
        let clock = found.channels.len();
        let times = times_ns.into_iter().map(since).collect();
        let [label, other] = TIME;
        let label = if self.places.contains_key(label) { other } else { label };
        let mut time = Channel::of(format!("{}/{label}", self.name), times);
        time.unit = Some("s".to_owned());
        found.channels.push(time);
        for mut column in self.columns {
            if column.is_wanted {
                column.values.resize(self.rows, f64::NAN);
            }
            let mut channel = Channel::of(format!("{}/{}", self.name, column.name), column.values);
            channel.clock = Clock::Channel(clock);
            found.channels.push(channel);
        }
    }
}
