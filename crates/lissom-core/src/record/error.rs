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
    #[error("run {run}: {found} tip channels where the campaign has {expected}")]
    TipCount {
        /// Name of the run.
        run: String,
        /// Tips of the campaign.
        expected: usize,
        /// Tips of the run.
        found: usize,
    },
    /// Gravity where it cannot act as `g_s·sin θ + g_c·cos θ` on the motor.
    #[error("{}", gravity_refused(*.linear))]
    Gravity {
        /// Whether the axis is linear.
        linear: bool,
    },
    /// Two channels of a run differ in length.
    #[error("run {run}: channel {channel} has {found} samples where the motor has {expected}")]
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
    /// Fewer samples than anything can be said from.
    #[error("run {run}: {found} samples; at least {least} are needed")]
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
    #[error("run {run}: a sample time of {found_s} s is not positive and finite")]
    SampleTime {
        /// Name of the run.
        run: String,
        /// The sample time found \[s\].
        found_s: f64,
    },
    /// Time stamps do not increase.
    #[error("run {run}: time goes from {before_s} s to {after_s} s at sample {sample}")]
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
    /// A known m·g·l that is no positive torque.
    #[error("m·g·l of a load is positive and finite, not {found_nm} N·m")]
    Mgl {
        /// The torque given \[N·m\].
        found_nm: f64,
    },
    /// The drive frequency is not a positive finite number below the Nyquist frequency.
    #[error(
        "run {run}: a drive frequency of {found_rad_s} rad/s is not between 0 and the Nyquist frequency {nyquist_rad_s} rad/s"
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
        "gravity on a linear axis is a constant force, which every fit has as its offset"
    } else {
        "gravity is identified for a rigid joint, and this campaign has tips"
    }
}
