//! Determines when the samples of a log were taken.
//!
//! Time stamps of logs come from many kinds of clocks: some are even, others were written late by a computer; rows are
//! lost, repeated, or written when a control loop had time; a clock starts again, or the sample time changes.
//! [`even_parts`] converts any log to runs with even samples, in these steps:
//!
//! 1. If time goes back and the motion is continuous, the clock is continued. If the motion jumps, the log is cut.
//! 2. Readings that were logged repeatedly, because a device was polled faster than it measures, are removed.
//! 3. Long stretches with different sample times become separate runs.
//! 4. Even stamps are used as they are. Single lost rows are filled in by interpolation. At longer gaps the log is cut.
//! 5. If stamps are uneven, each angle is predicted from its neighbours twice: at the times of the stamps and at even
//!    times. The clock with the smaller errors is used. If this is the clock of the stamps, all channels are
//!    interpolated at even times.
//!
//! The cost of each step grows in proportion to the number of rows.

mod agreement;
mod interpolation_error;
mod lagrange;
mod part;
mod rates;
mod repeated_readings;
mod resample;
mod restarts;
mod sample_count;
mod stretch;
mod tally;
#[cfg(test)]
mod tests;
pub(crate) mod thresholds;
mod time_grid;
mod trim;

pub use part::{EvenPart, LogRows};
pub use trim::Trim;

use thiserror::Error;

use part::{Part, Sampling};
use tally::Tally;

use super::{TimeBase, note};

/// A log as parts with even samples.
#[derive(Debug, Clone, PartialEq)]
pub struct EvenLog {
    /// Parts that are long enough, in order.
    pub parts: Vec<EvenPart>,
    /// Number of places at which the log was cut.
    pub cuts: usize,
    /// Number of samples of the longest part, including parts that are too short to be used.
    pub longest: usize,
}

/// Error of [`even_parts`].
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum ClockError {
    /// A time stamp does not increase, and it is not a restart of the clock.
    #[error("time does not increase at row {row}")]
    NotIncreasing {
        /// The row, from 0.
        row: usize,
    },
    /// Fewer than two rows remain.
    #[error("only {left} rows remain of a log of {length_s} s")]
    NothingLeft {
        /// Remaining rows.
        left: usize,
        /// Length of the log \[s\].
        length_s: f64,
    },
}

/// Converts the rows of a log to parts with even samples.
///
/// What `trim` says is left out; where that is between other rows, the log is cut. If the log is cut, parts with fewer than
/// `least` samples are left out. All channels must have the same length.
///
/// # Errors
/// [`ClockError::NotIncreasing`] if time stands still, goes back a little, or rows are out of order;
/// [`ClockError::NothingLeft`] if fewer than two rows remain.
pub fn even_parts(mut log: LogRows, trim: &Trim, least: usize) -> Result<EvenLog, ClockError> {
    let mut tally = Tally::default();
    let restarts = restarts::join(&mut log.stamps_s, &log.motor)
        .map_err(|row| ClockError::NotIncreasing { row })?;
    let mut cuts = restarts.cuts;
    if restarts.joined + cuts.len() > 0 {
        let (joined, cut, at_s) = (restarts.joined, cuts.len(), restarts.at_s);
        tally.restart = Some(note::ClockRestart { joined, cut, at_s }.into());
    }
    trim.apply(&mut log, &mut cuts)?;
    remove_repeated(&mut log, &mut cuts, &mut tally);
    let mut parts = Vec::new();
    if let (Some(sample_time_s), None) = (log.sample_time_s, &tally.repeated) {
        // Rows without stamps have no gaps of their own.
        let bounds = bounds(&cuts, log.stamps_s.len());
        parts.extend(bounds.windows(2).map(|bound| {
            let base = TimeBase::uniform(log.stamps_s[bound[0]], sample_time_s);
            Part { rows: bound[0]..bound[1], base, sampling: Sampling::AsLogged }
        }));
        return Ok(finish(log, parts, tally, least));
    }
    let bounds = bounds(&cuts, log.stamps_s.len());
    for bound in bounds.windows(2) {
        let stretch = bound[0]..bound[1];
        let stamps_s = &log.stamps_s[stretch.clone()];
        let changes = rates::changes(stamps_s);
        let mut starts: Vec<usize> = [0].into_iter().chain(changes).collect();
        for start in &mut starts {
            *start += stretch.start;
        }
        starts.push(stretch.end);
        let before = parts.len();
        for rates in starts.windows(2) {
            parts.extend(stretch::parts(&log, rates[0]..rates[1], &mut tally));
        }
        if let ([_, change, .., _], Some(first), Some(last)) =
            (starts.as_slice(), parts.get(before), parts.last())
        {
            let at_s = log.stamps_s[*change];
            let (first_s, last_s) = (first.base.sample_time_s, last.base.sample_time_s);
            tally.rates =
                Some(note::RateChange { rates: starts.len() - 1, at_s, first_s, last_s }.into());
        }
    }
    Ok(finish(log, parts, tally, least))
}

/// Ends of the stretches between cuts.
fn bounds(cuts: &[usize], rows: usize) -> Vec<usize> {
    [0].into_iter().chain(cuts.iter().copied()).chain([rows]).collect()
}

/// Samples of the parts that are long enough.
fn finish(mut log: LogRows, parts: Vec<Part>, mut tally: Tally, least: usize) -> EvenLog {
    let cuts = parts.len().saturating_sub(1);
    let mut found = EvenLog { parts: Vec::new(), cuts, longest: 0 };
    for part in parts {
        if cuts > 0 && part.rows.len() < least {
            found.longest = found.longest.max(part.rows.len());
            tally.drop(log.stamps_s[part.rows.start], part.rows.len());
            continue;
        }
        let (even, interpolated) = if cuts == 0 { part.only(&mut log) } else { part.even(&log) };
        found.longest = found.longest.max(even.motor.len());
        tally.samples += even.motor.len();
        if matches!(part.sampling, Sampling::LostRows(_)) {
            tally.filled += interpolated;
        }
        found.parts.push(even);
    }
    if let Some(first) = found.parts.first_mut() {
        first.notes = tally.notes();
    }
    found
}

/// Removes readings that are repeated.
fn remove_repeated(log: &mut LogRows, cuts: &mut [usize], tally: &mut Tally) {
    let found = repeated_readings::first_readings(&log.command, &log.motor, &log.tips);
    let Some((kept, per_reading)) = found else { return };
    let removed = log.stamps_s.len() - kept.len();
    tally.repeated = Some(note::RepeatedReadings { per_reading, removed }.into());
    let channels = [&mut log.stamps_s, &mut log.command, &mut log.motor];
    for channel in channels.into_iter().chain(&mut log.tips) {
        *channel = kept.iter().map(|&row| channel[row]).collect();
    }
    for cut in cuts {
        *cut = kept.partition_point(|row| row < cut);
    }
}
