//! Prediction of another log by a result.

use std::path::Path;
use std::sync::Arc;

use lissom::identify::ValidationOptions;
use lissom::io::result::arm_of_text;
use lissom::io::{ValidationFile, write};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::campaign::NativeCampaign;
use crate::worker;

/// What errors call the text of a result.
const RESULT: &str = "result";

/// Compares a result with a campaign from which it was not identified: the bytes of a validation.json.
#[pyfunction]
#[pyo3(signature = (result, campaign, window_s=None, horizon_s=None))]
pub(crate) fn validate<'py>(
    py: Python<'py>,
    result: &str,
    campaign: &NativeCampaign,
    window_s: Option<f64>,
    horizon_s: Option<f64>,
) -> PyResult<Bound<'py, PyBytes>> {
    let file = Arc::clone(&campaign.file);
    let text = result.to_owned();
    let work = move || -> Result<String, lissom::Error> {
        let found = arm_of_text(RESULT, &text, &file.campaign.channels)?;
        let options = ValidationOptions { window_s, horizon_s };
        let validation = lissom::identify::validate(&found, &file.campaign, &options)?;
        let content = ValidationFile::of(&file.campaign, &found, &validation);
        Ok(write::json_text(Path::new(RESULT), &content)?)
    };
    let text = worker::wait(py, work)?;
    Ok(PyBytes::new(py, text.as_bytes()))
}
