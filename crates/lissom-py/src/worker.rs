//! Long work in a thread of its own, while the calling thread shows progress and hears Ctrl-C.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::Duration;

use pyo3::prelude::*;

use crate::errors::{internal_error, raised};

/// Time between two looks at signals.
const TICK: Duration = Duration::from_millis(50);

/// Runs `work` in a thread and waits for it. After Ctrl-C it is left to itself.
pub(crate) fn wait<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce() -> Result<T, lissom::Error> + Send + 'static,
) -> PyResult<T> {
    let outcome = started(work);
    loop {
        match next(py, &outcome) {
            Ok(found) => return found.map_err(|error| raised(py, error)),
            Err(RecvTimeoutError::Disconnected) => return Err(internal_error()),
            Err(RecvTimeoutError::Timeout) => py.check_signals()?,
        }
    }
}

/// Runs work that takes less than about [`TICK`] in the calling thread, which saves changes of threads.
pub(crate) fn short<T: Send>(
    py: Python<'_>,
    work: impl FnOnce() -> Result<T, lissom::Error> + Send,
) -> PyResult<T> {
    let outcome = py.detach(|| catch_unwind(AssertUnwindSafe(work)));
    let found = outcome.map_err(|_| internal_error())?.map_err(|error| raised(py, error))?;
    py.check_signals()?;
    Ok(found)
}

/// Starts work in a thread; gives where its outcome arrives.
pub(crate) fn started<T: Send + 'static>(
    work: impl FnOnce() -> T + Send + 'static,
) -> Mutex<Receiver<T>> {
    let (send, outcome) = mpsc::channel();
    thread::spawn(move || {
        // Nobody waits for a result that is not wanted any more.
        let _ = send.send(work());
    });
    Mutex::new(outcome)
}

/// The outcome, if it arrives before the next look at signals.
pub(crate) fn next<T: Send>(
    py: Python<'_>,
    outcome: &Mutex<Receiver<T>>,
) -> Result<T, RecvTimeoutError> {
    py.detach(|| outcome.lock().unwrap_or_else(PoisonError::into_inner).recv_timeout(TICK))
}
