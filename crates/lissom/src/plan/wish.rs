//! What a plan is to reach, and within which bounds.

use crate::replay::{ModalArm, Parameter};

/// A figure of an arm whose precision may be wished for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Figure {
    /// Coulomb friction, mean of both directions.
    Coulomb,
    /// Viscous friction.
    Viscous,
    /// Inertia of the motor's side.
    Inertia,
    /// Coupling between motor and beam.
    Coupling,
    /// Frequency of a mode, motor clamped.
    Frequency(usize),
    /// Damping of a mode, of the kind that it has: against the fixed frame or within the beam.
    Damping(usize),
}

impl Figure {
    /// All that an arm has.
    pub(super) fn of(arm: &ModalArm) -> Vec<Self> {
        let mut all = vec![Self::Coulomb, Self::Viscous, Self::Inertia];
        if !arm.modes.is_empty() {
            all.push(Self::Coupling);
        }
        all.extend((0..arm.modes.len()).map(Self::Frequency));
        all.extend((0..arm.modes.len()).map(Self::Damping));
        all.retain(|figure| figure.value(arm) > 0.0);
        all
    }

    /// What it is called.
    pub fn name(self) -> String {
        match self {
            Self::Coulomb => "Coulomb friction".to_owned(),
            Self::Viscous => "viscous friction".to_owned(),
            Self::Inertia => "inertia".to_owned(),
            Self::Coupling => "coupling".to_owned(),
            Self::Frequency(j) => format!("frequency of mode {}", j + 1),
            Self::Damping(j) => format!("damping of mode {}", j + 1),
        }
    }

    /// Its value in SI.
    pub fn value(self, arm: &ModalArm) -> f64 {
        match self {
            Self::Coulomb => arm.coulomb_nm,
            Self::Viscous => Parameter::Viscous.of(arm),
            Self::Inertia => arm.inertia_kg_m2,
            Self::Coupling => arm.coupling_nm_per_rad(),
            Self::Frequency(j) => arm.modes[j].omega_rad_s,
            Self::Damping(j) => arm.modes[j].within_per_s + arm.modes[j].grounded_per_s,
        }
    }

    /// Its derivative by a parameter; damping against the fixed frame stands for all of a mode that has
    /// some.
    pub(super) fn slope(self, arm: &ModalArm, parameter: Parameter) -> f64 {
        let of = match (self, parameter) {
            (Self::Coulomb, Parameter::Coulomb)
            | (Self::Viscous, Parameter::Viscous)
            | (Self::Inertia, Parameter::Inertia)
            | (Self::Coupling, Parameter::Stiffness(_)) => true,
            (Self::Frequency(j), Parameter::Frequency(k))
            | (Self::Damping(j), Parameter::DampingGrounded(k)) => j == k,
            (Self::Damping(j), Parameter::DampingWithin(k)) => {
                j == k && arm.modes[j].grounded_per_s <= 0.0
            }
            _ => false,
        };
        f64::from(of)
    }
}

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
}

/// Damping wanted where nothing else is said. Damping of one kind that is taken for the other puts viscous
/// friction off, and identification tells them apart only where that matters to the residual: at 4 % it
/// did, at 14 % it did not (`docs/planning.md`).
const DAMPING: f64 = 0.05;

impl Default for Precision {
    /// 0.5 %, viscous friction 2 %, frequencies 0.1 %, damping 5 %.
    fn default() -> Self {
        Self {
            coulomb: 5e-3,
            viscous: 2e-2,
            inertia: 5e-3,
            coupling: 5e-3,
            frequency: 1e-3,
            damping: DAMPING,
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
            damping: DAMPING,
        }
    }

    /// What is wanted of a figure.
    pub fn of(&self, figure: Figure) -> f64 {
        match figure {
            Figure::Coulomb => self.coulomb,
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
