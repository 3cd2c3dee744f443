//! Errors of the command, each with a hint.

use std::path::PathBuf;

use lissom::PayloadError;
use lissom::identify::{EquivalentRefusal, IdentifyError, ValidationError};
use lissom::plan::PlanError;
use lissom::rig::RigError;
use lissom_io::ResultError;
use lissom_report::FigureError;
use thiserror::Error;

use super::command_hint::{option, refusal_hint};

/// Why a command failed.
#[derive(Debug, Error)]
pub(crate) enum Failure {
    #[error(transparent)]
    Io(#[from] lissom_io::Error),
    #[error(transparent)]
    Write(#[from] lissom_io::WriteError),
    /// A file to compare that is not a result.
    #[error(transparent)]
    NoResult(lissom_io::Error),
    #[error("{}: {source}", campaign.display())]
    Identify { campaign: PathBuf, source: IdentifyError },
    #[error("{}: {source}", log.display())]
    Validate { log: PathBuf, source: ValidationError },
    /// A payload that cannot be predicted.
    #[error("{}: {source}", campaign.display())]
    Payload { campaign: PathBuf, source: PayloadError },
    /// A log without a description of its columns.
    #[error("{}: is not a campaign.toml, and nothing describes its columns", log.display())]
    UndescribedLog { log: PathBuf },
    /// Responses from which no equivalent arm can be built.
    #[error("{}: {source}", input.display())]
    Equivalent { input: PathBuf, source: Box<EquivalentRefusal>, place: Option<String> },
    #[cfg(feature = "fleet")]
    #[error(transparent)]
    Fleet(#[from] lissom_fleet::FleetError),
    #[cfg(feature = "studio")]
    #[error(transparent)]
    Studio(#[from] lissom_studio::StudioError),
    /// A request that cannot be fulfilled, with a hint.
    #[error("{0}")]
    Asked(String, &'static str),
    #[error("{}: exists and is not an earlier output; it is not overwritten", file.display())]
    NotAnOutput { file: PathBuf },
    #[error("{}: exists, and is not overwritten", file.display())]
    Exists { file: PathBuf },
    #[error("{}: is given for two outputs", file.display())]
    SameOutput { file: PathBuf },
    #[error("{}: is an input; it is not overwritten", file.display())]
    IsInput { file: PathBuf },
    /// A request that cannot be fulfilled for this arm, with a hint.
    #[error("{}: {reason}", arm.display())]
    Model { arm: PathBuf, reason: String, hint: &'static str },
    #[error(transparent)]
    Rig(#[from] RigError),
    /// A run of a virtual campaign cannot be simulated.
    #[error("run `{run}`: {source}")]
    VirtualRun { run: String, source: RigError },
    /// An experiment that needs a controller, which the arm file does not have.
    #[error("{}: run `{run}` needs a controller, but [rig] has none", arm.display())]
    NoController { arm: PathBuf, run: String },
    /// A plan needs a controller, which the arm file does not have.
    #[error("{}: [rig] has no controller, but a plan needs a position loop", arm.display())]
    LoopNeeded { arm: PathBuf },
    #[error("{}: {source}", arm.display())]
    Plan { arm: PathBuf, source: PlanError },
    /// An output folder with files of something else.
    #[error("{}: contains {what}; nothing is overwritten", folder.display())]
    OtherCampaign { folder: PathBuf, what: String },
    /// A manual page that cannot be made.
    #[error("{}: {source}", path.display())]
    Page { path: PathBuf, source: std::io::Error },
    /// A figure that a result does not have.
    #[error("{}: has no figure `{name}`", result.display())]
    NoFigure { result: PathBuf, name: String, near: Option<String>, needs_logs: bool },
    /// A run of which there is no such figure.
    #[error("{}: has no figure `{figure}` of a run `{run}`", result.display())]
    NoRunOfFigure { result: PathBuf, figure: String, run: String, near: Option<String> },
    #[error("the plot could not be drawn: {0}")]
    Figure(#[from] FigureError),
}

impl Failure {
    /// What the user can do.
    pub(crate) fn hint(&self) -> Option<String> {
        match self {
            Self::Write(error) => error.hint(),
            #[cfg(feature = "fleet")]
            Self::Fleet(error) => error.hint(),
            #[cfg(feature = "studio")]
            Self::Studio(error) => error.hint().map(str::to_owned),
            Self::NoResult(lissom_io::Error::Result(
                ResultError::Read { .. } | ResultError::Json { .. } | ResultError::NoResult { .. },
            )) => Some("give files that `lissom identify CAMPAIGN --json FILE` wrote".to_owned()),
            Self::Io(lissom_io::Error::Draft(error)) => error.hint_with(&option),
            Self::Io(error) | Self::NoResult(error) => error.hint(),
            Self::NotAnOutput { .. } => Some(
                "put the input before `--json FILE`, give another name, or delete the file if you do not need it"
                    .to_owned(),
            ),
            Self::Payload { source: PayloadError::NoDistance, .. } => Some(
                "add --at LENGTH: the payload's inertia is its mass times the square of this distance"
                    .to_owned(),
            ),
            Self::Payload { source: PayloadError::NoArm, .. } => {
                Some("run `lissom identify` on this campaign and read its findings".to_owned())
            }
            Self::Payload { source, .. } => Some(source.hint().to_owned()),
            Self::Model { hint, .. } | Self::Asked(_, hint) => Some((*hint).to_owned()),
            Self::Equivalent { source, place, .. } => {
                Some(place.clone().unwrap_or_else(|| equivalent_hint(source)))
            }
            Self::UndescribedLog { log } if log.extension().is_some_and(|e| e == "json") => {
                Some("give first the result, then the log, as in result.json campaign.toml".to_owned())
            }
            Self::UndescribedLog { .. } => Some(
                "add --like campaign.toml with the campaign of the result, or describe the log in its own \
                 campaign.toml: `lissom init LOG`, with the options of the identification, writes one"
                    .to_owned(),
            ),
            Self::Validate { source, .. } => Some(
                match source {
                    ValidationError::NothingMoves => {
                        "give a log in which the motor moves for at least a hundred samples"
                    }
                    ValidationError::TooFast { .. } | ValidationError::RunsAway => {
                        "use the result as `lissom identify` wrote it, and check the unit of the log's time"
                    }
                    _ => "describe the log with the same signals and units as the logs of the result",
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
                Some("give another --out, or delete the folder if you do not need it".to_owned())
            }
            Self::Exists { .. } => Some("give another name with --out".to_owned()),
            Self::NoFigure { needs_logs: true, .. } => {
                Some("give the logs too: lissom plot result.json campaign.toml --figure NAME".to_owned())
            }
            Self::NoFigure { near, .. } | Self::NoRunOfFigure { near, .. } => {
                let meant = near.as_ref().map_or_else(String::new, |near| format!("did you mean `{near}`? "));
                Some(format!("{meant}without --figure, `lissom plot RESULT [LOG...]` lists figures and runs"))
            }
            Self::SameOutput { .. } | Self::IsInput { .. } => {
                Some("give each output a file of its own".to_owned())
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
        PlanError::NoTime { .. } => "allow more time with --within",
        PlanError::NoMotion { .. } => {
            "check the current limit and the sensors in [rig], or allow more motion with --travel and --bend \
             and more time with --within"
        }
        PlanError::TooMuch { .. } => "give a longer sample_time in [rig], or fewer masses",
        PlanError::TooFast { .. } => {
            "check the units of [drive] inertia and viscous, and of masses, stiffness and damping in [beam]"
        }
        PlanError::GravityOnBeam { .. } => "remove [load], or plan for a rigid joint",
        PlanError::Wish { .. } => "give a number greater than zero",
        _ => "check the masses and stiffnesses in [beam]",
    }
}

fn rig_hint(error: &RigError) -> &'static str {
    match error {
        RigError::Unstable { .. } => {
            "lower the gains (first the derivative gain), filter the derivative, or sample faster"
        }
        RigError::BeyondSensor { .. } => {
            "use a smaller motion, give motor_sensor a larger range, or use { counts_per_turn = 4096 }, \
             which has no limits"
        }
        RigError::TooLong { .. } => {
            "record a shorter time, or log only every n-th sample with log_every"
        }
        RigError::AboveNyquist { .. } => {
            "use lower frequencies, or a shorter sample time of the controller"
        }
        RigError::SensorCount { .. } => "give `tip_sensors` once, or once for each mass",
        RigError::TooStiff { .. } => {
            "check the units of inertia, viscous, masses, stiffness and damping, or sample faster"
        }
        RigError::Unsupported { .. } => "remove it from the run or from the arm",
        _ => "check the numbers of the run and in [rig]",
    }
}
