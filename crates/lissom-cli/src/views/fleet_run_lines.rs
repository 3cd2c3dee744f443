//! What a run of a fleet did.

use std::num::NonZeroUsize;

use lissom_fleet::{FleetError, FleetTable, Progress, Values};
use lissom_text::significant;

use super::printer::{line, note};

/// Number of logs of the large fleet whose time is estimated.
const MANY: f64 = 1e6;
/// Smallest number of logs that say what others cost.
const TYPICAL_LEAST: usize = 100;
/// Seconds of an hour.
const HOUR_S: f64 = 3600.0;
/// Digits of times.
const DIGITS: usize = 2;

/// Prints what was done, how long it took, and what the time of a large fleet would be.
pub(crate) fn print(
    table: &FleetTable,
    progress: &Progress,
    workers: NonZeroUsize,
) -> Result<(), FleetError> {
    let p = progress;
    if p.before > 0 {
        line(&format!("{} logs had rows before", p.before));
    }
    let failed = failures(table)?;
    let all: usize = failed.iter().map(|(_, count)| count).sum();
    line(&format!("{} rows: {} identified, {all} failed", table.rows(), table.rows() - all));
    for (failure, count) in &failed {
        line(&format!("  {count} {failure}"));
    }
    if p.done > 0 {
        let each = |seconds: f64| significant(1e3 * seconds / p.done as f64, DIGITS);
        let workers_s = p.elapsed_s * workers.get() as f64;
        line(&format!(
            "{} logs, {} of them with more effort, in {} s with {workers} workers: {} ms of a worker each, of which \
             {} ms for the log itself",
            p.done,
            p.refined,
            significant(p.elapsed_s, DIGITS),
            each(workers_s),
            each(p.logs_s),
        ));
        // Few logs, or none with a result, do not say what many cost.
        if p.done >= TYPICAL_LEAST && p.failed < p.done {
            let hours = MANY * workers_s / p.done as f64 / HOUR_S;
            line(&format!("10⁶ such logs: about {} hours of a worker", significant(hours, DIGITS)));
        }
    }
    Ok(())
}

/// Says that a run was stopped.
pub(crate) fn stopped(table: &FleetTable) {
    note(&format!("stopped with {} rows; the same command goes on", table.rows()));
}

/// Number of rows with each kind of failure.
fn failures(table: &FleetTable) -> Result<Vec<(String, usize)>, FleetError> {
    let mut counts: Vec<(String, usize)> = Vec::new();
    let Some(Values::Text(all)) = table.column("failure")? else { return Ok(counts) };
    for failure in all.into_iter().flatten() {
        match counts.iter_mut().find(|(known, _)| *known == failure) {
            Some((_, count)) => *count += 1,
            None => counts.push((failure, 1)),
        }
    }
    counts.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
    Ok(counts)
}
