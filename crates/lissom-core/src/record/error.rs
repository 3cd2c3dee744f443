//! Why signals cannot make a run or a campaign.

use thiserror::Error;

/// Why signals cannot make a record.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum RecordError {
    /// A campaign without runs.
    #[error("the campaign has no runs")]
    NoRuns,
    /// A run has another number of tips than its campaign.
    #[error("run {run} has {found} tip channels, but the campaign has {expected}")]
    TipCount {
        /// Name of the run.
        run: String,
        /// Tips of the campaign.
        expected: usize,
        /// Tips of the run.
        found: usize,
    },
    /// Gravity cannot act as `g_s·sin θ + g_c·cos θ` on the motor.
    #[error("{}", gravity_refused(*.linear))]
    Gravity {
        /// Whether the axis is linear.
        linear: bool,
    },
    /// Two channels of a run differ in length.
    #[error("run {run}: channel {channel} has {found} samples, but the motor has {expected}")]
    Length {
        /// Name of the run.
        run: String,
        /// Name of the channel.
        channel: String,
        /// Samples of the motor channel.
        expected: usize,
        /// Samples of this channel.
        found: usize,
    },
    /// The run has too few samples.
    #[error("run {run} has {found} samples, but at least {least} are needed")]
    TooShort {
        /// Name of the run.
        run: String,
        /// Samples found.
        found: usize,
        /// Samples needed.
        least: usize,
    },
    /// A sample is NaN or infinite.
    #[error("run {run}: channel {channel} is not a finite number at sample {sample}")]
    NotFinite {
        /// Name of the run.
        run: String,
        /// Name of the channel.
        channel: String,
        /// Index of the sample, from 0.
        sample: usize,
    },
    /// The sample time is not a positive finite number.
    #[error("run {run}: the sample time is {found_s} s, but must be positive and finite")]
    SampleTime {
        /// Name of the run.
        run: String,
        /// The sample time found \[s\].
        found_s: f64,
    },
    /// Time stamps do not increase.
    #[error(
        "run {run}: time does not increase at sample {sample}: {after_s} s follows {before_s} s"
    )]
    TimeOrder {
        /// Name of the run.
        run: String,
        /// Index of the later sample, from 0.
        sample: usize,
        /// The stamp before it \[s\].
        before_s: f64,
        /// Its stamp \[s\].
        after_s: f64,
    },
    /// The known m·g·l is not a positive, finite torque.
    #[error("m·g·l of the load is {found_nm} N·m, but must be positive and finite")]
    Mgl {
        /// The torque given \[N·m\].
        found_nm: f64,
    },
    /// The drive frequency is not a positive finite number below the Nyquist frequency.
    #[error(
        "run {run}: the drive frequency is {found_rad_s} rad/s, but must be between 0 and the Nyquist frequency, {nyquist_rad_s} rad/s"
    )]
    Omega {
        /// Name of the run.
        run: String,
        /// The frequency given \[rad/s\].
        found_rad_s: f64,
        /// π over the sample time \[rad/s\].
        nyquist_rad_s: f64,
    },
}

fn gravity_refused(linear: bool) -> &'static str {
    if linear {
        "gravity on a linear axis is a constant force, which is part of the offset of friction"
    } else {
        "gravity can be identified for a rigid joint only, but this campaign has tips"
    }
}
