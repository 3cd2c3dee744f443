//! Units of a campaign's estimates.

use crate::record::{Axis, Channels, CommandQuantity};

/// Units in which a campaign's estimates are given.
///
/// Torques are in N·m or N where the torque constant is known, else in the unit of the command.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct EstimateUnits {
    /// Rotary or linear.
    pub axis: Axis,
    /// Quantity of the command.
    pub command: CommandQuantity,
    /// Whether torque per command is known.
    pub torque_known: bool,
}

impl EstimateUnits {
    /// Units of the estimates from these channels.
    pub fn new(channels: &Channels) -> Self {
        Self {
            axis: channels.axis,
            command: channels.command.quantity,
            torque_known: channels.command.torque_per_command.is_some(),
        }
    }

    /// Unit of the command.
    pub fn command(self) -> &'static str {
        match self.command {
            CommandQuantity::Current => "A",
            CommandQuantity::Voltage => "V",
            CommandQuantity::Effort if self.axis == Axis::Rotary => "N·m",
            CommandQuantity::Effort => "N",
            CommandQuantity::PositionError | CommandQuantity::Arbitrary => "units of command",
        }
    }

    /// Unit of an angle or a position.
    pub fn angle(self) -> &'static str {
        match self.axis {
            Axis::Rotary => "rad",
            Axis::Linear => "m",
        }
    }

    /// Unit of a torque or a force.
    pub fn torque(self) -> &'static str {
        match (self.torque_known, self.axis) {
            (false, _) => self.command(),
            (true, Axis::Rotary) => "N·m",
            (true, Axis::Linear) => "N",
        }
    }

    /// Unit of viscous friction.
    pub fn viscous(self) -> String {
        format!("{}·s/{}", self.torque(), self.angle())
    }

    /// Unit of coupling, and of a torque that grows with position.
    pub fn stiffness(self) -> String {
        format!("{}/{}", self.torque(), self.angle())
    }

    /// Unit of inertia or mass.
    pub fn inertia(self) -> String {
        match (self.torque_known, self.axis) {
            (true, Axis::Rotary) => "kg·m²".to_owned(),
            (true, Axis::Linear) => "kg".to_owned(),
            (false, _) => format!("{}·s²/{}", self.command(), self.angle()),
        }
    }
}
