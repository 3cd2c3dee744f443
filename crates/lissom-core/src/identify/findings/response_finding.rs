//! Frequency responses and the models that are fitted to them.

use std::fmt;

use strum::{IntoStaticStr, VariantNames};

use crate::identify::findings::describe::Describe;
use crate::identify::findings::result_key as key;
use crate::identify::findings::severity::Severity;

/// Frequency responses and the models that are fitted to them.
#[derive(Debug, Clone, PartialEq, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "kebab-case")]
#[non_exhaustive]
pub enum ResponseFinding {
    /// A corrected point is too uncertain.
    CorrectionWeak {
        /// Its frequency \[rad/s\].
        omega_rad_s: f64,
        /// Its relative standard error.
        std_share: f64,
    },
    /// Bands of the corrected response differ from the regression's model.
    BandsContradicted {
        /// Number of these bands.
        bands: usize,
        /// Number of all bands.
        of: usize,
        /// Relative difference above which a band is flagged.
        limit: f64,
    },
    /// Bands of the corrected response are uncertain.
    BandsUncertain {
        /// Number of these bands.
        bands: usize,
        /// Number of all bands.
        of: usize,
        /// Relative standard error above which a band is flagged.
        limit: f64,
    },
    /// The motor's rational model does not fit its responses.
    ModelMisfit {
        /// Root mean square of the difference, in standard errors.
        rms_standard_errors: f64,
    },
}

impl fmt::Display for ResponseFinding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::CorrectionWeak { omega_rad_s, std_share } => write!(
                f,
                "at {omega_rad_s:.3} rad/s nearly all of the current overcomes friction: the corrected response has a \
                 standard error of {:.0} % and is flagged",
                100.0 * std_share
            ),
            Self::BandsContradicted { bands, of, limit } => write!(
                f,
                "in {bands} of {of} frequency bands (of runs that are not sines) the corrected response differs from the \
                 regression's model by more than {:.0} %: these bands are flagged. The parameters are not affected",
                100.0 * limit
            ),
            Self::BandsUncertain { bands, of, limit } => write!(
                f,
                "in {bands} of {of} frequency bands (of runs that are not sines) the corrected response has a standard error \
                 above {:.0} %: these bands are flagged",
                100.0 * limit
            ),
            Self::ModelMisfit { rms_standard_errors } => write!(
                f,
                "the motor's rational model differs from the measured responses by {rms_standard_errors:.1} standard \
                 errors (rms): the linear models may be wrong"
            ),
        }
    }
}

impl Describe for ResponseFinding {
    fn code(&self) -> &'static str {
        self.into()
    }

    fn severity(&self) -> Severity {
        match self {
            Self::CorrectionWeak { .. } | Self::ModelMisfit { .. } => Severity::Warning,
            Self::BandsContradicted { .. } | Self::BandsUncertain { .. } => Severity::Info,
        }
    }

    fn affects(&self) -> Vec<&'static str> {
        match self {
            Self::CorrectionWeak { .. }
            | Self::BandsContradicted { .. }
            | Self::BandsUncertain { .. } => vec![key::CORRECTED_RESPONSE],
            Self::ModelMisfit { .. } => vec![key::MOTOR_MODEL, key::TIP_MODELS, key::STATE_SPACE],
        }
    }

    fn hint(&self) -> &'static str {
        match self {
            Self::CorrectionWeak { .. } => {
                "use a larger amplitude: friction then takes a smaller share of the current"
            }
            Self::BandsContradicted { .. } => {
                "use the response of the linear models in these bands: the runs hardly excite them, or feedback biases them"
            }
            Self::BandsUncertain { .. } => {
                "use the response of the linear models in these bands, or add a run that excites them"
            }
            Self::ModelMisfit { .. } => {
                "look for a delay, a lag, a mode without a tip or damping within the beam, which the model does not have, \
                 or for responses with larger errors than their standard errors"
            }
        }
    }
}
