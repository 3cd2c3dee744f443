//! What is in a log.

use std::path::{Path, PathBuf};

use lissom::io::inspect::{Inspection, InspectionFile, TextOptions, inspect_data, inspect_with};
use lissom::io::write;
use pyo3::prelude::*;

use crate::columns::{Column, table};
use crate::errors::raised;
use crate::worker;

/// Describes a log: the text that `lissom inspect --json` writes.
#[pyfunction]
#[pyo3(signature = (path, header_row=None, skip_rows=0))]
pub(crate) fn inspect(
    py: Python<'_>,
    path: PathBuf,
    header_row: Option<usize>,
    skip_rows: usize,
) -> PyResult<String> {
    let options = TextOptions { header_row, skip_rows, ..TextOptions::default() };
    let found = worker::wait(py, move || Ok(inspect_with(&path, &options)?))?;
    text(py, found)
}

/// Describes a table in memory.
#[pyfunction]
pub(crate) fn inspect_columns(
    py: Python<'_>,
    name: &str,
    columns: Vec<(String, Column<'_>)>,
) -> PyResult<String> {
    let (log, name) = (table(&columns), name.to_owned());
    let found = worker::wait(py, move || Ok(inspect_data(&name, log)))?;
    text(py, found)
}

fn text(py: Python<'_>, found: Inspection) -> PyResult<String> {
    let file = InspectionFile::of(&[found]);
    write::json_text(Path::new("inspection"), &file).map_err(|error| raised(py, error))
}
