//! Messages of notes: what was done to a log when it was read.

use std::fmt;

use crate::identify::findings::describe::Describe;
use crate::identify::findings::number_text::{counted, significant, trimmed};
use crate::identify::findings::result_key as key;
use crate::identify::findings::severity::Severity;
use crate::record::Note;
use crate::record::clock::thresholds::RESAMPLING_ERROR;
use crate::record::other_clock::OtherClock;

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
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
            | Self::RateChange { .. } => clock_message(self, f),
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
            Self::Thinned { factor } => {
                write!(f, "the log has too many rows and is thinned: one sample for every {factor} rows")
            }
            Self::HeadSkipped { seconds } => {
                write!(f, "the first {seconds} s are left out, as the campaign asks")
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

/// Writes the message of a note about the clock of a log.
fn clock_message(note: &Note, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    match note {
        Note::Resampled { step_s, agreement, error, error_share, noise } => {
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
        Note::SampleCount { step_s, jitter_rms_share, agreement } => write!(
            f,
            "time stamps are uneven by {} % of a step (rms), and the motion contradicts them (with the stamps the \
             prediction error of the angle is {} times that with even times): the samples are taken as evenly \
             spaced, with a sample time of {} ms",
            significant(100.0 * jitter_rms_share, 2),
            significant(*agreement, 2),
            significant(1e3 * step_s, 6)
        ),
        Note::RowsFilled { count, share } => write!(
            f,
            "{} missing ({} % of the log): filled in by interpolation",
            counted(*count, "row is", "rows are"),
            significant(100.0 * share, 2)
        ),
        Note::RepeatedReadings { per_reading, removed } if *per_reading < 1.5 => write!(
            f,
            "{} removed, because time stamp and values repeat the row before",
            counted(*removed, "row is", "rows are")
        ),
        Note::RepeatedReadings { per_reading, removed } => write!(
            f,
            "each reading is in {} rows of the log: the first one is used, and {removed} repeated rows are removed",
            trimmed(&format!("{per_reading:.2}"))
        ),
        Note::ClockRestart { joined, cut, at_s } => {
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
        Note::RateChange { rates: 2, at_s, first_s, last_s } => write!(
            f,
            "the sample time changes from {} to {} ms after {at_s:.4} s: the log is cut there into two runs",
            significant(1e3 * first_s, 4),
            significant(1e3 * last_s, 4)
        ),
        Note::RateChange { rates, at_s, first_s, last_s } => write!(
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

impl Describe for Note {
    fn code(&self) -> &'static str {
        self.into()
    }

    fn severity(&self) -> Severity {
        match self {
            Self::OtherClock { clock: OtherClock { repeats_s: Some(_), .. }, .. } => {
                Severity::Warning
            }
            Self::Resampled { error_share, .. } if *error_share > RESAMPLING_ERROR => {
                Severity::Warning
            }
            _ => Severity::Info,
        }
    }

    fn affects(&self) -> Vec<&'static str> {
        match self {
            Self::Resampled { error_share, .. } if *error_share > RESAMPLING_ERROR => {
                vec![key::INERTIA, key::VISCOUS, key::RAW_RESPONSE]
            }
            Self::OtherClock { clock: OtherClock { repeats_s: Some(_), .. }, .. } => {
                vec![key::COUPLING, key::MODES]
            }
            _ => Vec::new(),
        }
    }

    fn hint(&self) -> &'static str {
        match self {
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
            Self::RateChange { .. } => {
                "nothing to do; you can also give separate logs as separate runs"
            }
            Self::Thinned { .. } => "log fewer samples, or cut the log into several runs",
            Self::HeadSkipped { .. } | Self::LeftOut { .. } => "",
        }
    }
}
