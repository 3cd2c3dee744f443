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
    /// A tip is not measured as an angle.
    TipWithoutAngle {
        /// Name of the tip.
        tip: String,
        /// Whether it measures acceleration; otherwise its scale is unknown.
        acceleration: bool,
        /// Whether the inertia is that of motor and beam together, because no tip is measured as an angle.
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
        /// Number of the mode, from 1.
        mode: usize,
        /// Its estimate.
        ratio: Estimate,
    },
    /// The coupling is too uncertain, and friction and inertia come from the equation without it.
    RigidEquation {
        /// Estimate of the coupling.
        coupling: Estimate,
        /// Its unit.
        units: EstimateUnits,
        /// Residual torque relative to the torque: with the coupling, and without it.
        residual_shares: [f64; 2],
    },
    /// The coupling of the only tip is negative.
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
                "the motor's response shows a flexible mode near {} rad/s (motor clamped), but no tip is measured: the \
                 estimates are rough",
                significant(*omega_rad_s, 3)
            ),
            Self::TipWithoutAngle { tip, acceleration, inertia_with_beam } => write!(
                f,
                "the sensor \"{tip}\" {}: slip phases give modes from it, but no coupling, which is given only where another method has one{}",
                if *acceleration { "measures acceleration" } else { "has an unknown scale" },
                if *inertia_with_beam {
                    ". The inertia is approximately that of motor and beam together"
                } else {
                    ""
                }
            ),
            Self::MoreModesThanTips { modes, tips } => write!(
                f,
                "the responses show {}, but only {} measured: the tips do not give the whole coupling torque. The inertia \
                 includes that of the missing modes and is too large, and the coupling is too small",
                counted(*modes, "mode", "modes"),
                counted(*tips, "tip is", "tips are")
            ),
            Self::NegativeDamping { mode, ratio } => write!(
                f,
                "the damping ratio of mode {mode} would be {}, but a beam cannot gain energy: the ratio is not given",
                with_error(*ratio)
            ),
            Self::RigidEquation { coupling, units, residual_shares: [with, without] } => write!(
                f,
                "the coupling to the beam would be {} {}, which is too uncertain: it is not given. Friction and inertia come \
                 from the equation without it, whose residual is {} % of the torque ({} % with the coupling). The \
                 inertia is that of motor and load together",
                with_error(*coupling),
                units.stiffness(),
                significant(100.0 * without, 3),
                significant(100.0 * with, 3)
            ),
            Self::CouplingSign => f.write_str(
                "the coupling is negative, as if the beam pushed the motor away: the sign of the tip seems to be reversed",
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
            // The split of inertia between motor and beam rests on what moves the tips.
            Self::ModesNotFound => vec![key::MODES, key::COUPLING, key::INERTIA],
            Self::NegativeDamping { .. } => vec![key::MODES],
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
                "measure the angle or the deflection of the tip if you need the coupling"
            }
            Self::MoreModesThanTips { .. } => {
                "measure as many points as there are modes in the band"
            }
            Self::NegativeDamping { .. } => {
                "add runs near the frequency of the mode, where damping acts most"
            }
            Self::RigidEquation { .. } => {
                "add runs near the beam's resonance, where the coupling acts most; check the sign and scale of the tip"
            }
            Self::CouplingSign => "give the tip a negative scale in the campaign",
        }
    }
}
