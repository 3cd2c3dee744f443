//! The error type of a program that uses lissom.

use thiserror::Error;

/// Any error of lissom: of the numerical core, or of a file.
///
/// ```
/// use lissom::prelude::*;
/// fn inertia_of(log: &std::path::Path) -> Result<Option<Estimate>, lissom::Error> {
///     let logs = read_campaign(log)?;
///     Ok(Identify::of_file(&logs).run()?.inertia())
/// }
/// let error = inertia_of("no/campaign.toml".as_ref()).unwrap_err();
/// assert!(error.to_string().starts_with("no/campaign.toml"));
/// assert!(error.hint().is_some());
/// ```
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// The numerical core reports an error: parameters, an experiment, runs or options are not valid.
    #[error(transparent)]
    Core(lissom_core::Error),
    /// A file cannot be read or written.
    #[error(transparent)]
    File(#[from] lissom_io::Error),
}

impl Error {
    /// What to do about the error, if there is a hint.
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::Core(_) => None,
            Self::File(error) => error.hint(),
        }
    }
}

macro_rules! from_core {
    ($($source:ty),+ $(,)?) => {$(
        impl From<$source> for Error {
            fn from(error: $source) -> Self {
                Self::Core(error.into())
            }
        }
    )+};
}

macro_rules! from_file {
    ($($source:ty),+ $(,)?) => {$(
        impl From<$source> for Error {
            fn from(error: $source) -> Self {
                Self::File(error.into())
            }
        }
    )+};
}

from_file!(
    lissom_io::export::ExportError,
    lissom_io::inspect::DraftError,
    lissom_io::result::ComparisonError,
    lissom_io::ConfigError,
    lissom_io::FrequencyError,
    lissom_io::LogError,
    lissom_io::ResponseError,
    lissom_io::ResultError,
    lissom_io::UnitError,
    lissom_io::WriteError,
);

from_core!(
    lissom_core::Error,
    lissom_core::arm::ArmBuildError,
    lissom_core::beam::BeamError,
    lissom_core::drive::DriveError,
    lissom_core::identify::EquivalentError,
    lissom_core::identify::IdentifyError,
    lissom_core::identify::SharedPolesError,
    lissom_core::identify::ValidationError,
    lissom_core::plan::PlanError,
    lissom_core::record::RecordError,
    lissom_core::record::clock::ClockError,
    lissom_core::rig::RigError,
    lissom_core::spectrum::SteadyError,
);
