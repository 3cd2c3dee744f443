//! Names of axes, directions and quantities in JSON.

use lissom_core::drive::Falloff;
use lissom_core::identify::{ArmSource, Method};
use lissom_core::record::{Axis, CommandQuantity, TipQuantity};
use serde::{Deserialize, Serialize};

use super::unit_names::UnitNames;

/// Kind of axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum AxisName {
    /// A rotary axis, with angles in rad.
    Rotary,
    /// A linear axis, with positions in m.
    Linear,
}

impl AxisName {
    /// The name of an axis.
    pub fn of(axis: Axis) -> Self {
        match axis {
            Axis::Rotary => Self::Rotary,
            Axis::Linear => Self::Linear,
        }
    }

    fn axis(self) -> Axis {
        match self {
            Self::Rotary => Axis::Rotary,
            Self::Linear => Axis::Linear,
        }
    }

    /// The name as in JSON.
    pub fn text(self) -> &'static str {
        match self {
            Self::Rotary => "rotary",
            Self::Linear => "linear",
        }
    }
}

/// What a tip measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum TipQuantityName {
    /// Angle of the radius to its point.
    Angle,
    /// Deflection of its point from the motor's line.
    Deflection,
    /// Acceleration of its point.
    Acceleration,
}

impl TipQuantityName {
    /// The name of a quantity.
    pub fn of(quantity: TipQuantity) -> Self {
        match quantity {
            TipQuantity::Angle => Self::Angle,
            TipQuantity::Deflection => Self::Deflection,
            TipQuantity::Acceleration => Self::Acceleration,
        }
    }

    /// The name as in JSON.
    pub(crate) fn text(self) -> &'static str {
        match self {
            Self::Angle => "angle",
            Self::Deflection => "deflection",
            Self::Acceleration => "acceleration",
        }
    }
}

/// Direction of the motor's motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum DirectionName {
    /// Towards larger angles.
    Forward,
    /// Towards smaller angles.
    Backward,
}

impl DirectionName {
    /// Its sign: +1 or −1.
    pub fn sign(self) -> f64 {
        match self {
            Self::Forward => 1.0,
            Self::Backward => -1.0,
        }
    }

    /// Forward if `forward` is true, otherwise backward.
    pub(crate) fn of(forward: bool) -> Self {
        if forward { Self::Forward } else { Self::Backward }
    }
}

/// How friction near rest changes with speed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum FalloffName {
    /// exp(-|v|/v_s).
    Exponential,
    /// exp(-(v/v_s)^2).
    Gaussian,
}

impl FalloffName {
    /// The name of a falloff.
    pub fn of(falloff: Falloff) -> Self {
        match falloff {
            Falloff::Exponential => Self::Exponential,
            Falloff::Gaussian => Self::Gaussian,
        }
    }

    /// The falloff of this name.
    pub(crate) fn falloff(self) -> Falloff {
        match self {
            Self::Exponential => Falloff::Exponential,
            Self::Gaussian => Falloff::Gaussian,
        }
    }
}

/// The method that gave the estimates.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum ArmSourceName {
    /// The output-error method.
    OutputError,
    /// The regression.
    Regression,
}

impl ArmSourceName {
    /// The name of a method.
    pub fn of(source: ArmSource) -> Self {
        match source {
            ArmSource::OutputError => Self::OutputError,
            ArmSource::Regression => Self::Regression,
        }
    }

    /// The method of this name.
    pub(crate) fn source(self) -> ArmSource {
        match self {
            Self::OutputError => ArmSource::OutputError,
            Self::Regression => ArmSource::Regression,
        }
    }
}

/// A method that estimates the drive's parameters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum MethodName {
    /// The output-error method: simulation of the arm under the logged command, with parameters adapted to the log.
    OutputError,
    /// Regression in slip phases with the friction law that the data support.
    FrictionLaw,
    /// Regression in slip phases with Coulomb friction and one viscous coefficient.
    Regression,
    /// Ordinary least squares of smoothed samples.
    LeastSquares,
    /// Rational model of the corrected frequency response.
    FrequencyResponse,
    /// Third harmonic of the command.
    ThirdHarmonic,
    /// Command at constant velocities, extrapolated to standstill.
    ConstantVelocity,
}

impl MethodName {
    /// The name of a method; `None` if the file has no name for it.
    pub(crate) fn of(method: Method) -> Option<Self> {
        Some(match method {
            Method::OutputError => Self::OutputError,
            Method::FrictionLaw => Self::FrictionLaw,
            Method::Regression => Self::Regression,
            Method::LeastSquares => Self::LeastSquares,
            Method::FrequencyResponse => Self::FrequencyResponse,
            Method::ThirdHarmonic => Self::ThirdHarmonic,
            Method::ConstantVelocity => Self::ConstantVelocity,
            _ => return None,
        })
    }

    /// The method in words.
    pub fn words(self) -> &'static str {
        let method = match self {
            Self::OutputError => Method::OutputError,
            Self::FrictionLaw => Method::FrictionLaw,
            Self::Regression => Method::Regression,
            Self::LeastSquares => Method::LeastSquares,
            Self::FrequencyResponse => Method::FrequencyResponse,
            Self::ThirdHarmonic => Method::ThirdHarmonic,
            Self::ConstantVelocity => Method::ConstantVelocity,
        };
        method.words()
    }
}

/// Unit of the command.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum CommandUnitName {
    /// A current.
    A,
    /// A voltage.
    V,
    /// A torque.
    #[serde(rename = "N·m")]
    NewtonMetre,
    /// A force.
    #[serde(rename = "N")]
    Newton,
    /// An unknown unit, or a position error.
    #[serde(rename = "command")]
    Command,
}

impl CommandUnitName {
    pub(super) fn of(quantity: CommandQuantity, axis: Axis) -> Self {
        match quantity {
            CommandQuantity::Current => Self::A,
            CommandQuantity::Voltage => Self::V,
            CommandQuantity::Effort if axis == Axis::Rotary => Self::NewtonMetre,
            CommandQuantity::Effort => Self::Newton,
            CommandQuantity::PositionError | CommandQuantity::Arbitrary => Self::Command,
        }
    }

    /// The units of a result.
    pub(super) fn names(self, axis: AxisName, torque_per_command: Option<f64>) -> UnitNames {
        let command = match self {
            Self::A => CommandQuantity::Current,
            Self::V => CommandQuantity::Voltage,
            Self::NewtonMetre | Self::Newton => CommandQuantity::Effort,
            Self::Command => CommandQuantity::Arbitrary,
        };
        UnitNames { torque_known: torque_per_command.is_some(), axis: axis.axis(), command }
    }
}
