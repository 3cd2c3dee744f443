//! Why a rig cannot be built, or an experiment cannot be run.

use thiserror::Error;

/// Why an experiment cannot be made or carried out.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum RigError {
    /// A quantity that must be positive is not.
    #[error("{quantity} is {found}, but must be positive and finite")]
    NotPositive {
        /// Which quantity, with its unit.
        quantity: &'static str,
        /// The number found.
        found: f64,
    },
    /// A quantity that must not be negative is.
    #[error("{quantity} is {found}, but must be finite and not negative")]
    Negative {
        /// Which quantity, with its unit.
        quantity: &'static str,
        /// The number found.
        found: f64,
    },
    /// A number that must be finite is not.
    #[error("{quantity} is {found}, but must be finite")]
    NotFinite {
        /// Which quantity, with its unit.
        quantity: &'static str,
        /// The number found.
        found: f64,
    },
    /// The number of bits of a converter is not possible.
    #[error("a converter has {found} bits, but must have 1 to 32")]
    Bits {
        /// Requested number of bits.
        found: u32,
    },
    /// The number of tip sensors is not zero, one, or the number of masses.
    #[error(
        "{found} tip sensors for a beam of {masses} masses; give none, one for all masses, or {masses}"
    )]
    SensorCount {
        /// Sensors given.
        found: usize,
        /// Masses of the beam.
        masses: usize,
    },
    /// A rig without a controller.
    #[error("the rig has no controller")]
    NoController,
    /// A rig without a sample time.
    #[error("the rig has no sample time")]
    NoSampleTime,
    /// The beam does not have these masses.
    #[error("tips {} to {} do not exist: the beam has {masses} masses, counted from 0", found.start, found.end)]
    TipRange {
        /// Requested masses.
        found: std::ops::Range<usize>,
        /// Masses of the beam.
        masses: usize,
    },
    /// The arm changes too fast for a simulation with this sample time.
    #[error(
        "the arm changes at rates up to {rate_per_s:.1e} 1/s, which needs {steps:.1e} steps in a sample of {sample_time_s} s; at most {most:.0e} are possible"
    )]
    TooStiff {
        /// Bound on the rates \[1/s\].
        rate_per_s: f64,
        /// Steps in a sample.
        steps: f64,
        /// Sample time \[s\].
        sample_time_s: f64,
        /// Most steps.
        most: f64,
    },
    /// A time stamp may be later than that of the next row.
    #[error(
        "time stamps are late by up to {most_s} s, but rows follow every {log_time_s} s: stamps would not increase"
    )]
    LateStamps {
        /// The largest lateness \[s\].
        most_s: f64,
        /// Time between two rows \[s\].
        log_time_s: f64,
    },
    /// Friction wanders too much.
    #[error(
        "friction wanders with a standard deviation of {found}, but at most {most} is possible"
    )]
    Wander {
        /// The relative standard deviation found \[1\].
        found: f64,
        /// The largest \[1\].
        most: f64,
    },
    /// A gain is too large for the integers of the control computer.
    #[error("{quantity} is {found} as an integer, but at most {most} is possible")]
    Gain {
        /// Name of the gain.
        quantity: &'static str,
        /// Its value as an integer.
        found: f64,
        /// Largest possible value.
        most: f64,
    },
    /// There are more bits behind the binary point than an integer has.
    #[error("{found} bits behind the binary point, but at most {most} are possible")]
    BinaryPoint {
        /// Requested number of bits.
        found: u32,
        /// Largest possible number.
        most: u32,
    },
    /// The table has no rows.
    #[error("the table has no rows")]
    EmptyTable,
    /// The columns of the table differ in length.
    #[error("the table has {times} times and {values} values")]
    TableLength {
        /// Number of times.
        times: usize,
        /// Number of values.
        values: usize,
    },
    /// The table contains NaN or infinity.
    #[error("row {row} of the table is not finite: time {time_s} s, value {value}")]
    TableNotFinite {
        /// The row, from 0.
        row: usize,
        /// Its time \[s\].
        time_s: f64,
        /// Its value.
        value: f64,
    },
    /// Times of a table do not increase.
    #[error("time does not increase at row {row} of the table: {after_s} s follows {before_s} s")]
    TableOrder {
        /// The later row, from 0.
        row: usize,
        /// Time of the row before \[s\].
        before_s: f64,
        /// Its time \[s\].
        after_s: f64,
    },
    /// Integer arithmetic with a sensor or converter that has no steps.
    #[error("integer arithmetic needs a `{what}` with steps")]
    NeedsSteps {
        /// Name of the sensor or converter.
        what: &'static str,
    },
    /// Arms that replace one another have different numbers of masses.
    #[error("an arm of {found} masses cannot replace one of {expected} masses during a run")]
    Masses {
        /// Masses of the first arm.
        expected: usize,
        /// Masses of the other.
        found: usize,
    },
    /// The initial state is not a state of the arm.
    #[error("the initial state has {found} numbers, but the arm needs {expected}, all finite")]
    State {
        /// Numbers found.
        found: usize,
        /// Numbers that the state has.
        expected: usize,
    },
    /// The motor left the range of its sensor, and the loop lost control.
    #[error(
        "the motor left the range of its sensor, and the loop lost control: it was at {angle_rad:.3} rad after {time_s:.3} s, and its sensor ends at {:.3} and {:.3} rad",
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
    /// The rig cannot simulate something.
    #[error("{what} cannot be simulated")]
    Unsupported {
        /// What it cannot simulate.
        what: &'static str,
    },
    /// The tolerance of the solver is not possible.
    #[error("the tolerance is {found}, but must be from {least} to {most}")]
    Tolerance {
        /// The number found.
        found: f64,
        /// The smallest possible.
        least: f64,
        /// The largest possible.
        most: f64,
    },
    /// The solver of a motion cannot continue.
    #[error("the motion cannot be computed beyond {time_s} s: the step was {step_s} s there")]
    NotFollowed {
        /// Time from the motion's start \[s\].
        time_s: f64,
        /// The step that was tried \[s\].
        step_s: f64,
    },
    /// The state is no longer finite.
    #[error("the motion is no longer finite {time_s} s after its start")]
    Lost {
        /// Time at which this was detected \[s\].
        time_s: f64,
    },
    /// The multisine has no lines.
    #[error("the multisine has no lines")]
    NoLines,
    /// An odd multisine cannot have this line.
    #[error(
        "line {found} of the multisine is not possible: lines must be odd, increase, and be at most {most}"
    )]
    Line {
        /// The line.
        found: u32,
        /// The highest possible.
        most: u32,
    },
    /// The reference has frequencies above the Nyquist frequency.
    #[error(
        "the reference goes up to {omega_rad_s} rad/s, but the Nyquist frequency is {nyquist_rad_s} rad/s"
    )]
    AboveNyquist {
        /// Highest frequency of the reference \[rad/s\].
        omega_rad_s: f64,
        /// π over the time between two actions of the controller \[rad/s\].
        nyquist_rad_s: f64,
    },
    /// A run has too many samples.
    #[error("{quantity} takes {samples} samples, but at most {most} are simulated")]
    TooLong {
        /// The quantity that needs them.
        quantity: &'static str,
        /// Number of samples needed.
        samples: f64,
        /// Largest number allowed.
        most: f64,
    },
    /// The static deflection for the initial state is not finite.
    #[error("the deflection under a tip force of {tip_force_n} N is not finite")]
    Deflection {
        /// The force \[N\].
        tip_force_n: f64,
    },
    /// The output of the controller is NaN or infinite.
    #[error("the output of the controller was {found} A at {time_s} s")]
    Controller {
        /// Its output \[A\].
        found: f64,
        /// Time \[s\].
        time_s: f64,
    },
    /// The loop is unstable: the angle of the motor grew beyond a bound.
    #[error(
        "the loop is unstable: the motor was at {angle_rad} rad after {time_s} s, beyond {bound_rad} rad"
    )]
    Unstable {
        /// Angle reached \[rad\].
        angle_rad: f64,
        /// The bound \[rad\].
        bound_rad: f64,
        /// Time at which this was detected, from the start of the loop \[s\].
        time_s: f64,
        /// State at that time, `[θ_m, θ̇_m, θ_i.., θ̇_i..]` \[rad, rad/s\].
        state: Vec<f64>,
    },
    /// The log does not make a valid run.
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
