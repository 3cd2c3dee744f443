//! The error type of the whole crate.

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

/// Any error of this crate. Functions return the error of their own module; the operator `?` converts each of them to this
/// one.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Error {
    /// Invalid parameters of a beam.
    #[error(transparent)]
    Beam(#[from] BeamError),
    /// Invalid parameters of a motor or of friction.
    #[error(transparent)]
    Drive(#[from] DriveError),
    /// A rig or an experiment that is not possible.
    #[error(transparent)]
    Rig(#[from] RigError),
    /// Channels that do not make a valid run or campaign.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// Time stamps from which no clock can be derived.
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
    /// Responses that do not give an equivalent arm.
    #[error(transparent)]
    Equivalent(#[from] EquivalentError),
    /// Responses to which shared poles cannot be fitted.
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
