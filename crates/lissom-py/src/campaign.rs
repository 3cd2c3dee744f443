//! A campaign: its description and the samples of its runs.

use std::path::PathBuf;
use std::sync::Arc;

use lissom::io::{CampaignFile, CampaignReader, MemoryLogs};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::columns::{Column, table};
use crate::worker;

/// A campaign that was read: immutable.
#[pyclass(frozen, name = "Campaign", module = "lissom._lissom")]
pub(crate) struct NativeCampaign {
    pub(crate) file: Arc<CampaignFile>,
}

#[pymethods]
impl NativeCampaign {
    /// Reads a campaign from the text of a campaign.toml. `name` is what errors call it; files are relative to its folder.
    /// `logs` are tables in memory by the names that the text gives as files. `only` is a log to read in place of the runs.
    #[staticmethod]
    #[pyo3(signature = (name, text, logs, only=None))]
    fn of_text(
        py: Python<'_>,
        name: PathBuf,
        text: String,
        logs: Vec<(String, Vec<(String, Column<'_>)>)>,
        only: Option<PathBuf>,
    ) -> PyResult<Self> {
        let mut memory = MemoryLogs::default();
        for (name, columns) in &logs {
            memory.add(name.as_str(), table(columns));
        }
        Self::read(py, CampaignReader::of_text(name, text).with_logs(memory), only)
    }

    /// Reads a campaign.toml and its logs. `only` is a log to read in place of its runs.
    #[staticmethod]
    #[pyo3(signature = (path, only=None))]
    fn of_file(py: Python<'_>, path: PathBuf, only: Option<PathBuf>) -> PyResult<Self> {
        Self::read(py, CampaignReader::of_file(&path), only)
    }

    /// The runs: name, sample time and start [s], and the arrays `time`, `command`, `motor` and one for each tip, in SI.
    fn runs<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyDict>>> {
        let campaign = &self.file.campaign;
        let array = |values: &[f64]| PyArray1::from_slice(py, values);
        let of_run = |run: &lissom::record::Run| {
            let entry = PyDict::new(py);
            entry.set_item("name", run.name())?;
            entry.set_item("sample_time_s", run.sample_time_s())?;
            let start_s = run.time().start_s;
            let time: Vec<f64> =
                (0..run.len()).map(|k| start_s + run.sample_time_s() * k as f64).collect();
            entry.set_item("time", array(&time))?;
            entry.set_item("command", array(run.command()))?;
            entry.set_item("motor", array(run.motor()))?;
            for (tip, samples) in campaign.channels.tips.iter().zip(run.tips()) {
                entry.set_item(format!("tip {}", tip.name), array(samples))?;
            }
            Ok(entry)
        };
        campaign.runs.iter().map(of_run).collect()
    }

    /// Names of the tips.
    fn tips(&self) -> Vec<String> {
        self.file.campaign.channels.tips.iter().map(|tip| tip.name.clone()).collect()
    }
}

impl NativeCampaign {
    fn read(py: Python<'_>, reader: CampaignReader, only: Option<PathBuf>) -> PyResult<Self> {
        let reader = match only {
            Some(log) => reader.only(&log),
            None => reader,
        };
        let file = worker::wait(py, move || Ok(reader.read()?))?;
        Ok(Self { file: Arc::new(file) })
    }
}
