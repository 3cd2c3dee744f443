//! Controllers of the motor's angle, and what a user's own has to do.

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

/// What a controller gets to know at an instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sensed<'a> {
    /// Time on the reference's clock \[s\]. While the loop waits at the first value of a reference
    /// that is not periodic, time since it began to.
    pub time_s: f64,
    /// Time from one action of the controller to the next \[s\].
    pub period_s: f64,
    /// Where the motor should be \[rad\].
    pub reference_rad: f64,
    /// Where its sensor says that it is \[rad\].
    pub motor_rad: f64,
    /// What the sensors of the masses' angles say, from base to tip \[rad\].
    pub tips_rad: &'a [f64],
    /// Largest current that the amplifier gives \[A\]; infinite where it has no limit.
    pub limit_a: f64,
}

/// A sampled controller: from angles to a demand of current.
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
    /// The demand of current \[A\]; the amplifier limits it. NaN and infinity end the run.
    fn current_a(&mut self, now: &Sensed<'_>) -> f64;

    /// Forgets all that came before: a run begins.
    fn reset(&mut self);

    /// The slowest time constant that the controller brings into the loop \[s\]. It helps to judge
    /// when a transient has gone; zero, the default, leaves that to the arm's own decays.
    fn memory_s(&self) -> f64 {
        0.0
    }
}

/// The controllers that come with the rig.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum ControlLaw {
    /// P.
    Proportional(Proportional),
    /// PD, as in the report.
    Pd(Pd),
    /// PID.
    Pid(Pid),
    /// PD in the integers of the report's computer.
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
