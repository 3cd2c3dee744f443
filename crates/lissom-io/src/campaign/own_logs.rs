//! Signals that are in a log of their own, with a clock of its own.

use std::path::{Path, PathBuf};

use lissom_core::finding::Finding;
use lissom_core::record::other_clock::{
    Follows, OtherClock, OtherClockError, StampedSignal, other_clock,
};
use lissom_core::record::{Axis, Hold, TipQuantity, note};

use super::campaign_signals::{OwnLog, Signals, TipSource};
use super::conversions::{camera_angle, channel_in_range, in_si, stamps_s};
use super::memory_logs::LogPlaces;
use super::run_spec::RunSpec;
use super::whole_turns;
use crate::io_error::Error;
use crate::log::{self, ColumnRef, LogColumn, LogError, LogOptions, Series};

/// A gap of more steps than this is not interpolated.
const GAP_STEPS: f64 = 4.5;

/// The log of a run, while signals of other logs are added to it.
pub(super) struct RunLog<'a> {
    pub(super) places: LogPlaces<'a>,
    pub(super) spec: &'a RunSpec,
    pub(super) signals: &'a Signals,
    pub(super) options: &'a LogOptions,
    /// The log, for messages.
    pub(super) file: &'a str,
}

/// Signals of a run in SI; those of other logs are empty at first.
pub(super) struct RunSignals {
    pub(super) stamps_s: Vec<f64>,
    pub(super) command: Vec<f64>,
    pub(super) motor: Vec<f64>,
    pub(super) tips: Vec<Vec<f64>>,
    pub(super) notes: Vec<Finding>,
}

/// A signal of another log.
struct Own {
    /// The log, for messages.
    file: String,
    stamps_s: Vec<f64>,
    values: Vec<f64>,
}

/// The logs of a run as the campaign names them: its own, and those of signals that have one.
pub(super) fn logs_of_run(signals: &Signals, spec: &RunSpec) -> Vec<PathBuf> {
    let motor = signals.motor_log.iter().map(|own| own.of_run(spec, spec.motor_file.as_deref()));
    let mut files = spec.tip_files.iter();
    let tips = signals.tip_logs.iter().flatten();
    let tips = tips.map(|own| own.of_run(spec, files.next().map(PathBuf::as_path)));
    [spec.file.clone()].into_iter().chain(motor).chain(tips).collect()
}

impl OwnLog {
    /// The log for a run, which may name it itself.
    fn of_run(&self, spec: &RunSpec, named: Option<&Path>) -> PathBuf {
        let general = || PathBuf::from(log::of_run(&self.file, &spec.file));
        named.map_or_else(general, Path::to_owned)
    }
}

impl RunLog<'_> {
    /// Adds the signals of other logs, at the stamps of the run's log; rows outside of one of the logs are left out.
    pub(super) fn join(&self, of: &mut RunSignals) -> Result<(), Error> {
        let signals = self.signals;
        if let Some(own) = &signals.motor_log {
            let columns = [&signals.motor.column];
            let other = self.read(own, self.spec.motor_file.as_deref(), &columns)?;
            let mut values =
                in_si(other.columns.into_iter().next().unwrap_or_default(), &signals.motor);
            if signals.axis == Axis::Rotary {
                whole_turns::remove_turns(&mut values);
            }
            channel_in_range("motor", &values, &other.file)?;
            let motor = Own { file: other.file, stamps_s: other.stamps_s, values };
            let clock = self.clock_of_run(of, own, &motor)?;
            let at = |stamp_s: f64| clock.map_or(stamp_s, |c| c.reference_s(stamp_s));
            of.motor = motor.at_stamps(of, at);
            // The clock of the motor's log, as seen from that of the run.
            let note = clock.map(|c| OtherClock {
                offset_s: -c.offset_s,
                drift: -c.drift,
                middle_s: c.middle_s + c.offset_s,
                ..c
            });
            of.note("motor", note);
        }
        let mut files = self.spec.tip_files.iter();
        for (k, (tip, source)) in signals.tips.iter().enumerate() {
            let Some(own) = &signals.tip_logs[k] else { continue };
            let columns: Vec<&ColumnRef> = match source {
                TipSource::Column(reading) => vec![&reading.column],
                TipSource::Camera { x, y, .. } => vec![x, y],
            };
            let other = self.read(own, files.next().map(PathBuf::as_path), &columns)?;
            let mut columns = other.columns.into_iter();
            let first = columns.next().unwrap_or_default();
            let mut values = match source {
                TipSource::Column(reading) => in_si(first, reading),
                TipSource::Camera { origin, scale, .. } => {
                    camera_angle(&first, &columns.next().unwrap_or_default(), *origin, *scale)
                }
            };
            let angle = tip.quantity == TipQuantity::Angle;
            if angle && tip.calibrated && signals.axis == Axis::Rotary {
                whole_turns::remove_turns(&mut values);
            }
            let follows =
                if angle && tip.calibrated { Follows::Angle } else { Follows::Acceleration };
            channel_in_range(&tip.name, &values, &other.file)?;
            let tip_signal = Own { file: other.file, stamps_s: other.stamps_s, values };
            let clock = self.clock_of_tip(of, own, &tip_signal, &tip.name, follows)?;
            of.tips[k] = tip_signal.at_stamps(of, |t| clock.map_or(t, |c| c.other_s(t)));
            of.note(&tip.name, clock);
        }
        of.leave_out(self.file)
    }

    /// The clock of the run's log, with the motor's log as the reference.
    fn clock_of_run(
        &self,
        of: &RunSignals,
        own: &OwnLog,
        motor: &Own,
    ) -> Result<Option<OtherClock>, Error> {
        if own.shared_clock {
            return Ok(None);
        }
        let command =
            StampedSignal { stamps_s: self.increasing(&of.stamps_s)?, values: &of.command };
        let found = other_clock(motor.stamped(), command, Follows::Torque);
        found.map(Some).map_err(|error| self.no_clock(error, motor, "motor"))
    }

    /// The clock of a tip's log, with that of the run as the reference.
    fn clock_of_tip(
        &self,
        of: &RunSignals,
        own: &OwnLog,
        tip: &Own,
        name: &str,
        follows: Follows,
    ) -> Result<Option<OtherClock>, Error> {
        if own.shared_clock {
            return Ok(None);
        }
        let kept: Vec<usize> = (0..of.motor.len()).filter(|k| of.motor[*k].is_finite()).collect();
        let stamps_s: Vec<f64> = kept.iter().map(|k| of.stamps_s[*k]).collect();
        let values: Vec<f64> = kept.iter().map(|k| of.motor[*k]).collect();
        let motor = StampedSignal { stamps_s: self.increasing(&stamps_s)?, values: &values };
        let found = other_clock(motor, tip.stamped(), follows);
        found.map(Some).map_err(|error| self.no_clock(error, tip, name))
    }

    fn increasing<'s>(&self, stamps_s: &'s [f64]) -> Result<&'s [f64], Error> {
        if stamps_s.windows(2).all(|pair| pair[1] > pair[0]) {
            return Ok(stamps_s);
        }
        Err(LogError::RestartWithOtherLog { file: self.file.to_owned() }.into())
    }

    fn no_clock(&self, error: OtherClockError, other: &Own, channel: &str) -> Error {
        let (file, channel) = (self.file.to_owned(), channel.to_owned());
        let explained = match error {
            OtherClockError::NoSharedMotion { explained } => explained,
            OtherClockError::FewSamples { found, least } => {
                let is_other = other.stamps_s.len() == found;
                let file = if is_other { other.file.clone() } else { file };
                return LogError::FewSamples { file, found, least }.into();
            }
            _ => 0.0,
        };
        LogError::NoSharedMotion { file, other: other.file.clone(), channel, explained }.into()
    }

    /// Reads a signal of another log.
    fn read(
        &self,
        own: &OwnLog,
        of_run: Option<&Path>,
        columns: &[&ColumnRef],
    ) -> Result<OwnColumns, Error> {
        let relative = own.of_run(self.spec, of_run);
        let path = self.places.path(&relative);
        let in_memory = self.places.in_memory(&relative);
        let file = in_memory
            .as_ref()
            .map_or_else(|| path.display().to_string(), |part| part.label.clone());
        let columns: Vec<LogColumn> = columns
            .iter()
            .map(|column| LogColumn { column: (*column).clone(), hold: Hold::Measured })
            .collect();
        let source = own.time.as_ref().unwrap_or(&self.signals.time);
        let mut log = match &in_memory {
            Some(part) => log::read_part(part, source.column(), &columns, self.options)?,
            None => log::read_log(&path, source.column(), &columns, self.options)?,
        };
        let stamps_s = stamps_s(source, &mut log);
        channel_in_range("time", &stamps_s, &file)?;
        if let Some(back) = log.time_back.first() {
            return Err(LogError::time_back(&file, "time", back).into());
        }
        Ok(OwnColumns { file, stamps_s, columns: log.columns })
    }
}

/// Columns of another log.
struct OwnColumns {
    file: String,
    stamps_s: Vec<f64>,
    columns: Vec<Vec<f64>>,
}

impl Own {
    fn stamped(&self) -> StampedSignal<'_> {
        StampedSignal { stamps_s: &self.stamps_s, values: &self.values }
    }

    /// The values at the stamps of the run, of which `at` gives the stamps of this log; NaN outside of it and in its gaps.
    fn at_stamps(&self, of: &RunSignals, at: impl Fn(f64) -> f64) -> Vec<f64> {
        let mut steps: Vec<f64> = self.stamps_s.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let middle = steps.len() / 2;
        if steps.len() < 3 {
            return vec![f64::NAN; of.stamps_s.len()];
        }
        let median_s = *steps.select_nth_unstable_by(middle, f64::total_cmp).1;
        let series = Series::of(&self.stamps_s, &self.values, Hold::Measured);
        let value = |stamp_s: &f64| {
            let here_s = at(*stamp_s);
            let next = self.stamps_s.partition_point(|t| *t <= here_s);
            let bounds = next.checked_sub(1).map(|k| self.stamps_s[k]).zip(self.stamps_s.get(next));
            match bounds {
                Some((before_s, after_s)) if after_s - before_s <= GAP_STEPS * median_s => {
                    series.at(here_s)
                }
                _ => f64::NAN,
            }
        };
        of.stamps_s.iter().map(value).collect()
    }
}

impl RunSignals {
    fn note(&mut self, channel: &str, clock: Option<OtherClock>) {
        let channel = channel.to_owned();
        self.notes.extend(clock.map(|clock| note::OtherClock { channel, clock }.into()));
    }

    /// Leaves out the rows in which a signal of another log is missing.
    fn leave_out(&mut self, file: &str) -> Result<(), Error> {
        let complete = |k: &usize| {
            self.motor[*k].is_finite() && self.tips.iter().all(|tip| tip[*k].is_finite())
        };
        let kept: Vec<usize> = (0..self.stamps_s.len()).filter(complete).collect();
        if kept.len() < 2 {
            return Err(LogError::NoSharedTime { file: file.to_owned() }.into());
        }
        let channels = [&mut self.stamps_s, &mut self.command, &mut self.motor];
        for channel in channels.into_iter().chain(&mut self.tips) {
            *channel = kept.iter().map(|k| channel[*k]).collect();
        }
        Ok(())
    }
}
