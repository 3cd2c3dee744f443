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

/// Lists the areas once: the enum, its conversions, its codes.
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
            /// The codes of all kinds, area by area.
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
    /// What kind of motion a run is.
    Run(RunFinding),
    /// Friction from constant velocities.
    ConstantVelocity(ConstantVelocityFinding),
    /// Regression in slip phases.
    Regression(RegressionFinding),
    /// Friction that is not Coulomb friction and one viscous constant.
    FrictionLaw(FrictionLawFinding),
    /// The output-error method.
    OutputError(OutputErrorFinding),
    /// Frequency responses and the models that are fitted to them.
    Response(ResponseFinding),
    /// Modes and tips.
    Beam(BeamFinding),
    /// The estimates of the result.
    Estimate(EstimateFinding),
    /// An equivalent arm: its points and modes.
    Equivalent(EquivalentFinding),
    /// An equivalent arm: what the motor's response gives.
    EquivalentMotor(EquivalentMotorFinding),
    /// Another payload.
    Payload(PayloadFinding),
    /// Prediction of a log.
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

    /// Place among findings of the same severity: what acts on the joint comes before what is worth knowing, and that
    /// before what concerns responses alone.
    pub(crate) fn rank(&self) -> u8 {
        match self {
            Self::Regression(_)
            | Self::FrictionLaw(_)
            | Self::Log(_)
            | Self::OutputError(OutputErrorFinding::ModesByTheMotor { .. })
            | Self::Estimate(EstimateFinding::Offset { .. }) => 0,
            Self::Response(_) | Self::Estimate(EstimateFinding::NoPairs) => 2,
            _ => 1,
        }
    }

    /// Whether it is a cause that other findings may follow from: wrong readings, a run unlike the others, what the
    /// equation lacks, a lag, a mode without a tip, friction that varies.
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
