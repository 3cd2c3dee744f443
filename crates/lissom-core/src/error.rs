//! The one error of this crate: what each part can refuse.

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

/// Any error of this crate. Functions return the error of their own part, which says all that can go wrong there;
/// each becomes this one by `?`.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Error {
    /// Numbers that make no beam.
    #[error(transparent)]
    Beam(#[from] BeamError),
    /// Numbers that make no motor or no friction.
    #[error(transparent)]
    Drive(#[from] DriveError),
    /// A rig or an experiment that cannot be.
    #[error(transparent)]
    Rig(#[from] RigError),
    /// Channels that make no run or no campaign.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// Time stamps that make no clock.
    #[error(transparent)]
    Clock(#[from] ClockError),
    /// A record that is not periodic.
    #[error(transparent)]
    Steady(#[from] SteadyError),
    /// A campaign that cannot be identified at all.
    #[error(transparent)]
    Identify(#[from] IdentifyError),
    /// A result that cannot be compared with logs.
    #[error(transparent)]
    Validation(#[from] ValidationError),
    /// Responses that make no equivalent arm.
    #[error(transparent)]
    Equivalent(#[from] EquivalentError),
    /// Responses without poles in common.
    #[error(transparent)]
    SharedPoles(#[from] SharedPolesError),
    /// Runs that cannot be planned.
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
