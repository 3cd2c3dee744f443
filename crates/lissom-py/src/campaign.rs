//! A campaign: its description and the samples of its runs.

use std::path::PathBuf;
use std::sync::Arc;

use lissom::io::{CampaignFile, CampaignReader, MemoryLogs};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::columns::{Column, table};
use crate::worker;

/// A table in memory: its name, and its columns by name.
type Table<'py> = (String, Vec<(String, Column<'py>)>);

/// A campaign that was read: immutable.
#[pyclass(frozen, name = "Campaign", module = "lissom._lissom")]
pub(crate) struct NativeCampaign {
    pub(crate) file: Arc<CampaignFile>,
}

#[pymethods]
impl NativeCampaign {
    /// Reads a campaign from the text of a campaign.toml. `name` is what errors call it; files are relative to its folder.
    /// `logs` are tables in memory by the names that the text gives as files. `short` says that this
    /// takes a few milliseconds: all logs are in memory, and not long.
    #[staticmethod]
    #[pyo3(signature = (name, text, logs, short=false))]
    fn of_text(
        py: Python<'_>,
        name: PathBuf,
        text: String,
        logs: Vec<Table<'_>>,
        short: bool,
    ) -> PyResult<Self> {
        Self::read(py, CampaignReader::of_text(name, text), &logs, &[], short)
    }

    /// Reads a campaign.toml and its logs. `only` are logs to read in place of its runs, of which `logs` are in memory.
    #[staticmethod]
    #[pyo3(signature = (path, logs=Vec::new(), only=Vec::new()))]
    fn of_file(
        py: Python<'_>,
        path: PathBuf,
        logs: Vec<Table<'_>>,
        only: Vec<PathBuf>,
    ) -> PyResult<Self> {
        Self::read(py, CampaignReader::of_file(&path), &logs, &only, false)
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
    fn read(
        py: Python<'_>,
        reader: CampaignReader,
        logs: &[Table<'_>],
        only: &[PathBuf],
        short: bool,
    ) -> PyResult<Self> {
        let mut memory = MemoryLogs::default();
        for (name, columns) in logs {
            memory.add(name.as_str(), table(columns));
        }
        let reader = only.iter().fold(reader.with_logs(memory), |reader, log| reader.only(log));
        let work = move || Ok(reader.read()?);
        let file = if short { worker::short(py, work)? } else { worker::wait(py, work)? };
        Ok(Self { file: Arc::new(file) })
    }
}
