//! Results side by side.

use std::path::Path;

use lissom::io::{ComparedFile, ParameterList, ResultFile, write};
use pyo3::prelude::*;

use crate::errors::raised;

/// Compares results, texts of result.json with their names, with the first of them: the text that
/// `lissom compare --json` writes.
#[pyfunction]
pub(crate) fn compare(py: Python<'_>, results: Vec<(String, String)>) -> PyResult<String> {
    let work = || -> Result<String, lissom::Error> {
        let list = |(name, text): &(String, String)| {
            Ok::<_, lissom::Error>((
                name.clone(),
                ParameterList::of(&ResultFile::of_text(name, text)?),
            ))
        };
        let lists = results.iter().map(list).collect::<Result<Vec<_>, _>>()?;
        Ok(write::json_text(Path::new("comparison"), &ComparedFile::of(&lists)?)?)
    };
    py.detach(work).map_err(|error| raised(py, error))
}
