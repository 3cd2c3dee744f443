//! What is asked of a drive.

use std::fmt;

/// A parameter of a drive.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DriveParameter {
    /// Coulomb friction of the line.
    Coulomb,
    /// Viscous friction of the line.
    Viscous,
    /// All that turns.
    Inertia,
    /// Largest torque of gravity.
    Gravity,
    /// Constant load.
    Load,
}

impl DriveParameter {
    /// All of them.
    pub const ALL: [Self; 5] =
        [Self::Coulomb, Self::Viscous, Self::Inertia, Self::Gravity, Self::Load];

    /// How findings name it.
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
