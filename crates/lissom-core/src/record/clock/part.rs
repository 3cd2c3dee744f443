//! Parts of a log that become runs.

use std::mem::take;
use std::ops::Range;

use super::resample::Resampler;
use crate::finding::Finding;
use crate::record::{Hold, TimeBase};

/// The channels of a log, row by row.
#[derive(Debug, Clone)]
pub struct LogRows {
    /// Time stamps as in the log \[s\]; for a log without stamps, multiples of `sample_time_s`.
    pub stamps_s: Vec<f64>,
    /// The sample time \[s\] of a log without stamps.
    pub sample_time_s: Option<f64>,
    /// Resolution of the stamps: the step of their last decimal \[s\]; 0 if it is unknown.
    pub stamp_step_s: f64,
    /// The command, in its own unit.
    pub command: Vec<f64>,
    /// How the command acts between samples.
    pub hold: Hold,
    /// Motor angle \[rad\] or position \[m\].
    pub motor: Vec<f64>,
    /// Tip channels, each as long as the motor's.
    pub tips: Vec<Vec<f64>>,
}

/// A part of a log with even samples.
#[derive(Debug, Clone, PartialEq)]
pub struct EvenPart {
    /// Start and sample time, and how far the stamps were from even.
    pub time: TimeBase,
    /// The command, in its own unit.
    pub command: Vec<f64>,
    /// Motor angle \[rad\] or position \[m\].
    pub motor: Vec<f64>,
    /// Tip channels, each as long as the motor's.
    pub tips: Vec<Vec<f64>>,
    /// What was done to the log. The first part has the notes of the whole log.
    pub notes: Vec<Finding>,
}

impl EvenPart {
    /// Samples of a range, as a part of its own. The notes go with the first sample.
    #[must_use]
    pub fn piece(&self, range: Range<usize>) -> Self {
        let start_s = self.time.start_s + range.start as f64 * self.time.sample_time_s;
        let notes = if range.start == 0 { self.notes.clone() } else { Vec::new() };
        Self {
            time: TimeBase { start_s, ..self.time },
            command: self.command[range.clone()].to_vec(),
            motor: self.motor[range.clone()].to_vec(),
            tips: self.tips.iter().map(|tip| tip[range.clone()].to_vec()).collect(),
            notes,
        }
    }
}

/// Rows of a log, and how they become samples of one run.
#[derive(Debug, Clone)]
pub(super) struct Part {
    pub(super) rows: Range<usize>,
    pub(super) base: TimeBase,
    pub(super) sampling: Sampling,
}

#[derive(Debug, Clone)]
pub(super) enum Sampling {
    /// The rows are the samples.
    AsLogged,
    /// Rows are lost: positions of the others in samples.
    LostRows(Vec<f64>),
    /// Rows are not on the grid: their times in steps of it.
    Uneven(Vec<f64>),
}

impl Part {
    /// The samples, and how many of them are interpolated.
    pub(super) fn even(&self, log: &LogRows) -> (EvenPart, usize) {
        let cut = |channel: &Vec<f64>| channel[self.rows.clone()].to_vec();
        let (time, notes) = (self.base, Vec::new());
        let (positions, lost) = match &self.sampling {
            Sampling::AsLogged => {
                let tips = log.tips.iter().map(cut).collect();
                let (command, motor) = (cut(&log.command), cut(&log.motor));
                return (EvenPart { time, command, motor, tips, notes }, 0);
            }
            Sampling::LostRows(positions) => (positions, true),
            Sampling::Uneven(positions) => (positions, false),
        };
        let grid = Resampler::new(positions);
        let measured = |channel: &Vec<f64>| grid.measured(&channel[self.rows.clone()]);
        let command = &log.command[self.rows.clone()];
        let command = match (log.hold, lost) {
            (Hold::Measured, _) => grid.measured(command),
            (Hold::Sampled, true) => grid.held_with_lost_rows(command),
            (Hold::Sampled, false) => grid.held(command),
        };
        let (motor, tips) = (measured(&log.motor), log.tips.iter().map(measured).collect());
        (EvenPart { time, command, motor, tips, notes }, grid.interpolated())
    }

    /// The same of the only part of a log, whose channels are moved if they are its samples.
    pub(super) fn only(&self, log: &mut LogRows) -> (EvenPart, usize) {
        if !matches!(self.sampling, Sampling::AsLogged) || self.rows != (0..log.motor.len()) {
            return self.even(log);
        }
        let (command, motor) = (take(&mut log.command), take(&mut log.motor));
        let tips = take(&mut log.tips);
        (EvenPart { time: self.base, command, motor, tips, notes: Vec::new() }, 0)
    }
}
