//! The estimated parameters, by name.

use std::fmt;

use serde::{Deserialize, Serialize};

/// A parameter that identification estimates.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum ScoredParameter {
    /// Coulomb friction.
    Coulomb,
    /// Inertia of the motor's side.
    Inertia,
    /// Coulomb friction while moving forward.
    Forward,
    /// Coulomb friction while moving backward.
    Backward,
    /// Coupling h_{n+1}.
    Coupling,
    /// Viscous friction.
    Viscous,
    /// Natural frequency of mode k, from 0.
    Frequency(usize),
    /// Damping ratio of mode k, from 0.
    Damping(usize),
}

impl ScoredParameter {
    /// Its key in the list of results that a finding affects.
    pub(crate) fn key(self) -> &'static str {
        match self {
            Self::Coulomb | Self::Forward | Self::Backward => "friction.coulomb",
            Self::Inertia => "drive.inertia",
            Self::Coupling => "beam.coupling",
            Self::Viscous => "friction.viscous",
            Self::Frequency(_) | Self::Damping(_) => "beam.modes",
        }
    }

    /// Relative error that the goals of the project allow, if there is a goal.
    pub fn bar(self) -> Option<f64> {
        match self {
            Self::Coulomb | Self::Forward | Self::Backward | Self::Inertia | Self::Coupling => {
                Some(0.01)
            }
            Self::Viscous => Some(0.05),
            Self::Frequency(_) => Some(0.002),
            Self::Damping(_) => None,
        }
    }
}

impl fmt::Display for ScoredParameter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Coulomb => f.write_str("Coulomb friction"),
            Self::Forward => f.write_str("Coulomb friction forward"),
            Self::Backward => f.write_str("Coulomb friction backward"),
            Self::Inertia => f.write_str("inertia"),
            Self::Coupling => f.write_str("coupling"),
            Self::Viscous => f.write_str("viscous friction"),
            Self::Frequency(k) => write!(f, "frequency {}", k + 1),
            Self::Damping(k) => write!(f, "damping ratio {}", k + 1),
        }
    }
}
