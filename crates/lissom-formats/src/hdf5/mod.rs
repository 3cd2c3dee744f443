//! HDF5 files.
//!
//! A dataset is a channel with the path of its groups, `run/theta`; of several axes, the longest counts the samples. The
//! fields of a compound type are `run/theta/field`, the parts of complex numbers `run/h/real` and `run/h/imag`. The attribute `unit` or `units` of a dataset is the unit.
//! Soft and external links are not followed.
//!
//! The file is read in pieces. A chunk of a dataset is in memory as a whole.

pub(crate) mod dataset;
mod open;

pub(crate) use open::opened;

use std::collections::HashSet;

use hdf5_pure::{Dataset, Datatype, Group, Layout};

use crate::array::{Array, Axis, axes};
use crate::channel_ref::Wanted;
use crate::collected::{Collected, LeftOut};
use crate::columns::Columns;
use crate::format::Format;
use crate::format_error::FormatError;
use crate::guard::guarded;
use crate::log_data::LogData;
use crate::source::Source;

/// First bytes of a file.
pub(crate) const HDF5: &[u8] = b"\x89HDF\r\n\x1a\n";
/// Deepest nesting of groups: hard links may lead back to an outer group.
const MOST_DEPTH: usize = 32;
/// Most groups that are read: with such links there may be any number of paths.
const MOST_GROUPS: usize = 10_000;

const LINKS: LeftOut = LeftOut {
    what: "further names of datasets that are read under another name",
    way_out: "use the first name",
};
const NO_NUMBERS: LeftOut = LeftOut {
    what: "references, times and opaque data",
    way_out: "in Python: write the numbers to a dataset of their own with h5py",
};
const UNUSUAL: LeftOut = LeftOut {
    what: "numbers of an unusual size",
    way_out: "in Python: write them as float64, f[\"y\"] = f[\"x\"].astype(\"f8\")",
};
const UNREADABLE: LeftOut = LeftOut {
    what: "datasets that are damaged, or stored in a way that is not read",
    way_out: "write the file without libver=\"latest\", without SZIP or external files: h5repack FILE log.h5",
};
const NO_DATA: LeftOut =
    LeftOut { what: "datasets to which nothing was written", way_out: "write the log again" };

/// Reads a file.
pub(crate) fn read(source: &Source, wanted: Wanted) -> Result<LogData, FormatError> {
    guarded(Format::Hdf5, || {
        let file = opened(source)?;
        let mut found = Collected::of(wanted);
        let mut groups = Groups { file_bytes: source.length(), ..Groups::default() };
        groups.collect("", &file.root(), 0, &mut found)?;
        if groups.read > MOST_GROUPS {
            found.note(format!("the file has more than {MOST_GROUPS} groups: not all are read"));
        }
        found.finish(Format::Hdf5)
    })
}

/// What of a file was read.
#[derive(Default)]
struct Groups {
    read: usize,
    file_bytes: u64,
    /// Addresses of the data in the file.
    data: HashSet<u64>,
    has_failed: bool,
}

impl Groups {
    /// Appends the channels of a group.
    fn collect(
        &mut self,
        path: &str,
        group: &Group,
        depth: usize,
        found: &mut Collected,
    ) -> Result<(), FormatError> {
        self.read += 1;
        if self.read > MOST_GROUPS || depth > MOST_DEPTH {
            return Ok(());
        }
        let place = if path.is_empty() { "/" } else { path };
        match group.iter_datasets() {
            Ok(datasets) => {
                for (name, dataset) in by_name(datasets) {
                    let path = joined(path, &name);
                    match self.collect_dataset(&path, &dataset, found) {
                        Ok(()) => {}
                        Err(error @ FormatError::TooLarge { .. }) => return Err(error),
                        Err(error) => self.leave_out(&path, &error, found),
                    }
                }
            }
            Err(error) => self.leave_out(place, &dataset::damaged(error), found),
        }
        match group.iter_groups() {
            Ok(groups) => {
                for (name, group) in by_name(groups) {
                    self.collect(&joined(path, &name), &group, depth + 1, found)?;
                }
            }
            Err(error) => self.leave_out(place, &dataset::damaged(error), found),
        }
        Ok(())
    }

    /// Leaves out what cannot be read; the first reason is noted.
    fn leave_out(&mut self, path: &str, reason: &FormatError, found: &mut Collected) {
        if !self.has_failed {
            found.note(format!("{path} is left out: {reason}"));
        }
        self.has_failed = true;
        found.leave_out(path, &UNREADABLE);
    }

    /// Appends the channels of a dataset.
    fn collect_dataset(
        &mut self,
        path: &str,
        dataset: &Dataset,
        found: &mut Collected,
    ) -> Result<(), FormatError> {
        let datatype = dataset.datatype().map_err(dataset::damaged)?;
        if dataset::is_text(&datatype) {
            return Ok(());
        }
        let lengths = dataset::shape(dataset)?;
        if lengths.contains(&0) {
            return Ok(());
        }
        match self.is_new(dataset)? {
            Some(true) => {}
            Some(false) => {
                found.leave_out(path, &LINKS);
                return Ok(());
            }
            None => {
                found.leave_out(path, &NO_DATA);
                return Ok(());
            }
        }
        let Some(axes) = axes(&lengths, dataset::item_size(dataset)?, false) else {
            return Err(dataset::too_large());
        };
        let bytes = dataset::byte_count(dataset, self.file_bytes, found)?;
        if bytes == 0 {
            return Ok(());
        }
        let mut fields = Fields { bytes, number: found.channels.len() + 1, all: Vec::new() };
        fields.add(path, &datatype, (0, axes), found)?;
        let (paths, mut arrays): (Vec<_>, Vec<_>) = fields.all.into_iter().unzip();
        dataset::read_values(dataset, &mut arrays)?;
        let first = found.channels.len();
        for (path, columns) in paths.iter().zip(arrays) {
            columns.push(path, found);
        }
        let unit = unit(dataset);
        found.channels.iter_mut().skip(first).for_each(|channel| channel.unit.clone_from(&unit));
        Ok(())
    }

    /// Whether the data of a dataset are read for the first time; `None` if it has no data.
    fn is_new(&mut self, dataset: &Dataset) -> Result<Option<bool>, FormatError> {
        let address = match dataset.layout().map_err(dataset::damaged)? {
            Layout::Contiguous { address, .. } => address,
            Layout::Chunked { .. } => {
                dataset.chunks().map_err(dataset::damaged)?.first().map(|chunk| chunk.address)
            }
            _ => return Ok(Some(true)),
        };
        Ok(address.map(|address| self.data.insert(address)))
    }
}

fn by_name<T>(objects: impl Iterator<Item = (String, T)>) -> Vec<(String, T)> {
    let mut objects: Vec<_> = objects.collect();
    objects.sort_by(|(a, _), (b, _)| a.cmp(b));
    objects
}

fn joined(path: &str, name: &str) -> String {
    if path.is_empty() { name.to_owned() } else { format!("{path}/{name}") }
}

/// The unit in the attributes of a dataset.
fn unit(dataset: &Dataset) -> Option<String> {
    let attributes = dataset.attrs().ok()?;
    let unit = ["unit", "units", "Unit", "Units"].iter().find_map(|key| attributes.get(*key))?;
    Some(unit.as_str()?.trim().to_owned()).filter(|unit| !unit.is_empty())
}

/// The arrays of numbers in a dataset.
struct Fields {
    /// Number of bytes of the dataset.
    bytes: usize,
    /// Number in the file of the next channel.
    number: usize,
    /// With their paths.
    all: Vec<(String, Columns)>,
}

impl Fields {
    /// Adds the arrays of numbers of items of a type; the first item begins at an offset.
    fn add(
        &mut self,
        path: &str,
        of: &Datatype,
        (offset, axes): (usize, Vec<Axis>),
        found: &mut Collected,
    ) -> Result<(), FormatError> {
        if let Some(number) = dataset::number(of) {
            return self.push(path, "", &Array { number, offset, axes }, found);
        }
        if let Some(([real, imag], behind)) = dataset::complex(of) {
            let array = Array { number: real, offset, axes: axes.clone() };
            self.push(path, "/real", &array, found)?;
            let array = Array { number: imag, offset: offset.saturating_add(behind), axes };
            return self.push(path, "/imag", &array, found);
        }
        match of {
            Datatype::Array { base_type, dimensions } => {
                let lengths: Vec<usize> =
                    dimensions.iter().map(|length| *length as usize).collect();
                let size = base_type.type_size() as usize;
                let inner = crate::array::axes(&lengths, size, false);
                let inner = inner.ok_or_else(dataset::too_large)?;
                self.add(path, base_type, (offset, [axes, inner].concat()), found)
            }
            Datatype::Compound { members, .. } => {
                for member in members {
                    let behind = usize::try_from(member.byte_offset).unwrap_or(usize::MAX);
                    let place = (offset.saturating_add(behind), axes.clone());
                    self.add(&joined(path, &member.name), &member.datatype, place, found)?;
                }
                Ok(())
            }
            of if dataset::is_text(of) => Ok(()),
            Datatype::FixedPoint { .. } | Datatype::FloatingPoint { .. } => {
                found.leave_out(path, &UNUSUAL);
                Ok(())
            }
            _ => {
                found.leave_out(path, &NO_NUMBERS);
                Ok(())
            }
        }
    }

    fn push(
        &mut self,
        path: &str,
        part: &'static str,
        array: &Array,
        found: &mut Collected,
    ) -> Result<(), FormatError> {
        let columns = array.columns(path, part, Some(self.number), self.bytes, found)?;
        self.number += columns.all.len();
        self.all.push((path.to_owned(), columns));
        Ok(())
    }
}
