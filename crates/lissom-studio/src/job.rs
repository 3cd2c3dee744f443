//! The identification that runs: its progress, and a way to end it.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

use lissom::identify::{Interrupt, Stage};
use serde::Serialize;

use crate::problem::Problem;

/// An identification that runs or has ended.
#[derive(Debug)]
pub(crate) struct Job {
    pub(crate) interrupt: Interrupt,
    started: Instant,
    /// Whether it is to end without a result.
    dropped: AtomicBool,
    progress: Mutex<Progress>,
    most_evaluations: u64,
}

#[derive(Debug)]
struct Progress {
    step: &'static str,
    /// Whether the logs are read.
    has_read: bool,
    /// Stages that are done, of all.
    done: usize,
    all: usize,
    searches: bool,
    first: Vec<FirstRow>,
    outcome: Option<Result<u64, Problem>>,
}

/// A parameter of the first result.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub(crate) struct FirstRow {
    pub(crate) name: String,
    pub(crate) value: String,
    pub(crate) unit: String,
}

/// A job as the page has it.
#[derive(Debug, Serialize)]
pub(crate) struct JobView {
    step: &'static str,
    /// Part that is done, from 0 to 1; none if it is not known.
    done: Option<f64>,
    elapsed_s: f64,
    /// At most so much longer, in seconds; none if it is not known.
    at_most_s: Option<f64>,
    /// The result of the methods without a search.
    first: Vec<FirstRow>,
    finished: bool,
    /// The number of the result.
    result: Option<u64>,
    problem: Option<Problem>,
}

impl Job {
    pub(crate) fn new(most_evaluations: u64) -> Self {
        Self {
            interrupt: Interrupt::default(),
            started: Instant::now(),
            dropped: AtomicBool::new(false),
            progress: Mutex::new(Progress {
                step: "reading the logs",
                has_read: false,
                done: 0,
                all: 0,
                searches: false,
                first: Vec::new(),
                outcome: None,
            }),
            most_evaluations,
        }
    }

    fn with(&self, change: impl FnOnce(&mut Progress)) {
        change(&mut self.progress.lock().unwrap_or_else(PoisonError::into_inner));
    }

    /// The step that begins.
    pub(crate) fn step(&self, step: &'static str) {
        self.with(|progress| {
            progress.step = step;
            progress.searches = false;
        });
    }

    /// The parameters without a search, and the number of stages to come.
    pub(crate) fn first(&self, rows: Vec<FirstRow>, stages: usize) {
        self.with(|progress| {
            progress.first = rows;
            progress.all = stages;
        });
    }

    /// The stage that an identification has reached.
    pub(crate) fn stage(&self, stage: Stage) {
        self.with(|progress| {
            progress.done += 1;
            progress.searches = stage == Stage::OutputError;
            progress.step = stage.name();
        });
    }

    /// The logs are read: a result can be made of them.
    pub(crate) fn has_read(&self) {
        self.with(|progress| progress.has_read = true);
    }

    /// Ends the search with the best result so far. Before the logs are read, the job ends without a result.
    pub(crate) fn stop(&self) {
        self.interrupt.ask();
        self.with(|progress| {
            if !progress.has_read {
                self.dropped.store(true, Ordering::Relaxed);
            }
        });
    }

    /// Whether it is to end without a result.
    pub(crate) fn is_dropped(&self) -> bool {
        self.dropped.load(Ordering::Relaxed)
    }

    pub(crate) fn is_finished(&self) -> bool {
        self.progress.lock().unwrap_or_else(PoisonError::into_inner).outcome.is_some()
    }

    /// Ends the job, with the number of its result.
    pub(crate) fn finish(&self, outcome: Result<u64, Problem>) {
        self.with(|progress| progress.outcome = Some(outcome));
    }

    pub(crate) fn view(&self) -> JobView {
        let progress = self.progress.lock().unwrap_or_else(PoisonError::into_inner);
        let elapsed_s = self.started.elapsed().as_secs_f64();
        let evaluations = self.interrupt.evaluations();
        let part = evaluations as f64 / self.most_evaluations.max(1) as f64;
        let searching = progress.searches && evaluations > 0;
        let stages = (progress.all > 0).then(|| progress.done as f64 / progress.all as f64);
        JobView {
            step: progress.step,
            done: if searching { Some(part.min(1.0)) } else { stages.map(|part| part.min(1.0)) },
            elapsed_s,
            at_most_s: searching.then(|| elapsed_s * (1.0 / part - 1.0).max(0.0)),
            first: progress.first.clone(),
            finished: progress.outcome.is_some(),
            result: progress.outcome.as_ref().and_then(|outcome| outcome.as_ref().ok()).copied(),
            problem: progress.outcome.as_ref().and_then(|outcome| outcome.as_ref().err()).cloned(),
        }
    }
}
