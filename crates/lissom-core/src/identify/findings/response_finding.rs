//! Frequency responses and the models that are fitted to them.

use crate::finding::Severity::{Info, Warning};
use crate::finding::findings;
use crate::finding::result_key as key;

findings! {
    /// A corrected point is too uncertain.
    "correction-weak" CorrectionWeak { omega_rad_s: f64, std_share: f64 }
        Warning, [key::CORRECTED_RESPONSE],
        format!("at {omega_rad_s:.3} rad/s nearly all of the current overcomes friction: the corrected response has a standard \
            error of {:.0} % and is flagged", 100.0 * std_share),
        "use a larger amplitude: friction then takes a smaller share of the current";

    /// Bands of the corrected response differ from the regression's model by more than a limit.
    "bands-flagged" BandsContradicted { bands: usize, of: usize, limit: f64 }
        Info, [key::CORRECTED_RESPONSE],
        format!("in {bands} of {of} frequency bands (of runs that are not sines) the corrected response differs from the \
            regression's model by more than {:.0} %: these bands are flagged. The parameters are not affected", 100.0 * limit),
        "use the response of the linear models in these bands: the runs hardly excite them, or feedback biases them";

    /// Bands of the corrected response have a relative standard error above a limit.
    "bands-flagged" BandsUncertain { bands: usize, of: usize, limit: f64 }
        Info, [key::CORRECTED_RESPONSE],
        format!("in {bands} of {of} frequency bands (of runs that are not sines) the corrected response has a standard error \
            above {:.0} %: these bands are flagged", 100.0 * limit),
        "use the response of the linear models in these bands, or add a run that excites them";

    /// The motor's rational model does not fit its responses.
    "model-misfit" ModelMisfit { rms_standard_errors: f64 }
        Warning, [key::MOTOR_MODEL, key::TIP_MODELS, key::STATE_SPACE],
        format!("the motor's rational model differs from the measured responses by {rms_standard_errors:.1} standard errors \
            (rms): the linear models may be wrong"),
        "look for a delay, a lag, a mode without a tip or damping within the beam, which the model does not have, or for \
            responses with larger errors than their standard errors";
}
