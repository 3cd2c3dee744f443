//! Errors as exceptions of the package: `lissom.InputError` and `lissom.FileError`, each with a hint.

use std::error::Error as _;
use std::io::ErrorKind;

use lissom::Error;
use lissom::io::LogError;
use lissom_fleet::FleetError;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

/// Module with the classes of exceptions.
const CLASSES: &str = "lissom._errors";

/// An exception of the class, with its message and what to do about it.
fn exception(py: Python<'_>, class: &str, message: &str, hint: Option<&str>) -> PyErr {
    let made = || -> PyResult<Bound<'_, PyAny>> {
        py.import(CLASSES)?.getattr(class)?.call1((message, hint.unwrap_or_default()))
    };
    match made() {
        Ok(value) => PyErr::from_value(value),
        Err(error) => error,
    }
}

/// An input that cannot be used.
pub(crate) fn input_error(py: Python<'_>, message: &str, hint: Option<&str>) -> PyErr {
    exception(py, "InputError", message, hint)
}

/// A panic of the library, which is a fault of it.
pub(crate) fn internal_error() -> PyErr {
    PyRuntimeError::new_err("lissom stopped by a fault of its own; please report it with the input")
}

/// The class of an error: one of files if a file cannot be opened, read or written.
fn class_of(error: &Error) -> &'static str {
    let Error::File(file) = error else { return "InputError" };
    let mut causes = std::iter::successors(file.source(), |&cause| cause.source());
    let of_system = causes.find_map(|cause| cause.downcast_ref::<std::io::Error>());
    match of_system {
        Some(cause) if cause.kind() == ErrorKind::NotFound => "MissingFileError",
        Some(_) => "FileError",
        None if matches!(
            file,
            lissom::io::Error::Write(_) | lissom::io::Error::Log(LogError::Open { .. })
        ) =>
        {
            "FileError"
        }
        None => "InputError",
    }
}

/// The exception of a fleet that cannot go on.
pub(crate) fn fleet_raised(py: Python<'_>, error: &FleetError) -> PyErr {
    let class = match error {
        FleetError::Read { .. } | FleetError::Write(_) | FleetError::InUse { .. } => "FileError",
        FleetError::Worker { .. } | FleetError::Stopped => "LissomError",
        _ => "InputError",
    };
    exception(py, class, &error.to_string(), error.hint().as_deref())
}

/// The exception of any error of the library.
pub(crate) fn raised(py: Python<'_>, error: impl Into<Error>) -> PyErr {
    let error = error.into();
    exception(py, class_of(&error), &error.to_string(), error.hint().as_deref())
}
