//! Friction, inertia and coupling as one method estimates them.

use crate::identify::estimate::Estimate;
use crate::identify::friction_estimates::Friction;
use crate::identify::gravity_estimate::Gravity;

/// A way to estimate the parameters of the drive.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Method {
    /// Replay of the logged command through an arm whose parameters are moved.
    OutputError,
    /// Regression in slip phases under the simplest friction law that the data do not reject.
    FrictionLaw,
    /// Regression in slip phases with viscous friction by direction.
    RegressionByDirection,
    /// Regression in slip phases with Coulomb friction and one viscous coefficient.
    Regression,
    /// Ordinary least squares of smoothed samples.
    LeastSquares,
    /// Rational model of the frequency response, after correction for Coulomb friction.
    FrequencyResponse,
    /// Third harmonic of the command, with the rational model of the response that it corrects.
    ThirdHarmonic,
    /// Command at constant velocities, extrapolated to standstill.
    ConstantVelocity,
}

impl Method {
    /// The name that result files use.
    pub fn name(self) -> &'static str {
        match self {
            Self::OutputError => "output_error",
            Self::FrictionLaw => "friction_law",
            Self::RegressionByDirection => "regression_by_direction",
            Self::Regression => "regression",
            Self::LeastSquares => "least_squares",
            Self::FrequencyResponse => "frequency_response",
            Self::ThirdHarmonic => "third_harmonic",
            Self::ConstantVelocity => "constant_velocity",
        }
    }
}

/// Friction, inertia and coupling from one fit.
///
/// All of them belong together: they describe the logs only as a whole, and the standard errors are
/// those of that fit. What the method does not give is `None`.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct DriveEstimates {
    /// Friction \[N·m or N\].
    pub friction: Friction,
    /// Inertia \[kg·m²\] or mass \[kg\].
    pub inertia: Option<Estimate>,
    /// Torque per angle between motor and beam, Σκ_i \[N·m/rad\].
    pub coupling: Option<Estimate>,
    /// κ_i of each tip of the campaign; empty where no tip shows an angle.
    pub coupling_by_tip: Vec<Option<Estimate>>,
    /// Gravity, where the campaign has it.
    pub gravity: Option<Gravity>,
}
