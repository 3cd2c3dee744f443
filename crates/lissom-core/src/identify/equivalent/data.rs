//! Responses of points of a beam, and the equivalent arm that they give.

use crate::identify::equivalent::equivalent_arm::EquivalentArm;
use crate::identify::equivalent::refusal::PartOutside;
use crate::identify::equivalent::zeros::ResponseZero;
use crate::identify::equivalent::{EquivalentBeam, StrainlessForm};
use crate::identify::findings::Finding;
use crate::identify::responses::correct::Response;
use crate::identify::responses::rational::{MotorData, SharedPoles, Spurious};

/// Where the deviations of responses are from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Deviations {
    /// Measured.
    Measured,
    /// Measured, and no less than a share of the response.
    Floored,
    /// Not known: a share of each response, of one size or both, and what the model leaves says which.
    FromResidual,
}

/// Responses of points of a beam, and of its motor.
#[derive(Debug, Clone)]
pub struct EquivalentData {
    /// Names of the points.
    pub names: Vec<String>,
    /// Frequencies \[rad/s\].
    pub omega_rad_s: Vec<f64>,
    /// θ_i/θ_m of each point (outer) at each frequency.
    pub outputs: Vec<Vec<Response>>,
    /// θ_m per command, friction taken out; `None`: step 5 alone.
    pub motor: Option<MotorData>,
    /// Where the deviations are from.
    pub deviations: Deviations,
}

/// An equivalent arm and how far it holds.
#[derive(Debug, Clone)]
pub struct Equivalent {
    /// All poles found.
    pub fit: SharedPoles,
    /// Why each of them is no mode; `None` of those that are.
    pub spurious: Vec<Option<Spurious>>,
    /// Those of the arm.
    pub modes: Vec<usize>,
    /// Its points, places in [`EquivalentData::names`].
    pub points: Vec<usize>,
    /// The poles of the arm at its points.
    pub kept: SharedPoles,
    /// Â and B̂ as fitted.
    pub beam: EquivalentBeam,
    /// Ĥ, ĥ, J and V too; `None` without a motor's response that holds them.
    pub arm: Option<EquivalentArm>,
    /// The form for use as an arm; `None` where a point is no angle.
    pub strainless: Option<StrainlessForm>,
    /// Zeros of every point's response, with all modes found and those that poles above the frequencies stand for.
    pub zeros: Vec<Vec<ResponseZero>>,
    /// Names of the points measured.
    pub names: Vec<String>,
    /// Imaginary parts that no damping explains, where they stand clear of the noise.
    pub imaginary: Vec<PartOutside>,
    /// What the model of all poles leaves of the points' responses, as a share of each, rms.
    pub relative_residual: f64,
    /// Where the deviations are from.
    pub deviations: Deviations,
    /// What to know of it.
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
