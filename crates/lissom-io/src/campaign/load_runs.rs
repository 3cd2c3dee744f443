//! Reads logs into runs.

use std::collections::HashMap;

use lissom_core::finding::Finding;
use lissom_core::record::clock::{self, ClockError, EvenLog, EvenPart, LogRows};
use lissom_core::record::{
    Axis, Campaign, Channels, Command, Hold, RecordError, RestingReadings, Run, Tip, TipQuantity,
    note, rest_at_zero, undriven,
};
use rayon::prelude::*;

use super::campaign_file::ReadOptions;
use super::campaign_signals::{CommandKind, Signals, TimeSource, TipSource};
use super::conversions::{camera_angle, channel_in_range, in_si, stamps_s};
use super::derived_channels::{goal_difference, integrated};
use super::memory_logs::LogPlaces;
use super::own_logs::{RunLog, RunSignals};
use super::run_spec::RunSpec;
use super::several_runs;
use super::speed_check::{self, Contradiction};
use super::whole_turns;
use crate::config::{ConfigError, ConfigPlace};
use crate::io_error::Error;
use crate::log::{self, ColumnRef, Log, LogColumn, LogError, LogOptions, TimeBack};

/// Reads all runs, several at the same time. The error is that of the first run with an error.
pub(super) fn load(
    places: LogPlaces<'_>,
    signals: &Signals,
    command: Command,
    specs: &[RunSpec],
    options: &ReadOptions,
) -> Result<Campaign, Error> {
    let specs =
        several_runs::of_specs(places, signals.run.as_ref(), specs, &signals.log_options(options))?;
    let mut names = Vec::with_capacity(specs.len());
    let mut named: HashMap<&str, usize> = HashMap::new();
    for spec in &specs {
        let times = named.entry(&spec.name).and_modify(|n| *n += 1).or_insert(1);
        // Findings and results identify runs by name.
        names.push(if *times == 1 {
            spec.name.clone()
        } else {
            format!("{} ({times})", spec.name)
        });
    }
    let load = |(spec, name): (&RunSpec, &String)| load_run(places, signals, spec, name, options);
    let loaded: Vec<_> = specs.par_iter().zip(&names).with_max_len(1).map(load).collect();
    let mut runs = Vec::with_capacity(specs.len());
    for run in loaded {
        runs.extend(run?);
    }
    let tips: Vec<Tip> = signals.tips.iter().map(|(tip, _)| tip.clone()).collect();
    for (k, tip) in tips.iter().enumerate() {
        // Equal samples are one channel given twice; no two sensors agree in every sample of a motion.
        let is_motor = |run: &Run| run.tips()[k] == run.motor();
        if tip.quantity == TipQuantity::Angle && !runs.is_empty() && runs.iter().all(is_motor) {
            let problem = format!(
                "tip \"{}\" has the same samples as the motor in every run: it shows no bending of the arm",
                tip.name
            );
            let hint =
                "give the channel of the sensor at the tip; for a rigid axis, leave the tip out";
            return Err(ConfigError::new(ConfigPlace::default(), problem, hint).into());
        }
    }
    let channels = Channels { axis: signals.axis, command, tips };
    Ok(Campaign::new(channels, runs)?)
}

fn load_run(
    places: LogPlaces<'_>,
    signals: &Signals,
    spec: &RunSpec,
    name: &str,
    options: &ReadOptions,
) -> Result<Vec<Run>, Error> {
    let path = places.path(&spec.file);
    let file = spec.part.as_ref().map_or_else(|| path.display().to_string(), |p| p.label.clone());
    let log_options = signals.log_options(options);
    let time = signals.time.column();
    let log = match &spec.part {
        Some(part) => log::read_part(part, time, &columns(signals), &log_options)?,
        None => log::read_log(&path, time, &columns(signals), &log_options)?,
    };
    let (factor, repeated) = (log.factor, log.repeated);
    let (even, turns, own) = even_parts(log, signals, (places, spec), options, &file)?;
    let (parts, undriven) = without_undriven(even.parts, signals, options.least_piece);
    let count = parts.len();
    let mut runs = Vec::with_capacity(count);
    for (index, part) in parts.into_iter().enumerate() {
        let piece = match count {
            1 => name.to_owned(),
            _ => format!("{name} [{}/{count}]", index + 1),
        };
        let mut motor = part.motor;
        let mut at_rest = None;
        if signals.motor_speed {
            at_rest = rest_at_zero(&mut motor);
            motor = integrated(&motor, part.time.sample_time_s);
        }
        let command = match signals.command.kind {
            CommandKind::Goal => goal_difference(&part.command, &motor, signals.command.hold),
            _ => part.command,
        };
        let mut run = Run::new(piece, part.time, command, motor, part.tips)
            .map_err(|error| of_log(error, &file))?;
        if let Some((omega_rad_s, place)) = &spec.omega_rad_s {
            run = run.with_omega(*omega_rad_s).map_err(|error| match error {
                RecordError::Omega { found_rad_s, nyquist_rad_s, .. } => {
                    let problem = format!(
                        " is {found_rad_s:.4} rad/s, but must be below {nyquist_rad_s:.4} rad/s, the Nyquist frequency of {file}"
                    );
                    let hint = "`omega_rad_s` is in rad/s; `frequency = \"5 Hz\"` has a unit; check \
                                also the unit of the time stamps";
                    ConfigError::new(place.clone(), problem, hint).into()
                }
                other => of_log(other, &file),
            })?;
        }
        if let Some(RestingReadings { quantum, count }) = at_rest {
            run = run.with_note(note::SpeedAtRest { quantum, count });
        }
        if index == 0 {
            run = undriven.iter().cloned().fold(run, Run::with_note);
            run = own.iter().cloned().fold(run, Run::with_note);
            if factor > 1 {
                run = run.with_note(note::Thinned { factor });
            }
            if let Some((count, share)) = spec.rows_without_run {
                run = run.with_note(note::RowsWithoutRun { count, share });
            }
            if spec.trim.skip_s > 0.0 {
                run = run.with_note(note::HeadSkipped { seconds: spec.trim.skip_s });
            }
            if !spec.trim.is_head() {
                let stretches =
                    spec.trim.left_out_s.len() + usize::from(spec.trim.until_s.is_some());
                run = run.with_note(note::LeftOut { stretches });
            }
            if signals.motor_speed {
                run = run.with_note(note::SpeedIntegrated {});
            }
            if turns > 0 {
                run = run.with_note(note::TurnsRemoved { count: turns });
            }
            if repeated > 0 {
                let per_reading = 1.0 + repeated as f64 / run.len() as f64;
                run = run.with_note(note::RepeatedReadings { per_reading, removed: repeated });
            }
        }
        runs.push(part.notes.into_iter().fold(run, Run::with_note));
    }
    Ok(runs)
}

/// The parts without stretches in which the motor is moved from outside while the command is zero, and a note on these. Gravity,
/// and a beam, move a motor without a command; there nothing is left out.
fn without_undriven(
    parts: Vec<EvenPart>,
    signals: &Signals,
    least: usize,
) -> (Vec<EvenPart>, Option<note::Undriven>) {
    if signals.gravity || signals.command.kind == CommandKind::Goal || !signals.tips.is_empty() {
        return (parts, None);
    }
    let (mut kept, mut note) = (Vec::new(), None::<note::Undriven>);
    for part in parts {
        let found = undriven(&part.command, &part.motor, signals.motor_speed);
        if found.is_empty() {
            kept.push(part);
            continue;
        }
        let sample_s = part.time.sample_time_s;
        for range in &found {
            let (start_s, long_s) = (range.start as f64 * sample_s, range.len() as f64 * sample_s);
            let first = || note::Undriven { count: 0, at_s: start_s, length_s: 0.0 };
            let all = note.get_or_insert_with(first);
            all.count += 1;
            all.length_s += long_s;
        }
        let ends = found.iter().map(|r| r.start).chain([part.motor.len()]);
        let starts = std::iter::once(0).chain(found.iter().map(|r| r.end));
        let pieces: Vec<_> = starts.zip(ends).filter(|(from, to)| from + least <= *to).collect();
        kept.extend(pieces.into_iter().map(|(from, to)| part.piece(from..to)));
    }
    (kept, note)
}

/// Refuses samples that are too large.
fn in_range(
    command: &[f64],
    motor: &[f64],
    tips: &[Vec<f64>],
    signals: &Signals,
    file: &str,
) -> Result<(), LogError> {
    let tips = signals.tips.iter().map(|(tip, _)| tip.name.as_str()).zip(tips);
    let mut all = [("command", command), ("motor", motor)]
        .into_iter()
        .chain(tips.map(|(name, tip)| (name, tip.as_slice())));
    all.try_for_each(|(channel, samples)| channel_in_range(channel, samples, file))
}

/// Turns an error of a run into an error of its log.
fn of_log(error: RecordError, file: &str) -> Error {
    let file = file.to_owned();
    match error {
        RecordError::TooShort { found, least, .. } => {
            LogError::FewSamples { file, found, least }.into()
        }
        RecordError::SampleTime { found_s, .. } => LogError::SampleTime { file, found_s }.into(),
        other => other.into(),
    }
}

/// The columns to read from the log of the run: command, motor, the columns of each tip, and the speed if it is logged in
/// addition.
fn columns(signals: &Signals) -> Vec<LogColumn> {
    let measured = |column: &ColumnRef| LogColumn { column: column.clone(), hold: Hold::Measured };
    let command = &signals.command;
    let command = LogColumn { column: command.reading.column.clone(), hold: command.hold };
    let mut columns = vec![command];
    if signals.motor_log.is_none() {
        columns.push(measured(&signals.motor.column));
    }
    for (k, (_, source)) in signals.tips.iter().enumerate() {
        if signals.tip_logs[k].is_some() {
            continue;
        }
        match source {
            TipSource::Column(reading) => columns.push(measured(&reading.column)),
            TipSource::Camera { x, y, .. } => columns.extend([measured(x), measured(y)]),
        }
    }
    columns.extend(signals.speed.as_ref().map(|speed| measured(&speed.column)));
    columns
}

/// Turns a log into runs with even samples. Also returns the number of turns removed, and notes on signals of other logs.
fn even_parts(
    mut log: Log,
    signals: &Signals,
    (places, spec): (LogPlaces<'_>, &RunSpec),
    options: &ReadOptions,
    file: &str,
) -> Result<(EvenLog, usize, Vec<Finding>), Error> {
    let stamps_s = stamps_s(&signals.time, &mut log);
    channel_in_range("time", &stamps_s, file)?;
    let (sample_time_s, stamp_step_s) = match &signals.time {
        TimeSource::Stamps(_, unit_s) => (None, log.time_step * unit_s),
        TimeSource::Steps(step_s) => (Some(step_s * log.factor as f64), 0.0),
    };
    let mut columns = log.columns;
    let speed = signals.speed.as_ref().map(|of| in_si(columns.pop().unwrap_or_default(), of));
    let (mut command, mut motor, mut tips) = channels(columns, signals);
    in_range(&command, &motor, &tips, signals, file)?;
    let turns = remove_turns(signals, &mut command, &mut motor, &mut tips);
    let spikes = replace_spikes(signals, &stamps_s, &mut motor, &mut tips);
    if let Some(speed) = speed.filter(|_| signals.motor_log.is_none())
        && let Some(found) = speed_check::contradiction(&stamps_s, &motor, &speed)
    {
        let Contradiction { ratio, correlation } = found;
        return Err(LogError::Speed { file: file.to_owned(), ratio, correlation }.into());
    }
    let (stamps_s, command, motor, tips, mut notes) = if has_own_logs(signals) {
        let mut all = RunSignals { stamps_s, command, motor, tips, notes: Vec::new() };
        let log_options = LogOptions { max_rows: options.max_rows, ..LogOptions::default() };
        RunLog { places, spec, signals, options: &log_options, file }.join(&mut all)?;
        in_range(&all.command, &all.motor, &all.tips, signals, file)?;
        (all.stamps_s, all.command, all.motor, all.tips, all.notes)
    } else {
        (stamps_s, command, motor, tips, Vec::new())
    };
    notes.extend(spikes);
    let hold = signals.command.hold;
    let rows = LogRows { stamps_s, sample_time_s, stamp_step_s, command, hold, motor, tips };
    let even =
        clock::even_parts(rows, &spec.trim, options.least_piece).map_err(|error| match error {
            ClockError::NothingLeft { left, length_s } => {
                LogError::AllLeftOut { file: file.to_owned(), length_s, left }
            }
            error => {
                let row = match error {
                    ClockError::NotIncreasing { row } => row,
                    _ => 0,
                };
                let column = match &signals.time {
                    TimeSource::Stamps(column, _) => column.to_string(),
                    TimeSource::Steps(_) => String::new(),
                };
                let none = TimeBack { sample: row, row, before: 0.0, after: 0.0 };
                let found = log.time_back.iter().rfind(|back| back.sample <= row).unwrap_or(&none);
                LogError::time_back(file, &column, found)
            }
        })?;
    if even.parts.is_empty() {
        return Err(LogError::AllPiecesShort {
            file: file.to_owned(),
            gaps: even.cuts,
            least: options.least_piece,
            longest: even.longest,
        }
        .into());
    }
    Ok((even, turns, notes))
}

/// Whether a signal is in a log of its own.
fn has_own_logs(signals: &Signals) -> bool {
    signals.motor_log.is_some() || signals.tip_logs.iter().any(Option::is_some)
}

/// Removes jumps of one turn from all angles, and counts them.
fn remove_turns(
    signals: &Signals,
    command: &mut [f64],
    motor: &mut [f64],
    tips: &mut [Vec<f64>],
) -> usize {
    if signals.axis == Axis::Linear {
        return 0;
    }
    let mut turns = 0;
    if signals.command.kind == CommandKind::Goal {
        turns += whole_turns::remove_turns(command);
    }
    if !signals.motor_speed {
        turns += whole_turns::remove_turns(motor);
    }
    for ((tip, _), samples) in signals.tips.iter().zip(tips) {
        if tip.quantity == TipQuantity::Angle && tip.calibrated {
            turns += whole_turns::remove_turns(samples);
        }
    }
    turns
}

/// Replaces single wrong readings of the positions of motor and tips.
fn replace_spikes(
    signals: &Signals,
    stamps_s: &[f64],
    motor: &mut [f64],
    tips: &mut [Vec<f64>],
) -> Vec<Finding> {
    let motor = (!signals.motor_speed).then(|| ("motor".to_owned(), motor));
    let tips = signals.tips.iter().zip(tips).filter_map(|((tip, _), samples)| {
        let is_position = tip.quantity != TipQuantity::Acceleration;
        is_position.then(|| (format!("tip \"{}\"", tip.name), samples.as_mut_slice()))
    });
    let replace = |(channel, samples): (String, &mut [f64])| {
        let replaced = lissom_core::record::replace_spikes(samples);
        let first = replaced.first()?;
        let at_s = stamps_s.get(first.sample)? - stamps_s.first()?;
        let value = first.value;
        Some(note::SpikesReplaced { channel, count: replaced.len(), at_s, value }.into())
    };
    motor.into_iter().chain(tips).filter_map(replace).collect()
}

/// Converts command, motor and tips to SI.
fn channels(columns: Vec<Vec<f64>>, signals: &Signals) -> (Vec<f64>, Vec<f64>, Vec<Vec<f64>>) {
    let mut columns = columns.into_iter();
    let mut next = || columns.next().unwrap_or_default();
    // A signal of another log is empty here.
    let command = in_si(next(), &signals.command.reading);
    let motor =
        if signals.motor_log.is_some() { Vec::new() } else { in_si(next(), &signals.motor) };
    let mut tips = Vec::with_capacity(signals.tips.len());
    for (k, (_, source)) in signals.tips.iter().enumerate() {
        tips.push(match source {
            _ if signals.tip_logs[k].is_some() => Vec::new(),
            TipSource::Column(reading) => in_si(next(), reading),
            TipSource::Camera { origin, scale, .. } => {
                let (x, y) = (next(), next());
                camera_angle(&x, &y, *origin, *scale)
            }
        });
    }
    (command, motor, tips)
}
