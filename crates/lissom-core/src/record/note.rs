//! What was done to a log when it was read into a [`Run`](super::Run), in findings.

use lissom_text::significant;

use super::clock::thresholds::RESAMPLING_ERROR;
use super::other_clock;
use crate::finding::Severity::{Info, Warning};
use crate::finding::{counted, findings, result_key as key, trimmed};

/// The clock that was found from the motion, in words.
fn in_words(clock: &other_clock::OtherClock) -> String {
    let (drift_ppm, std_ppm) = (1e6 * clock.drift, significant(1e6 * clock.drift_std, 2));
    let drift = if drift_ppm.abs() > 0.0 {
        format!(", and it runs {drift_ppm:.0} ± {std_ppm} ppm faster")
    } else {
        format!("; it does not drift (standard error {std_ppm} ppm)")
    };
    let repeats = clock.repeats_s.map_or_else(String::new, |repeats_s| {
        let apart = significant(repeats_s, 4);
        format!(". The motion repeats: a time that differs by {apart} s fits as well")
    });
    format!(
        "its time is that of the run's log plus {:.5} s ± {} ms (standard error; a delay of the sensor is part of it){drift}{repeats}",
        clock.offset_s,
        significant(1e3 * clock.offset_std_s, 2)
    )
}

findings! {
    /// The log was cut at gaps in its time stamps, the longest of this length after this stamp.
    "log-cut" Gap { count: usize, at_s: f64, length_s: f64 }
        Info, [],
        match count {
            1 => format!("the log has a gap of {length_s:.4} s after {at_s:.4} s: it is cut there into separate runs"),
            _ => format!("the log has {count} gaps, the longest of {length_s:.4} s after {at_s:.4} s: it is cut there into \
                separate runs"),
        },
        "log without interruption";

    /// The clock of the log started again. Where the motion is continuous, the clock was continued, elsewhere the log was
    /// cut. The stamp is that before the first restart.
    "log-cut" ClockRestart { joined: usize, cut: usize, at_s: f64 }
        Info, [],
        format!("the clock of the log starts again {}, first after {at_s:.4} s; {}", counted(joined + cut, "time", "times"),
            match (joined, cut) {
                (_, 0) => "the motion is continuous, and the clock is continued".to_owned(),
                (0, _) => "the motion is not continuous: the log is cut there into separate runs".to_owned(),
                _ => format!("where the motion is continuous, the clock is continued, elsewhere the log is cut ({})",
                    counted(*cut, "time", "times")),
            }),
        "nothing to do, if the recording was not interrupted there";

    /// The sample time changes within the log. The log was cut there.
    "log-cut" RateChange { rates: usize, at_s: f64, first_s: f64, last_s: f64 }
        Info, [],
        {
            let [first, last] = [first_s, last_s].map(|s| significant(1e3 * s, 4));
            match rates {
                2 => format!("the sample time changes from {first} to {last} ms after {at_s:.4} s: the log is cut there into two \
                    runs"),
                _ => format!("the sample time changes {} times, first after {at_s:.4} s, from {first} ms at first to {last} ms at \
                    last: the log is cut there into {rates} runs", rates - 1),
            }
        },
        "nothing to do; you can also give separate logs as separate runs";

    /// Parts between two cuts were too short and were left out, the first from this stamp on.
    "left-out" PieceDropped { count: usize, at_s: f64, samples: usize }
        Info, [],
        match count {
            1 => format!("the piece of the log from {at_s:.4} s on, between two cuts, has only {samples} samples: it is not used"),
            _ => format!("{count} pieces of the log between two cuts, the first from {at_s:.4} s on, are too short: their {samples} \
                samples are not used"),
        },
        "log without interruption";

    /// Rows without a value in the column of runs were not used.
    "left-out" RowsWithoutRun { count: usize, share: f64 }
        Info, [],
        format!("{count} rows of the file, {:.2} % of all, have no value in the column of runs: they are not used", 1e2 * share),
        "nothing to do if these rows are between runs; else complete the column";

    /// Samples at the beginning were left out because it was requested.
    "left-out" HeadSkipped { seconds: f64 }
        Info, [],
        format!("the first {seconds} s are left out, as the campaign asks"),
        "";

    /// Stretches, the end of the log included, were left out because it was requested.
    "left-out" LeftOut { stretches: usize }
        Info, [],
        match stretches {
            1 => "a stretch of the log is left out, as the campaign asks".to_owned(),
            _ => format!("{stretches} stretches of the log are left out, as the campaign asks"),
        },
        "";

    /// The motor was moved from outside while the command was exactly zero: these stretches were left out, and the log was
    /// cut there. Times are from the first sample; the length is that of all stretches.
    "left-out" Undriven { count: usize, at_s: f64, length_s: f64 }
        Info, [],
        format!("the motor moves faster and faster while the command is exactly zero, in {} from {} s on, {} s together: it is \
            moved from outside (by hand, with the amplifier off). This is left out", counted(*count, "stretch", "stretches"),
            significant(*at_s, 4), significant(*length_s, 3)),
        "nothing to do; if gravity or a spring moves the joint, say so ([load] gravity = true), and the stretch is used";

    /// Uneven time stamps agree with the motion, or drift: all channels were interpolated at even times. The agreement is
    /// the error of angles that are predicted from their neighbours at even times over that with the clock that is used;
    /// `None` if the mean step drifts, and the samples are at the moving average of the stamps. The error of the
    /// interpolated angle is without the noise of the sensor, and its share is that of the change within one step that is
    /// due to acceleration (rms).
    "uneven-stamps" Resampled { step_s: f64, agreement: Option<f64>, error: f64, error_share: f64, noise: f64 }
        if *error_share > RESAMPLING_ERROR { Warning } else { Info },
        if *error_share > RESAMPLING_ERROR { &[key::INERTIA, key::VISCOUS, key::RAW_RESPONSE][..] } else { &[] },
        format!("time stamps are uneven, and {}; the channels are interpolated on an even grid of {} ms. The interpolation error \
            of the angle (rms) is {} % of the displacement by acceleration within one step{}", match agreement {
                Some(ratio) => format!("the motion agrees with them (with even times the prediction error of the angle is {} \
                    times as large)", significant(*ratio, 2)),
                None => "their mean step drifts: the moving average of the stamps is used as the time of the samples".to_owned(),
            },
            significant(1e3 * step_s, 4), significant(100.0 * error_share, 2), if *noise > 0.0 {
                format!(", and {} times the sensor's noise", significant(error / noise, 2))
            } else {
                String::new()
            }),
        if *error_share > RESAMPLING_ERROR {
            "log faster: the motion changes too much between two samples to be interpolated"
        } else {
            "nothing to do, if the log was made in this way; the clock of the controller gives even stamps"
        };

    /// Uneven time stamps contradict the motion: the samples were taken evenly. The agreement is the error of angles that
    /// are predicted from their neighbours at the times of the stamps over that at even times.
    "uneven-stamps" SampleCount { step_s: f64, jitter_rms_share: f64, agreement: f64 }
        Info, [],
        format!("time stamps are uneven by {} % of a step (rms), and the motion contradicts them (with the stamps the prediction \
            error of the angle is {} times that with even times): the samples are taken as evenly spaced, with a sample time of \
            {} ms", significant(100.0 * jitter_rms_share, 2), significant(*agreement, 2), significant(1e3 * step_s, 6)),
        "nothing to do, if the log was made in this way; the clock of the controller gives even stamps";

    /// Single rows were lost and have been filled in by interpolation; the share is that of all samples.
    "rows-filled" RowsFilled { count: usize, share: f64 }
        Info, [],
        format!("{} missing ({} % of the log): filled in by interpolation", counted(*count, "row is", "rows are"),
            significant(100.0 * share, 2)),
        "nothing to do; with a larger buffer the logger loses no rows";

    /// A channel is from another log, whose clock was found from the motion.
    "other-clock" OtherClock { channel: String, clock: other_clock::OtherClock }
        if clock.repeats_s.is_some() { Warning } else { Info },
        if clock.repeats_s.is_some() { &[key::COUPLING, key::MODES][..] } else { &[] },
        format!("{channel} is from another log, whose clock is found from the motion: {}", in_words(clock)),
        match clock.repeats_s {
            Some(_) => "record the beginning or the end of the motion in both logs, or use a motion that does not repeat",
            None => "nothing to do; if both logs have the same clock, state it: clock = \"shared\"",
        };

    /// Every reading was logged several times, or rows repeat the row before. Only the first of each was kept.
    "repeated-readings" RepeatedReadings { per_reading: f64, removed: usize }
        Info, [],
        if *per_reading < 1.5 {
            let rows = counted(*removed, "row is", "rows are");
            format!("{rows} removed, because time stamp and values repeat the row before")
        } else {
            format!("each reading is in {} rows of the log: the first one is used, and {removed} repeated rows are removed",
                trimmed(&format!("{per_reading:.2}")))
        },
        "nothing to do; you can log at the rate of the device";

    /// The log had too many rows. Each sample is now made of several of them.
    "thinned" Thinned { factor: usize }
        Info, [],
        format!("the log has too many rows and is thinned: one sample for every {factor} rows"),
        "log fewer samples, or cut the log into several runs";

    /// The log contains the motor's speed. It was integrated to an angle that starts at 0.
    "speed-integrated" SpeedIntegrated {}
        Info, [],
        "the log has the speed of the motor: the angle is integrated from it, starting at 0",
        "nothing to do; a log that also has the angle shows slow motion better";

    /// The levels of a speed, this far apart, do not include zero: long stays on the lowest ones were taken as rest.
    "readings-corrected" SpeedAtRest { quantum: f64, count: usize }
        Info, [],
        format!("the levels of the speed are {} rad/s (or m/s) apart, and zero is none of them: {} that stay on the lowest level \
            are taken as rest", significant(*quantum, 3), counted(*count, "reading", "readings")),
        "nothing to do if the drive codes its speed so; else give the speed's offset in the campaign";

    /// Jumps by one turn, as absolute encoders make them, were removed from the angles.
    "readings-corrected" TurnsRemoved { count: usize }
        Info, [],
        format!("{} removed from the angles: the encoder starts again after each turn",
            counted(*count, "jump of one turn is", "jumps of one turn are")),
        "nothing to do";

    /// Single wrong readings of a position, the first at this time from the first stamp of the log, were replaced by the
    /// means of their neighbours.
    "readings-corrected" SpikesReplaced { channel: String, count: usize, at_s: f64, value: f64 }
        Info, [],
        match count {
            1 => format!("{at_s:.4} s after the log's first stamp the {channel} reads {value:.4}, far from the readings before \
                and after it: it is replaced by their mean"),
            _ => format!("{count} readings of the {channel} are far from those before and after them, and replaced by the mean of \
                these: the first, {at_s:.4} s after the log's first stamp, is {value:.4}"),
        },
        "nothing to do; the cause is a lost count or a fault of the connection";
}
