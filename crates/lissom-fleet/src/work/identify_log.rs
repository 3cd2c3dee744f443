//! Identifies one log of a fleet.

use std::fs::File;
use std::panic::{self, AssertUnwindSafe};
use std::path::PathBuf;
use std::time::Instant;

use lissom::io::log::LogPath;
use lissom::io::{CampaignFile, LogError};
use lissom::{Found, Identify};
use lissom_io::EffortName;

use crate::checksum::Checksum;
use crate::fleet_error::FleetError;
use crate::fleet_log::FleetLog;
use crate::row::{Failure, FleetRow, RowOutcome, RowResult};
use crate::settings::{FleetSettings, Refinement};

/// A lag that a quick identification takes for friction: a search decides.
const LAG: &str = "angle-lag";

/// Identifies a log. Every failure, also a defect of the program, is a row.
pub(crate) fn identify_log(settings: &FleetSettings, log: &FleetLog) -> FleetRow {
    let started = Instant::now();
    let seconds = || started.elapsed().as_secs_f64();
    let work = || match files(settings, log).map(|files| sha256(&files)) {
        Err(error) => (None, failed(Failure::Input, error.to_string(), error.hint())),
        // A folder has all files of the runs.
        Ok(Err(error)) if settings.by_folder => (None, not_read(&error.into(), log)),
        Ok(digest) => (digest.ok(), outcome(settings, log, started)),
    };
    match panic::catch_unwind(AssertUnwindSafe(work)) {
        Ok((digest, outcome)) => {
            let mut row = FleetRow::new(log, seconds(), outcome);
            row.input_sha256 = digest;
            row
        }
        Err(cause) => {
            let text = cause.downcast_ref::<String>().map(String::as_str);
            let text = text.or_else(|| cause.downcast_ref::<&str>().copied()).unwrap_or("unknown");
            let message = format!("defect of lissom: {text}; please report it with this log");
            FleetRow::failed(log, seconds(), Failure::Internal, message)
        }
    }
}

fn outcome(settings: &FleetSettings, log: &FleetLog, started: Instant) -> RowOutcome {
    let file = match settings.reader(log.path()).read() {
        Ok(file) => file,
        Err(error) => return not_read(&error, log),
    };
    let first = match identified(settings, &file, settings.effort, started) {
        Ok(found) => found,
        Err(error) => return failed(Failure::Input, error.to_string(), error.hint()),
    };
    let result = RowResult::of(&first, settings.effort, settings.keep_results);
    let refinement = settings
        .refinement
        .as_ref()
        .filter(|more| more.effort > settings.effort && is_asked(more, &result));
    let Some(more) = refinement else { return RowOutcome::Identified(Box::new(result)) };
    match identified(settings, &file, more.effort, started) {
        Ok(found) => {
            let result = RowResult::of(&found, more.effort, settings.keep_results);
            RowOutcome::Identified(Box::new(result))
        }
        Err(error) => failed(Failure::Input, error.to_string(), error.hint()),
    }
}

/// The files of a log.
fn files(settings: &FleetSettings, log: &FleetLog) -> Result<Vec<PathBuf>, FleetError> {
    Ok(match settings.run_files()? {
        Some(files) => files.iter().map(|file| log.path().join(file)).collect(),
        None => vec![LogPath::of(log.path()).file],
    })
}

/// The outcome of a log that cannot be read.
fn not_read(error: &lissom_io::Error, log: &FleetLog) -> RowOutcome {
    let (failure, message) = (kind(error), with_name(error.to_string(), log));
    // Hints for files that are missing are about the runs of a campaign.
    let hint = error.hint().filter(|_| failure != Failure::Missing);
    failed(failure, message, hint)
}

/// Whether a finding asks for more effort.
fn is_asked(more: &Refinement, result: &RowResult) -> bool {
    if more.codes.is_empty() {
        let lag = result.warnings.iter().any(|code| code == LAG);
        return lag || !result.refusals.is_empty();
    }
    let mut codes = result.refusals.iter().chain(&result.warnings).chain(&result.infos);
    codes.any(|code| more.codes.contains(code))
}

fn identified(
    settings: &FleetSettings,
    file: &CampaignFile,
    effort: EffortName,
    started: Instant,
) -> Result<Found, lissom::Error> {
    let left = settings.search_limit().saturating_sub(started.elapsed());
    Ok(Identify::of_file(file).effort(effort.effort()).time_limit(left).run()?)
}

/// A message that names the log, in place of the file that it is read from.
fn with_name(message: String, log: &FleetLog) -> String {
    match &log.file {
        Some(file) => message.replace(&*file.to_string_lossy(), &log.log),
        None => message,
    }
}

fn failed(failure: Failure, message: String, hint: Option<String>) -> RowOutcome {
    let message = match hint {
        Some(hint) => format!("{message}\nhint: {hint}"),
        None => message,
    };
    RowOutcome::Failed { failure, message }
}

fn kind(error: &lissom_io::Error) -> Failure {
    match error {
        lissom_io::Error::Log(LogError::Open { .. }) => Failure::Missing,
        _ => Failure::Input,
    }
}

/// SHA-256 of the bytes of files, one after the other.
fn sha256(files: &[PathBuf]) -> Result<String, LogError> {
    let mut checksum = Checksum::default();
    for path in files {
        let failed = |source| LogError::Open { file: path.display().to_string(), source };
        File::open(path).and_then(|file| checksum.add(file)).map_err(failed)?;
    }
    Ok(checksum.text())
}
