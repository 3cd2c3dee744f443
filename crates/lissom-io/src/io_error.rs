//! The crate's error.

use lissom_core::record::RecordError;
use thiserror::Error;

use crate::arm_file::arm_error::ArmError;
use crate::campaign::campaign_error::CampaignError;
use crate::config::ConfigError;
use crate::log::LogError;
use crate::model::frequency_file::FrequencyError;
use crate::plan::plan_error::PlanError;
use crate::responses::ResponseError;
use crate::result::result_error::ResultError;
use crate::units::UnitError;
use crate::write::WriteError;

/// Anything that can go wrong on the way in or out.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// A quantity or unit.
    #[error(transparent)]
    Unit(#[from] UnitError),
    /// A log.
    #[error(transparent)]
    Log(#[from] LogError),
    /// `arm.toml` or `campaign.toml` as a file of keys and values.
    #[error(transparent)]
    Config(#[from] ConfigError),
    /// An `arm.toml` that makes no arm.
    #[error(transparent)]
    Arm(#[from] ArmError),
    /// Experiments that make no sense.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// A list of frequencies.
    #[error(transparent)]
    Frequencies(#[from] FrequencyError),
    /// What a campaign says about its signals and drive.
    #[error(transparent)]
    Campaign(#[from] CampaignError),
    /// Runs that make no campaign.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// Tables of frequency responses.
    #[error(transparent)]
    Responses(#[from] ResponseError),
    /// A result that was read back.
    #[error(transparent)]
    Result(#[from] ResultError),
    /// Writing a file.
    #[error(transparent)]
    Write(#[from] WriteError),
}

impl Error {
    /// What to do about it.
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::Unit(error) => error.hint(),
            Self::Log(error) => error.hint(),
            Self::Config(error) => error.hint(),
            Self::Arm(error) => error.hint(),
            Self::Plan(error) => error.hint(),
            Self::Frequencies(error) => error.hint(),
            Self::Campaign(error) => error.hint(),
            Self::Responses(error) => error.hint(),
            Self::Result(error) => error.hint(),
            Self::Write(error) => error.hint(),
            // A reader makes no such run: see [`LogError`] and [`CampaignError`].
            Self::Record(_) => None,
        }
    }
}
