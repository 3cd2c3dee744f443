//! The equivalent arm of measured responses.

use std::path::{Path, PathBuf};

use lissom::EquivalentInput;
use lissom::io::{
    EquivalentFile, FrequencyResponses, MeasuredResponse, ResponseError, read_responses, write,
};
use numpy::{Complex64, PyReadonlyArray1};
use pyo3::prelude::*;

use crate::errors::{input_error, raised};

/// The text that `lissom equivalent --json` writes, and the text of an arm.toml, or why there is none with a hint.
pub(crate) type Solved = (String, Option<String>, Option<(String, String)>);

/// Name of the motor's response.
const MOTOR: &str = "motor";

/// The equivalent arm of an input.
pub(crate) fn solved(
    py: Python<'_>,
    input: &EquivalentInput,
    modes: Option<usize>,
) -> PyResult<Solved> {
    let found = py
        .detach(|| lissom::identify::equivalent(&input.data, modes))
        .map_err(|error| input_error(py, &error.to_string(), Some(error.hint())))?;
    let file = EquivalentFile::of(input.names, &found);
    let text = write::json_text(Path::new("equivalent"), &file);
    let text = text.map_err(|error| raised(py, error))?;
    Ok(match input.arm_text(&found) {
        Ok(arm) => (text, Some(arm), None),
        Err(error) => (text, None, Some((error.to_string(), error.hint().to_owned()))),
    })
}

/// The equivalent arm of tables of frequency responses.
#[pyfunction]
#[pyo3(signature = (files, torque_constant=None, modes=None))]
pub(crate) fn equivalent_of_files(
    py: Python<'_>,
    files: Vec<PathBuf>,
    torque_constant: Option<&str>,
    modes: Option<usize>,
) -> PyResult<Solved> {
    let read = py.detach(|| read_responses(&files));
    of_responses(
        py,
        &read.map_err(|error: ResponseError| raised(py, error))?,
        torque_constant,
        modes,
    )
}

/// The equivalent arm of arrays: frequencies \[rad/s\], and responses, each with its name and its standard errors. That with
/// the name `motor` is the motor's.
#[pyfunction]
#[pyo3(signature = (omega_rad_s, responses, torque_constant=None, modes=None))]
pub(crate) fn equivalent_of_arrays(
    py: Python<'_>,
    omega_rad_s: Vec<f64>,
    responses: Vec<(String, PyReadonlyArray1<'_, Complex64>, Option<Vec<f64>>)>,
    torque_constant: Option<&str>,
    modes: Option<usize>,
) -> PyResult<Solved> {
    let measured = |(name, response, std): (String, PyReadonlyArray1<'_, Complex64>, _)| {
        MeasuredResponse { name, response: response.as_array().to_vec(), std, dimension: None }
    };
    let (motor, points): (Vec<_>, Vec<_>) =
        responses.into_iter().map(measured).partition(|response| response.name == MOTOR);
    let motor = motor.into_iter().next();
    of_responses(py, &FrequencyResponses { omega_rad_s, points, motor }, torque_constant, modes)
}

fn of_responses(
    py: Python<'_>,
    responses: &FrequencyResponses,
    torque_constant: Option<&str>,
    modes: Option<usize>,
) -> PyResult<Solved> {
    let input = EquivalentInput::of_responses(responses, torque_constant)
        .map_err(|error| input_error(py, &error.to_string(), Some(error.hint())))?;
    solved(py, &input, modes)
}
