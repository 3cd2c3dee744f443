//! What a reader did to a log.

/// Something done to a log on its way into a [`Run`](super::Run) that its user should know.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Note {
    /// The log was cut at gaps in its time stamps.
    GapCut {
        /// Number of gaps.
        count: usize,
        /// Stamp before the longest one \[s\].
        at_s: f64,
        /// Its time without samples \[s\].
        length_s: f64,
    },
    /// Pieces between two cuts were too short and were left out.
    PieceDropped {
        /// Number of pieces.
        count: usize,
        /// Stamp of the first sample of the first one \[s\].
        at_s: f64,
        /// Samples of all of them.
        samples: usize,
    },
    /// Uneven time stamps agree with the motion, or drift: all channels were interpolated on an even grid.
    Resampled {
        /// Step of the grid \[s\].
        step_s: f64,
        /// The error of angles that their neighbours predict at even times, as a multiple of the error with the clock
        /// that is used. `None` where the mean step drifts, and samples are at the moving average of the stamps.
        agreement: Option<f64>,
        /// Rms error of the interpolated angle \[rad or m\], without the sensor's noise.
        error: f64,
        /// That error over the rms of what acceleration moves the angle within a step.
        error_share: f64,
        /// Standard deviation of the noise of the angle \[rad or m\].
        noise: f64,
    },
    /// Uneven time stamps contradict the motion: the samples were taken evenly.
    SampleCount {
        /// Their sample time \[s\].
        step_s: f64,
        /// Distance of the stamps' steps from it (rms), as a share of it.
        jitter_rms_share: f64,
        /// The error of angles that their neighbours predict at the stamps, as a multiple of the error at even times.
        agreement: f64,
    },
    /// Single rows were lost and have been filled in by interpolation.
    RowsFilled {
        /// Number of rows.
        count: usize,
        /// Their share of all samples.
        share: f64,
    },
    /// Every reading was in the log several times. The first of each was kept.
    RepeatedReadings {
        /// Mean number of rows with one reading.
        per_reading: f64,
        /// Rows that were removed.
        removed: usize,
    },
    /// The clock of the log started again.
    ClockRestart {
        /// Restarts across which the motion goes on: the clock was continued.
        joined: usize,
        /// Restarts at which the log was cut.
        cut: usize,
        /// Stamp before the first restart \[s\].
        at_s: f64,
    },
    /// The sample time changes within the log, which was cut there.
    RateChange {
        /// Stretches with sample times of their own.
        rates: usize,
        /// Stamp of the first change \[s\].
        at_s: f64,
        /// Sample time before the first change \[s\].
        first_s: f64,
        /// Sample time after the last change \[s\].
        last_s: f64,
    },
    /// The log has the motor's speed: its angle was integrated, from 0.
    SpeedIntegrated,
    /// Jumps of one turn, as absolute encoders make them, were removed from the angles.
    TurnsRemoved {
        /// Number of jumps.
        count: usize,
    },
    /// The log had too many rows: each sample stands for several of them.
    Thinned {
        /// Rows of the log per sample.
        factor: usize,
    },
    /// Samples at the beginning were left out on request.
    HeadSkipped {
        /// Time left out \[s\].
        seconds: f64,
    },
}
