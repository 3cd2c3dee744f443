//! Modes of the beam and its tips.

use std::fmt;

use strum::{IntoStaticStr, VariantNames};

use crate::identify::findings::describe::Describe;
use crate::identify::findings::number_text::{counted, significant};
use crate::identify::findings::result_key as key;
use crate::identify::findings::severity::Severity;

/// Modes of the beam and its tips.
#[derive(Debug, Clone, PartialEq, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "kebab-case")]
#[non_exhaustive]
pub enum BeamFinding {
    /// No mode explains the tips' responses.
    ModesNotFound,
    /// The motor's response looks flexible, and no tip is measured.
    FlexibleWithoutTip {
        /// Frequency of the mode with the motor clamped \[rad/s\].
        omega_rad_s: f64,
    },
    /// A tip gives no angle.
    TipWithoutAngle {
        /// Name of the tip.
        tip: String,
        /// Whether it is an acceleration; else its scale is unknown.
        acceleration: bool,
        /// Whether the inertia is that of motor and beam together because no tip gives an angle.
        inertia_with_beam: bool,
    },
    /// The responses show more modes than there are tips.
    MoreModesThanTips {
        /// Modes found.
        modes: usize,
        /// Tips measured.
        tips: usize,
    },
    /// The only coupling is negative.
    CouplingSign,
}

impl fmt::Display for BeamFinding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::ModesNotFound => f.write_str(
                "no mode explains the responses of the tips to the motor: modes are not given",
            ),
            Self::FlexibleWithoutTip { omega_rad_s } => write!(
                f,
                "the motor's response looks flexible, with a mode near {} rad/s when the motor is clamped, and no tip is \
                 measured: the estimates are rough",
                significant(*omega_rad_s, 3)
            ),
            Self::TipWithoutAngle { tip, acceleration, inertia_with_beam } => write!(
                f,
                "tip {tip} {}: it gives modes, but no coupling by regression{}",
                if *acceleration { "is an acceleration" } else { "has an unknown scale" },
                if *inertia_with_beam {
                    "; the inertia is about that of motor and beam together"
                } else {
                    ""
                }
            ),
            Self::MoreModesThanTips { modes, tips } => write!(
                f,
                "the responses show {}, and {} measured: the coupling torque is not a sum over these tips alone",
                counted(*modes, "mode", "modes"),
                counted(*tips, "tip is", "tips are")
            ),
            Self::CouplingSign => f.write_str(
                "the coupling is negative, as if the beam pushed the motor away: the tip's sign looks reversed",
            ),
        }
    }
}

impl Describe for BeamFinding {
    fn code(&self) -> &'static str {
        self.into()
    }

    fn severity(&self) -> Severity {
        match self {
            Self::TipWithoutAngle { inertia_with_beam: false, .. } => Severity::Info,
            Self::TipWithoutAngle { .. }
            | Self::FlexibleWithoutTip { .. }
            | Self::MoreModesThanTips { .. } => Severity::Warning,
            Self::ModesNotFound | Self::CouplingSign => Severity::Refusal,
        }
    }

    fn affects(&self) -> Vec<&'static str> {
        match self {
            Self::ModesNotFound => vec![key::MODES],
            Self::FlexibleWithoutTip { .. } => vec![key::INERTIA, key::VISCOUS, key::COULOMB],
            Self::TipWithoutAngle { inertia_with_beam: false, .. } => vec![key::COUPLING],
            Self::TipWithoutAngle { .. } | Self::MoreModesThanTips { .. } => {
                vec![key::COUPLING, key::INERTIA]
            }
            Self::CouplingSign => vec![key::COUPLING, key::MODES],
        }
    }

    fn hint(&self) -> &'static str {
        match self {
            Self::ModesNotFound => {
                "use six or more frequencies near the beam's resonance, or a sweep"
            }
            Self::FlexibleWithoutTip { .. } => "measure a tip",
            Self::TipWithoutAngle { .. } => {
                "measure the angle or the deflection of the tip for the coupling"
            }
            Self::MoreModesThanTips { .. } => {
                "measure as many points as there are modes in the band"
            }
            Self::CouplingSign => "give the tip a negative scale in the campaign",
        }
    }
}
