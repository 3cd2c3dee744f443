//! Arrays of a binary file, and the channels they contain.
//!
//! The longest axis of an array counts the samples; every place on the other axes is a channel. Of a square array the
//! columns are the channels.

use std::borrow::Cow;

use crate::collected::{Collected, LeftOut};
use crate::format_error::FormatError;
use crate::log_data::Channel;
use crate::number::Number;

/// Most channels of one array.
const MOST_CHANNELS: usize = 4096;
const MANY_CHANNELS: LeftOut = LeftOut {
    what: "arrays with more than 4096 channels",
    way_out: "save the rows or columns that are needed as an array of their own",
};
/// Bytes that are decoded for all channels before the next ones: they fit into the cache of a core.
const BLOCK_BYTES: usize = 1 << 15;

/// An array of numbers in the bytes of a file.
#[derive(Debug, Clone)]
pub(crate) struct Array<'a> {
    pub(crate) bytes: Cow<'a, [u8]>,
    pub(crate) number: Number,
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

impl Array<'_> {
    /// Appends its channels to those of the file. They are named `name`, or `name[1]`, `name[2]`, ... if there are several.
    pub(crate) fn collect(&self, name: &str, found: &mut Collected) -> Result<(), FormatError> {
        self.collect_part(name, "", found)
    }

    /// Appends the channels of complex numbers, whose two parts are these arrays.
    pub(crate) fn collect_complex(
        [real, imag]: [&Self; 2],
        name: &str,
        found: &mut Collected,
    ) -> Result<(), FormatError> {
        real.collect_part(name, "/real", found)?;
        imag.collect_part(name, "/imag", found)
    }

    /// Appends its channels; `part` is the end of their names.
    fn collect_part(
        &self,
        name: &str,
        part: &str,
        found: &mut Collected,
    ) -> Result<(), FormatError> {
        let too_large = || FormatError::content(name, "the array is larger than the file");
        let lengths: Vec<usize> = self.axes.iter().map(|axis| axis.length).collect();
        let count = items(&lengths).ok_or_else(too_large)?;
        if count == 0 {
            return Ok(());
        }
        let axes: Vec<Axis> = self.axes.iter().copied().filter(|axis| axis.length > 1).collect();
        let longest = axes.iter().map(|axis| axis.length).max();
        let samples = axes.iter().position(|axis| Some(axis.length) == longest);
        let (length, stride) = match samples.and_then(|k| axes.get(k)) {
            Some(axis) => (axis.length, axis.stride),
            None => (1, self.number.kind.size()),
        };
        if count / length > MOST_CHANNELS {
            found.leave_out(name, &MANY_CHANNELS);
            return Ok(());
        }
        if self.reach().is_none_or(|reach| reach > self.bytes.len()) {
            return Err(too_large());
        }
        found.take_bytes(count.saturating_mul(size_of::<f64>()))?;
        let others: Vec<Axis> =
            axes.iter().enumerate().filter(|(k, _)| Some(*k) != samples).map(|(_, a)| *a).collect();
        let places = places(&others);
        let mut values: Vec<Vec<f64>> = places.iter().map(|_| Vec::with_capacity(length)).collect();
        let step = (BLOCK_BYTES / stride.max(1)).max(1);
        for first in (0..length).step_by(step) {
            let rows = step.min(length - first);
            for (out, place) in values.iter_mut().zip(&places) {
                let bytes = self.bytes.get(place.offset + first * stride..).unwrap_or_default();
                self.number.append(out, bytes, stride, rows);
            }
        }
        let named = |place: &Place| format!("{name}{}{part}", place.label);
        found.channels.extend(places.iter().zip(values).map(|(p, v)| Channel::of(named(p), v)));
        Ok(())
    }

    /// Its number, if it has one.
    pub(crate) fn scalar(&self) -> Option<f64> {
        let mut value = Vec::with_capacity(1);
        if self.axes.iter().all(|axis| axis.length == 1) {
            self.number.append(&mut value, &self.bytes, self.number.kind.size(), 1);
        }
        value.pop()
    }

    /// Bytes from the beginning to the end of the last item.
    fn reach(&self) -> Option<usize> {
        let last = |reach: usize, axis: &Axis| {
            reach.checked_add(axis.length.checked_sub(1)?.checked_mul(axis.stride)?)
        };
        self.axes.iter().try_fold(self.number.kind.size(), last)
    }
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
