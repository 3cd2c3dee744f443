//! Modes of the beam and its tips.

use std::fmt;

use strum::{IntoStaticStr, VariantNames};

use crate::identify::estimate::Estimate;
use crate::identify::findings::describe::Describe;
use crate::identify::findings::number_text::{counted, significant, with_error};
use crate::identify::findings::result_key as key;
use crate::identify::findings::severity::Severity;
use crate::identify::findings::units::EstimateUnits;

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
    /// The damping ratio of a mode comes out negative.
    NegativeDamping {
        /// The mode's number, from one.
        mode: usize,
        /// What it would be.
        ratio: Estimate,
    },
    /// The coupling is hardly known, and friction is that of an axis without it.
    RigidEquation {
        /// What the coupling would be.
        coupling: Estimate,
        /// Its unit.
        units: EstimateUnits,
        /// Shares of the torque that the equation leaves with the coupling and without it.
        residual_shares: [f64; 2],
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
                "the responses show {}, and {} measured: the coupling torque is not a sum over these tips alone. Inertia is \
                 then too large, by what the missing modes turn, and the coupling too small",
                counted(*modes, "mode", "modes"),
                counted(*tips, "tip is", "tips are")
            ),
            Self::NegativeDamping { mode, ratio } => write!(
                f,
                "the damping ratio of mode {mode} would be {}: a beam does not gain energy, and it is not given",
                with_error(*ratio)
            ),
            Self::RigidEquation { coupling, units, residual_shares: [with, without] } => write!(
                f,
                "the coupling to the beam would be {} {}: friction and inertia are those of the equation without it, which \
                 leaves {} % of the torque where that with it leaves {} %. Inertia is that of motor and load together",
                with_error(*coupling),
                units.stiffness(),
                significant(100.0 * without, 3),
                significant(100.0 * with, 3)
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
            Self::ModesNotFound
            | Self::NegativeDamping { .. }
            | Self::RigidEquation { .. }
            | Self::CouplingSign => Severity::Refusal,
        }
    }

    fn affects(&self) -> Vec<&'static str> {
        match self {
            Self::ModesNotFound | Self::NegativeDamping { .. } => vec![key::MODES],
            Self::FlexibleWithoutTip { .. } => vec![key::INERTIA, key::VISCOUS, key::COULOMB],
            Self::RigidEquation { .. } | Self::TipWithoutAngle { inertia_with_beam: false, .. } => {
                vec![key::COUPLING]
            }
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
            Self::NegativeDamping { .. } => "add runs near the mode, where damping shows most",
            Self::RigidEquation { .. } => {
                "add runs near the beam's resonance, where the coupling shows; check the tip's sign and scale"
            }
            Self::CouplingSign => "give the tip a negative scale in the campaign",
        }
    }
}
