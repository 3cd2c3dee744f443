//! Why a rig cannot be built, or an experiment cannot be run.

use thiserror::Error;

/// A rig cannot be built, or an experiment cannot be run.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum RigError {
    /// A quantity that must be positive is not positive, or not finite.
    #[error("{quantity} = {found} is not positive and finite")]
    NotPositive {
        /// Name of the quantity, with its unit.
        quantity: &'static str,
        /// The number found.
        found: f64,
    },
    /// A quantity that must not be negative is negative, or not finite.
    #[error("{quantity} = {found} is negative or not finite")]
    Negative {
        /// Name of the quantity, with its unit.
        quantity: &'static str,
        /// The number found.
        found: f64,
    },
    /// A number that must be finite is not.
    #[error("{quantity} = {found} is not finite")]
    NotFinite {
        /// Name of the quantity, with its unit.
        quantity: &'static str,
        /// The number found.
        found: f64,
    },
    /// A converter has no bits or too many.
    #[error("a converter of {found} bits; 1 to 32 are possible")]
    Bits {
        /// Number of bits requested.
        found: u32,
    },
    /// The number of tip sensors is neither zero, nor one, nor the number of masses.
    #[error(
        "{found} tip sensors on a beam of {masses} masses; give none, one for all, or {masses}"
    )]
    SensorCount {
        /// Number of sensors given.
        found: usize,
        /// Number of masses of the beam.
        masses: usize,
    },
    /// The rig has no controller.
    #[error("the rig has no controller")]
    NoController,
    /// Masses were requested that the beam does not have.
    #[error("tips {} to {} of a beam with {masses} masses; tips are counted from 0", found.start, found.end)]
    TipRange {
        /// Masses that were requested.
        found: std::ops::Range<usize>,
        /// Number of masses of the beam.
        masses: usize,
    },
    /// The arm changes too fast, for its sample time, to be simulated.
    #[error(
        "the arm changes at rates up to {rate_per_s:.1e} 1/s, {steps:.1e} steps in a sample of {sample_time_s} s; {most:.0e} are possible"
    )]
    TooStiff {
        /// Bound on the rates of the arm \[1/s\].
        rate_per_s: f64,
        /// Number of steps per sample that it would take \[1\].
        steps: f64,
        /// Sample time \[s\].
        sample_time_s: f64,
        /// Largest number of steps per sample.
        most: f64,
    },
    /// Time stamps could be later than the stamp of the next row.
    #[error(
        "time stamps late by up to {most_s} s, and rows every {log_time_s} s: stamps must increase"
    )]
    LateStamps {
        /// Largest lateness \[s\].
        most_s: f64,
        /// Time between two rows \[s\].
        log_time_s: f64,
    },
    /// The relative standard deviation of wandering friction is too large.
    #[error("friction wanders by a standard deviation of {found}; {most} at most is possible")]
    Wander {
        /// Relative standard deviation given \[1\].
        found: f64,
        /// Largest value allowed \[1\].
        most: f64,
    },
    /// A gain does not fit into the integers of the control computer.
    #[error("{quantity} is {found} in integers; they hold {most} at most")]
    Gain {
        /// Name of the gain.
        quantity: &'static str,
        /// Its value as an integer.
        found: f64,
        /// Largest value that fits.
        most: f64,
    },
    /// More bits after the binary point than an integer has.
    #[error("a binary point of {found} bits; {most} at most are possible")]
    BinaryPoint {
        /// Number of bits requested.
        found: u32,
        /// Largest number possible.
        most: u32,
    },
    /// A table has no rows.
    #[error("the table has no rows")]
    EmptyTable,
    /// The columns of a table differ in length.
    #[error("the table has {times} times and {values} values")]
    TableLength {
        /// Number of times.
        times: usize,
        /// Number of values.
        values: usize,
    },
    /// A table contains NaN or infinity.
    #[error("row {row} of the table, {time_s} s and {value}, is not finite")]
    TableNotFinite {
        /// Index of the row, from 0.
        row: usize,
        /// Its time \[s\].
        time_s: f64,
        /// Its value.
        value: f64,
    },
    /// The times of a table do not increase.
    #[error("time goes from {before_s} s to {after_s} s at row {row} of the table")]
    TableOrder {
        /// Index of the later row, from 0.
        row: usize,
        /// Time of the row before \[s\].
        before_s: f64,
        /// Its time \[s\].
        after_s: f64,
    },
    /// Integer arithmetic needs sensors and converters with steps, and one has none.
    #[error("integer arithmetic needs a `{what}` with steps")]
    NeedsSteps {
        /// The sensor or converter without steps.
        what: &'static str,
    },
    /// Arms that replace each other during a run have different numbers of masses.
    #[error("an arm of {found} masses cannot take over from one of {expected}")]
    Masses {
        /// Number of masses of the first arm.
        expected: usize,
        /// Number of masses of the other arm.
        found: usize,
    },
    /// The initial state does not fit the arm.
    #[error("a start of {found} numbers; the arm's state has {expected}, all finite")]
    State {
        /// Number of values found.
        found: usize,
        /// Number of values of the arm's state.
        expected: usize,
    },
    /// The motor left the range of its sensor, and the loop became unstable.
    #[error(
        "the loop lost the motor, which was at {angle_rad:.3} rad after {time_s:.3} s: its sensor ends at {:.3} and {:.3} rad",
        range_rad.0, range_rad.1
    )]
    BeyondSensor {
        /// Angle reached \[rad\].
        angle_rad: f64,
        /// Lowest and highest angle that the sensor reads \[rad\].
        range_rad: (f64, f64),
        /// Time from the start \[s\].
        time_s: f64,
    },
    /// The rig cannot simulate this combination.
    #[error("{what} cannot be simulated")]
    Unsupported {
        /// What cannot be simulated.
        what: &'static str,
    },
    /// A tolerance of the solver is outside the allowed range.
    #[error("a tolerance of {found}; {least} to {most} are possible")]
    Tolerance {
        /// The number found.
        found: f64,
        /// Smallest tolerance.
        least: f64,
        /// Largest tolerance.
        most: f64,
    },
    /// A motion that is solved step by step cannot be continued.
    #[error("the motion cannot be followed beyond {time_s} s: the step there was {step_s} s")]
    NotFollowed {
        /// Time since the start of the motion \[s\].
        time_s: f64,
        /// Last step that was tried \[s\].
        step_s: f64,
    },
    /// The state is no longer finite.
    #[error("the motion left the range of numbers {time_s} s after its start")]
    Lost {
        /// Time at which this was noticed \[s\].
        time_s: f64,
    },
    /// The multisine has no lines.
    #[error("the multisine has no lines")]
    NoLines,
    /// An odd multisine cannot have this line.
    #[error("line {found} of the multisine: lines are odd, increase and go up to {most}")]
    Line {
        /// Number of the line.
        found: u32,
        /// Highest line possible.
        most: u32,
    },
    /// The reference contains frequencies above the Nyquist frequency.
    #[error(
        "the reference goes up to {omega_rad_s} rad/s; the Nyquist frequency is {nyquist_rad_s} rad/s"
    )]
    AboveNyquist {
        /// Highest frequency of the reference \[rad/s\].
        omega_rad_s: f64,
        /// π over the time between two actions of the controller \[rad/s\].
        nyquist_rad_s: f64,
    },
    /// A run would have too many samples.
    #[error("{quantity} takes {samples} samples; {most} at most are simulated")]
    TooLong {
        /// The part of the experiment that takes them.
        quantity: &'static str,
        /// Number of samples needed.
        samples: f64,
        /// Largest number allowed.
        most: f64,
    },
    /// The statics of the beam could not be solved for a start from a deflection.
    #[error("the deflection under a tip force of {tip_force_n} N is not finite")]
    Deflection {
        /// The force at the tip \[N\].
        tip_force_n: f64,
    },
    /// A controller returned NaN or infinity.
    #[error("the controller gave {found} A at {time_s} s")]
    Controller {
        /// Value that it returned \[A\].
        found: f64,
        /// Time \[s\].
        time_s: f64,
    },
    /// The loop is unstable: the motor left the range of plausible angles.
    #[error(
        "the loop is unstable: the motor was at {angle_rad} rad after {time_s} s, beyond {bound_rad} rad"
    )]
    Unstable {
        /// Angle reached \[rad\].
        angle_rad: f64,
        /// Largest angle allowed \[rad\].
        bound_rad: f64,
        /// Time since the start of the loop at which this was noticed \[s\].
        time_s: f64,
        /// State at that time, `[θ_m, θ̇_m, θ_i.., θ̇_i..]` \[rad, rad/s\].
        state: Vec<f64>,
    },
    /// The log could not be converted to a run.
    #[error(transparent)]
    Record(#[from] crate::record::RecordError),
}

/// Lets positive, finite numbers pass.
pub(super) fn positive(quantity: &'static str, found: f64) -> Result<f64, RigError> {
    if found > 0.0 && found.is_finite() {
        Ok(found)
    } else {
        Err(RigError::NotPositive { quantity, found })
    }
}

/// Lets finite numbers from zero on pass.
pub(super) fn not_negative(quantity: &'static str, found: f64) -> Result<f64, RigError> {
    if found >= 0.0 && found.is_finite() {
        Ok(found)
    } else {
        Err(RigError::Negative { quantity, found })
    }
}

/// Lets finite numbers pass.
pub(super) fn finite(quantity: &'static str, found: f64) -> Result<f64, RigError> {
    if found.is_finite() { Ok(found) } else { Err(RigError::NotFinite { quantity, found }) }
}
