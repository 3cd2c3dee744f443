//! A run of a fleet: which logs wait, which batches are being worked on, and the folder of the results.

use std::collections::{HashMap, HashSet, VecDeque};
use std::path::Path;
use std::time::{Duration, Instant};

use crate::batch_size::BatchSize;
use crate::existing_rows::ExistingRows;
use crate::fleet_error::FleetError;
use crate::fleet_log::FleetLog;
use crate::row::FleetRow;
use crate::settings::FleetSettings;
use crate::store::FleetFolder;
use crate::work::{Batch, BatchRows};

/// A run of a fleet. It gives batches to whoever works on them, and takes their rows.
///
/// A log has at most one row, however often its batch is done. Batches that are lost are given again by
/// [`FleetRun::give_back`], or by the next run into the same folder.
#[derive(Debug)]
pub struct FleetRun {
    folder: FleetFolder,
    settings: FleetSettings,
    waiting: VecDeque<FleetLog>,
    given: HashMap<u64, Vec<FleetLog>>,
    next_batch: u64,
    size: BatchSize,
    started: Instant,
    progress: Progress,
}

/// How far a run is.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Progress {
    /// Logs that are asked for.
    pub logs: usize,
    /// Logs that had rows before.
    pub before: usize,
    /// Logs that got rows in this run.
    pub done: usize,
    /// Of these, rows without a result.
    pub failed: usize,
    /// Of these, logs that were identified with more effort.
    pub refined: usize,
    /// Time since the run began \[s\].
    pub elapsed_s: f64,
    /// Time of the logs themselves, of all workers together \[s\].
    pub logs_s: f64,
    /// Time of the batches: of the logs, and of starting processes \[s\].
    pub batches_s: f64,
}

impl Progress {
    /// Logs without a row.
    pub fn left(&self) -> usize {
        self.logs.saturating_sub(self.before + self.done)
    }

    /// Time that is left at the speed so far; none before the first rows.
    pub fn left_time(&self) -> Option<Duration> {
        let each = self.elapsed_s / self.done as f64;
        Duration::try_from_secs_f64(each * self.left() as f64).ok()
    }
}

impl FleetRun {
    /// Begins a run that writes into `out`.
    ///
    /// # Errors
    /// [`FleetError::NoLogs`] without logs, [`FleetError::Setting`] if the time limit is not positive,
    /// [`FleetError::FindingCode`] if a refinement asks for a finding that does not exist, [`FleetError::OtherSettings`],
    /// [`FleetError::NotEmpty`] (if rows are refused), [`FleetError::InUse`], [`FleetError::NoManifest`],
    /// [`FleetError::Damaged`] or [`FleetError::Write`] if the folder cannot be used.
    pub fn begin(
        out: &Path,
        settings: FleetSettings,
        logs: Vec<FleetLog>,
        existing: &ExistingRows,
    ) -> Result<Self, FleetError> {
        if logs.is_empty() {
            return Err(FleetError::NoLogs { place: "fleet".to_owned() });
        }
        let limit = settings.time_limit_s;
        if !(limit > 0.0 && limit.is_finite()) {
            return Err(FleetError::Setting { setting: "time limit", value: limit });
        }
        settings.check_codes()?;
        settings.check_campaign(out)?;
        let (folder, done) = FleetFolder::open(out, &settings, existing, &logs)?;
        let mut seen = HashSet::new();
        let logs: Vec<FleetLog> =
            logs.into_iter().filter(|log| seen.insert(log.log.clone())).collect();
        let all = logs.len();
        let waiting: VecDeque<FleetLog> =
            logs.into_iter().filter(|log| !done.contains(&log.log)).collect();
        let progress = Progress { logs: all, before: all - waiting.len(), ..Progress::default() };
        let (given, size, started) = (HashMap::new(), BatchSize::default(), Instant::now());
        Ok(Self { folder, settings, waiting, given, next_batch: 1, size, started, progress })
    }

    /// What is done with every log.
    pub fn settings(&self) -> &FleetSettings {
        &self.settings
    }

    /// The next batch for one of so many workers; none if no log waits.
    pub fn next_batch(&mut self, workers: usize) -> Option<Batch> {
        let size = self.size.next(self.waiting.len(), workers);
        let logs: Vec<FleetLog> = self.waiting.drain(..size).collect();
        if logs.is_empty() {
            return None;
        }
        let number = self.next_batch;
        self.next_batch += 1;
        self.given.insert(number, logs.clone());
        Some(Batch { number, settings: self.settings.clone(), logs })
    }

    /// Takes the rows of a batch. Logs of it without a row can be given back.
    ///
    /// # Errors
    /// [`FleetError::NoBatch`] if these are not rows of a batch that was given and not yet taken,
    /// [`FleetError::Write`] if they cannot be written: their logs then have no rows.
    pub fn take(&mut self, found: &BatchRows) -> Result<(), FleetError> {
        let number = found.number;
        let mut left = self.given.get(&number).cloned().ok_or(FleetError::NoBatch { number })?;
        for row in &found.rows {
            let place = left.iter().position(|log| log.log == row.log);
            left.remove(place.ok_or(FleetError::NoBatch { number })?);
        }
        self.folder.add(&found.rows)?;
        if left.is_empty() {
            self.given.remove(&number);
        } else {
            self.given.insert(number, left);
        }
        let rows = &found.rows;
        self.size.learn(rows.len(), found.seconds);
        let p = &mut self.progress;
        p.done += rows.len();
        p.failed += rows.iter().filter(|row| row.failure().is_some()).count();
        p.refined += rows.iter().filter(|row| self.settings.is_refined(row)).count();
        p.logs_s += rows.iter().map(|row: &FleetRow| row.seconds).sum::<f64>();
        p.batches_s += found.seconds;
        Ok(())
    }

    /// Makes rows visible that were taken half a second ago or earlier. To be called now and then.
    ///
    /// # Errors
    /// [`FleetError::Write`] if the manifest cannot be written.
    pub fn show_rows(&mut self) -> Result<(), FleetError> {
        self.folder.finish_if_due()
    }

    /// Puts the logs of a batch that have no row at the end of those that wait.
    pub fn give_back(&mut self, number: u64) {
        self.waiting.extend(self.given.remove(&number).unwrap_or_default());
    }

    /// How far the run is.
    pub fn progress(&self) -> Progress {
        Progress { elapsed_s: self.started.elapsed().as_secs_f64(), ..self.progress }
    }

    /// Ends the run: all rows that were taken are visible.
    ///
    /// # Errors
    /// [`FleetError::Write`] if the manifest cannot be written.
    pub fn end(mut self) -> Result<Progress, FleetError> {
        self.folder.finish()?;
        Ok(self.progress())
    }
}
