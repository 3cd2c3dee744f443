//! Controllers of the motor's angle, and the trait for controllers of your own.

mod derivative;
mod integer;
mod pd;
mod pid;
mod proportional;
#[cfg(test)]
mod tests;

pub use integer::{IntegerPd, Word};
pub use pd::Pd;
pub use pid::Pid;
pub use proportional::Proportional;

/// What a controller can read at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sensed<'a> {
    /// Time on the clock of the reference \[s\]. While the loop waits at the first value of a reference that is not
    /// periodic, time since the wait began.
    pub time_s: f64,
    /// Time from one action of the controller to the next \[s\].
    pub period_s: f64,
    /// Desired angle of the motor \[rad\].
    pub reference_rad: f64,
    /// Angle of the motor as its sensor reads it \[rad\].
    pub motor_rad: f64,
    /// Angles of the masses as their sensors read them, from base to tip \[rad\].
    pub tips_rad: &'a [f64],
    /// Largest current of the amplifier \[A\]; infinite if it has no limit.
    pub limit_a: f64,
}

/// A sampled controller: it computes a current from angles.
///
/// ```
/// # use lissom::rig::{Controller, Sensed};
/// struct BangBang;
/// impl Controller for BangBang {
///     fn current_a(&mut self, now: &Sensed<'_>) -> f64 {
///         0.5_f64.copysign(now.reference_rad - now.motor_rad)
///     }
///     fn reset(&mut self) {}
/// }
/// ```
pub trait Controller {
    /// Current that the controller asks for \[A\]; the amplifier limits it. NaN and infinity end the run with an error.
    fn current_a(&mut self, now: &Sensed<'_>) -> f64;

    /// Resets the internal state; called before a run begins.
    fn reset(&mut self);

    /// Slowest time constant of the controller \[s\]. It helps to decide when a transient has decayed. Zero, the
    /// default, means that the decay rates of the arm decide alone.
    fn memory_s(&self) -> f64 {
        0.0
    }
}

/// Controllers that are part of the rig.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum ControlLaw {
    /// P control.
    Proportional(Proportional),
    /// PD control, as in the 1989 report.
    Pd(Pd),
    /// PID control.
    Pid(Pid),
    /// PD control in the integers of the control computer of the 1989 report.
    IntegerPd(IntegerPd),
}

impl Controller for ControlLaw {
    fn current_a(&mut self, now: &Sensed<'_>) -> f64 {
        match self {
            Self::Proportional(law) => law.current_a(now),
            Self::Pd(law) => law.current_a(now),
            Self::Pid(law) => law.current_a(now),
            Self::IntegerPd(law) => law.current_a(now),
        }
    }

    fn reset(&mut self) {
        match self {
            Self::Proportional(law) => law.reset(),
            Self::Pd(law) => law.reset(),
            Self::Pid(law) => law.reset(),
            Self::IntegerPd(law) => law.reset(),
        }
    }

    fn memory_s(&self) -> f64 {
        match self {
            Self::Proportional(law) => law.memory_s(),
            Self::Pd(law) => law.memory_s(),
            Self::Pid(law) => law.memory_s(),
            Self::IntegerPd(law) => law.memory_s(),
        }
    }
}

impl From<Proportional> for ControlLaw {
    fn from(law: Proportional) -> Self {
        Self::Proportional(law)
    }
}

impl From<Pd> for ControlLaw {
    fn from(law: Pd) -> Self {
        Self::Pd(law)
    }
}

impl From<Pid> for ControlLaw {
    fn from(law: Pid) -> Self {
        Self::Pid(law)
    }
}

impl From<IntegerPd> for ControlLaw {
    fn from(law: IntegerPd) -> Self {
        Self::IntegerPd(law)
    }
}
