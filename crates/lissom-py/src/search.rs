//! A search that shows progress, and goes on for its best result so far when it is interrupted.

use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::sync::{Mutex, PoisonError};

use lissom::identify::Interrupt;
use pyo3::prelude::*;

use crate::errors::{internal_error, raised};
use crate::found::NativeFound;
use crate::worker::{next, started};

/// What the work gives.
pub(crate) type Outcome = Result<NativeFound, lissom::Error>;

/// Work that was interrupted and ends soon with its best result so far.
#[pyclass(frozen, module = "lissom._lissom")]
pub(crate) struct Pending {
    outcome: Mutex<Receiver<Outcome>>,
}

#[pymethods]
impl Pending {
    /// Waits for the best result so far. Call it once.
    fn wait(&self, py: Python<'_>) -> PyResult<NativeFound> {
        let outcome =
            py.detach(|| self.outcome.lock().unwrap_or_else(PoisonError::into_inner).recv());
        outcome.map_err(|_| internal_error())?.map_err(|error| raised(py, error))
    }
}

/// How work ended: with a result, or by Ctrl-C or an error of the function that shows progress.
pub(crate) enum Ended {
    /// With a result.
    Done(NativeFound),
    /// By an exception; the best result so far follows.
    Stopped(PyErr, Pending),
}

/// Runs `work` in a thread. `show` is called about every 50 ms.
pub(crate) fn run<'py>(
    py: Python<'py>,
    interrupt: &Interrupt,
    work: impl FnOnce() -> Outcome + Send + 'static,
    show: impl Fn(Python<'py>) -> PyResult<()>,
) -> PyResult<Ended> {
    let outcome = started(work);
    loop {
        match next(py, &outcome) {
            Ok(found) => return found.map(Ended::Done).map_err(|error| raised(py, error)),
            Err(RecvTimeoutError::Disconnected) => return Err(internal_error()),
            Err(RecvTimeoutError::Timeout) => {
                if let Err(error) = py.check_signals().and_then(|()| show(py)) {
                    interrupt.ask();
                    return Ok(Ended::Stopped(error, Pending { outcome }));
                }
            }
        }
    }
}
