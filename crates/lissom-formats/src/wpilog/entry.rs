//! Entries of a log: their values, and the channels they become.

use super::layout::{Layout, Leaf};
use crate::channel_ref::Wanted;
use crate::collected::{Collected, LeftOut};
use crate::format_error::FormatError;
use crate::log_data::{Channel, Clock};
use crate::number::Number;

/// Most places of an array.
const MOST_PLACES: usize = 4096;
/// Time stamps count microseconds.
const STAMPS_PER_S: f64 = 1e6;

const LONG: LeftOut =
    LeftOut { what: "arrays of more than 4096 places", way_out: "log parts of the arrays" };
const UNFIT: LeftOut = LeftOut {
    what: "records whose size does not fit their type",
    way_out: "copy the file again if the values matter",
};

/// An entry of a log, with its values.
pub(super) struct Entry {
    pub(super) name: String,
    pub(super) unit: Option<String>,
    /// Name of its type.
    pub(super) of: String,
    pub(super) layout: Option<Layout>,
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

impl Entry {
    /// An entry without records.
    pub(super) fn new(
        (name, of): (String, String),
        unit: Option<String>,
        layout: Option<Layout>,
    ) -> Self {
        let (rows, is_wanted, times_s, places) = (0, None, Vec::new(), Vec::new());
        Self { name, unit, of, layout, rows, is_wanted, times_s, places }
    }

    /// Appends the values of a record.
    pub(super) fn append(
        &mut self,
        stamp: u64,
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
            self.times_s.push(stamp as f64 / STAMPS_PER_S);
        }
        Ok(())
    }

    /// Appends its channels, with their clock before them.
    pub(super) fn collect(self, found: &mut Collected) {
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
