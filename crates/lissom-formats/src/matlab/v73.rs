//! MATLAB files of version 7.3: HDF5 files, with the class of each variable in an attribute.
//!
//! A struct is a group, a struct array a group of references for each field, and a cell array a dataset of references.
//! The axes are in the order of HDF5, which is the reverse of MATLAB's.

use std::collections::BTreeMap;
use std::slice;

use hdf5_pure::{Dataset, Datatype, Group, Object};

use super::attributes::{Attributes, is_object};
use super::left_out::{SPARSE, TOO_DEEP, object as object_class};
use super::value::{Struct, Value, collect};
use crate::array::{Array, axes, items};
use crate::channel_ref::Wanted;
use crate::collected::{Collected, LeftOut};
use crate::format::Format;
use crate::format_error::FormatError;
use crate::guard::guarded;
use crate::hdf5::{dataset, opened};
use crate::log_data::LogData;
use crate::number::Number;
use crate::source::Source;

/// First bytes of a file; HDF5 begins behind them.
pub(crate) const MATLAB_73: &[u8] = b"MATLAB 7.";
/// Deepest nesting of structs and cells.
const MOST_DEPTH: usize = 32;
/// Most values: references may lead to one value on any number of paths.
const MOST_VALUES: usize = 1_000_000;
/// Longest text that is kept: units are short.
const MOST_TEXT: usize = 256;

const CYCLES: LeftOut = LeftOut {
    what: "references that lead back to themselves",
    way_out: "save the variables again in MATLAB",
};
const UNKNOWN: LeftOut = LeftOut {
    what: "values of an unknown type",
    way_out: "in MATLAB: x = double(x); save(\"log.mat\", \"x\")",
};

/// Reads a file.
pub(crate) fn read(source: &Source, wanted: Wanted) -> Result<LogData, FormatError> {
    guarded(Format::Matlab, || {
        let file = opened(source)?;
        let mut found = Collected::of(wanted);
        for (name, variable) in children(&file.root())? {
            // The targets of references, and the content of objects.
            if name.starts_with('#') {
                continue;
            }
            let file_bytes = source.length();
            let mut reader = Reader { file_bytes, taken: 0, values: 0, path: Vec::new() };
            let read = reader.value(&variable, &name, 0, &mut found);
            match read.and_then(|mut value| collect(&name, &mut value, &mut found)) {
                Ok(()) => {}
                Err(error @ FormatError::TooLarge { .. }) => return Err(error),
                Err(error) => found.note(format!("{name} is left out: {error}")),
            }
            found.release_bytes(reader.taken);
        }
        found.finish(Format::Matlab)
    })
}

/// The objects of a group, by name.
fn children(group: &Group) -> Result<BTreeMap<String, Object>, FormatError> {
    let mut found = BTreeMap::new();
    for (name, dataset) in group.iter_datasets().map_err(dataset::damaged)? {
        found.insert(name, Object::Dataset(Box::new(dataset)));
    }
    for (name, group) in group.iter_groups().map_err(dataset::damaged)? {
        found.insert(name, Object::Group(group));
    }
    Ok(found)
}

/// Reads a variable.
struct Reader {
    file_bytes: u64,
    /// Bytes that its values take in memory.
    taken: usize,
    values: usize,
    /// Addresses of the references that lead to the value that is read.
    path: Vec<u64>,
}

impl Reader {
    fn value(
        &mut self,
        object: &Object,
        path: &str,
        depth: usize,
        found: &mut Collected,
    ) -> Result<Value, FormatError> {
        self.values += 1;
        if depth >= MOST_DEPTH || self.values > MOST_VALUES {
            return Ok(Value::LeftOut(&TOO_DEEP));
        }
        let attributes = Attributes::of(object)?;
        let class = attributes.class.as_deref();
        if attributes.is_sparse {
            return Ok(Value::LeftOut(&SPARSE));
        }
        if let Some(class) = class.filter(|class| attributes.is_object || is_object(class)) {
            return Ok(Value::LeftOut(object_class(class)));
        }
        match object {
            Object::Group(group) => self.fields(group, path, depth, found),
            Object::Dataset(_) if attributes.is_empty => Ok(Value::Text(String::new())),
            Object::Dataset(dataset) => self.dataset(dataset, class, path, depth, found),
            _ => Ok(Value::LeftOut(&UNKNOWN)),
        }
    }

    fn dataset(
        &mut self,
        dataset: &Dataset,
        class: Option<&str>,
        path: &str,
        depth: usize,
        found: &mut Collected,
    ) -> Result<Value, FormatError> {
        let datatype = dataset.datatype().map_err(dataset::damaged)?;
        if matches!(datatype, Datatype::Reference { .. }) {
            let path = |k: usize| format!("{path}[{}]", k + 1);
            return Ok(Value::Cells(self.targets(dataset, &path, depth, found)?));
        }
        let mut lengths = dataset::shape(dataset)?;
        lengths.reverse();
        let is_row = matches!(lengths[..], [1, length] if length <= MOST_TEXT);
        if dataset::is_text(&datatype) || (class == Some("char") && !is_row) {
            return Ok(Value::Text(String::new()));
        }
        let first = (depth == 0).then_some(found.channels.len() + 1);
        if let Some(numbers) = dataset::complex(&datatype) {
            return self.complex(dataset, numbers, &lengths, (path, first), found);
        }
        let Some(number) = dataset::number(&datatype) else {
            return Ok(Value::LeftOut(&UNKNOWN));
        };
        if class == Some("char") {
            let bytes = self.bytes(dataset, found)?;
            let units = bytes.as_chunks::<2>().0.iter().map(|unit| u16::from_le_bytes(*unit));
            let units: Vec<u16> = units.collect();
            return Ok(Value::Text(String::from_utf16_lossy(&units).trim().to_owned()));
        }
        let bytes = dataset::byte_count(dataset, self.file_bytes, found)?;
        let Some(axes) = axes(&lengths, number.kind.size(), true) else {
            return Err(dataset::too_large());
        };
        let array = Array { number, offset: 0, axes };
        let mut columns = array.columns(path, "", first, bytes, found)?;
        dataset::read_values(dataset, slice::from_mut(&mut columns))?;
        Ok(Value::Numbers(columns))
    }

    fn bytes(&mut self, of: &Dataset, found: &mut Collected) -> Result<Vec<u8>, FormatError> {
        let bytes = dataset::bytes(of, self.file_bytes, found)?;
        self.taken += bytes.len();
        Ok(bytes)
    }

    /// The values to which the references of a dataset lead, in MATLAB's order; each has a path.
    fn targets(
        &mut self,
        dataset: &Dataset,
        path: &dyn Fn(usize) -> String,
        depth: usize,
        found: &mut Collected,
    ) -> Result<Vec<Value>, FormatError> {
        let bytes = self.bytes(dataset, found)?;
        let addresses = bytes.as_chunks::<8>().0.iter().map(|address| u64::from_le_bytes(*address));
        self.take(items(&dataset::shape(dataset)?), found)?;
        let targets = dataset.dereference().map_err(dataset::damaged)?;
        let mut values = Vec::with_capacity(targets.len());
        for (k, (address, target)) in addresses.zip(&targets).enumerate() {
            if self.path.contains(&address) {
                values.push(Value::LeftOut(&CYCLES));
                continue;
            }
            self.path.push(address);
            values.push(self.value(target, &path(k), depth + 1, found)?);
            self.path.pop();
        }
        Ok(values)
    }

    /// Counts the bytes of handles and values of a number of references.
    fn take(&mut self, count: Option<usize>, found: &mut Collected) -> Result<(), FormatError> {
        /// Of a value, and of the handle of a dataset with its header.
        const BYTES: usize = 2048;
        let bytes = count.and_then(|count| count.checked_mul(BYTES));
        let bytes = bytes.ok_or_else(dataset::too_large)?;
        found.take_bytes(bytes)?;
        self.taken += bytes;
        Ok(())
    }

    /// Complex numbers; the first channel of the value at a path has this number in the file, if it is known.
    fn complex(
        &self,
        of: &Dataset,
        ([real, imag], behind): ([Number; 2], usize),
        lengths: &[usize],
        (path, first): (&str, Option<usize>),
        found: &mut Collected,
    ) -> Result<Value, FormatError> {
        let Some(axes) = axes(lengths, dataset::item_size(of)?, true) else {
            return Err(dataset::too_large());
        };
        let bytes = dataset::byte_count(of, self.file_bytes, found)?;
        let array = Array { number: real, offset: 0, axes: axes.clone() };
        let real = array.columns(path, "/real", first, bytes, found)?;
        let first = first.map(|first| first + real.all.len());
        let array = Array { number: imag, offset: behind, axes };
        let mut parts = [real, array.columns(path, "/imag", first, bytes, found)?];
        dataset::read_values(of, &mut parts)?;
        Ok(Value::Complex(parts))
    }

    /// A struct, or a struct array: of such a one, each field is a dataset of references without a class.
    fn fields(
        &mut self,
        group: &Group,
        path: &str,
        depth: usize,
        found: &mut Collected,
    ) -> Result<Value, FormatError> {
        let children = children(group)?;
        let mut is_array = !children.is_empty();
        let mut elements = 1;
        for child in children.values() {
            is_array &= is_references(child)? && Attributes::of(child)?.class.is_none();
        }
        if is_array {
            let lengths = children.values().filter_map(|child| match child {
                Object::Dataset(dataset) => dataset::shape(dataset).ok(),
                _ => None,
            });
            elements = lengths.filter_map(|lengths| items(&lengths)).min().unwrap_or(0);
        }
        let mut of = Struct { fields: children.keys().cloned().collect(), values: Vec::new() };
        let mut columns = Vec::with_capacity(children.len());
        for (field, child) in &children {
            let path = |k: usize| format!("{}/{field}", Struct::path(path, k, elements));
            let all = of.is_clock(field).then(|| found.want_all());
            let values = match child {
                Object::Dataset(dataset) if is_array => self.targets(dataset, &path, depth, found),
                child => self.value(child, &path(0), depth + 1, found).map(|value| vec![value]),
            };
            if let Some(wanted) = all {
                found.wanted = wanted;
            }
            columns.push(values?);
        }
        let count = columns.iter().map(Vec::len).min().unwrap_or(0);
        let mut columns: Vec<_> = columns.into_iter().map(Vec::into_iter).collect();
        of.values = Vec::with_capacity(count * columns.len());
        for _ in 0..count {
            of.values.extend(columns.iter_mut().filter_map(Iterator::next));
        }
        Ok(Value::Struct(of))
    }
}

fn is_references(object: &Object) -> Result<bool, FormatError> {
    let Object::Dataset(dataset) = object else { return Ok(false) };
    let datatype = dataset.datatype().map_err(dataset::damaged)?;
    Ok(matches!(datatype, Datatype::Reference { .. }))
}
