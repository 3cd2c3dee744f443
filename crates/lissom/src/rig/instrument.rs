//! The instrument chain of 6.1: sensors and the sampled controller.

use thiserror::Error;

/// Why numbers cannot make a rig.
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
    /// A number that is none.
    #[error("{quantity} = {found} is not finite")]
    NotFinite {
        /// Which quantity, with its unit.
        quantity: &'static str,
        /// The number found.
        found: f64,
    },
    /// A start that is not a state of the arm.
    #[error("a start of {found} numbers; the arm's state has {expected}, all finite")]
    State {
        /// Numbers found.
        found: usize,
        /// Numbers that the state has.
        expected: usize,
    },
    /// A sensor with no or too many bits.
    #[error("a sensor of {found} bits; 1 to 32 are possible")]
    Bits {
        /// Bits asked for.
        found: u32,
    },
    /// The log could not be made into a run.
    #[error(transparent)]
    Record(#[from] crate::record::RecordError),
    /// The loop ran away: the motor left the range in which angles mean anything.
    #[error("the loop is unstable: the motor was at {angle_rad} rad after {time_s} s")]
    Unstable {
        /// Angle reached \[rad\].
        angle_rad: f64,
        /// Time at which it was noticed \[s\].
        time_s: f64,
    },
}

/// A sensor or converter that rounds to steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quantiser {
    step: f64,
}

impl Quantiser {
    /// `bits` over `range`: steps of `range/2^bits`, in the unit of the range.
    ///
    /// # Errors
    /// [`RigError`] unless the range is positive and there are 1 to 32 bits.
    pub fn new(bits: u32, range: f64) -> Result<Self, RigError> {
        if !(range > 0.0 && range.is_finite()) {
            return Err(RigError::NotPositive { quantity: "range of a sensor", found: range });
        }
        if !(1..=32).contains(&bits) {
            return Err(RigError::Bits { found: bits });
        }
        Ok(Self { step: range / (1_u64 << bits) as f64 })
    }

    /// The nearest step.
    pub fn read(&self, value: f64) -> f64 {
        (value / self.step).round() * self.step
    }

    /// The step \[unit of the range\].
    pub fn step(&self) -> f64 {
        self.step
    }
}

/// Proportional-plus-derivative position loop: `i = k_p·e + k_d·(e_k − e_{k−1})/T`.
///
/// # Source
/// `[Feliu1989, Section 5.1]`
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pd {
    /// Proportional gain \[A/rad\].
    pub proportional_a_per_rad: f64,
    /// Derivative gain \[A·s/rad\].
    pub derivative_a_s_per_rad: f64,
    /// The amplifier's limit \[A\].
    pub limit_a: f64,
}

impl Pd {
    /// Current for the error now and the one a sample ago, limited \[A\].
    pub fn current_a(&self, error: f64, error_before: f64, sample_time_s: f64) -> f64 {
        let demand = self.proportional_a_per_rad * error
            + self.derivative_a_s_per_rad * (error - error_before) / sample_time_s;
        demand.clamp(-self.limit_a, self.limit_a)
    }
}
