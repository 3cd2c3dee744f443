//! Campaigns on a virtual rig.

use std::path::{Path, PathBuf};

use lissom::io::{ArmFile, ConfigError, PlanFile};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rayon::prelude::*;

use crate::errors::{input_error, raised};
use crate::worker;

/// A file, or its text.
pub(crate) fn text(
    py: Python<'_>,
    path: Option<PathBuf>,
    text: Option<String>,
    name: &str,
) -> PyResult<(PathBuf, String)> {
    match (path, text) {
        (Some(path), _) => {
            let read = lissom::io::read_text(&path);
            let read = read.map_err(|source| raised(py, ConfigError::unread(&path, source)))?;
            Ok((path, read))
        }
        (None, Some(text)) => Ok((PathBuf::from(name), text)),
        (None, None) => Err(input_error(py, &format!("no {name}"), None)),
    }
}

/// Simulates the experiments of a plan: the columns of each log, as `lissom rig` writes them. Arm and plan are files or
/// texts of such files.
#[pyfunction]
#[pyo3(signature = (seed, arm_path=None, arm_text=None, plan_path=None, plan_text=None))]
pub(crate) fn simulate(
    py: Python<'_>,
    seed: u64,
    arm_path: Option<PathBuf>,
    arm_text: Option<String>,
    plan_path: Option<PathBuf>,
    plan_text: Option<String>,
) -> PyResult<Vec<(String, Bound<'_, PyDict>)>> {
    let (arm_path, arm) = text(py, arm_path, arm_text, "arm")?;
    let (plan_path, plan) = text(py, plan_path, plan_text, "plan")?;
    let logs = worker::wait(py, move || logs(&arm_path, &arm, &plan_path, &plan, seed))?;
    let columns = |(name, run): (String, lissom::record::Run)| {
        let columns = PyDict::new(py);
        let time: Vec<f64> = (0..run.len()).map(|k| k as f64 * run.sample_time_s()).collect();
        columns.set_item("t", PyArray1::from_vec(py, time))?;
        columns.set_item("i", PyArray1::from_slice(py, run.command()))?;
        columns.set_item("theta_m", PyArray1::from_slice(py, run.motor()))?;
        for (mass, tip) in run.tips().iter().enumerate() {
            columns.set_item(format!("theta_{}", mass + 1), PyArray1::from_slice(py, tip))?;
        }
        Ok((name, columns))
    };
    logs.into_iter().map(columns).collect()
}

fn logs(
    arm_path: &Path,
    arm: &str,
    plan_path: &Path,
    plan: &str,
    seed: u64,
) -> Result<Vec<(String, lissom::record::Run)>, lissom::Error> {
    let rig = ArmFile::from_text(arm_path, arm)?.rig(arm_path)?;
    let plan = PlanFile::from_text(plan_path, plan)?;
    let one = |run: &lissom::io::PlanRun| {
        let logged = rig.run(&run.name, &run.experiment, run.seed.wrapping_add(seed))?;
        Ok((run.name.clone(), logged.run))
    };
    plan.runs.par_iter().map(one).collect()
}
