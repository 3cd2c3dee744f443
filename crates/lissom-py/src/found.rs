//! What an identification found, with the logs that it is from: the report page and the figures.

use std::sync::Arc;

use lissom::Found;
use lissom::io::CampaignFile;
use lissom_views::known_arm::checked;
use lissom_views::{ProgramHints, Reference, report_page, result_figures};
use pyo3::prelude::*;

use crate::errors::{input_error, raised};

/// An identification with its logs: immutable.
#[pyclass(frozen, name = "Found", module = "lissom._lissom")]
pub(crate) struct NativeFound {
    file: Arc<CampaignFile>,
    found: Box<Found>,
}

#[pymethods]
impl NativeFound {
    /// The report page as HTML, as the command writes it, but without hints about options of the command.
    fn report(&self, py: Python<'_>, title: &str) -> PyResult<String> {
        let reference = self.reference(py)?;
        let page = || {
            let (campaign, id) = (&self.file.campaign, self.found.identified());
            let described = checked(id, reference.as_ref());
            let (reference, described) = (reference.as_ref(), described.as_ref());
            report_page::page(title, campaign, id, reference, described, ProgramHints::NONE)
        };
        Ok(py.detach(page))
    }

    /// The figures, each with its name and its SVG.
    fn figures(&self, py: Python<'_>) -> PyResult<Vec<(String, String)>> {
        let reference = self.reference(py)?;
        let figures = || {
            let (channels, id) = (&self.file.campaign.channels, self.found.identified());
            let all = result_figures(channels, id, reference.as_ref()).into_iter();
            all.map(|f| Ok((f.name, f.figure.to_svg().map_err(|error| error.to_string())?)))
                .collect()
        };
        let drawn: Result<Vec<(String, String)>, String> = py.detach(figures);
        drawn.map_err(|error| {
            input_error(py, &format!("the plot could not be drawn: {error}"), None)
        })
    }
}

impl NativeFound {
    pub(crate) fn new(file: Arc<CampaignFile>, found: Found) -> Self {
        Self { file, found: Box::new(found) }
    }

    /// The arm.toml that the campaign gives for comparison.
    fn reference(&self, py: Python<'_>) -> PyResult<Option<Reference>> {
        Reference::of(&self.file).map_err(|error| raised(py, error))
    }
}
