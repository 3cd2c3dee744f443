//! Work on logs: in a process of its own, which a log may bring to its end.
//!
//! A worker process ([`serve`]) gets the settings, then log after log, as lines of JSON, and answers each with a row. The
//! process that started it ([`LogWorker`]) waits for the row until the time limit.

mod batch;
mod identify_log;
mod message;
mod serve;
mod worker_process;

pub use batch::{Batch, BatchRows, LogWorker};
pub use serve::serve;
pub use worker_process::WorkerProgram;
