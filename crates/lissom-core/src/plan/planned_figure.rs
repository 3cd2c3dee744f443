//! Parameters that a plan can be asked for.

use crate::information::Figure;
use crate::replay::Parameter;

/// A parameter whose precision can be requested.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum PlannedFigure {
    /// A parameter of the arm.
    Arm(Figure),
    /// m·g·l, the amplitude of gravity.
    Gravity,
}

impl PlannedFigure {
    /// Name in texts.
    pub fn name(self) -> String {
        match self {
            Self::Arm(figure) => figure.name(),
            Self::Gravity => "gravity".to_owned(),
        }
    }
}

/// An unknown of the identification.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum PlannedUnknown {
    /// A parameter of the arm.
    Arm(Parameter),
    /// g_s: gravity per sin θ.
    GravitySine,
    /// g_c: gravity per cos θ.
    GravityCosine,
}

impl PlannedUnknown {
    /// Name in results.
    pub fn name(self) -> String {
        match self {
            Self::Arm(parameter) => parameter.name(),
            Self::GravitySine => "gravity-sine".to_owned(),
            Self::GravityCosine => "gravity-cosine".to_owned(),
        }
    }
}
