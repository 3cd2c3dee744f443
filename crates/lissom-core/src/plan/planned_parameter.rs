//! Parameters that a plan can be asked for.

use crate::information::ArmParameter;
use crate::replay::Parameter;

/// A parameter whose precision can be requested.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum PlannedParameter {
    /// A parameter of the arm.
    Arm(ArmParameter),
    /// m·g·l, the amplitude of gravity.
    Gravity,
}

impl PlannedParameter {
    /// Name in texts.
    pub fn name(self) -> String {
        match self {
            Self::Arm(parameter) => parameter.name(),
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
