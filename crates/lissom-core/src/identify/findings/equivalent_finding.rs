//! An equivalent arm: its points and modes.

use std::fmt;

use strum::{IntoStaticStr, VariantNames};

use crate::identify::equivalent::refusal::EquivalentRefusal;
use crate::identify::estimate::Estimate;
use crate::identify::findings::describe::Describe;
use crate::identify::findings::number_text::{counted, later, milliseconds};
use crate::identify::findings::result_key as key;
use crate::identify::findings::severity::Severity;
use crate::identify::responses::rational::Spurious;

/// An equivalent arm: its points and modes.
#[derive(Debug, Clone, PartialEq, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "kebab-case")]
#[non_exhaustive]
pub enum EquivalentFinding {
    /// The responses of a campaign make no equivalent arm.
    EquivalentRefused {
        /// The reason.
        refusal: EquivalentRefusal,
    },
    /// A pole of the fit is not a mode of the arm.
    EquivalentSpuriousPole {
        /// Its frequency \[rad/s\].
        omega_rad_s: f64,
        /// The reason.
        reason: Spurious,
    },
    /// Fewer modes are kept than were found.
    EquivalentModesLeftOut {
        /// Modes kept.
        kept: usize,
        /// Modes found.
        found: usize,
    },
    /// There are more points than modes.
    EquivalentPointsLeftOut {
        /// Modes of the arm.
        modes: usize,
        /// Names of the points that are left out.
        points: Vec<String>,
    },
    /// A response has an imaginary part that neither damping nor a delay explains.
    EquivalentImaginaryPart {
        /// Name of the point.
        point: String,
        /// Size of that part relative to the response, median.
        share: f64,
        /// The same in standard errors, rms; `None` if these are not known.
        standard_errors: Option<f64>,
    },
    /// The response of a point is delayed relative to the motor.
    EquivalentDelay {
        /// Name of the point.
        point: String,
        /// The delay; negative if the response comes earlier \[s\].
        delay_s: Estimate,
    },
    /// Residues have terms in s.
    EquivalentTermsInS {
        /// The largest of them relative to its gain.
        largest_share: f64,
        /// Largest delay that they may hide \[s\].
        hidden_delay_s: f64,
    },
    /// The points' responses differ from the model.
    EquivalentMisfit {
        /// Root mean square of the difference, in standard errors.
        rms_standard_errors: f64,
    },
    /// Standard errors of the responses are larger than their errors.
    EquivalentDeviationsLarge {
        /// Root mean square of the difference from the model, in standard errors.
        rms_standard_errors: f64,
    },
    /// The gains of a point do not add up to one: it is not an angle.
    EquivalentNoAngle {
        /// Difference between their sum and one.
        missing_gain: f64,
    },
    /// The last mode gets the difference between the sum of the gains and one.
    EquivalentCompleted {
        /// Difference between the sum and one.
        missing_gain: f64,
        /// The largest relative change of a gain.
        change_share: f64,
    },
}

impl fmt::Display for EquivalentFinding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::EquivalentRefused { refusal } => {
                write!(f, "there is no equivalent arm: {refusal}")
            }
            Self::EquivalentSpuriousPole { omega_rad_s, reason } => write!(
                f,
                "a pole at {omega_rad_s:.4} rad/s {}: it is not a mode of the arm",
                match reason {
                    Spurious::Outside => "lies outside the measured frequencies",
                    Spurious::Damped => "is damped more than any mode of a beam",
                    Spurious::Unfelt =>
                        "has gains less than four standard errors from zero at all points",
                }
            ),
            Self::EquivalentModesLeftOut { kept, found } => write!(
                f,
                "{kept} of {found} modes are kept: the arm is valid below the first mode that is left out"
            ),
            Self::EquivalentPointsLeftOut { modes, points } => write!(
                f,
                "the arm has {} and therefore as many points: {} {} not in it, but {} used for the poles",
                counted(*modes, "mode", "modes"),
                points.join(", "),
                if points.len() == 1 { "is" } else { "are" },
                if points.len() == 1 { "its response is" } else { "their responses are" }
            ),
            Self::EquivalentImaginaryPart { point, share, standard_errors } => {
                let errors = standard_errors
                    .map_or_else(String::new, |n| format!(" ({n:.1} standard errors)"));
                write!(
                    f,
                    "the response of {point} has an imaginary part of {:.2} % of its size{errors} that no damping \
                     explains: errors of frequencies and gains may be larger than their intervals",
                    100.0 * share
                )
            }
            Self::EquivalentDelay { point, delay_s } => write!(
                f,
                "the response of {point} comes {} {} than the motor's angle: the delay is removed, and the intervals \
                 include its uncertainty",
                milliseconds(*delay_s),
                later(delay_s.value)
            ),
            Self::EquivalentTermsInS { largest_share, hidden_delay_s } => write!(
                f,
                "the residues have terms in s, up to {largest_share:.4} of their gains: the beam has internal damping, or \
                 damping with another shape than its modes. These terms may hide a delay of up to {:.4} ms, which \
                 the intervals of the gains include",
                1e3 * hidden_delay_s
            ),
            Self::EquivalentMisfit { rms_standard_errors } => write!(
                f,
                "the responses of the points differ from the model by {rms_standard_errors:.1} standard errors (rms): \
                 they contain more than the modes of an arm, or the standard errors are too small. The intervals include \
                 the difference"
            ),
            Self::EquivalentDeviationsLarge { rms_standard_errors } => write!(
                f,
                "the responses differ from the model by only {rms_standard_errors:.2} standard errors (rms): the given \
                 standard errors are too large, and the intervals are wider than they need to be"
            ),
            Self::EquivalentNoAngle { missing_gain } => write!(
                f,
                "the sum of the gains of a point differs from one by {missing_gain:.3}: the point does not turn with a motor \
                 that turns slowly. The form for use as an arm and the state space are not given"
            ),
            Self::EquivalentCompleted { missing_gain, change_share } => write!(
                f,
                "the sum of the gains of a point differs from one by {missing_gain:.3}: for use as an arm the last mode gets \
                 the difference, so that an arm that turns as one body is not bent. This changes a gain by up to {:.0} %, \
                 and the zeros as well",
                100.0 * change_share
            ),
        }
    }
}

impl Describe for EquivalentFinding {
    fn code(&self) -> &'static str {
        self.into()
    }

    fn severity(&self) -> Severity {
        match self {
            Self::EquivalentRefused { .. }
            | Self::EquivalentSpuriousPole { .. }
            | Self::EquivalentModesLeftOut { .. }
            | Self::EquivalentPointsLeftOut { .. }
            | Self::EquivalentTermsInS { .. }
            | Self::EquivalentDeviationsLarge { .. }
            | Self::EquivalentCompleted { .. } => Severity::Info,
            Self::EquivalentImaginaryPart { .. }
            | Self::EquivalentDelay { .. }
            | Self::EquivalentMisfit { .. }
            | Self::EquivalentNoAngle { .. } => Severity::Warning,
        }
    }

    fn affects(&self) -> Vec<&'static str> {
        vec![key::EQUIVALENT]
    }

    fn hint(&self) -> &'static str {
        match self {
            Self::EquivalentRefused { refusal } => refusal.hint(),
            Self::EquivalentSpuriousPole { .. } => {
                "nothing to do if the pole describes modes beyond the measured frequencies, or noise"
            }
            Self::EquivalentModesLeftOut { .. } => {
                "use the arm below the first mode that is left out, or keep more modes"
            }
            Self::EquivalentPointsLeftOut { .. } => {
                "measure at higher frequencies, so that there are as many modes as points"
            }
            Self::EquivalentImaginaryPart { .. } => {
                "check the phase of the channels: filters, sampling, a delay between them"
            }
            Self::EquivalentDelay { .. } => {
                "sample both channels at the same time and with the same filter, or correct the responses by the delay; \
                 damping within the beam may look like a small delay"
            }
            Self::EquivalentTermsInS { .. } => {
                "nothing to do: the fit contains these terms; an identification from logs finds an arm with such damping"
            }
            Self::EquivalentMisfit { .. } => {
                "look at the plot: a misfit at one frequency is a disturbance, a misfit everywhere means wrong standard errors"
            }
            Self::EquivalentDeviationsLarge { .. } => "check the standard errors of the responses",
            Self::EquivalentNoAngle { .. } => {
                "check whether an angle has the wrong sign, or another unit than the motor's angle"
            }
            Self::EquivalentCompleted { .. } => {
                "the last mode's part of the responses has an error of this size; the parts of the other modes do not"
            }
        }
    }
}
