//! What a plan is to reach, and within which bounds.

use crate::information::Figure;
use crate::plan::thresholds::DAMPING_WISHED;

/// Wanted standard deviations, relative to the figures.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Precision {
    /// Of Coulomb friction.
    pub coulomb: f64,
    /// Of viscous friction.
    pub viscous: f64,
    /// Of the inertia.
    pub inertia: f64,
    /// Of the coupling.
    pub coupling: f64,
    /// Of each frequency.
    pub frequency: f64,
    /// Of each mode's damping.
    pub damping: f64,
    /// Of the amplitude of gravity.
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
    /// The same for all figures but damping.
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

    /// What is wanted of a figure.
    pub fn of(&self, figure: Figure) -> f64 {
        match figure {
            Figure::Coulomb | Figure::Offset => self.coulomb,
            Figure::Viscous => self.viscous,
            Figure::Inertia => self.inertia,
            Figure::Coupling => self.coupling,
            Figure::Frequency(_) => self.frequency,
            Figure::Damping(_) => self.damping,
        }
    }
}

/// Which runs a plan may hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Kinds {
    /// Sines alone, each with its triple where that can be driven, and at least one that has it.
    Sines,
    /// At least one sine with its triple, which the third-harmonic method needs; else whatever takes
    /// the least time.
    #[default]
    WithPair,
    /// Whatever takes the least time.
    Any,
}

/// What a plan is to reach, and within which bounds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wishes {
    /// Wanted deviations.
    pub precision: Precision,
    /// Longest time of all runs together, with what they wait for a transient \[s\].
    pub within_s: f64,
    /// The motor turns no further than this from where it begins \[rad\].
    pub travel_rad: f64,
    /// A tip bends no further than this from the motor's line \[rad\].
    pub bend_rad: f64,
    /// Share of the current's limit that is not planned for: the true arm may need it.
    pub current_reserve: f64,
    /// Which runs.
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
