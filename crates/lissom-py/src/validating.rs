//! Prediction of another log by a result.

use std::path::Path;
use std::sync::Arc;

use lissom::identify::{TorquePrediction, Validation, ValidationOptions};
use lissom::io::result::arm_of_text;
use lissom::io::{CampaignFile, UnitNames, ValidationFile, channel_name_unit, write};
use numpy::{PyArray1, PyArrayMethods as _};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::campaign::NativeCampaign;
use crate::worker;

/// What errors call the text of a result.
const RESULT: &str = "result";

/// An array of a series.
type Array<'py> = Bound<'py, PyArray1<f64>>;

/// Name of a run, its time \[s\], measured values and predicted values.
type Series<'py> = (String, Array<'py>, Array<'py>, Array<'py>);

/// A validation with the series that its plots show: immutable.
#[pyclass(frozen, name = "Validation", module = "lissom._lissom")]
pub(crate) struct NativeValidation {
    file: Arc<CampaignFile>,
    validation: Box<Validation>,
    text: String,
}

#[pymethods]
impl NativeValidation {
    /// The bytes of a validation.json.
    fn data<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        PyBytes::new(py, self.text.as_bytes())
    }

    /// Unit of the torque, and for each run its name, time \[s\], logged and predicted torque.
    fn torque<'py>(&self, py: Python<'py>) -> (String, Vec<Series<'py>>) {
        let campaign = &self.file.campaign;
        let unit = UnitNames::new(&campaign.channels).torque_unit().to_owned();
        let array = |values: &[f64]| PyArray1::from_slice(py, values);
        let runs = |torque: &TorquePrediction| {
            let of_run = |run: &lissom::identify::TorqueRun| {
                let name = campaign.runs[run.run].name().to_owned();
                (name, array(&run.time_s), array(&run.logged_nm), array(&run.predicted_nm))
            };
            torque.runs.iter().map(of_run).collect()
        };
        (unit, self.validation.torque.as_ref().map_or_else(Vec::new, runs))
    }

    /// Name and unit of each channel, motor first, and for each run its name, the time \[s\] and the measured and predicted
    /// values. A predicted value is NaN where nothing is predicted.
    fn motion<'py>(&self, py: Python<'py>) -> Vec<(String, String, Vec<Series<'py>>)> {
        let campaign = &self.file.campaign;
        let of_channel = |channel: usize| {
            let (name, unit) = channel_name_unit(&campaign.channels, channel);
            let of_run = |(index, run): (usize, &lissom::record::Run)| {
                let measured = channel.checked_sub(1).map_or(run.motor(), |k| &run.tips()[k]);
                let predicted = PyArray1::from_vec(py, vec![f64::NAN; measured.len()]);
                {
                    let mut predicted = predicted.readwrite();
                    if let Ok(values) = predicted.as_slice_mut() {
                        for s in self.validation.stretches.iter().filter(|s| s.run == index) {
                            let part = &s.channels[channel];
                            values[s.first..s.first + part.len()].copy_from_slice(part);
                        }
                    }
                }
                let time = (0..measured.len()).map(|k| k as f64 * run.sample_time_s()).collect();
                let (time, measured) =
                    (PyArray1::from_vec(py, time), PyArray1::from_slice(py, measured));
                (run.name().to_owned(), time, measured, predicted)
            };
            let runs = campaign.runs.iter().enumerate().map(of_run).collect();
            (name.to_owned(), unit.to_owned(), runs)
        };
        (0..=campaign.channels.tips.len()).map(of_channel).collect()
    }
}

/// Compares a result with a campaign from which it was not identified.
#[pyfunction]
#[pyo3(signature = (result, campaign, window_s=None, horizon_s=None))]
pub(crate) fn validate(
    py: Python<'_>,
    result: &str,
    campaign: &NativeCampaign,
    window_s: Option<f64>,
    horizon_s: Option<f64>,
) -> PyResult<NativeValidation> {
    let file = Arc::clone(&campaign.file);
    let text = result.to_owned();
    let work = move || -> Result<NativeValidation, lissom::Error> {
        let found = arm_of_text(RESULT, &text, &file.campaign.channels)?;
        let options = ValidationOptions { window_s, horizon_s };
        let validation = lissom::identify::validate(&found, &file.campaign, &options)?;
        let content = ValidationFile::of(&file.campaign, &found, &validation);
        let text = write::json_text(Path::new(RESULT), &content)?;
        Ok(NativeValidation { file, validation: Box::new(validation), text })
    };
    worker::wait(py, work)
}
