//! Identification of a campaign.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

use lissom::Identify;
use lissom::identify::{Effort, Interrupt, Stage};
use lissom::io::{CampaignFile, EffortName};
use pyo3::prelude::*;

use crate::campaign::NativeCampaign;
use crate::errors::input_error;
use crate::found::NativeFound;
use crate::search::{self, Ended, Outcome, Pending};
use crate::worker;

/// The stages in progress, with the share of all work before each. The search takes most of the time.
const STAGES: [(Stage, f64); 5] = [
    (Stage::Run(0, 1), 0.0),
    (Stage::Regression, 0.05),
    (Stage::Beam, 0.1),
    (Stage::OutputError, 0.15),
    (Stage::Responses, 0.95),
];
/// Samples of motor and tips that are identified quickly within about 50 ms: a quick identification takes about 1 µs for each.
const SHORT_SAMPLES: usize = 50_000;
/// Index of the search in [`STAGES`].
const SEARCH: usize = 3;

fn index(stage: Stage) -> usize {
    match stage {
        Stage::Run(..) => 0,
        Stage::Regression => 1,
        Stage::Beam => 2,
        Stage::OutputError => SEARCH,
        Stage::Responses => 4,
    }
}

/// A result, or the exception that stopped the work with what ends later.
type Identified = (Option<NativeFound>, Option<(PyErr, Pending)>);

/// Identifies a campaign: what was found, and nothing; or, if it was stopped, the exception and what ends later.
#[pyfunction]
#[pyo3(signature = (campaign, effort, window_s=None, time_limit_s=None, threads=None, progress=None))]
pub(crate) fn identify<'py>(
    py: Python<'py>,
    campaign: &NativeCampaign,
    effort: &str,
    window_s: Option<f64>,
    time_limit_s: Option<f64>,
    threads: Option<usize>,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<Identified> {
    let Some(effort) = EffortName::of(effort).map(EffortName::effort) else {
        let message = format!("effort is \"{effort}\", and not quick, normal or thorough");
        return Err(input_error(py, &message, None));
    };
    let plain = threads.is_none() && time_limit_s.is_none() && progress.is_none();
    if effort == Effort::Quick && plain && is_short(campaign) {
        let (file, none) = (Arc::clone(&campaign.file), AtomicUsize::new(0));
        let interrupt = Interrupt::default();
        let work = || identified(file, effort, window_s, interrupt, &none);
        return Ok((Some(worker::short(py, work)?), None));
    }
    let limit = time_limit_s.and_then(|s| Duration::try_from_secs_f64(s).ok());
    let interrupt = limit.map_or_else(Interrupt::default, Interrupt::after);
    let reached = Arc::new(AtomicUsize::new(0));
    let work = {
        let (file, interrupt, reached) =
            (Arc::clone(&campaign.file), interrupt.clone(), Arc::clone(&reached));
        move || {
            let work = || identified(file, effort, window_s, interrupt, &reached);
            in_threads(threads, work)
        }
    };
    let show = |py: Python<'py>| {
        let Some(progress) = &progress else { return Ok(()) };
        let stage = reached.load(Ordering::Relaxed).min(STAGES.len() - 1);
        let (of, begins) = STAGES[stage];
        let name = of.name();
        let most = effort.most_evaluations().max(1) as f64;
        let done = match stage {
            SEARCH => (interrupt.evaluations() as f64 / most).min(1.0),
            _ => 0.0,
        };
        let ends = STAGES.get(stage + 1).map_or(1.0, |next| next.1);
        progress.call1((name, begins + done * (ends - begins)))?;
        py.check_signals()
    };
    match search::run(py, &interrupt, work, show)? {
        Ended::Done(done) => {
            if let Some(progress) = progress {
                progress.call1(("done", 1.0))?;
            }
            Ok((Some(done), None))
        }
        Ended::Stopped(error, pending) => Ok((None, Some((error, pending)))),
    }
}

/// Whether a quick identification takes less than about 50 ms.
fn is_short(campaign: &NativeCampaign) -> bool {
    let runs = campaign.file.campaign.runs.iter();
    runs.map(|run| run.len() * (1 + run.tips().len())).sum::<usize>() < SHORT_SAMPLES
}

/// What the campaign gives.
fn identified(
    file: Arc<CampaignFile>,
    effort: Effort,
    window_s: Option<f64>,
    interrupt: Interrupt,
    reached: &AtomicUsize,
) -> Outcome {
    let mut identify = Identify::of_file(&file).effort(effort).interrupt(interrupt);
    if let Some(window_s) = window_s {
        identify = identify.window_s(window_s);
    }
    let reach = |stage| reached.store(index(stage), Ordering::Relaxed);
    let mut found = identify.progress(reach).run()?;
    if let Some(arm) = file.described_arm()? {
        found = found.compared_with(&arm);
    }
    Ok(NativeFound::new(file, found))
}

/// Runs work with so many threads; with all of the machine if the number is not given or they cannot be had.
fn in_threads(threads: Option<usize>, work: impl FnOnce() -> Outcome + Send) -> Outcome {
    let pool = threads.and_then(|n| rayon::ThreadPoolBuilder::new().num_threads(n).build().ok());
    match pool {
        Some(pool) => pool.install(work),
        None => work(),
    }
}
