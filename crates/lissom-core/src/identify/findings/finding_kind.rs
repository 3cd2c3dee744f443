//! All kinds of findings, one enum for each area.

use std::fmt;

use strum::VariantNames as _;

use crate::identify::findings::beam_finding::BeamFinding;
use crate::identify::findings::channel_finding::ChannelFinding;
use crate::identify::findings::constant_velocity_finding::ConstantVelocityFinding;
use crate::identify::findings::describe::Describe;
use crate::identify::findings::equivalent_finding::EquivalentFinding;
use crate::identify::findings::equivalent_motor_finding::EquivalentMotorFinding;
use crate::identify::findings::estimate_finding::EstimateFinding;
use crate::identify::findings::friction_law_finding::FrictionLawFinding;
use crate::identify::findings::log_finding::LogFinding;
use crate::identify::findings::output_error_finding::OutputErrorFinding;
use crate::identify::findings::payload_finding::PayloadFinding;
use crate::identify::findings::regression_finding::RegressionFinding;
use crate::identify::findings::response_finding::ResponseFinding;
use crate::identify::findings::run_finding::RunFinding;
use crate::identify::findings::severity::Severity;
use crate::identify::findings::validation_finding::ValidationFinding;
use crate::record::Note;

/// Declares the enum of all areas, the conversions into it and the list of codes.
macro_rules! areas {
    ($($(#[$doc:meta])* $area:ident($finding:ident),)*) => {
        /// What was found.
        #[derive(Debug, Clone, PartialEq)]
        #[non_exhaustive]
        pub enum FindingKind {
            $($(#[$doc])* $area($finding),)*
        }

        $(impl From<$finding> for FindingKind {
            fn from(found: $finding) -> Self {
                Self::$area(found)
            }
        })*

        impl FindingKind {
            /// Codes of all kinds, area by area.
            pub fn codes() -> impl Iterator<Item = &'static str> {
                [$($finding::VARIANTS),*].into_iter().flatten().copied()
            }

            fn describe(&self) -> &dyn Describe {
                match self {
                    $(Self::$area(found) => found,)*
                }
            }
        }
    };
}

areas! {
    /// Readings of one channel.
    Channel(ChannelFinding),
    /// Time stamps and samples of a log.
    Log(LogFinding),
    /// What was done to a log when it was read.
    Note(Note),
    /// What kind of motion a run is.
    Run(RunFinding),
    /// Friction from constant velocities.
    ConstantVelocity(ConstantVelocityFinding),
    /// Regression in slip phases.
    Regression(RegressionFinding),
    /// Friction with more terms than Coulomb friction and one viscous constant.
    FrictionLaw(FrictionLawFinding),
    /// The output-error method.
    OutputError(OutputErrorFinding),
    /// Frequency responses and the models that are fitted to them.
    Response(ResponseFinding),
    /// Modes and tips.
    Beam(BeamFinding),
    /// Estimates of the result: given, uncertain or refused.
    Estimate(EstimateFinding),
    /// An equivalent arm: its points and modes.
    Equivalent(EquivalentFinding),
    /// An equivalent arm: inertia, viscous friction and coupling from the motor's response.
    EquivalentMotor(EquivalentMotorFinding),
    /// Prediction of the arm with another payload.
    Payload(PayloadFinding),
    /// Prediction of a log with an identified arm.
    Validation(ValidationFinding),
}

impl FindingKind {
    /// Stable name, e.g. `saturation`.
    pub fn code(&self) -> &'static str {
        self.describe().code()
    }

    /// How much it matters.
    pub fn severity(&self) -> Severity {
        self.describe().severity()
    }

    /// Result keys that it affects, without the suffix of their unit.
    pub fn affects(&self) -> Vec<&'static str> {
        self.describe().affects()
    }

    /// What to do about it; empty where there is nothing to do.
    pub fn hint(&self) -> &'static str {
        self.describe().hint()
    }

    /// Sort order among findings of the same severity: 0 for effects on the joint or in the log, 2 for findings about
    /// responses only, 1 for all others.
    pub(crate) fn rank(&self) -> u8 {
        match self {
            Self::Regression(_)
            | Self::FrictionLaw(_)
            | Self::Log(_)
            | Self::Note(_)
            | Self::OutputError(OutputErrorFinding::ModesByTheMotor { .. })
            | Self::Estimate(EstimateFinding::Offset { .. }) => 0,
            Self::Response(_) | Self::Estimate(EstimateFinding::NoPairs) => 2,
            _ => 1,
        }
    }

    /// Whether it may be the cause of other findings: wrong readings, a run unlike the others, a missing term of the
    /// equation, a lag, a mode without a tip, friction that varies.
    pub(crate) fn is_cause(&self) -> bool {
        match self {
            Self::Channel(found) => found.is_wrong_reading(),
            Self::Estimate(found) => matches!(found, EstimateFinding::CommandSign),
            Self::Run(found) => {
                matches!(found, RunFinding::RunStandsOut { .. } | RunFinding::UnlikeOthers { .. })
            }
            Self::Regression(found) => found.is_cause(),
            Self::OutputError(found) => found.is_cause(),
            Self::Beam(found) => matches!(found, BeamFinding::MoreModesThanTips { .. }),
            _ => false,
        }
    }
}

impl fmt::Display for FindingKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.describe().fmt(f)
    }
}
