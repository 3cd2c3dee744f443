//! Reads measured logs and campaign descriptions; writes logs, models and results.
//!
//! - [`read_campaign`] reads a `campaign.toml` and its logs into a
//!   [`Campaign`](lissom_core::record::Campaign): see [`campaign`] for the file, [`log`] for the logs.
//! - [`ArmFile::read`] reads an `arm.toml`: see [`arm_file`]; [`ModelFile`] is the model computed from it.
//! - [`PlanFile::read`] reads a `plan.toml`, the experiments of a virtual campaign: see [`plan`].
//! - [`read_responses`] reads tables of frequency responses: see [`responses`].
//! - [`ResultFile`] is the result of an identification. [`read_arm`] reads its arm; [`ParameterList`] lists its parameters.
//!   [`ComparedFile`] has the parameters of several results, [`ValidationFile`] how well a result predicts another log,
//!   [`ThresholdsFile`] the list of thresholds: see [`result`].
//! - [`PlannedFile`] is a plan as JSON, [`RigFile`] describes a virtual campaign, [`DemoFile`] and
//!   [`FiguresFile`] are estimates compared with known values.
//! - [`inspect`](mod@inspect) describes a log of which nothing is known yet, and makes a `campaign.toml` of it.
//! - [`fleet`] has the summary of the results of many machines.
//! - [`export`] writes models for other programs.
//! - [`limits`] checks parameters against limits.
//! - [`units`] reads quantities such as `"2.184 lbf*in/A"`.
//! - [`mod@write`] writes files whole or not at all.
//!
//! Every error is an [`Error`] with file, place and value; most have a [hint](Error::hint).

pub mod arm_file;
pub mod campaign;
pub mod comparison;
mod config;
mod effort_name;
mod excerpt;
pub mod export;
pub mod fleet;
pub mod inspect;
mod io_error;
pub mod limits;
pub mod log;
pub mod model;
mod nearest;
pub mod plan;
pub mod planned;
mod read_text;
pub mod responses;
pub mod result;
pub mod rig;
#[cfg(feature = "schema")]
mod schema_files;
#[cfg(feature = "schema")]
mod schema_pages;
pub mod units;
pub mod write;

pub use arm_file::{
    ArmFile, BeamKind, BeamSpec, DriveSpec, FrictionSpec, LoadSpec, RigSpec, SpanSpec, TipSpec,
};
pub use campaign::{
    AnalysisOptions, CampaignFile, CampaignReader, DriveConstants, MemoryLogs, ReadOptions,
    read_campaign, read_campaign_like,
};
pub use comparison::{DemoFile, FiguresFile};
pub use config::{ConfigError, ConfigPlace};
pub use effort_name::EffortName;
pub use io_error::Error;
pub use log::LogError;
pub use model::{FrequencyError, Model, ModelFile, read_frequencies};
pub use nearest::nearest;
pub use plan::{PlanFile, PlanRun};
pub use planned::PlannedFile;
pub use read_text::read_text;
pub use responses::{
    FrequencyResponses, MeasuredResponse, Positive, ResponseError, read_responses,
};
pub use result::{
    ComparedFile, EquivalentFile, ListedParameter, ParameterList, PayloadFile, PayloadPrediction,
    PredictedPayload, ResultError, ResultFile, ThresholdsFile, UnitNames, ValidationFile,
    channel_name_unit, read_arm,
};
pub use rig::{RigFile, RigRunEntry};
#[cfg(feature = "schema")]
pub use schema_files::schema_files;
#[cfg(feature = "schema")]
pub use schema_pages::schema_pages;
pub use units::UnitError;
pub use write::WriteError;
