//! What was done to a log when it was read.

use strum::{IntoStaticStr, VariantNames};

use super::other_clock::OtherClock;

/// A change that was made to a log when it was read into a [`Run`](super::Run), and that its user should know.
/// The names of its kinds are the codes of findings.
#[derive(Debug, Clone, PartialEq, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "kebab-case")]
#[non_exhaustive]
pub enum Note {
    /// The log was cut at gaps in its time stamps.
    Gap {
        /// Number of gaps.
        count: usize,
        /// Stamp before the longest gap \[s\].
        at_s: f64,
        /// Length of the longest gap \[s\].
        length_s: f64,
    },
    /// Parts between two cuts were too short and were left out.
    PieceDropped {
        /// Number of parts.
        count: usize,
        /// Stamp of the first sample of the first part \[s\].
        at_s: f64,
        /// Number of samples of all these parts.
        samples: usize,
    },
    /// Uneven time stamps agree with the motion, or drift: all channels were interpolated at even times.
    Resampled {
        /// Sample time after interpolation \[s\].
        step_s: f64,
        /// Ratio of two errors of angles that are predicted from their neighbours: the error at even times over the
        /// error with the clock that is used \[1\]. `None` if the mean step drifts; samples are then at the moving
        /// average of the stamps.
        agreement: Option<f64>,
        /// Error of the interpolated angle \[rad or m, rms\], without the noise of the sensor.
        error: f64,
        /// That error divided by the change of the angle within one step that is due to acceleration (rms) \[1\].
        error_share: f64,
        /// Standard deviation of the sensor noise of the angle \[rad or m\].
        noise: f64,
    },
    /// Uneven time stamps contradict the motion: the samples were taken evenly.
    SampleCount {
        /// Sample time \[s\].
        step_s: f64,
        /// Scatter of the steps between stamps (rms), as a share of the sample time \[1\].
        jitter_rms_share: f64,
        /// Ratio of two errors of angles that are predicted from their neighbours: the error at the times of the stamps
        /// over the error at even times \[1\].
        agreement: f64,
    },
    /// Single rows were lost and have been filled in by interpolation.
    RowsFilled {
        /// Number of rows.
        count: usize,
        /// Share of the filled rows in all samples \[1\].
        share: f64,
    },
    /// A channel is from another log, whose clock was found from the motion.
    OtherClock {
        /// Name of the channel.
        channel: String,
        /// The clock.
        clock: OtherClock,
    },
    /// Every reading was logged several times. Only the first of each was kept.
    RepeatedReadings {
        /// Mean number of rows per reading.
        per_reading: f64,
        /// Number of rows that were removed.
        removed: usize,
    },
    /// The clock of the log started again, once or more often.
    ClockRestart {
        /// Number of restarts across which the motion is continuous: the clock was continued.
        joined: usize,
        /// Number of restarts at which the log was cut.
        cut: usize,
        /// Stamp before the first restart \[s\].
        at_s: f64,
    },
    /// The sample time changes within the log. The log was cut there.
    RateChange {
        /// Number of stretches with different sample times.
        rates: usize,
        /// Stamp of the first change \[s\].
        at_s: f64,
        /// Sample time before the first change \[s\].
        first_s: f64,
        /// Sample time after the last change \[s\].
        last_s: f64,
    },
    /// The log contains the motor's speed. It was integrated to an angle that starts at 0.
    SpeedIntegrated,
    /// The motor was moved from outside while the command was exactly zero: this was left out, and the log was cut there.
    Undriven {
        /// Number of stretches.
        count: usize,
        /// Time of the first one, from the first sample \[s\].
        at_s: f64,
        /// Time that they last together \[s\].
        length_s: f64,
    },
    /// The levels of a speed do not include zero: long stays on the lowest ones were taken as rest.
    SpeedAtRest {
        /// Distance of the levels \[rad/s or m/s\].
        quantum: f64,
        /// Number of readings.
        count: usize,
    },
    /// Jumps by one turn, as absolute encoders make them, were removed from the angles.
    TurnsRemoved {
        /// Number of jumps.
        count: usize,
    },
    /// Single wrong readings of a position were replaced by the means of their neighbours.
    SpikesReplaced {
        /// Name of the channel.
        channel: String,
        /// Number of readings.
        count: usize,
        /// Time of the first one, from the first stamp of the log \[s\].
        at_s: f64,
        /// What it was [rad or m].
        value: f64,
    },
    /// Rows without a value in the column of runs were not used.
    RowsWithoutRun {
        /// Their number.
        count: usize,
        /// Their share of all rows of the file.
        share: f64,
    },
    /// The log had too many rows. Each sample is now made of several of them.
    Thinned {
        /// Number of rows of the log per sample.
        factor: usize,
    },
    /// Samples at the beginning were left out because it was requested.
    HeadSkipped {
        /// Time left out \[s\].
        seconds: f64,
    },
    /// Stretches were left out because it was requested.
    LeftOut {
        /// Their number, the end of the log included.
        stretches: usize,
    },
}
