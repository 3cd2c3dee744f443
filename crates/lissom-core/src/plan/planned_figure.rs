//! What a plan may be asked to find.

use crate::information::Figure;
use crate::replay::Parameter;

/// Something whose precision can be asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum PlannedFigure {
    /// Of the arm.
    Arm(Figure),
    /// m·g·l, the amplitude of gravity.
    Gravity,
}

impl PlannedFigure {
    /// What it is called.
    pub fn name(self) -> String {
        match self {
            Self::Arm(figure) => figure.name(),
            Self::Gravity => "gravity".to_owned(),
        }
    }
}

/// Something that an identification has to find.
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
    /// Its name in results.
    pub fn name(self) -> String {
        match self {
            Self::Arm(parameter) => parameter.name(),
            Self::GravitySine => "gravity-sine".to_owned(),
            Self::GravityCosine => "gravity-cosine".to_owned(),
        }
    }
}
