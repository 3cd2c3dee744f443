//! Names of the units of a campaign, and of what they measure.

use lissom_core::record::{Axis, Channels, CommandQuantity};

/// Units of a campaign, in words.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct UnitNames {
    /// Whether torque (or force) is known; otherwise estimates are per unit of command.
    pub torque_known: bool,
    /// Rotary or linear.
    pub axis: Axis,
    /// The command's quantity.
    pub command: CommandQuantity,
}

impl UnitNames {
    /// The units of these channels.
    pub fn new(channels: &Channels) -> Self {
        Self {
            torque_known: channels.command.torque_per_command.is_some(),
            axis: channels.axis,
            command: channels.command.quantity,
        }
    }

    /// Unit of an angle or position.
    pub fn angle(&self) -> &'static str {
        match self.axis {
            Axis::Rotary => "rad",
            Axis::Linear => "m",
        }
    }
    /// Unit of a speed.
    pub fn speed_unit(&self) -> String {
        format!("{}/s", self.angle())
    }
    /// Unit of friction that grows with the square root of the speed.
    pub fn root_unit(&self) -> String {
        format!("{}/√({}/s)", self.torque_unit(), self.angle())
    }
    /// Unit of a torque constant.
    pub fn torque_constant_unit(&self) -> String {
        let torque = Self { torque_known: true, ..*self };
        format!("{}/{}", torque.torque_unit(), self.command_unit())
    }
    /// Unit of the command in words.
    pub fn command_unit(&self) -> &'static str {
        match self.command {
            CommandQuantity::Current => "A",
            CommandQuantity::Voltage => "V",
            CommandQuantity::Effort if self.axis == Axis::Rotary => "N·m",
            CommandQuantity::Effort => "N",
            CommandQuantity::PositionError | CommandQuantity::Arbitrary => "command",
        }
    }
    /// Unit of a torque or force in words.
    pub fn torque_unit(&self) -> &'static str {
        match (self.torque_known, self.axis) {
            (false, _) => self.command_unit(),
            (true, Axis::Rotary) => "N·m",
            (true, Axis::Linear) => "N",
        }
    }
    /// What the motor's sensor measures: angle or position.
    pub fn motion(&self) -> &'static str {
        match self.axis {
            Axis::Rotary => "angle",
            Axis::Linear => "position",
        }
    }
    /// The command in words.
    pub fn command_name(&self) -> &'static str {
        match self.command {
            CommandQuantity::Current => "current",
            CommandQuantity::Voltage => "voltage",
            CommandQuantity::Effort if self.axis == Axis::Rotary => "torque",
            CommandQuantity::Effort => "force",
            CommandQuantity::PositionError | CommandQuantity::Arbitrary => "command",
        }
    }
    /// Inertia of a rotary axis or mass of a linear axis, in words.
    pub fn inertia_name(&self) -> &'static str {
        match self.axis {
            Axis::Rotary => "inertia",
            Axis::Linear => "mass",
        }
    }
    /// Unit of inertia or mass in words.
    pub fn inertia_unit(&self) -> String {
        match (self.torque_known, self.axis) {
            (true, Axis::Rotary) => "kg·m²".to_owned(),
            (true, Axis::Linear) => "kg".to_owned(),
            (false, _) => format!("{}·s²/{}", self.command_unit(), self.angle()),
        }
    }
    /// Unit of viscous friction in words.
    pub fn viscous_unit(&self) -> String {
        format!("{}·s/{}", self.torque_unit(), self.angle())
    }
    /// Unit of coupling in words.
    pub fn coupling_unit(&self) -> String {
        format!("{}/{}", self.torque_unit(), self.angle())
    }
}
