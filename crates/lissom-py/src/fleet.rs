//! Fleets: batches of logs for whoever works on them, and the rows.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use lissom_fleet::{
    Batch, BatchRows, ExistingRows, Failure, FleetError, FleetLog, FleetRun, FleetSettings,
    LogPattern, LogWorker, Progress, SummaryOptions, Values, WorkerProgram, folders_with,
    logs_of_paths, open, summarise, time_us,
};
use lissom_views::fleet_page;
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

use crate::errors::{fleet_raised, input_error, internal_error};

/// A batch: its number, the names of its logs, and itself as JSON.
type GivenBatch<'py> = (u64, Vec<String>, Bound<'py, PyBytes>);

/// Names of logs that have a row, and log and message of the first one without a result.
type Taken = (Vec<String>, Option<(String, String)>);

/// Columns by name.
type NamedColumns<'py> = Vec<(String, Bound<'py, PyAny>)>;

/// A run of a fleet. It gives batches, and takes their rows.
#[pyclass(frozen, name = "FleetRun", module = "lissom._lissom")]
pub(crate) struct NativeFleetRun {
    run: Mutex<Option<FleetRun>>,
}

#[pymethods]
impl NativeFleetRun {
    /// Begins a run that writes into a folder. `settings` and `logs` are JSON. Logs with the failures `again` are done again.
    #[new]
    fn new(
        py: Python<'_>,
        out: PathBuf,
        settings: &str,
        logs: &str,
        resume: bool,
        again: Vec<String>,
    ) -> PyResult<Self> {
        let settings: FleetSettings = of_json(py, settings)?;
        let logs: Vec<FleetLog> = of_json(py, logs)?;
        let again: Vec<Failure> = again.iter().filter_map(|name| Failure::of(name)).collect();
        let existing = match (resume, again.is_empty()) {
            (false, _) => ExistingRows::Refuse,
            (true, true) => ExistingRows::Keep,
            (true, false) => ExistingRows::KeepBut(again),
        };
        let run = py.detach(|| FleetRun::begin(&out, settings, logs, &existing));
        let run = run.map_err(|error| fleet_raised(py, &error))?;
        Ok(Self { run: Mutex::new(Some(run)) })
    }

    /// The next batch for one of so many workers: its number, the names of its logs, and itself as JSON; nothing if no log
    /// waits.
    fn next_batch<'py>(
        &self,
        py: Python<'py>,
        workers: usize,
    ) -> PyResult<Option<GivenBatch<'py>>> {
        let Some(batch) =
            self.with(|run| Ok(run.next_batch(workers))).map_err(|e| raised(py, e))?
        else {
            return Ok(None);
        };
        let names = batch.logs.iter().map(|log| log.log.clone()).collect();
        let json = serde_json::to_vec(&batch).map_err(|_| internal_error())?;
        Ok(Some((batch.number, names, PyBytes::new(py, &json))))
    }

    /// Makes rows visible that were taken a while ago.
    fn show_rows(&self, py: Python<'_>) -> PyResult<()> {
        py.detach(|| self.with(FleetRun::show_rows)).map_err(|e| raised(py, e))
    }

    /// Takes the rows of a batch, as JSON; gives the names of the logs that have one, and log and message of the first one
    /// without a result. The other logs of the batch can be given back.
    fn take(&self, py: Python<'_>, rows: &[u8]) -> PyResult<Taken> {
        let rows: BatchRows = serde_json::from_slice(rows)
            .map_err(|e| input_error(py, &format!("rows of a worker: {e}"), None))?;
        py.detach(|| self.with(|run| run.take(&rows))).map_err(|e| raised(py, e))?;
        let failed = rows.rows.iter().find_map(|row| {
            let (_, message) = row.failure()?;
            Some((row.log.clone(), message.to_owned()))
        });
        Ok((rows.rows.into_iter().map(|row| row.log).collect(), failed))
    }

    /// Puts the logs of a batch that was lost back.
    fn give_back(&self, py: Python<'_>, number: u64) -> PyResult<()> {
        let back = |run: &mut FleetRun| {
            run.give_back(number);
            Ok(())
        };
        self.with(back).map_err(|e| raised(py, e))
    }

    /// How far the run is.
    fn progress<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let progress = self.with(|run| Ok(run.progress())).map_err(|e| raised(py, e))?;
        of_progress(py, &progress)
    }

    /// Ends the run: all rows that were taken are visible, and the folder is free for another run.
    fn end<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        let Some(run) = self.lock().take() else { return Ok(None) };
        let progress = run.end().map_err(|error| fleet_raised(py, &error))?;
        of_progress(py, &progress).map(Some)
    }
}

impl NativeFleetRun {
    fn lock(&self) -> MutexGuard<'_, Option<FleetRun>> {
        self.run.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Does something with the run; nothing is possible after its end.
    fn with<T>(
        &self,
        work: impl FnOnce(&mut FleetRun) -> Result<T, FleetError>,
    ) -> Result<T, FleetError> {
        self.lock().as_mut().map_or(Err(FleetError::Stopped), work)
    }
}

fn raised(py: Python<'_>, error: FleetError) -> PyErr {
    fleet_raised(py, &error)
}

fn of_json<'a, T: serde::Deserialize<'a>>(py: Python<'_>, text: &'a str) -> PyResult<T> {
    serde_json::from_str(text).map_err(|e| input_error(py, &format!("settings: {e}"), None))
}

fn of_progress<'py>(py: Python<'py>, p: &Progress) -> PyResult<Bound<'py, PyDict>> {
    let entries = PyDict::new(py);
    for (key, count) in [
        ("logs", p.logs),
        ("before", p.before),
        ("done", p.done),
        ("failed", p.failed),
        ("refined", p.refined),
    ] {
        entries.set_item(key, count)?;
    }
    for (key, seconds) in
        [("elapsed_s", p.elapsed_s), ("logs_s", p.logs_s), ("batches_s", p.batches_s)]
    {
        entries.set_item(key, seconds)?;
    }
    entries.set_item("left_s", p.left_time().map(|left| left.as_secs_f64()))?;
    Ok(entries)
}

/// Identifies the logs of a batch one after the other in a process of its own.
#[pyclass(frozen, module = "lissom._lissom")]
pub(crate) struct FleetWorker {
    worker: Mutex<LogWorker>,
    batch: Batch,
    stop: Arc<AtomicBool>,
}

#[pymethods]
impl FleetWorker {
    /// A worker for a batch, JSON. `program` and its arguments start the process.
    #[new]
    fn new(
        py: Python<'_>,
        batch: &[u8],
        program: PathBuf,
        arguments: Vec<OsString>,
    ) -> PyResult<Self> {
        let batch: Batch = serde_json::from_slice(batch)
            .map_err(|e| input_error(py, &format!("batch: {e}"), None))?;
        let program = WorkerProgram { program, arguments };
        let worker = LogWorker::new(batch.settings.clone(), program);
        let worker = Mutex::new(worker.map_err(|error| fleet_raised(py, &error))?);
        Ok(Self { worker, batch, stop: Arc::new(AtomicBool::new(false)) })
    }

    /// Names of the logs, and the files to read for them.
    fn logs(&self) -> Vec<(String, PathBuf)> {
        self.batch.logs.iter().map(|log| (log.log.clone(), log.path().to_owned())).collect()
    }

    /// The files of a log that is a folder, relative to it; nothing if each log is a file.
    fn run_files(&self, py: Python<'_>) -> PyResult<Option<Vec<String>>> {
        self.batch.settings.run_files().map_err(|error| raised(py, error))
    }

    /// The row of a log, JSON, read from a file or folder; nothing if the worker is stopped.
    fn row<'py>(
        &self,
        py: Python<'py>,
        place: usize,
        file: Option<PathBuf>,
    ) -> PyResult<Option<Bound<'py, PyBytes>>> {
        let mut log = self.batch.logs.get(place).cloned().ok_or_else(internal_error)?;
        log.file = file.or(log.file);
        let row = py.detach(|| {
            self.worker.lock().unwrap_or_else(PoisonError::into_inner).row(&log, &self.stop)
        });
        match row {
            Ok(row) => as_bytes(py, &row).map(Some),
            Err(FleetError::Stopped) => Ok(None),
            Err(error) => Err(fleet_raised(py, &error)),
        }
    }

    /// The row of a log that could not be fetched.
    fn missing<'py>(
        &self,
        py: Python<'py>,
        place: usize,
        message: String,
    ) -> PyResult<Bound<'py, PyBytes>> {
        let log = self.batch.logs.get(place).ok_or_else(internal_error)?;
        as_bytes(py, &lissom_fleet::FleetRow::failed(log, 0.0, Failure::Missing, message))
    }

    /// Ends the process; a thread that waits for a row gets nothing.
    fn stop(&self) {
        self.stop.store(true, Ordering::Relaxed);
    }
}

fn as_bytes<'py>(py: Python<'py>, row: &lissom_fleet::FleetRow) -> PyResult<Bound<'py, PyBytes>> {
    Ok(PyBytes::new(py, &serde_json::to_vec(row).map_err(|_| internal_error())?))
}

/// The files of a log that is a folder, relative to it, by settings, JSON; nothing if each log is a file.
#[pyfunction]
pub(crate) fn fleet_run_files(py: Python<'_>, settings: &str) -> PyResult<Option<Vec<String>>> {
    let settings: FleetSettings = of_json(py, settings)?;
    settings.run_files().map_err(|error| raised(py, error))
}

/// The folders that have files of the campaign's runs, of the addresses of files below `place`.
#[pyfunction]
pub(crate) fn fleet_folders(
    py: Python<'_>,
    place: String,
    files: Vec<PathBuf>,
    run_files: Vec<String>,
) -> PyResult<Vec<String>> {
    let folders = py.detach(|| folders_with(&files, &run_files));
    if folders.is_empty() {
        return Err(raised(py, FleetError::no_folder(place, &run_files)));
    }
    Ok(folders.into_iter().map(|folder| folder.display().to_string()).collect())
}

/// Logs of files and folders, JSON, with what their names say by a pattern; files below folders that do not end like it are
/// left out. With `run_files`, each folder that has some of them is a log.
#[pyfunction]
#[pyo3(signature = (paths, except_, pattern=None, run_files=None))]
pub(crate) fn fleet_logs(
    py: Python<'_>,
    paths: Vec<PathBuf>,
    except_: Vec<PathBuf>,
    pattern: Option<&str>,
    run_files: Option<Vec<String>>,
) -> PyResult<String> {
    let except: Vec<&Path> = except_.iter().map(PathBuf::as_path).collect();
    let list = || {
        let pattern = pattern.map(LogPattern::new).transpose()?;
        logs_of_paths(&paths, pattern.as_ref(), &except, run_files.as_deref())
    };
    let found = py.detach(list).map_err(|error| fleet_raised(py, &error))?;
    serde_json::to_string(&found.logs).map_err(|_| internal_error())
}

/// Logs, JSON, with what their names say by a pattern. `among` leaves out those that do not end like it.
#[pyfunction]
pub(crate) fn fleet_pattern(
    py: Python<'_>,
    logs: &str,
    pattern: &str,
    among: bool,
) -> PyResult<String> {
    let mut logs: Vec<FleetLog> = of_json(py, logs)?;
    let read = || {
        let pattern = LogPattern::new(pattern)?;
        if among {
            logs.retain(|log| pattern.fits(Path::new(&log.log)));
        }
        logs.iter_mut().try_for_each(|log| pattern.read(log))
    };
    py.detach(read).map_err(|error| fleet_raised(py, &error))?;
    serde_json::to_string(&logs).map_err(|_| internal_error())
}

/// A time in microseconds since 1970 UTC; nothing if the text is not one.
#[pyfunction]
pub(crate) fn fleet_time(text: &str) -> Option<i64> {
    time_us(text)
}

/// The manifest of a folder, JSON.
#[pyfunction]
pub(crate) fn fleet_manifest(py: Python<'_>, folder: PathBuf) -> PyResult<String> {
    let table = open(&folder).map_err(|error| fleet_raised(py, &error))?;
    serde_json::to_string(table.manifest()).map_err(|_| internal_error())
}

/// The rows of a folder: each column with its name; missing numbers are NaN, missing times the smallest integer.
#[pyfunction]
#[pyo3(signature = (folder, only=None))]
pub(crate) fn fleet_columns(
    py: Python<'_>,
    folder: PathBuf,
    only: Option<Vec<String>>,
) -> PyResult<NamedColumns<'_>> {
    let read = || {
        let table = open(&folder)?;
        let names = match only {
            Some(names) => names,
            None => table.names()?,
        };
        let column = |name: String| Ok(table.column(&name)?.map(|values| (name, values)));
        names.into_iter().filter_map(|name| column(name).transpose()).collect()
    };
    let columns: Result<Vec<(String, Values)>, FleetError> = py.detach(read);
    let columns = columns.map_err(|error| fleet_raised(py, &error))?;
    columns.into_iter().map(|(name, values)| Ok((name, of_values(py, values)?))).collect()
}

fn of_values(py: Python<'_>, values: Values) -> PyResult<Bound<'_, PyAny>> {
    Ok(match values {
        Values::Text(texts) => texts.into_pyobject(py)?.into_any(),
        Values::Number(numbers) => {
            PyArray1::from_iter(py, numbers.into_iter().map(|n| n.unwrap_or(f64::NAN))).into_any()
        }
        Values::Time(times) => {
            PyArray1::from_iter(py, times.into_iter().map(|t| t.unwrap_or(i64::MIN))).into_any()
        }
    })
}

/// The summary of a folder, JSON.
#[pyfunction]
pub(crate) fn fleet_summary(py: Python<'_>, folder: PathBuf, false_share: f64) -> PyResult<String> {
    let options = SummaryOptions { false_share };
    let summary = py.detach(|| summarise(&open(&folder)?, options));
    serde_json::to_string(&summary.map_err(|e| fleet_raised(py, &e))?).map_err(|_| internal_error())
}

/// The page of a summary, JSON, as HTML.
#[pyfunction]
pub(crate) fn fleet_page_of(py: Python<'_>, title: &str, summary: &str) -> PyResult<String> {
    let summary = of_json(py, summary)?;
    Ok(fleet_page::page(title, &summary))
}
