//! Why a command could not be carried out.

use std::path::PathBuf;

use lissom::identify::{EquivalentRefusal, IdentifyError, ValidationError};
use lissom::plan::PlanError;
use lissom::rig::RigError;
use lissom_io::ResultError;
use lissom_report::FigureError;
use thiserror::Error;

use super::command_hint::refusal_hint;

/// A reason that goes to the user with its hint.
#[derive(Debug, Error)]
pub(crate) enum Failure {
    #[error(transparent)]
    Io(#[from] lissom_io::Error),
    #[error(transparent)]
    Write(#[from] lissom_io::WriteError),
    /// A file that is no result to compare.
    #[error(transparent)]
    NoResult(lissom_io::Error),
    #[error("{}: {source}", campaign.display())]
    Identify { campaign: PathBuf, source: IdentifyError },
    #[error("{}: {source}", log.display())]
    Validate { log: PathBuf, source: ValidationError },
    /// A log without anything that says what its columns are.
    #[error("{}: is no campaign.toml, and nothing says what its columns are", log.display())]
    UndescribedLog { log: PathBuf },
    /// Responses that make no equivalent arm.
    #[error("{}: {source}", input.display())]
    Equivalent { input: PathBuf, source: Box<EquivalentRefusal>, place: Option<String> },
    /// What was asked for makes no sense, or cannot be had; and the way out.
    #[error("{0}")]
    Asked(String, &'static str),
    #[error("{}: exists and is no earlier output; it is not written over", file.display())]
    NotAnOutput { file: PathBuf },
    #[error("{}: one name for two outputs", file.display())]
    SameOutput { file: PathBuf },
    #[error("{}: is read, and is not written over", file.display())]
    IsInput { file: PathBuf },
    /// What was asked for is not there for this beam.
    #[error("{}: {reason}", arm.display())]
    Model { arm: PathBuf, reason: String, hint: &'static str },
    #[error(transparent)]
    Rig(#[from] RigError),
    /// A run of a virtual campaign.
    #[error("run `{run}`: {source}")]
    VirtualRun { run: String, source: RigError },
    /// An experiment that needs what the arm file does not have.
    #[error("{}: run `{run}` needs a controller, and [rig] has none", arm.display())]
    NoController { arm: PathBuf, run: String },
    /// A plan moves the motor by its loop.
    #[error("{}: [rig] has no controller, and a plan is made for a position loop", arm.display())]
    LoopNeeded { arm: PathBuf },
    #[error("{}: {source}", arm.display())]
    Plan { arm: PathBuf, source: PlanError },
    /// A folder that holds something else.
    #[error("{}: holds {what}; nothing is written over", folder.display())]
    OtherCampaign { folder: PathBuf, what: String },
    /// A manual page.
    #[error("{}: {source}", path.display())]
    Page { path: PathBuf, source: std::io::Error },
    #[error("the plot could not be drawn: {0}")]
    Figure(#[from] FigureError),
}

impl Failure {
    /// What to do about it.
    pub(crate) fn hint(&self) -> Option<String> {
        match self {
            Self::Write(error) => error.hint(),
            Self::NoResult(lissom_io::Error::Result(
                ResultError::Read { .. } | ResultError::Json { .. } | ResultError::NoResult { .. },
            )) => Some("give files that `lissom identify CAMPAIGN --json FILE` wrote".to_owned()),
            Self::Io(error) | Self::NoResult(error) => error.hint(),
            Self::NotAnOutput { .. } => Some(
                "put the input before `--json FILE`, or remove the file if it is to go"
                    .to_owned(),
            ),
            Self::Model { hint, .. } | Self::Asked(_, hint) => Some((*hint).to_owned()),
            Self::Equivalent { source, place, .. } => {
                Some(place.clone().unwrap_or_else(|| equivalent_hint(source)))
            }
            Self::UndescribedLog { log } if log.extension().is_some_and(|e| e == "json") => {
                Some("first the result, then the log: lissom validate result.json campaign.toml".to_owned())
            }
            Self::UndescribedLog { .. } => Some(
                "add --like campaign.toml, the campaign that the result is from, or describe the log in \
                 a campaign.toml of its own"
                    .to_owned(),
            ),
            Self::Validate { source, .. } => Some(
                match source {
                    ValidationError::NothingMoves => {
                        "the log needs a stretch in which the motor moves for a hundred samples"
                    }
                    ValidationError::TooFast { .. } | ValidationError::RunsAway => {
                        "take the result as lissom identify wrote it, and check the unit of the log's time"
                    }
                    _ => "describe the log as those that the result is from",
                }
                .to_owned(),
            ),
            Self::VirtualRun { source, .. } => Some(rig_hint(source).to_owned()),
            Self::NoController { .. } => Some(
                "add controller = { proportional = \"8 A/rad\", derivative = \"0.2 A*s/rad\" } to [rig], \
                 or drive = \"current\" to the run"
                    .to_owned(),
            ),
            Self::LoopNeeded { .. } => Some(
                "add controller = { proportional = \"8 A/rad\", derivative = \"0.2 A*s/rad\" } to [rig]"
                    .to_owned(),
            ),
            Self::Plan { source, .. } => Some(plan_hint(source).to_owned()),
            Self::OtherCampaign { .. } => {
                Some("give another --out, or remove the folder if it is to go".to_owned())
            }
            Self::SameOutput { .. } | Self::IsInput { .. } => {
                Some("give each output its own file".to_owned())
            }
            Self::Identify { source: IdentifyError::NothingMoves { .. }, .. } => Some(
                "check the wiring and which columns the campaign names; a tip without a signal can be \
                 left out of [signals]"
                    .to_owned(),
            ),
            Self::Identify { source: IdentifyError::Window { .. }, .. } => {
                Some("give a time such as \"0.3 s\"".to_owned())
            }
            _ => None,
        }
    }
}

fn equivalent_hint(refusal: &EquivalentRefusal) -> String {
    let hint = refusal.hint();
    refusal_hint(refusal).map_or_else(|| hint.to_owned(), |more| format!("{hint}; {more}"))
}

fn plan_hint(error: &PlanError) -> &'static str {
    match error {
        PlanError::NoTime { .. } => "allow more with --within",
        PlanError::NoMotion { .. } => {
            "check the current limit and the sensors in [rig], or allow more with --travel, --bend and \
             --within"
        }
        PlanError::TooMuch { .. } => "give a longer sample_time in [rig], or fewer masses",
        PlanError::TooFast { .. } => {
            "check the units of [drive] inertia and viscous, and of masses, stiffness and damping in [beam]"
        }
        PlanError::GravityOnBeam { .. } => "remove the load, or plan for a rigid joint",
        PlanError::Wish { .. } => "give a number greater than zero",
        _ => "check the masses and stiffnesses in [beam]",
    }
}

fn rig_hint(error: &RigError) -> &'static str {
    match error {
        RigError::Unstable { .. } => {
            "lower the gains, above all the derivative one, filter it, or sample faster"
        }
        RigError::BeyondSensor { .. } => {
            "turn less, or give motor_sensor a larger range, or { counts_per_turn = 4096 }, which has no \
             ends"
        }
        RigError::TooLong { .. } => "record less, or log one sample in so many with log_every",
        RigError::AboveNyquist { .. } => {
            "ask for lower frequencies, or let the controller act faster"
        }
        RigError::SensorCount { .. } => "give one `tip_sensors`, or one for each mass",
        RigError::TooStiff { .. } => {
            "check the units of inertia, viscous, masses, stiffness and damping, or sample faster"
        }
        RigError::Unsupported { .. } => "remove it from the run or from the arm",
        _ => "check the numbers of the run and of [rig]",
    }
}
