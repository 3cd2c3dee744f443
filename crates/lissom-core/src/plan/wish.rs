//! Requested precision of a plan, and its limits.

use crate::information::ArmParameter;
use crate::plan::thresholds::DAMPING_WISHED;

/// Requested standard errors, relative to the parameters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Precision {
    /// Standard error of Coulomb friction.
    pub coulomb: f64,
    /// Standard error of viscous friction.
    pub viscous: f64,
    /// Standard error of inertia.
    pub inertia: f64,
    /// Standard error of coupling.
    pub coupling: f64,
    /// Standard error of each frequency.
    pub frequency: f64,
    /// Standard error of each mode's damping.
    pub damping: f64,
    /// Standard error of the amplitude of gravity.
    pub gravity: f64,
}

impl Default for Precision {
    /// 0.5 %, viscous friction 2 %, frequencies 0.1 %, damping 5 %.
    fn default() -> Self {
        Self {
            coulomb: 5e-3,
            viscous: 2e-2,
            inertia: 5e-3,
            coupling: 5e-3,
            frequency: 1e-3,
            damping: DAMPING_WISHED,
            gravity: 5e-3,
        }
    }
}

impl Precision {
    /// The same precision for all parameters except damping.
    pub fn all(relative: f64) -> Self {
        Self {
            coulomb: relative,
            viscous: relative,
            inertia: relative,
            coupling: relative,
            frequency: relative,
            damping: DAMPING_WISHED,
            gravity: relative,
        }
    }

    /// Requested precision of a parameter.
    pub fn of(&self, parameter: ArmParameter) -> f64 {
        match parameter {
            ArmParameter::Coulomb | ArmParameter::Offset => self.coulomb,
            ArmParameter::Viscous => self.viscous,
            ArmParameter::Inertia => self.inertia,
            ArmParameter::Coupling => self.coupling,
            ArmParameter::Frequency(_) => self.frequency,
            ArmParameter::Damping(_) => self.damping,
        }
    }
}

/// Kinds of runs that a plan may contain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Kinds {
    /// Only sines, each with a sine at three times its frequency if the rig can follow it; at least one such pair.
    Sines,
    /// At least one pair of sines at a frequency and three times that frequency, which the third-harmonic method needs;
    /// otherwise the runs that take the shortest time.
    #[default]
    WithPair,
    /// The runs that take the shortest time.
    Any,
}

/// Requested precision of a plan, and its limits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wishes {
    /// Requested standard errors.
    pub precision: Precision,
    /// Longest time of all runs together, including waiting for transients \[s\].
    pub within_s: f64,
    /// Largest angle of the motor from its start \[rad\].
    pub travel_rad: f64,
    /// Largest deflection of a tip from the motor's line \[rad\].
    pub bend_rad: f64,
    /// Share of the current limit that is kept in reserve, because the true arm may need it.
    pub current_reserve: f64,
    /// Kinds of runs.
    pub kinds: Kinds,
}

impl Default for Wishes {
    /// The default precision within half an hour, 1 rad of travel, 0.5 rad of bending, 30 % of the
    /// current in reserve.
    fn default() -> Self {
        Self {
            precision: Precision::default(),
            within_s: 1800.0,
            travel_rad: 1.0,
            bend_rad: 0.5,
            current_reserve: 0.3,
            kinds: Kinds::default(),
        }
    }
}
