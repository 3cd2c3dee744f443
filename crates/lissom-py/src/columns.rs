//! Columns of a table: numpy arrays of numbers, lists of words.

use lissom_formats::LogData;
use numpy::PyReadonlyArray1;
use pyo3::prelude::*;

/// A column of a table.
#[derive(FromPyObject)]
pub(crate) enum Column<'py> {
    /// Numbers, NaN where one is missing.
    Numbers(PyReadonlyArray1<'py, f64>),
    /// Words; a blank is a missing one.
    Words(Vec<String>),
}

/// A table of a log. Arrays are copied once.
pub(crate) fn table(columns: &[(String, Column<'_>)]) -> LogData {
    let mut log = LogData::of_columns(std::iter::empty::<(String, Vec<f64>)>());
    for (name, column) in columns {
        log = match column {
            Column::Numbers(array) => {
                let values =
                    array.as_slice().map_or_else(|_| array.as_array().to_vec(), <[f64]>::to_vec);
                log.with_column(name.as_str(), values)
            }
            Column::Words(words) => log.with_words(name.as_str(), words.iter().map(String::as_str)),
        };
    }
    log
}
