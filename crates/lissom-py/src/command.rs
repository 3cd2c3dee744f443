//! The command `lissom`.

use std::ffi::OsString;

use pyo3::prelude::*;

/// Runs the command with its arguments, of which the first is the name of the program; gives the exit code. `own` starts
/// the command in a process of its own.
#[pyfunction]
pub(crate) fn command(py: Python<'_>, arguments: Vec<OsString>, own: Vec<OsString>) -> u8 {
    py.detach(|| lissom_cli::run(arguments, &own))
}
