//! A `result.json` as a list of parameters and as text.

use lissom::io::{ListedParameter, ParameterList, ResultFile};
use pyo3::prelude::*;

use crate::errors::raised;

/// What errors call the text of a result.
const RESULT: &str = "result";

/// A parameter: key, name, unit, value with standard error and 95 % interval or nothing if it is refused, and the codes of
/// the warnings that affect it.
pub(crate) type Row = (String, String, String, Option<(f64, f64, [f64; 2])>, Vec<String>);

/// The parameters of a result, in the order of the tables.
#[pyfunction]
pub(crate) fn parameters(py: Python<'_>, result: &str) -> PyResult<Vec<Row>> {
    let fail = |error| raised(py, lissom::io::Error::from(error));
    let result = ResultFile::of_text(RESULT, result).map_err(fail)?;
    Ok(rows(ParameterList::of(&result).parameters))
}

/// Parameters as rows.
pub(crate) fn rows(parameters: Vec<ListedParameter>) -> Vec<Row> {
    let row = |p: ListedParameter| {
        let estimate = p.estimate.map(|e| (e.value, e.std, e.ci95));
        (p.key, p.name, p.unit, estimate, p.warnings)
    };
    parameters.into_iter().map(row).collect()
}

/// The result as a table with its findings.
#[pyfunction]
pub(crate) fn result_text(py: Python<'_>, result: &str) -> PyResult<String> {
    let file = ResultFile::of_text(RESULT, result)
        .map_err(|error| raised(py, lissom::io::Error::from(error)))?;
    Ok(lissom::ResultText(&file).to_string())
}
