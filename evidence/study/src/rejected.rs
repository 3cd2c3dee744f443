//! Reasons why runs and draws are given up.

use std::fmt;

use lissom::beam::BeamError;
use lissom::drive::DriveError;
use lissom::rig::RigError;
use serde::{Deserialize, Serialize};

/// The reason why a run was given up.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Dropped {
    /// The loop is unstable.
    Unstable,
    /// The joint sticks for more than 15 % at every allowed amplitude.
    Sticks,
    /// The motor moves by less than 20 steps of its encoder.
    TooSmall,
    /// The amplifier saturates; with a smaller amplitude the joint sticks or the encoder is too coarse.
    Current,
    /// The beam bends too far; with a smaller amplitude the joint sticks or the encoder is too coarse.
    Bend,
    /// The rig cannot make the run.
    Impossible,
}

impl fmt::Display for Dropped {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Unstable => "the loop is unstable",
            Self::Sticks => "the joint sticks for more than 15 % at every allowed amplitude",
            Self::TooSmall => "the motor moves by less than 20 steps of its encoder",
            Self::Current => {
                "the amplifier saturates; with a smaller amplitude the joint sticks or the encoder is too coarse"
            }
            Self::Bend => {
                "the beam bends too far; with a smaller amplitude the joint sticks or the encoder is too coarse"
            }
            Self::Impossible => "the rig cannot make the run",
        })
    }
}

impl Dropped {
    /// Whether the run is tried with a smaller amplitude next.
    pub(crate) fn is_too_large(self) -> bool {
        matches!(self, Self::Current | Self::Bend)
    }
}

/// The reason why a draw was rejected.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Rejected {
    /// The highest mode of the beam has fewer than six samples in a period.
    FastMode,
    /// No loop is stable with a margin and insensitive enough to the encoder's steps.
    NoLoop,
    /// Too few runs were good; with the most frequent reason of the others.
    FewRuns(Dropped),
    /// Friction is below 5 % or above 60 % of the peak torque that was reached.
    CoulombShare,
    /// The numbers do not make a valid rig.
    Impossible(String),
}

impl fmt::Display for Rejected {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::FastMode => {
                f.write_str("the highest mode has fewer than six samples in a period")
            }
            Self::NoLoop => f.write_str(
                "no loop is stable with a margin and insensitive enough to the encoder's steps",
            ),
            Self::FewRuns(why) => write!(f, "too few good runs: {why}"),
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
