//! The error type of this crate: one variant for each module.

use thiserror::Error;

use crate::arm::ArmBuildError;
use crate::beam::BeamError;
use crate::drive::DriveError;
use crate::identify::{EquivalentError, IdentifyError, SharedPolesError, ValidationError};
use crate::plan::PlanError;
use crate::record::RecordError;
use crate::record::clock::ClockError;
use crate::rig::RigError;
use crate::spectrum::SteadyError;

/// Any error of this crate.
///
/// Each function returns the error type of its own module, which lists what can fail there. The operator `?` converts
/// it to this type.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Error {
    /// A beam cannot be built from these numbers.
    #[error(transparent)]
    Beam(#[from] BeamError),
    /// A motor or a friction law cannot be built from these numbers.
    #[error(transparent)]
    Drive(#[from] DriveError),
    /// A rig cannot be built, or an experiment cannot be run on it.
    #[error(transparent)]
    Rig(#[from] RigError),
    /// Channels do not make a run or a campaign.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// Time stamps are not usable.
    #[error(transparent)]
    Clock(#[from] ClockError),
    /// A record is not periodic.
    #[error(transparent)]
    Steady(#[from] SteadyError),
    /// A campaign cannot be identified at all.
    #[error(transparent)]
    Identify(#[from] IdentifyError),
    /// A result cannot be compared with the given logs.
    #[error(transparent)]
    Validation(#[from] ValidationError),
    /// No equivalent arm can be computed from the responses.
    #[error(transparent)]
    Equivalent(#[from] EquivalentError),
    /// No common poles can be fitted to the responses.
    #[error(transparent)]
    SharedPoles(#[from] SharedPolesError),
    /// No plan can be made for this arm.
    #[error(transparent)]
    Plan(#[from] PlanError),
}

impl From<ArmBuildError> for Error {
    fn from(error: ArmBuildError) -> Self {
        match error {
            ArmBuildError::Beam(error) => Self::Beam(error),
            ArmBuildError::Drive(error) => Self::Drive(error),
        }
    }
}
