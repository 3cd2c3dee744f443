//! Time stamps and samples of a log.

use std::fmt;

use strum::{IntoStaticStr, VariantNames};

use crate::identify::findings::describe::Describe;
use crate::identify::findings::number_text::{counted, significant, trimmed};
use crate::identify::findings::result_key as key;
use crate::identify::findings::severity::Severity;
use crate::record::Note;
use crate::record::clock::thresholds::RESAMPLING_ERROR;
use crate::record::other_clock::OtherClock;

/// Time stamps and samples of a log.
#[derive(Debug, Clone, PartialEq, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "kebab-case")]
#[non_exhaustive]
pub enum LogFinding {
    /// A run has the same samples as an earlier one.
    RepeatedRun {
        /// Name of the earlier run.
        first: String,
    },
    /// Time stamps are not evenly spaced.
    Jitter {
        /// Root mean square of their difference from an even grid, as a share of the sample time.
        rms_share: f64,
        /// The largest difference.
        max_share: f64,
    },
    /// The sample time of a run is far from that of the other runs.
    SampleTimeUnlike {
        /// Sample time of the run \[s\].
        sample_time_s: f64,
        /// Median of all runs \[s\].
        median_s: f64,
    },
    /// The samples are as far apart, or as close together, as no log of a drive has them.
    TimeUnit {
        /// Median sample time of the runs \[s\].
        sample_time_s: f64,
    },
    /// The log was cut at gaps in its time stamps.
    Gap {
        /// Number of gaps.
        count: usize,
        /// Time stamp before the longest gap \[s\].
        at_s: f64,
        /// Length of the longest gap \[s\].
        length_s: f64,
    },
    /// Pieces between two cuts are too short and are not used.
    PieceDropped {
        /// Number of pieces.
        count: usize,
        /// Time stamp of the first sample of the first piece \[s\].
        at_s: f64,
        /// Samples of all these pieces together.
        samples: usize,
    },
    /// Channels are interpolated on an even grid.
    Resampled {
        /// Step of the grid \[s\].
        step_s: f64,
        /// Prediction error of the angle with evenly spaced times, relative to that with the clock that is used.
        agreement: Option<f64>,
        /// Rms error of the interpolated angle \[rad or m\].
        error: f64,
        /// That error relative to the displacement by acceleration within one step.
        error_share: f64,
        /// Standard deviation of the noise of the angle \[rad or m\].
        noise: f64,
    },
    /// Samples were taken at even times, but their time stamps are uneven.
    SampleCount {
        /// Their sample time \[s\].
        step_s: f64,
        /// Difference between the steps of the stamps and the sample time (rms), as a share of the sample time.
        jitter_rms_share: f64,
        /// Prediction error of the angle with the stamps, relative to that with even times.
        agreement: f64,
    },
    /// Single rows are missing and are filled in by interpolation.
    RowsFilled {
        /// Number of rows.
        count: usize,
        /// Their share of all samples.
        share: f64,
    },
    /// The log contains each reading several times.
    RepeatedReadings {
        /// Mean number of rows with one reading.
        per_reading: f64,
        /// Number of rows that are removed.
        removed: usize,
    },
    /// The clock of the log starts again.
    ClockRestart {
        /// Number of restarts across which the motion is continuous.
        joined: usize,
        /// Number of restarts at which the log is cut.
        cut: usize,
        /// Time stamp before the first restart \[s\].
        at_s: f64,
    },
    /// The sample time changes within the log.
    RateChange {
        /// Number of parts with different sample times.
        rates: usize,
        /// Time stamp of the first change \[s\].
        at_s: f64,
        /// Sample time before the first change \[s\].
        first_s: f64,
        /// Sample time after the last change \[s\].
        last_s: f64,
    },
    /// The angle is integrated from the speed.
    SpeedIntegrated,
    /// The motor was moved from outside while the command was zero; this is left out.
    Undriven {
        /// Number of stretches.
        count: usize,
        /// Time of the first one, from the first sample \[s\].
        at_s: f64,
        /// Time that they last together \[s\].
        length_s: f64,
    },
    /// A speed that stays on the lowest levels of its sensor is rest.
    SpeedAtRest {
        /// Distance of the levels \[rad/s or m/s\].
        quantum: f64,
        /// Number of readings.
        count: usize,
    },
    /// Jumps of one turn are removed from the angles.
    TurnsRemoved {
        /// Number of jumps.
        count: usize,
    },
    /// Rows without a value in the column of runs are not used.
    RowsWithoutRun {
        /// Their number.
        count: usize,
        /// Their share of all rows of the file.
        share: f64,
    },
    /// Single wrong readings are replaced.
    SpikesReplaced {
        /// Name of the channel.
        channel: String,
        /// Number of readings.
        count: usize,
        /// Time of the first one \[s\].
        at_s: f64,
        /// What it was \[rad or m\].
        value: f64,
    },
    /// The command follows the motor as a position goal does.
    CommandFollowsMotor {
        /// Correlation of command and angle.
        correlation: f64,
    },
    /// The log has too many rows and is thinned.
    Thinned {
        /// Rows of the log for each sample.
        factor: usize,
    },
    /// A channel is from another log, whose clock was found from the motion.
    OtherClock {
        /// Name of the channel.
        channel: String,
        /// The clock.
        clock: OtherClock,
    },
    /// Samples at the beginning are left out, as the campaign asks.
    HeadSkipped {
        /// Time left out \[s\].
        length_s: f64,
    },
    /// Stretches are left out, as the campaign asks.
    LeftOut {
        /// Their number, the end of the log included.
        stretches: usize,
    },
}

impl From<&Note> for LogFinding {
    fn from(note: &Note) -> Self {
        match *note {
            Note::GapCut { count, at_s, length_s } => Self::Gap { count, at_s, length_s },
            Note::PieceDropped { count, at_s, samples } => {
                Self::PieceDropped { count, at_s, samples }
            }
            Note::Resampled { step_s, agreement, error, error_share, noise } => {
                Self::Resampled { step_s, agreement, error, error_share, noise }
            }
            Note::SampleCount { step_s, jitter_rms_share, agreement } => {
                Self::SampleCount { step_s, jitter_rms_share, agreement }
            }
            Note::RowsFilled { count, share } => Self::RowsFilled { count, share },
            Note::RepeatedReadings { per_reading, removed } => {
                Self::RepeatedReadings { per_reading, removed }
            }
            Note::ClockRestart { joined, cut, at_s } => Self::ClockRestart { joined, cut, at_s },
            Note::RateChange { rates, at_s, first_s, last_s } => {
                Self::RateChange { rates, at_s, first_s, last_s }
            }
            Note::OtherClock { ref channel, clock } => {
                Self::OtherClock { channel: channel.clone(), clock }
            }
            Note::SpeedIntegrated => Self::SpeedIntegrated,
            Note::Undriven { count, at_s, length_s } => Self::Undriven { count, at_s, length_s },
            Note::SpeedAtRest { quantum, count } => Self::SpeedAtRest { quantum, count },
            Note::TurnsRemoved { count } => Self::TurnsRemoved { count },
            Note::RowsWithoutRun { count, share } => Self::RowsWithoutRun { count, share },
            Note::SpikesReplaced { ref channel, count, at_s, value } => {
                Self::SpikesReplaced { channel: channel.clone(), count, at_s, value }
            }
            Note::Thinned { factor } => Self::Thinned { factor },
            Note::HeadSkipped { seconds } => Self::HeadSkipped { length_s: seconds },
            Note::LeftOut { stretches } => Self::LeftOut { stretches },
        }
    }
}

impl fmt::Display for LogFinding {
    #[expect(clippy::too_many_lines, reason = "one sentence for each finding")]
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::RepeatedRun { first } => {
                write!(f, "all samples are equal to those of {first}: this run is not used")
            }
            Self::SampleTimeUnlike { sample_time_s, median_s } => write!(
                f,
                "the sample time of this run is {} s, that of the runs in general {} s: its time stamps may be in another unit",
                significant(*sample_time_s, 3),
                significant(*median_s, 3)
            ),
            Self::TimeUnit { sample_time_s } => write!(
                f,
                "the samples are {} s apart, which no log of a drive is: the time stamps are probably in another unit",
                significant(*sample_time_s, 3)
            ),
            Self::Jitter { rms_share, max_share } => write!(
                f,
                "time stamps differ from an even grid by {:.1} % of the sample time (rms; at most {:.0} %): samples \
                 are taken as evenly spaced",
                100.0 * rms_share,
                100.0 * max_share
            ),
            Self::Gap { count: 1, at_s, length_s } => write!(
                f,
                "the log has a gap of {length_s:.4} s after {at_s:.4} s: it is cut there into separate runs"
            ),
            Self::Gap { count, at_s, length_s } => write!(
                f,
                "the log has {count} gaps, the longest of {length_s:.4} s after {at_s:.4} s: it is cut there into \
                 separate runs"
            ),
            Self::PieceDropped { count: 1, at_s, samples } => write!(
                f,
                "the piece of the log from {at_s:.4} s on, between two cuts, has only {samples} samples: it is not used"
            ),
            Self::PieceDropped { count, at_s, samples } => write!(
                f,
                "{count} pieces of the log between two cuts, the first from {at_s:.4} s on, are too short: their \
                 {samples} samples are not used"
            ),
            Self::Resampled { .. }
            | Self::SampleCount { .. }
            | Self::RowsFilled { .. }
            | Self::RepeatedReadings { .. }
            | Self::ClockRestart { .. }
            | Self::RateChange { .. } => self.clock_message(f),
            Self::OtherClock { channel, clock } => other_clock_message(f, channel, clock),
            Self::SpeedIntegrated => f.write_str(
                "the log has the speed of the motor: the angle is integrated from it, starting at 0",
            ),
            Self::Undriven { count, at_s, length_s } => write!(
                f,
                "the motor moves faster and faster while the command is exactly zero, in {} from {} s on, {} s together: it is \
                 moved from outside (by hand, with the amplifier off). This is left out",
                counted(*count, "stretch", "stretches"),
                significant(*at_s, 4),
                significant(*length_s, 3)
            ),
            Self::SpeedAtRest { quantum, count } => write!(
                f,
                "the levels of the speed are {} rad/s (or m/s) apart, and zero is none of them: {} that stay on the lowest \
                 level are taken as rest",
                significant(*quantum, 3),
                counted(*count, "reading", "readings")
            ),
            Self::TurnsRemoved { count } => write!(
                f,
                "{} of one turn {} removed from the angles: the encoder starts again after each turn",
                counted(*count, "jump", "jumps"),
                if *count == 1 { "is" } else { "are" }
            ),
            Self::RowsWithoutRun { count, share } => write!(
                f,
                "{count} rows of the file, {:.2} % of all, have no value in the column of runs: they are not used",
                1e2 * share
            ),
            Self::SpikesReplaced { channel, count: 1, at_s, value } => write!(
                f,
                "{at_s:.4} s after the log's first stamp the {channel} reads {value:.4}, far from the readings before and after \
                 it: it is replaced by their mean"
            ),
            Self::SpikesReplaced { channel, count, at_s, value } => write!(
                f,
                "{count} readings of the {channel} are far from those before and after them, and replaced by the mean of these: \
                 the first, {at_s:.4} s after the log's first stamp, is {value:.4}"
            ),
            Self::CommandFollowsMotor { correlation } => write!(
                f,
                "the command follows the motor's angle (correlation {correlation:.4}): it looks like the position goal of a \
                 servo. If it is one, all estimates are wrong"
            ),
            Self::Thinned { factor } => {
                write!(f, "the log has too many rows and is thinned: one sample for every {factor} rows")
            }
            Self::HeadSkipped { length_s } => {
                write!(f, "the first {length_s} s are left out, as the campaign asks")
            }
            Self::LeftOut { stretches: 1 } => {
                write!(f, "a stretch of the log is left out, as the campaign asks")
            }
            Self::LeftOut { stretches } => {
                write!(f, "{stretches} stretches of the log are left out, as the campaign asks")
            }
        }
    }
}

/// Writes the message of a clock that was found from the motion.
fn other_clock_message(
    f: &mut fmt::Formatter<'_>,
    channel: &str,
    clock: &OtherClock,
) -> fmt::Result {
    write!(
        f,
        "{channel} is from another log, whose clock is found from the motion: its time is that of the run's log plus \
         {:.5} s ± {} ms (standard error; a delay of the sensor is part of it)",
        clock.offset_s,
        significant(1e3 * clock.offset_std_s, 2)
    )?;
    let (drift_ppm, std_ppm) = (1e6 * clock.drift, significant(1e6 * clock.drift_std, 2));
    if drift_ppm.abs() > 0.0 {
        write!(f, ", and it runs {drift_ppm:.0} ± {std_ppm} ppm faster")?;
    } else {
        write!(f, "; it does not drift (standard error {std_ppm} ppm)")?;
    }
    if let Some(repeats_s) = clock.repeats_s {
        write!(
            f,
            ". The motion repeats: a time that differs by {} s fits as well",
            significant(repeats_s, 4)
        )?;
    }
    Ok(())
}

impl LogFinding {
    /// Writes the message of a finding about the clock of a log.
    fn clock_message(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Resampled { step_s, agreement, error, error_share, noise } => {
                match agreement {
                    Some(ratio) => write!(
                        f,
                        "time stamps are uneven, and the motion agrees with them (with even times the prediction error \
                         of the angle is {} times as large)",
                        significant(*ratio, 2)
                    )?,
                    None => write!(
                        f,
                        "time stamps are uneven, and their mean step drifts: the moving average of the stamps is used \
                         as the time of the samples"
                    )?,
                }
                write!(
                    f,
                    "; the channels are interpolated on an even grid of {} ms. The interpolation error of the angle \
                     (rms) is {} % of the displacement by acceleration within one step",
                    significant(1e3 * step_s, 4),
                    significant(100.0 * error_share, 2)
                )?;
                if *noise > 0.0 {
                    write!(f, ", and {} times the sensor's noise", significant(error / noise, 2))?;
                }
                Ok(())
            }
            Self::SampleCount { step_s, jitter_rms_share, agreement } => write!(
                f,
                "time stamps are uneven by {} % of a step (rms), and the motion contradicts them (with the stamps the \
                 prediction error of the angle is {} times that with even times): the samples are taken as evenly \
                 spaced, with a sample time of {} ms",
                significant(100.0 * jitter_rms_share, 2),
                significant(*agreement, 2),
                significant(1e3 * step_s, 6)
            ),
            Self::RowsFilled { count, share } => write!(
                f,
                "{} missing ({} % of the log): filled in by interpolation",
                counted(*count, "row is", "rows are"),
                significant(100.0 * share, 2)
            ),
            Self::RepeatedReadings { per_reading, removed } if *per_reading < 1.5 => write!(
                f,
                "{} removed, because time stamp and values repeat the row before",
                counted(*removed, "row is", "rows are")
            ),
            Self::RepeatedReadings { per_reading, removed } => write!(
                f,
                "each reading is in {} rows of the log: the first one is used, and {removed} repeated rows are removed",
                trimmed(&format!("{per_reading:.2}"))
            ),
            Self::ClockRestart { joined, cut, at_s } => {
                write!(
                    f,
                    "the clock of the log starts again {}, first after {at_s:.4} s",
                    counted(joined + cut, "time", "times")
                )?;
                match (joined, cut) {
                    (_, 0) => write!(f, "; the motion is continuous, and the clock is continued"),
                    (0, _) => write!(
                        f,
                        "; the motion is not continuous: the log is cut there into separate runs"
                    ),
                    _ => write!(
                        f,
                        "; where the motion is continuous, the clock is continued, elsewhere the log is cut ({})",
                        counted(*cut, "time", "times")
                    ),
                }
            }
            Self::RateChange { rates: 2, at_s, first_s, last_s } => write!(
                f,
                "the sample time changes from {} to {} ms after {at_s:.4} s: the log is cut there into two runs",
                significant(1e3 * first_s, 4),
                significant(1e3 * last_s, 4)
            ),
            Self::RateChange { rates, at_s, first_s, last_s } => write!(
                f,
                "the sample time changes {} times, first after {at_s:.4} s, from {} ms at first to {} ms at last: \
                 the log is cut there into {rates} runs",
                rates - 1,
                significant(1e3 * first_s, 4),
                significant(1e3 * last_s, 4)
            ),
            _ => Ok(()),
        }
    }
}

impl Describe for LogFinding {
    fn code(&self) -> &'static str {
        self.into()
    }

    fn severity(&self) -> Severity {
        match self {
            Self::RepeatedRun { .. }
            | Self::SampleTimeUnlike { .. }
            | Self::TimeUnit { .. }
            | Self::Jitter { .. }
            | Self::CommandFollowsMotor { .. }
            | Self::OtherClock { clock: OtherClock { repeats_s: Some(_), .. }, .. } => {
                Severity::Warning
            }
            Self::Resampled { error_share, .. } if *error_share > RESAMPLING_ERROR => {
                Severity::Warning
            }
            Self::Gap { .. }
            | Self::PieceDropped { .. }
            | Self::Resampled { .. }
            | Self::SampleCount { .. }
            | Self::RowsFilled { .. }
            | Self::RepeatedReadings { .. }
            | Self::ClockRestart { .. }
            | Self::RateChange { .. }
            | Self::OtherClock { .. }
            | Self::SpeedIntegrated
            | Self::Undriven { .. }
            | Self::SpeedAtRest { .. }
            | Self::TurnsRemoved { .. }
            | Self::RowsWithoutRun { .. }
            | Self::SpikesReplaced { .. }
            | Self::Thinned { .. }
            | Self::HeadSkipped { .. }
            | Self::LeftOut { .. } => Severity::Info,
        }
    }

    fn affects(&self) -> Vec<&'static str> {
        match self {
            Self::RepeatedRun { .. } => vec![key::RAW_RESPONSE],
            Self::SampleTimeUnlike { .. } | Self::TimeUnit { .. } => {
                let joint = [key::COULOMB, key::VISCOUS, key::INERTIA, key::GRAVITY];
                [&joint[..], &[key::COUPLING, key::MODES]].concat()
            }
            Self::Jitter { .. } => vec![key::INERTIA, key::VISCOUS, key::RAW_RESPONSE],
            Self::CommandFollowsMotor { .. } => vec![key::INERTIA, key::VISCOUS, key::COULOMB],
            Self::Resampled { error_share, .. } if *error_share > RESAMPLING_ERROR => {
                vec![key::INERTIA, key::VISCOUS, key::RAW_RESPONSE]
            }
            Self::OtherClock { clock: OtherClock { repeats_s: Some(_), .. }, .. } => {
                vec![key::COUPLING, key::MODES]
            }
            Self::Gap { .. }
            | Self::PieceDropped { .. }
            | Self::Resampled { .. }
            | Self::SampleCount { .. }
            | Self::RowsFilled { .. }
            | Self::RepeatedReadings { .. }
            | Self::ClockRestart { .. }
            | Self::RateChange { .. }
            | Self::OtherClock { .. }
            | Self::SpeedIntegrated
            | Self::Undriven { .. }
            | Self::SpeedAtRest { .. }
            | Self::TurnsRemoved { .. }
            | Self::RowsWithoutRun { .. }
            | Self::SpikesReplaced { .. }
            | Self::Thinned { .. }
            | Self::HeadSkipped { .. }
            | Self::LeftOut { .. } => Vec::new(),
        }
    }

    fn hint(&self) -> &'static str {
        match self {
            Self::RepeatedRun { .. } => {
                "remove it from the campaign: a log that counts twice makes standard errors too small"
            }
            Self::SampleTimeUnlike { .. } => {
                "check the unit of time in this log; give a log with another unit in a campaign of its own"
            }
            Self::TimeUnit { .. } => {
                "check the unit of time; stamps that grow by 1 or 2 are often milliseconds, by 1000 or more microseconds"
            }
            Self::Jitter { .. } => "use the clock of the controller for the time stamps",
            Self::OtherClock { clock: OtherClock { repeats_s: Some(_), .. }, .. } => {
                "record the beginning or the end of the motion in both logs, or use a motion that does not repeat"
            }
            Self::OtherClock { .. } => {
                "nothing to do; if both logs have the same clock, state it: clock = \"shared\""
            }
            Self::Gap { .. } | Self::PieceDropped { .. } => "log without interruption",
            Self::Resampled { error_share, .. } if *error_share > RESAMPLING_ERROR => {
                "log faster: the motion changes too much between two samples to be interpolated"
            }
            Self::Resampled { .. } | Self::SampleCount { .. } => {
                "nothing to do, if the log was made in this way; the clock of the controller gives even stamps"
            }
            Self::RowsFilled { .. } => {
                "nothing to do; with a larger buffer the logger loses no rows"
            }
            Self::RepeatedReadings { .. } => "nothing to do; you can log at the rate of the device",
            Self::ClockRestart { .. } => {
                "nothing to do, if the recording was not interrupted there"
            }
            Self::SpeedIntegrated => {
                "nothing to do; a log that also has the angle shows slow motion better"
            }
            Self::Undriven { .. } => {
                "nothing to do; if gravity or a spring moves the joint, say so ([load] gravity = true), and the stretch is used"
            }
            Self::SpeedAtRest { .. } => {
                "nothing to do if the drive codes its speed so; else give the speed's offset in the campaign"
            }
            Self::TurnsRemoved { .. } => "nothing to do",
            Self::RowsWithoutRun { .. } => {
                "nothing to do if these rows are between runs; else complete the column"
            }
            Self::SpikesReplaced { .. } => {
                "nothing to do; the cause is a lost count or a fault of the connection"
            }
            Self::CommandFollowsMotor { .. } => {
                "if the command is a position goal, give it `quantity = \"goal\"`; nothing to do if a spring or gravity holds \
                 the motor"
            }
            Self::RateChange { .. } => {
                "nothing to do; you can also give separate logs as separate runs"
            }
            Self::Thinned { .. } => "log fewer samples, or cut the log into several runs",
            Self::HeadSkipped { .. } | Self::LeftOut { .. } => "",
        }
    }
}
