//! The parameters of a drive.

use std::fmt;

/// A parameter of a drive.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DriveParameter {
    /// Coulomb friction, by least squares.
    Coulomb,
    /// Viscous friction, by least squares.
    Viscous,
    /// Inertia of all rotating parts.
    Inertia,
    /// Largest torque of gravity.
    Gravity,
    /// Constant load.
    Load,
}

impl DriveParameter {
    /// All parameters.
    pub const ALL: [Self; 5] =
        [Self::Coulomb, Self::Viscous, Self::Inertia, Self::Gravity, Self::Load];

    /// Its key in the list of results that a finding affects.
    pub(crate) fn key(self) -> &'static str {
        match self {
            Self::Coulomb => "friction.coulomb",
            Self::Viscous => "friction.viscous",
            Self::Inertia => "drive.inertia",
            Self::Gravity => "gravity",
            Self::Load => "friction.offset",
        }
    }
}

impl fmt::Display for DriveParameter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Coulomb => "coulomb",
            Self::Viscous => "viscous",
            Self::Inertia => "inertia",
            Self::Gravity => "gravity",
            Self::Load => "load",
        })
    }
}
