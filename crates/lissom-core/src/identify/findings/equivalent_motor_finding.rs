//! An equivalent arm: inertia, viscous friction and coupling from the motor's response.

use std::fmt;

use strum::{IntoStaticStr, VariantNames};

use crate::identify::equivalent::equivalent_error::EquivalentError;
use crate::identify::estimate::Estimate;
use crate::identify::findings::describe::Describe;
use crate::identify::findings::number_text::{later, milliseconds};
use crate::identify::findings::result_key as key;
use crate::identify::findings::severity::Severity;

/// An equivalent arm: inertia, viscous friction and coupling from the motor's response.
#[derive(Debug, Clone, PartialEq, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "kebab-case")]
#[non_exhaustive]
pub enum EquivalentMotorFinding {
    /// The motor's response differs from that of the arm.
    EquivalentMotorMisfit {
        /// Root mean square of the difference in standard errors; `None` if these are not known.
        rms_standard_errors: Option<f64>,
        /// The difference relative to the response, rms.
        share: f64,
        /// The same for the responses of the points.
        share_of_points: f64,
    },
    /// The motor's response is delayed relative to the command.
    EquivalentMotorDelay {
        /// The delay; negative if the response comes earlier \[s\].
        delay_s: Estimate,
    },
    /// The motor's response contains Coulomb friction.
    EquivalentMotorFriction {
        /// Size of the friction in standard errors.
        standard_errors: f64,
    },
    /// Parameters of the arm are negative.
    EquivalentImplausible {
        /// Names of the parameters.
        parameters: Vec<String>,
    },
    /// Inertia, viscous friction and coupling cannot be identified.
    EquivalentWithoutTorque {
        /// The reason.
        error: EquivalentError,
    },
}

impl fmt::Display for EquivalentMotorFinding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::EquivalentMotorMisfit { rms_standard_errors: Some(errors), .. } => write!(
                f,
                "the motor's response differs from the model by {errors:.1} standard errors (rms): it contains friction, \
                 or modes that are not in the arm. The intervals include the difference"
            ),
            Self::EquivalentMotorMisfit { rms_standard_errors: None, share, share_of_points } => {
                write!(
                    f,
                    "the motor's response differs from the model by {:.1} % (rms), and the points' responses by {:.2} %: it \
                 contains friction or modes that are not in the arm, is not an angle per command, or is poorly measured",
                    100.0 * share,
                    100.0 * share_of_points
                )
            }
            Self::EquivalentMotorDelay { delay_s } => write!(
                f,
                "the motor's response comes {} {} than the command: the delay is removed, and the intervals include \
                 its uncertainty",
                milliseconds(*delay_s),
                later(delay_s.value)
            ),
            Self::EquivalentMotorFriction { standard_errors } => write!(
                f,
                "the motor's response contains a torque against the motion that does not grow with speed, like Coulomb \
                 friction ({standard_errors:.1} standard errors from zero): errors of viscous friction and inertia may \
                 be larger than their intervals"
            ),
            Self::EquivalentImplausible { parameters } => write!(
                f,
                "{} {} negative, which is not possible for an arm",
                parameters.join(", "),
                if parameters.len() == 1 { "is" } else { "are" }
            ),
            Self::EquivalentWithoutTorque { error } => error.fmt(f),
        }
    }
}

impl Describe for EquivalentMotorFinding {
    fn code(&self) -> &'static str {
        self.into()
    }

    fn severity(&self) -> Severity {
        Severity::Warning
    }

    fn affects(&self) -> Vec<&'static str> {
        vec![key::EQUIVALENT]
    }

    fn hint(&self) -> &'static str {
        match self {
            Self::EquivalentMotorMisfit { rms_standard_errors: Some(_), .. } => {
                "look at the plot of the motor's response"
            }
            Self::EquivalentMotorMisfit { .. } => {
                "look at the plot of the motor's response; give standard errors (columns that end in _std) to separate \
                 noise from misfit"
            }
            Self::EquivalentMotorDelay { .. } => {
                "sample command and angle at the same time and with the same filter, or correct the response by the delay"
            }
            Self::EquivalentMotorFriction { .. } => {
                "remove the friction first (an identification from the logs does so), or measure at larger amplitudes"
            }
            Self::EquivalentImplausible { .. } => {
                "check the motor's response: its sign, the torque constant, and whether friction has been removed"
            }
            Self::EquivalentWithoutTorque { .. } => "give the motor's response at more frequencies",
        }
    }
}
