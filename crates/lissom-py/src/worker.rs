//! Long work in a thread of its own, while the calling thread shows progress and hears Ctrl-C.

use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::Duration;

use lissom::identify::Interrupt;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::errors::{internal_error, raised};

/// Time between two looks at signals.
const TICK: Duration = Duration::from_millis(50);

/// What the work gives: the text of a `result.json`.
pub(crate) type Outcome = Result<String, lissom::Error>;

/// Work that was interrupted and ends soon with its best result so far.
#[pyclass(frozen, module = "lissom._lissom")]
pub(crate) struct Pending {
    outcome: Mutex<Receiver<Outcome>>,
}

#[pymethods]
impl Pending {
    /// Waits for the best result so far: the bytes of a result.json. Call it once.
    fn wait<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let outcome =
            py.detach(|| self.outcome.lock().unwrap_or_else(PoisonError::into_inner).recv());
        bytes(py, outcome.map_err(|_| internal_error())?)
    }
}

/// How work ended: with the bytes of a result, or by Ctrl-C or an error of the function that shows progress.
pub(crate) enum Ended<'py> {
    /// With a result.
    Done(Bound<'py, PyBytes>),
    /// By an exception; the best result so far follows.
    Stopped(PyErr, Pending),
}

/// Runs `work` in a thread. `show` is called about every 50 ms.
pub(crate) fn run<'py>(
    py: Python<'py>,
    interrupt: &Interrupt,
    work: impl FnOnce() -> Outcome + Send + 'static,
    show: impl Fn(Python<'py>) -> PyResult<()>,
) -> PyResult<Ended<'py>> {
    let (send, outcome) = mpsc::channel();
    thread::spawn(move || {
        // Nobody waits for a result that is not wanted any more.
        let _ = send.send(work());
    });
    let outcome = Mutex::new(outcome);
    loop {
        let next =
            py.detach(|| outcome.lock().unwrap_or_else(PoisonError::into_inner).recv_timeout(TICK));
        match next {
            Ok(found) => return bytes(py, found).map(Ended::Done),
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

fn bytes(py: Python<'_>, outcome: Outcome) -> PyResult<Bound<'_, PyBytes>> {
    let text = outcome.map_err(|error| raised(py, error))?;
    Ok(PyBytes::new(py, text.as_bytes()))
}
