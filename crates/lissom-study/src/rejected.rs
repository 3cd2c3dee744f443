//! Why runs and draws are given up.

use std::fmt;

use lissom::beam::BeamError;
use lissom::drive::DriveError;
use lissom::rig::RigError;
use serde::{Deserialize, Serialize};

/// Why a run was given up.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Dropped {
    /// The loop ran away.
    Unstable,
    /// The joint sticks for more than 15 % however large the run may be.
    Sticks,
    /// The motor moves by less than 20 steps of its encoder.
    TooSmall,
    /// The amplifier limits it, and smaller the joint sticks or the encoder is too coarse.
    Current,
    /// The beam bends too far, and smaller the joint sticks or the encoder is too coarse.
    Bend,
    /// The rig cannot do it.
    Impossible,
}

impl fmt::Display for Dropped {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Unstable => "the loop ran away",
            Self::Sticks => "sticks for more than 15 % at any amplitude allowed",
            Self::TooSmall => "less than 20 steps of the motor's encoder",
            Self::Current => "the amplifier limits it, and smaller it sticks or is too coarse",
            Self::Bend => "the beam bends too far, and smaller it sticks or is too coarse",
            Self::Impossible => "the rig cannot do it",
        })
    }
}

impl Dropped {
    /// Whether a smaller run is tried next.
    pub(crate) fn is_too_large(self) -> bool {
        matches!(self, Self::Current | Self::Bend)
    }
}

/// Why a draw was rejected.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Rejected {
    /// The beam's last mode has fewer than six samples a period.
    FastMode,
    /// No loop is stable with a margin and quiet enough for the encoder.
    NoLoop,
    /// Too few runs were sound; the commonest reason of those given up.
    FewRuns(Dropped),
    /// Friction is below 5 % or above 60 % of the peak torque that was reached.
    CoulombShare,
    /// The numbers cannot make a rig.
    Impossible(String),
}

impl fmt::Display for Rejected {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::FastMode => f.write_str("last mode has fewer than six samples a period"),
            Self::NoLoop => f.write_str("no loop is stable with a margin and quiet enough"),
            Self::FewRuns(why) => write!(f, "too few sound runs: {why}"),
            Self::CoulombShare => {
                f.write_str("friction below 5 % or above 60 % of the peak torque")
            }
            Self::Impossible(why) => write!(f, "cannot be built: {why}"),
        }
    }
}

impl From<BeamError> for Rejected {
    fn from(error: BeamError) -> Self {
        Self::Impossible(error.to_string())
    }
}

impl From<DriveError> for Rejected {
    fn from(error: DriveError) -> Self {
        Self::Impossible(error.to_string())
    }
}

impl From<RigError> for Rejected {
    fn from(error: RigError) -> Self {
        Self::Impossible(error.to_string())
    }
}

impl From<lissom::Error> for Rejected {
    fn from(error: lissom::Error) -> Self {
        Self::Impossible(error.to_string())
    }
}
