//! Names of directions and of the unit of the command in JSON.

use lissom_core::record::{Axis, CommandQuantity};
use serde::{Deserialize, Serialize};

use super::unit_names::UnitNames;

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
    pub(super) fn names(self, axis: Axis, torque_per_command: Option<f64>) -> UnitNames {
        let command = match self {
            Self::A => CommandQuantity::Current,
            Self::V => CommandQuantity::Voltage,
            Self::NewtonMetre | Self::Newton => CommandQuantity::Effort,
            Self::Command => CommandQuantity::Arbitrary,
        };
        UnitNames { torque_known: torque_per_command.is_some(), axis, command }
    }
}
