//! Estimates of friction, inertia and coupling from one method, and those of the beam.

use strum::IntoStaticStr;

use crate::identify::estimate::{Estimate, ModeEstimate};
use crate::identify::friction_estimates::Friction;
use crate::identify::gravity_estimate::Gravity;

/// A method that estimates the parameters of the drive.
#[derive(Debug, Clone, Copy, PartialEq, Eq, IntoStaticStr)]
#[strum(serialize_all = "snake_case")]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub enum Method {
    /// Output-error method: simulates the arm under the logged command and changes its parameters until the simulated
    /// motion is the logged one.
    OutputError,
    /// Regression in slip phases with the simplest friction law that the data do not reject.
    FrictionLaw,
    /// Regression in slip phases with Coulomb friction and one viscous coefficient.
    Regression,
    /// Ordinary least squares of smoothed samples.
    LeastSquares,
    /// Rational model of the frequency response, which is corrected for Coulomb friction.
    FrequencyResponse,
    /// Third harmonic of the command, with the rational model of the response that it corrects.
    ThirdHarmonic,
    /// Command at constant velocities, extrapolated to zero speed.
    ConstantVelocity,
}

impl Method {
    /// Name in result files.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

impl Method {
    /// Its name in texts.
    pub fn words(self) -> &'static str {
        match self {
            Self::OutputError => {
                "the output-error method: the motion simulated from the logged command is fitted to the log"
            }
            Self::FrictionLaw => "regression in slip phases, with the terms that predict best",
            Self::Regression => "regression in slip phases",
            Self::LeastSquares => "ordinary least squares",
            Self::FrequencyResponse => "a fit to the corrected frequency response",
            Self::ThirdHarmonic => "the third-harmonic method",
            Self::ConstantVelocity => "the method of constant velocities",
        }
    }
}

/// Friction, inertia and coupling from one fit.
///
/// These estimates belong together: they describe the logs only as a whole, and their standard errors are those of that
/// fit. A parameter that the method does not estimate is `None`.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct DriveEstimates {
    /// Friction \[N·m or N\].
    pub friction: Friction,
    /// Inertia \[kg·m²\], or mass \[kg\] on a linear axis.
    pub inertia: Option<Estimate>,
    /// Coupling between motor and beam, Σκ_i \[N·m/rad\].
    pub coupling: Option<Estimate>,
    /// κ_i of each tip of the campaign \[N·m/rad\]; empty if no tip measures an angle.
    pub coupling_by_tip: Vec<Option<Estimate>>,
    /// Gravity, if the campaign has it.
    pub gravity: Option<Gravity>,
}

/// Estimates of the beam.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct BeamEstimates {
    /// Modes with the motor clamped, ascending in frequency.
    pub modes: Vec<ModeEstimate>,
    /// Coupling between motor and beam, Σκ_i = h_{n+1} of (15) \[N·m/rad\].
    pub coupling: Option<Estimate>,
    /// κ_i of each tip of the campaign \[N·m/rad\], `None` for a tip that measures no angle; empty if none does.
    pub coupling_by_tip: Vec<Option<Estimate>>,
}
