//! Arrays of a binary file, and the channels they contain.
//!
//! The longest axis of an array counts the samples; every place on the other axes is a channel. Of a square array the
//! columns are the channels.

use crate::collected::Collected;
use crate::columns::{Column, Columns, Values};
use crate::format_error::FormatError;
use crate::number::Number;

/// Most channels of one array.
const MOST_CHANNELS: usize = 4096;

/// Where the numbers of an array are, in items that follow each other.
#[derive(Debug, Clone)]
pub(crate) struct Array {
    pub(crate) number: Number,
    /// Where the first number begins \[byte\].
    pub(crate) offset: usize,
    pub(crate) axes: Vec<Axis>,
}

/// An axis of an array.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Axis {
    /// Its number of places.
    pub(crate) length: usize,
    /// Distance of two places \[byte\].
    pub(crate) stride: usize,
}

/// The axes of an array of items of `size` bytes without gaps; `None` if it is too large for this computer.
pub(crate) fn axes(lengths: &[usize], size: usize, first_is_fastest: bool) -> Option<Vec<Axis>> {
    let mut stride = size;
    let mut axes = Vec::with_capacity(lengths.len());
    let mut push = |length: usize| -> Option<()> {
        axes.push(Axis { length, stride });
        stride = stride.checked_mul(length)?;
        Some(())
    };
    if first_is_fastest {
        lengths.iter().try_for_each(|length| push(*length))?;
    } else {
        lengths.iter().rev().try_for_each(|length| push(*length))?;
        axes.reverse();
    }
    Some(axes)
}

/// The number of items on these axes; `None` if it is too large for this computer.
pub(crate) fn items(lengths: &[usize]) -> Option<usize> {
    lengths.iter().try_fold(1_usize, |product, length| product.checked_mul(*length))
}

impl Array {
    /// The channels of the array `name`. Values are read later of those that are wanted; their memory is counted here. `part`
    /// is the end of the names; the first channel has this number in the file, if it is known. The items have these bytes.
    pub(crate) fn columns(
        &self,
        name: &str,
        part: &'static str,
        number: Option<usize>,
        bytes: usize,
        found: &mut Collected,
    ) -> Result<Columns, FormatError> {
        let lengths: Vec<usize> = self.axes.iter().map(|axis| axis.length).collect();
        let count = items(&lengths).ok_or_else(|| too_large(name))?;
        let none = Columns { part, ..Columns::default() };
        if count == 0 {
            return Ok(none);
        }
        let axes: Vec<Axis> = self.axes.iter().copied().filter(|axis| axis.length > 1).collect();
        let longest = axes.iter().map(|axis| axis.length).max();
        let samples = axes.iter().position(|axis| Some(axis.length) == longest);
        let (length, stride) = match samples.and_then(|k| axes.get(k)) {
            Some(axis) => (axis.length, axis.stride),
            None => (1, self.number.kind.size()),
        };
        if count / length > MOST_CHANNELS {
            return Ok(Columns { has_too_many: true, ..none });
        }
        if self.reach().is_none_or(|reach| reach > bytes) {
            return Err(too_large(name));
        }
        let others: Vec<Axis> =
            axes.iter().enumerate().filter(|(k, _)| Some(*k) != samples).map(|(_, a)| *a).collect();
        let mut columns = Vec::new();
        for (k, Place { offset, label }) in places(&others).into_iter().enumerate() {
            let number = number.map(|number| number + k);
            // A number alone may be one of a channel of another name.
            let is_wanted =
                count == 1 || found.wanted.has_at(&format!("{name}{label}{part}"), number);
            let values = if is_wanted {
                found.take_bytes(length.saturating_mul(size_of::<f64>()))?;
                let (next, left) = (self.offset + offset, length);
                Some(Values { number: self.number, next, stride, left, read: Vec::new() })
            } else {
                None
            };
            columns.push(Column { label, values });
        }
        Ok(Columns { length, all: columns, ..none })
    }

    /// Bytes from the beginning of the items to the end of the last number.
    fn reach(&self) -> Option<usize> {
        let last = |reach: usize, axis: &Axis| {
            reach.checked_add(axis.length.checked_sub(1)?.checked_mul(axis.stride)?)
        };
        let size = self.offset.checked_add(self.number.kind.size())?;
        self.axes.iter().try_fold(size, last)
    }
}

pub(crate) fn too_large(name: &str) -> FormatError {
    FormatError::content(name, "the array is larger than the file")
}

/// Where a channel begins.
struct Place {
    offset: usize,
    /// As `[2]` or `[2,1]`; empty if there is one channel.
    label: String,
}

/// The places on axes, the last axis fastest.
fn places(axes: &[Axis]) -> Vec<Place> {
    let mut places = vec![(0, String::new())];
    for axis in axes {
        let along = |(offset, label): &(usize, String)| {
            let (offset, label) = (*offset, label.clone());
            (0..axis.length).map(move |k| {
                let comma = if label.is_empty() { "" } else { "," };
                (offset + k * axis.stride, format!("{label}{comma}{}", k + 1))
            })
        };
        places = places.iter().flat_map(along).collect();
    }
    let place = |(offset, label): (usize, String)| {
        let label = if label.is_empty() { label } else { format!("[{label}]") };
        Place { offset, label }
    };
    places.into_iter().map(place).collect()
}
