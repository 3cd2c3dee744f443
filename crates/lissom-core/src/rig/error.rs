//! Why a rig cannot be built, or an experiment cannot be run.

use thiserror::Error;

/// Why an experiment cannot be made or carried out.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum RigError {
    /// A quantity that must be positive is not.
    #[error("{quantity} = {found} is not positive and finite")]
    NotPositive {
        /// Which quantity, with its unit.
        quantity: &'static str,
        /// The number found.
        found: f64,
    },
    /// A quantity that must not be negative is.
    #[error("{quantity} = {found} is negative or not finite")]
    Negative {
        /// Which quantity, with its unit.
        quantity: &'static str,
        /// The number found.
        found: f64,
    },
    /// A number that must be finite is not.
    #[error("{quantity} = {found} is not finite")]
    NotFinite {
        /// Which quantity, with its unit.
        quantity: &'static str,
        /// The number found.
        found: f64,
    },
    /// A converter with no or too many bits.
    #[error("a converter of {found} bits; 1 to 32 are possible")]
    Bits {
        /// Bits asked for.
        found: u32,
    },
    /// Neither no, one nor as many tip sensors as the beam has masses.
    #[error(
        "{found} tip sensors on a beam of {masses} masses; give none, one for all, or {masses}"
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
    /// Masses that the beam does not have.
    #[error("tips {} to {} of a beam with {masses} masses; tips are counted from 0", found.start, found.end)]
    TipRange {
        /// The masses asked for.
        found: std::ops::Range<usize>,
        /// Masses of the beam.
        masses: usize,
    },
    /// An arm that changes too fast for its sample time to be simulated.
    #[error(
        "the arm changes at rates up to {rate_per_s:.1e} 1/s, {steps:.1e} steps in a sample of {sample_time_s} s; {most:.0e} are possible"
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
    /// Time stamps that may be later than the next row's.
    #[error(
        "time stamps late by up to {most_s} s, and rows every {log_time_s} s: stamps must increase"
    )]
    LateStamps {
        /// The largest lateness \[s\].
        most_s: f64,
        /// Time between two rows \[s\].
        log_time_s: f64,
    },
    /// Friction that wanders too far.
    #[error("friction wanders by a standard deviation of {found}; {most} at most is possible")]
    Wander {
        /// The relative standard deviation found \[1\].
        found: f64,
        /// The largest \[1\].
        most: f64,
    },
    /// A gain that the integers of the control computer do not hold.
    #[error("{quantity} is {found} in integers; they hold {most} at most")]
    Gain {
        /// Which gain.
        quantity: &'static str,
        /// Its size in integers.
        found: f64,
        /// The largest that fits.
        most: f64,
    },
    /// More bits behind the binary point than an integer has.
    #[error("a binary point of {found} bits; {most} at most are possible")]
    BinaryPoint {
        /// Bits asked for.
        found: u32,
        /// The most that there can be.
        most: u32,
    },
    /// A table without rows.
    #[error("the table has no rows")]
    EmptyTable,
    /// A table whose columns differ in length.
    #[error("the table has {times} times and {values} values")]
    TableLength {
        /// Number of times.
        times: usize,
        /// Number of values.
        values: usize,
    },
    /// A table holds NaN or infinity.
    #[error("row {row} of the table, {time_s} s and {value}, is not finite")]
    TableNotFinite {
        /// The row, from 0.
        row: usize,
        /// Its time \[s\].
        time_s: f64,
        /// Its value.
        value: f64,
    },
    /// Times of a table do not increase.
    #[error("time goes from {before_s} s to {after_s} s at row {row} of the table")]
    TableOrder {
        /// The later row, from 0.
        row: usize,
        /// Time of the row before \[s\].
        before_s: f64,
        /// Its time \[s\].
        after_s: f64,
    },
    /// Integer arithmetic beside a sensor or converter without steps.
    #[error("integer arithmetic needs a `{what}` with steps")]
    NeedsSteps {
        /// Which.
        what: &'static str,
    },
    /// Arms that take over from one another have different numbers of masses.
    #[error("an arm of {found} masses cannot take over from one of {expected}")]
    Masses {
        /// Masses of the first arm.
        expected: usize,
        /// Masses of the other.
        found: usize,
    },
    /// A start that is not a state of the arm.
    #[error("a start of {found} numbers; the arm's state has {expected}, all finite")]
    State {
        /// Numbers found.
        found: usize,
        /// Numbers that the state has.
        expected: usize,
    },
    /// The motor left its sensor's range, and the loop ran away without knowing where it was.
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
    /// What the rig cannot simulate.
    #[error("{what} cannot be simulated")]
    Unsupported {
        /// What.
        what: &'static str,
    },
    /// A tolerance that no solver is asked for.
    #[error("a tolerance of {found}; {least} to {most} are possible")]
    Tolerance {
        /// The number found.
        found: f64,
        /// The finest.
        least: f64,
        /// The coarsest.
        most: f64,
    },
    /// A motion that is solved step by step got nowhere.
    #[error("the motion cannot be followed beyond {time_s} s: the step there was {step_s} s")]
    NotFollowed {
        /// Time from the motion's start \[s\].
        time_s: f64,
        /// The step that was tried \[s\].
        step_s: f64,
    },
    /// The state is no number any more.
    #[error("the motion left the range of numbers {time_s} s after its start")]
    Lost {
        /// When it was noticed \[s\].
        time_s: f64,
    },
    /// A multisine without lines.
    #[error("the multisine has no lines")]
    NoLines,
    /// A line that an odd multisine cannot have.
    #[error("line {found} of the multisine: lines are odd, increase and go up to {most}")]
    Line {
        /// The line.
        found: u32,
        /// The highest possible.
        most: u32,
    },
    /// A reference that the sample time cannot carry.
    #[error(
        "the reference goes up to {omega_rad_s} rad/s; the Nyquist frequency is {nyquist_rad_s} rad/s"
    )]
    AboveNyquist {
        /// Highest frequency of the reference \[rad/s\].
        omega_rad_s: f64,
        /// π over the time between two actions of the controller \[rad/s\].
        nyquist_rad_s: f64,
    },
    /// More samples than a run is let have.
    #[error("{quantity} takes {samples} samples; {most} at most are simulated")]
    TooLong {
        /// What takes them.
        quantity: &'static str,
        /// Samples needed.
        samples: f64,
        /// The most that are allowed.
        most: f64,
    },
    /// The beam's statics could not be solved for a start from a deflection.
    #[error("the deflection under a tip force of {tip_force_n} N is not finite")]
    Deflection {
        /// The force \[N\].
        tip_force_n: f64,
    },
    /// A controller gave NaN or infinity.
    #[error("the controller gave {found} A at {time_s} s")]
    Controller {
        /// What it gave \[A\].
        found: f64,
        /// When \[s\].
        time_s: f64,
    },
    /// The loop ran away: the motor left the range in which angles mean anything.
    #[error(
        "the loop is unstable: the motor was at {angle_rad} rad after {time_s} s, beyond {bound_rad} rad"
    )]
    Unstable {
        /// Angle reached \[rad\].
        angle_rad: f64,
        /// The bound that it left \[rad\].
        bound_rad: f64,
        /// Time at which it was noticed, from the start of the loop \[s\].
        time_s: f64,
        /// State at that time, `[θ_m, θ̇_m, θ_i.., θ̇_i..]` \[rad, rad/s\].
        state: Vec<f64>,
    },
    /// The log could not be made into a run.
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
