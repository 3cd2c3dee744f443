//! When the samples of a log were taken.
//!
//! Logs come with many clocks: even ones, and stamps that a computer put on late; rows that are lost, repeated, or
//! taken when a loop had time; clocks that start again, and sample times that change. [`even_parts`] makes runs with
//! even samples of them. Steps, in this order:
//!
//! 1. Time goes back: where the motion goes on, the clock is continued; where it does not, the log is cut.
//! 2. Readings that are repeated, since a device was polled faster than it measured, are removed.
//! 3. Long stretches with sample times of their own become runs of their own.
//! 4. Even stamps are used as they are. Single lost rows are filled in by interpolation, and the log is cut at longer
//!    gaps.
//! 5. With uneven stamps, each angle is predicted from its neighbours twice: at the times of the stamps and at even
//!    times. The clock with the smaller errors is used. If it is that of the stamps, all channels are interpolated at
//!    even times.
//!
//! Each step takes a time in proportion to the number of rows.

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

pub use part::{EvenPart, LogRows};

use thiserror::Error;

use part::{Part, Sampling};
use tally::Tally;

use super::{Note, TimeBase};

/// A log as runs with even samples.
#[derive(Debug, Clone, PartialEq)]
pub struct EvenLog {
    /// Its parts that are long enough, in order.
    pub parts: Vec<EvenPart>,
    /// Places at which it was cut.
    pub cuts: usize,
    /// Samples of the longest part, used or not.
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

/// Makes runs with even samples of the rows of a log.
///
/// The first `skip_s` seconds are left out. Where the log is cut, parts of fewer than `least` samples are left out. All
/// channels must have one length.
///
/// # Errors
/// [`ClockError::NotIncreasing`] where time stands still, goes back a little, or rows are out of order;
/// [`ClockError::NothingLeft`] if fewer than two rows are left.
pub fn even_parts(mut log: LogRows, skip_s: f64, least: usize) -> Result<EvenLog, ClockError> {
    let mut tally = Tally::default();
    let restarts = restarts::join(&mut log.stamps_s, &log.motor)
        .map_err(|row| ClockError::NotIncreasing { row })?;
    let mut cuts = restarts.cuts;
    if restarts.joined + cuts.len() > 0 {
        let (joined, cut, at_s) = (restarts.joined, cuts.len(), restarts.at_s);
        tally.restart = Some(Note::ClockRestart { joined, cut, at_s });
    }
    skip(&mut log, &mut cuts, skip_s)?;
    remove_repeated(&mut log, &mut cuts, &mut tally);
    let mut parts = Vec::new();
    if let (Some(sample_time_s), None) = (log.sample_time_s, &tally.repeated) {
        let base = TimeBase::uniform(log.stamps_s[0], sample_time_s);
        parts.push(Part { rows: 0..log.stamps_s.len(), base, sampling: Sampling::AsLogged });
        return Ok(finish(&log, parts, tally, 0));
    }
    let bounds: Vec<usize> = [0].into_iter().chain(cuts).chain([log.stamps_s.len()]).collect();
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
            tally.rates = Some(Note::RateChange { rates: starts.len() - 1, at_s, first_s, last_s });
        }
    }
    Ok(finish(&log, parts, tally, least))
}

/// Samples of the parts that are long enough.
fn finish(log: &LogRows, parts: Vec<Part>, mut tally: Tally, least: usize) -> EvenLog {
    let cuts = parts.len().saturating_sub(1);
    let mut found = EvenLog { parts: Vec::new(), cuts, longest: 0 };
    for part in parts {
        if cuts > 0 && part.rows.len() < least {
            found.longest = found.longest.max(part.rows.len());
            tally.drop(log.stamps_s[part.rows.start], part.rows.len());
            continue;
        }
        let (even, interpolated) = part.even(log);
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

/// Removes the first seconds of a log.
fn skip(log: &mut LogRows, cuts: &mut Vec<usize>, skip_s: f64) -> Result<(), ClockError> {
    let stretch = &log.stamps_s[..cuts.first().copied().unwrap_or(log.stamps_s.len())];
    let start_s = stretch.first().copied().unwrap_or(0.0);
    let first = stretch.partition_point(|stamp| stamp - start_s < skip_s);
    let left = log.stamps_s.len() - first;
    if left < 2 {
        let length_s = log.stamps_s.last().map_or(0.0, |end| end - start_s);
        return Err(ClockError::NothingLeft { left, length_s });
    }
    if first > 0 {
        let channels = [&mut log.stamps_s, &mut log.command, &mut log.motor];
        for channel in channels.into_iter().chain(&mut log.tips) {
            channel.drain(..first);
        }
        for cut in cuts.iter_mut() {
            *cut -= first;
        }
        cuts.retain(|cut| *cut > 0);
    }
    Ok(())
}

/// Removes readings that are repeated.
fn remove_repeated(log: &mut LogRows, cuts: &mut [usize], tally: &mut Tally) {
    let found = repeated_readings::first_readings(&log.command, &log.motor, &log.tips);
    let Some((kept, per_reading)) = found else { return };
    let removed = log.stamps_s.len() - kept.len();
    tally.repeated = Some(Note::RepeatedReadings { per_reading, removed });
    let channels = [&mut log.stamps_s, &mut log.command, &mut log.motor];
    for channel in channels.into_iter().chain(&mut log.tips) {
        *channel = kept.iter().map(|&row| channel[row]).collect();
    }
    for cut in cuts {
        *cut = kept.partition_point(|row| row < cut);
    }
}
