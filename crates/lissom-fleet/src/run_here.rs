//! Identifies a fleet with worker processes of this machine.

use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::Duration;

use crate::fleet_error::FleetError;
use crate::fleet_run::{FleetRun, Progress};
use crate::work::{LogWorker, WorkerProgram};

/// Time between two looks at whether the work is stopped.
const TICK: Duration = Duration::from_millis(50);

/// Identifies a fleet with so many worker processes at a time. `show` is called after every batch, and about every
/// 50 ms. When `stop` is set, the processes are ended, and the
/// rows so far are kept, also those of batches that are not complete.
///
/// # Errors
/// What [`FleetRun`] and [`LogWorker`] report; rows that were written before are kept.
pub fn run_here(
    mut run: FleetRun,
    workers: NonZeroUsize,
    program: &WorkerProgram,
    stop: &AtomicBool,
    mut show: impl FnMut(&Progress),
) -> Result<Progress, FleetError> {
    let workers = workers.get();
    let ended = AtomicBool::new(false);
    let shared = Mutex::new(&mut run);
    let lock = || shared.lock().unwrap_or_else(PoisonError::into_inner);
    let outcome = thread::scope(|scope| {
        let (send, batches) = mpsc::channel();
        for _ in 0..workers {
            let send = send.clone();
            let (lock, ended) = (&lock, &ended);
            scope.spawn(move || {
                let mut worker = match LogWorker::new(lock().settings().clone(), program.clone()) {
                    Ok(worker) => worker,
                    Err(error) => {
                        let _ = send.send(Err(error));
                        return;
                    }
                };
                loop {
                    let batch = lock().next_batch(workers);
                    let Some(batch) = batch else { return };
                    let done = worker.rows(&batch, ended);
                    let is_last = done.is_err() || ended.load(Ordering::Relaxed);
                    if send.send(done).is_err() || is_last {
                        return;
                    }
                }
            });
        }
        drop(send);
        let outcome = loop {
            let taken = match batches.recv_timeout(TICK) {
                Ok(Ok(rows)) => lock().take(&rows),
                Ok(Err(error)) => Err(error),
                Err(RecvTimeoutError::Disconnected) => break Ok(()),
                Err(RecvTimeoutError::Timeout) => lock().show_rows(),
            };
            if taken.is_err() {
                break taken;
            }
            show(&lock().progress());
            if stop.load(Ordering::Relaxed) {
                break Err(FleetError::Stopped);
            }
        };
        // Threads that still work see this, give their rows so far, and end.
        ended.store(true, Ordering::Relaxed);
        let rest = batches.into_iter().flatten().try_for_each(|rows| lock().take(&rows));
        outcome.and(rest)
    });
    let ended = run.end();
    outcome.and(ended)
}
