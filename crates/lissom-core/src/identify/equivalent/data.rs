//! Responses of points of a beam, and the equivalent arm that follows from them.

use crate::identify::equivalent::equivalent_arm::EquivalentArm;
use crate::identify::equivalent::refusal::PartOutside;
use crate::identify::equivalent::zeros::ResponseZero;
use crate::identify::equivalent::{EquivalentBeam, StrainlessForm};
use crate::identify::findings::Finding;
use crate::identify::responses::correct::Response;
use crate::identify::responses::rational::{MotorData, SharedPoles, Spurious};

/// Origin of the standard errors of responses.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum StdSource {
    /// Measured.
    Measured,
    /// Measured, and at least a share of the response.
    Floored,
    /// Unknown: they are a share of each response, a constant, or both; the residual of the model decides which.
    FromResidual,
}

/// Responses of points of a beam, and of its motor.
#[derive(Debug, Clone)]
pub struct EquivalentData {
    /// Names of the points.
    pub names: Vec<String>,
    /// Frequencies of all responses \[rad/s\].
    pub omega_rad_s: Vec<f64>,
    /// θ_i/θ_m of each point (outer index) at each frequency (inner index) \[1\].
    pub outputs: Vec<Vec<Response>>,
    /// θ_m per command, corrected for friction. Without it only Â and B̂ (step 5) are computed.
    pub motor: Option<MotorData>,
    /// Origin of the standard errors.
    pub std_source: StdSource,
}

/// An equivalent arm, with the data that show how far it is valid.
#[derive(Debug, Clone)]
pub struct Equivalent {
    /// All poles that were fitted.
    pub fit: SharedPoles,
    /// For each pole, the reason why it is not a mode; `None` for modes.
    pub spurious: Vec<Option<Spurious>>,
    /// Indices of the poles that are modes of the arm.
    pub modes: Vec<usize>,
    /// Points of the arm, as indices of [`EquivalentData::names`].
    pub points: Vec<usize>,
    /// The fit with only these poles and points.
    pub kept: SharedPoles,
    /// Â and B̂ as fitted.
    pub beam: EquivalentBeam,
    /// Ĥ, ĥ, J and V in addition; `None` if there is no response of the motor that determines them.
    pub arm: Option<EquivalentArm>,
    /// The form for use as an arm; `None` if the motion of a point cannot be converted to angles.
    pub strainless: Option<StrainlessForm>,
    /// Zeros of the response of every point, computed with all modes that were found and with the poles above the
    /// measured frequencies, which stand for higher modes.
    pub zeros: Vec<Vec<ResponseZero>>,
    /// Names of the measured points.
    pub names: Vec<String>,
    /// Imaginary parts that no damping explains, if they are clearly above the noise.
    pub imaginary: Vec<PartOutside>,
    /// Residual of the points' responses with all poles, relative to the response, rms \[1\].
    pub relative_residual: f64,
    /// Origin of the standard errors.
    pub std_source: StdSource,
    /// Findings about the arm.
    pub findings: Vec<Finding>,
}

/// Σ|H − fit|²/|H|² over all responses, its mean's root.
pub(crate) fn relative_residual(data: &EquivalentData, fit: &SharedPoles) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for (output, responses) in data.outputs.iter().enumerate() {
        for (w, r) in data.omega_rad_s.iter().zip(responses) {
            let share = (r.value - fit.response(output, *w)).norm_sqr() / r.value.norm_sqr();
            if share.is_finite() {
                (sum, count) = (sum + share, count + 1.0);
            }
        }
    }
    f64::sqrt(sum / f64::max(count, 1.0))
}
