//! A batch of logs.

use std::sync::atomic::AtomicBool;
use std::time::Instant;

use serde::{Deserialize, Serialize};

use super::worker_process::{Treated, WorkerProcess, WorkerProgram};
use crate::fleet_error::FleetError;
use crate::fleet_log::FleetLog;
use crate::row::{Failure, FleetRow};
use crate::settings::FleetSettings;
use crate::version::VERSION;

/// Logs that are identified one after the other by one worker.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Batch {
    /// Its number.
    pub number: u64,
    /// What is done with each log.
    pub settings: FleetSettings,
    /// The logs.
    pub logs: Vec<FleetLog>,
}

/// The rows of a batch.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BatchRows {
    /// Number of the batch.
    pub number: u64,
    /// A row for each log.
    pub rows: Vec<FleetRow>,
    /// Time that the batch took, with the start of processes \[s\].
    pub seconds: f64,
}

/// Identifies logs one after the other in a process of its own. A log that brings the process to its end, or takes longer
/// than the time limit, is a row like any other; the next log gets a new process.
pub struct LogWorker {
    settings: FleetSettings,
    program: WorkerProgram,
    process: Option<WorkerProcess>,
}

impl LogWorker {
    /// A worker, whose process starts with the first log.
    ///
    /// # Errors
    /// [`FleetError::Version`] if the settings are of another version.
    pub fn new(settings: FleetSettings, program: WorkerProgram) -> Result<Self, FleetError> {
        if settings.version == VERSION {
            Ok(Self { settings, program, process: None })
        } else {
            Err(FleetError::Version { worker: VERSION.to_owned() })
        }
    }

    /// Identifies the logs of a batch. When `stop` is set, gives the rows so far.
    ///
    /// # Errors
    /// As [`LogWorker::row`].
    pub fn rows(&mut self, batch: &Batch, stop: &AtomicBool) -> Result<BatchRows, FleetError> {
        let started = Instant::now();
        let mut rows = Vec::with_capacity(batch.logs.len());
        for log in &batch.logs {
            match self.row(log, stop) {
                Ok(row) => rows.push(row),
                Err(FleetError::Stopped) => break,
                Err(error) => return Err(error),
            }
        }
        Ok(BatchRows { number: batch.number, rows, seconds: started.elapsed().as_secs_f64() })
    }

    /// Identifies a log.
    ///
    /// # Errors
    /// [`FleetError::Version`] if the process is of another version, [`FleetError::Worker`] if it cannot be started,
    /// [`FleetError::Stopped`] if `stop` is set.
    pub fn row(&mut self, log: &FleetLog, stop: &AtomicBool) -> Result<FleetRow, FleetError> {
        let started = Instant::now();
        let failed = |failure: Failure, message: String| {
            FleetRow::failed(log, started.elapsed().as_secs_f64(), failure, message)
        };
        let mut ends = 0;
        loop {
            let mut process = match self.process.take() {
                Some(process) => process,
                None => WorkerProcess::start(&self.program, &self.settings, stop)?,
            };
            match process.treat(log, self.settings.time_limit(), stop)? {
                Treated::Row(row) => {
                    self.process = Some(process);
                    return Ok(*row);
                }
                Treated::TooLong => {
                    let limit_s = self.settings.time_limit_s;
                    let message = format!("not done within the time limit of {limit_s} s");
                    return Ok(failed(Failure::TimeLimit, message));
                }
                Treated::Ended(how) => {
                    ends += 1;
                    if ends > self.settings.retries {
                        let times =
                            if ends == 1 { "once".to_owned() } else { format!("{ends} times") };
                        let message = format!("the process that read it ended, {times} ({how})");
                        return Ok(failed(Failure::ProcessEnded, message));
                    }
                }
            }
        }
    }
}
