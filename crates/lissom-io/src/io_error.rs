//! The error type of the crate.

use lissom_core::record::RecordError;
use thiserror::Error;

use crate::config::ConfigError;
use crate::export::ExportError;
use crate::inspect::DraftError;
use crate::log::LogError;
use crate::model::frequency_file::FrequencyError;
use crate::responses::ResponseError;
use crate::result::ComparisonError;
use crate::result::result_error::ResultError;
use crate::units::UnitError;
use crate::write::WriteError;

/// Any error in reading or writing files.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// A quantity or unit is wrong.
    #[error(transparent)]
    Unit(#[from] UnitError),
    /// A log cannot be used.
    #[error(transparent)]
    Log(#[from] LogError),
    /// A campaign.toml, arm.toml or other file of keys and values cannot be used.
    #[error(transparent)]
    Config(#[from] ConfigError),
    /// A list of frequencies cannot be used.
    #[error(transparent)]
    Frequencies(#[from] FrequencyError),
    /// The runs do not form a campaign.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// Tables of frequency responses cannot be used.
    #[error(transparent)]
    Responses(#[from] ResponseError),
    /// A result cannot be used.
    #[error(transparent)]
    Result(#[from] ResultError),
    /// No campaign can be made of a log and of what the user says about it.
    #[error(transparent)]
    Draft(#[from] DraftError),
    /// Results cannot be compared.
    #[error(transparent)]
    Comparison(#[from] ComparisonError),
    /// A model cannot be exported.
    #[error(transparent)]
    Export(#[from] ExportError),
    /// A file cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
}

impl Error {
    /// What the user can do.
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::Unit(error) => error.hint(),
            Self::Log(error) => error.hint(),
            Self::Config(error) => error.hint(),
            Self::Frequencies(error) => error.hint(),
            Self::Responses(error) => error.hint(),
            Self::Result(error) => error.hint(),
            Self::Draft(error) => error.hint(),
            Self::Comparison(error) => error.hint(),
            Self::Export(error) => error.hint(),
            Self::Write(error) => error.hint(),
            // Readers do not create such runs: see [`LogError`] and [`ConfigError`].
            Self::Record(_) => None,
        }
    }
}
