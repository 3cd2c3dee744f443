//! What an identification found, with the logs that it is from: parameters, result.json, the report page and the figures.

use std::path::Path;
use std::sync::Arc;

use lissom::io::{CampaignFile, PayloadFile, ResultFile, write};
use lissom::{EquivalentInput, Found, Payloads, predict_payload};
use lissom_views::known_arm::checked;
use lissom_views::report_page::{self, PageContent};
use lissom_views::{ProgramHints, Reference, own_logs, result_figures};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::campaign::NativeCampaign;
use crate::equivalent::{Solved, solved};
use crate::errors::{input_error, raised};
use crate::reading_results::{Row, rows};
use crate::worker;

/// An identification with its logs: immutable.
#[pyclass(frozen, name = "Found", module = "lissom._lissom")]
pub(crate) struct NativeFound {
    file: Arc<CampaignFile>,
    found: Arc<Found>,
}

#[pymethods]
impl NativeFound {
    /// The parameters, in the order of the tables.
    fn parameters(&self, py: Python<'_>) -> Vec<Row> {
        rows(py.detach(|| self.found.parameters()))
    }

    /// The bytes of the result.json, the same as the command writes.
    fn data<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let text = py.detach(|| write::json_text(Path::new("result"), &self.found.file()));
        let text = text.map_err(|error| raised(py, error))?;
        Ok(PyBytes::new(py, text.as_bytes()))
    }

    /// The report page as HTML, as the command writes it, but without hints about options of the command.
    fn report(&self, py: Python<'_>, title: String) -> PyResult<String> {
        let reference = self.reference(py)?;
        let (file, found) = (Arc::clone(&self.file), Arc::clone(&self.found));
        // The prediction of long logs takes seconds.
        worker::wait(py, move || {
            let (campaign, id) = (&file.campaign, found.identified());
            let described = checked(id, reference.as_ref());
            let result = &ResultFile::of(&campaign.channels, id, described.as_ref());
            let own = own_logs(campaign, id.arm.as_ref());
            let logs = own.as_ref().map(|own| (campaign, own));
            let (reference, hints) = (reference.as_ref(), &ProgramHints::NONE);
            let content = PageContent { result, logs, reference, hints };
            Ok(report_page::page(&title, content).to_html())
        })
    }

    /// Predicts other payloads: the text that `lissom payload --json` writes.
    #[pyo3(signature = (mass_kg, to_kg, at_m=None, tip=None))]
    fn payload(
        &self,
        py: Python<'_>,
        mass_kg: f64,
        to_kg: Vec<f64>,
        at_m: Option<f64>,
        tip: Option<String>,
    ) -> PyResult<String> {
        let asked = Payloads { mass_kg, to_kg, at_m, tip };
        let (channels, id) = (&self.file.campaign.channels, self.found.identified());
        let found = py
            .detach(|| predict_payload(channels, id, &asked))
            .map_err(|error| input_error(py, &error.to_string(), Some(error.hint())))?;
        write::json_text(Path::new("payload"), &PayloadFile::of(&found))
            .map_err(|error| raised(py, error))
    }

    /// The equivalent arm of the responses, with the lowest `modes` modes.
    #[pyo3(signature = (modes=None))]
    fn equivalent(&self, py: Python<'_>, modes: Option<usize>) -> PyResult<Solved> {
        let input = EquivalentInput::of_campaign(&self.file.campaign, self.found.identified())
            .map_err(|error| input_error(py, &error.to_string(), Some(error.hint())))?;
        solved(py, &input, modes)
    }

    /// The campaign.
    fn campaign(&self) -> NativeCampaign {
        NativeCampaign { file: Arc::clone(&self.file) }
    }

    /// The figures, each with its name and its SVG.
    fn figures(&self, py: Python<'_>) -> PyResult<Vec<(String, String)>> {
        let reference = self.reference(py)?;
        let figures = || {
            let all = result_figures(&self.found.file(), reference.as_ref()).into_iter();
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
        Self { file, found: Arc::new(found) }
    }

    /// The arm.toml that the campaign gives for comparison.
    fn reference(&self, py: Python<'_>) -> PyResult<Option<Reference>> {
        Reference::of(&self.file).map_err(|error| raised(py, error))
    }
}
