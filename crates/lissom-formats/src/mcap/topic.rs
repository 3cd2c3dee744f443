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

/// A field of all messages.
#[derive(Debug)]
struct Column {
    name: String,
    values: Vec<f64>,
}

/// The messages of a topic.
#[derive(Debug)]
pub(super) struct Topic {
    pub(super) name: String,
    columns: Vec<Column>,
    places: HashMap<String, usize>,
    log_times_ns: Vec<u64>,
    /// Of the header, if the message has one.
    stamps_ns: Vec<Option<i64>>,
}

impl Topic {
    pub(super) fn new(name: String) -> Self {
        let (columns, places) = (Vec::new(), HashMap::new());
        Self { name, columns, places, log_times_ns: Vec::new(), stamps_ns: Vec::new() }
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
        let rows = self.log_times_ns.len();
        found.take_bytes((rows + 1) * size_of::<f64>() + size_of::<Column>() + 2 * name.len())?;
        self.places.insert(name.to_owned(), place);
        self.columns.push(Column { name: name.to_owned(), values: Vec::new() });
        Ok(Some(place))
    }

    /// Sets a value of the message that is read.
    pub(super) fn set(&mut self, column: usize, value: f64) {
        let row = self.log_times_ns.len();
        let Some(column) = self.columns.get_mut(column) else { return };
        column.values.resize(row, f64::NAN);
        column.values.push(value);
    }

    /// Forgets the values of the message that is read.
    pub(super) fn forget(&mut self) {
        let row = self.log_times_ns.len();
        self.columns.iter_mut().for_each(|column| column.values.truncate(row));
    }

    /// Completes the message that is read.
    pub(super) fn complete(
        &mut self,
        log_time_ns: u64,
        stamp_ns: Option<i64>,
        found: &mut Collected,
    ) -> Result<(), FormatError> {
        found.take_bytes((self.columns.len() + 3) * size_of::<f64>())?;
        self.log_times_ns.push(log_time_ns);
        self.stamps_ns.push(stamp_ns);
        Ok(())
    }

    /// The stamps of the headers, if all messages have one and any is set.
    fn stamps(&self) -> Option<Vec<i64>> {
        let stamps: Option<Vec<i64>> = self.stamps_ns.iter().copied().collect();
        stamps.filter(|stamps| stamps.iter().any(|stamp| *stamp != 0))
    }

    fn log_times(&self) -> Vec<i64> {
        self.log_times_ns.iter().map(|time| time.cast_signed()).collect()
    }
}

/// Appends the channels of topics. Their times are counted from the first stamp of the file.
pub(super) fn collect(topics: Vec<Topic>, found: &mut Collected) -> Result<(), FormatError> {
    let topics: Vec<Topic> = topics.into_iter().filter(|t| !t.columns.is_empty()).collect();
    let first = |times: &Vec<i64>| times.iter().min().copied();
    let stamps = topics.iter().filter_map(Topic::stamps).filter_map(|t| first(&t)).min();
    let logged = topics.iter().filter(|topic| topic.stamps().is_none());
    let logged = logged.filter_map(|topic| first(&topic.log_times())).min();
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
    for topic in topics {
        let (times, origin) = match topic.stamps() {
            Some(times) => (times, stamps),
            None => (topic.log_times(), logged),
        };
        found.take_bytes(times.len() * size_of::<f64>())?;
        topic.collect(&times, origin, found);
    }
    Ok(())
}

impl Topic {
    /// Appends its channels, with their clock before them.
    fn collect(self, times_ns: &[i64], origin_ns: i64, found: &mut Collected) {
        let since = |time: &i64| time.wrapping_sub(origin_ns) as f64 / STAMPS_PER_S;
        let clock = found.channels.len();
        let times = times_ns.iter().map(since).collect();
        let label = if self.places.contains_key("time") { "log_time" } else { "time" };
        let mut time = Channel::of(format!("{}/{label}", self.name), times);
        time.unit = Some("s".to_owned());
        found.channels.push(time);
        for mut column in self.columns {
            column.values.resize(times_ns.len(), f64::NAN);
            let mut channel = Channel::of(format!("{}/{}", self.name, column.name), column.values);
            channel.clock = Clock::Channel(clock);
            found.channels.push(channel);
        }
    }
}
