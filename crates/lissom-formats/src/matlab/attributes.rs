//! Attributes of MATLAB values in HDF5 files.

use hdf5_pure::{AttrValue, Object};

use crate::format_error::FormatError;
use crate::hdf5::dataset;

/// The attributes by which MATLAB describes a value.
pub(super) struct Attributes {
    pub(super) class: Option<String>,
    pub(super) is_empty: bool,
    pub(super) is_sparse: bool,
    pub(super) is_object: bool,
}

impl Attributes {
    pub(super) fn of(object: &Object) -> Result<Self, FormatError> {
        let attributes = match object {
            Object::Group(group) => group.attrs(),
            Object::Dataset(dataset) => dataset.attrs(),
            _ => Ok(std::collections::HashMap::default()),
        };
        let attributes = attributes.map_err(dataset::damaged)?;
        let class = attributes.get("MATLAB_class").and_then(AttrValue::as_str);
        Ok(Self {
            class: class.map(|class| class.trim_end_matches('\0').to_owned()),
            is_empty: attributes.contains_key("MATLAB_empty"),
            is_sparse: attributes.contains_key("MATLAB_sparse"),
            is_object: attributes.contains_key("MATLAB_object_decode"),
        })
    }
}

/// Whether a class has values that are no numbers, texts, structs or cells.
pub(super) fn is_object(class: &str) -> bool {
    const PLAIN: [&str; 16] = [
        "double",
        "single",
        "int8",
        "int16",
        "int32",
        "int64",
        "uint8",
        "uint16",
        "uint32",
        "uint64",
        "logical",
        "char",
        "cell",
        "struct",
        "canonical empty",
        "",
    ];
    !PLAIN.contains(&class)
}
