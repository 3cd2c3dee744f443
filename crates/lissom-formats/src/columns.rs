//! The channels of arrays while the bytes of the arrays are read.

use crate::collected::{Collected, LeftOut};
use crate::format_error::FormatError;
use crate::log_data::Channel;
use crate::number::Number;
use crate::stream::Input;

const MANY_CHANNELS: LeftOut = LeftOut {
    what: "arrays with more than 4096 channels",
    way_out: "save the rows or columns that are needed as an array of their own",
};
/// Bytes that are decoded for all channels before the next ones: they fit into the cache of a core.
const BLOCK_BYTES: usize = 1 << 15;

/// The channels of an array.
#[derive(Debug, Clone, Default)]
pub(crate) struct Columns {
    /// Number of values of each channel.
    pub(crate) length: usize,
    /// The end of the names.
    pub(crate) part: &'static str,
    pub(crate) all: Vec<Column>,
    pub(crate) has_too_many: bool,
    /// Place of the first time, from which the others are counted, until it is read.
    pub(crate) first_time: Option<usize>,
}

/// A channel of an array.
#[derive(Debug, Clone)]
pub(crate) struct Column {
    /// As `[2]` or `[2,1]`; empty if there is one channel.
    pub(crate) label: String,
    /// `None` if it is not wanted.
    pub(crate) values: Option<Values>,
}

/// Values of a channel while they are read.
#[derive(Debug, Clone)]
pub(crate) struct Values {
    pub(crate) number: Number,
    /// Place of the next number, from the beginning of the array \[byte\].
    pub(crate) next: usize,
    /// Distance of two numbers \[byte\].
    pub(crate) stride: usize,
    /// How many numbers are not yet read.
    pub(crate) left: usize,
    pub(crate) read: Vec<f64>,
}

impl Values {
    /// Appends the numbers in bytes that begin at a place of the array.
    fn append(&mut self, bytes: &[u8], at: usize) {
        let Some(bytes) = self.next.checked_sub(at).and_then(|first| bytes.get(first..)) else {
            // A number that began in other bytes is that of a damaged type.
            self.left = if self.next < at { 0 } else { self.left };
            return;
        };
        let Some(behind) = bytes.len().checked_sub(self.number.kind.size()) else { return };
        let count = (behind / self.stride.max(1) + 1).min(self.left);
        self.read.reserve_exact(self.left.saturating_sub(self.read.capacity() - self.read.len()));
        self.number.append(&mut self.read, bytes, self.stride, count);
        self.next += count * self.stride;
        self.left -= count;
    }
}

impl Columns {
    /// Place of the next number that is wanted.
    pub(crate) fn next(&self) -> Option<usize> {
        let values = self.all.iter().filter_map(|column| column.values.as_ref());
        let next = values.filter(|values| values.left > 0).map(|values| values.next).min();
        next.map(|next| self.first_time.unwrap_or(next))
    }

    /// Bytes in memory of its wanted values.
    #[cfg(feature = "hdf5")]
    pub(crate) fn wanted_bytes(&self) -> usize {
        let wanted = self.all.iter().filter(|column| column.values.is_some());
        wanted.count().saturating_mul(self.length).saturating_mul(size_of::<f64>())
    }

    /// Appends the numbers in bytes that begin at a place of the array.
    pub(crate) fn append(&mut self, bytes: &[u8], at: usize) {
        let first = self.first_time.and_then(|first| first.checked_sub(at));
        if let Some(first) = first.and_then(|first| bytes.get(first..)) {
            self.first_time = None;
            let values = self.all.iter_mut().filter_map(|column| column.values.as_mut());
            values.for_each(|values| values.number = values.number.since_first(first));
        }
        for column in &mut self.all {
            if let Some(values) = column.values.as_mut().filter(|values| values.left > 0) {
                values.append(bytes, at);
            }
        }
    }

    /// Its number, if it has one.
    pub(crate) fn scalar(&self) -> Option<f64> {
        match &self.all[..] {
            [Column { values: Some(values), .. }] if self.length == 1 => {
                values.read.first().copied()
            }
            _ => None,
        }
    }

    /// Appends the channels of the array `name` to those of the file.
    pub(crate) fn push(self, name: &str, found: &mut Collected) {
        if self.has_too_many {
            found.leave_out(name, &MANY_CHANNELS);
        }
        for Column { label, values } in self.all {
            let values = values.map_or_else(Vec::new, |values| values.read);
            found.channels.push(Channel::of(format!("{name}{label}{}", self.part), values));
        }
    }
}

/// Reads the wanted values of arrays from the bytes of their items, of a size each; `None` if there are fewer bytes.
///
/// Bytes without wanted values are skipped, and those behind the last one are not read.
pub(crate) fn read_values(
    arrays: &mut [Columns],
    item_bytes: usize,
    bytes: u64,
    input: &mut dyn Input,
) -> Result<Option<()>, FormatError> {
    let item_bytes = item_bytes.max(1);
    let most = (BLOCK_BYTES / item_bytes).max(1) * item_bytes;
    let mut at = 0;
    while let Some(next) = arrays.iter().filter_map(Columns::next).min() {
        let begin = next / item_bytes * item_bytes;
        if begin > at {
            let Some(()) = input.skip((begin - at) as u64)? else { return Ok(None) };
            at = begin;
        }
        let count = (most as u64).min(bytes.saturating_sub(at as u64)) as usize;
        let Some(block) = input.next_bytes(count)?.filter(|_| count > 0) else { return Ok(None) };
        for array in arrays.iter_mut() {
            array.append(block, at);
        }
        at += count;
    }
    Ok(Some(()))
}
