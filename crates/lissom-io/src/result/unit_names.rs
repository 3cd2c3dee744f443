//! Names of keys and units of a campaign.

use lissom_core::record::{Axis, Channels, CommandQuantity};

/// Units of a campaign, with the suffixes of keys and the names of units.
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
    /// Every combination of units that a campaign may have.
    pub(crate) const ALL: [Self; 12] = {
        let [current, voltage, arbitrary] =
            [CommandQuantity::Current, CommandQuantity::Voltage, CommandQuantity::Arbitrary];
        [
            Self { torque_known: false, axis: Axis::Rotary, command: current },
            Self { torque_known: false, axis: Axis::Rotary, command: voltage },
            Self { torque_known: false, axis: Axis::Rotary, command: arbitrary },
            Self { torque_known: false, axis: Axis::Linear, command: current },
            Self { torque_known: false, axis: Axis::Linear, command: voltage },
            Self { torque_known: false, axis: Axis::Linear, command: arbitrary },
            Self { torque_known: true, axis: Axis::Rotary, command: current },
            Self { torque_known: true, axis: Axis::Rotary, command: voltage },
            Self { torque_known: true, axis: Axis::Rotary, command: arbitrary },
            Self { torque_known: true, axis: Axis::Linear, command: current },
            Self { torque_known: true, axis: Axis::Linear, command: voltage },
            Self { torque_known: true, axis: Axis::Linear, command: arbitrary },
        ]
    };

    /// The units of these channels.
    pub fn new(channels: &Channels) -> Self {
        Self {
            torque_known: channels.command.torque_per_command.is_some(),
            axis: channels.axis,
            command: channels.command.quantity,
        }
    }

    /// Suffix of the command's unit: `a`, `v` or `command`.
    pub fn command(&self) -> &'static str {
        match self.command {
            CommandQuantity::Current => "a",
            CommandQuantity::Voltage => "v",
            CommandQuantity::PositionError | CommandQuantity::Arbitrary => "command",
        }
    }
    /// Suffix of a torque or force; that of the command if the torque constant is unknown.
    pub fn torque(&self) -> &'static str {
        match (self.torque_known, self.axis) {
            (false, _) => self.command(),
            (true, Axis::Rotary) => "nm",
            (true, Axis::Linear) => "n",
        }
    }
    /// Suffix of an angle or position.
    pub fn angle(&self) -> &'static str {
        match self.axis {
            Axis::Rotary => "rad",
            Axis::Linear => "m",
        }
    }
    /// Key of the inertia or mass.
    pub fn inertia_key(&self) -> String {
        match (self.torque_known, self.axis) {
            (true, Axis::Rotary) => "inertia_kg_m2".to_owned(),
            (true, Axis::Linear) => "mass_kg".to_owned(),
            (false, _) => format!("inertia_{}_s2_per_{}", self.command(), self.angle()),
        }
    }
    /// Key of a viscous coefficient, e.g. `viscous_nm_s_per_rad`.
    pub fn viscous_key(&self, name: &str) -> String {
        format!("{name}_{}_s_per_{}", self.torque(), self.angle())
    }
    /// Key of a coupling, e.g. `coupling_nm_per_rad`.
    pub fn coupling_key(&self, name: &str) -> String {
        format!("{name}_{}_per_{}", self.torque(), self.angle())
    }

    /// Key of friction that grows with the square root of the speed.
    pub fn root_key(&self, name: &str) -> String {
        format!("{name}_{}_per_root_{}_per_s", self.torque(), self.angle())
    }

    /// Unit of the command in words.
    pub fn command_unit(&self) -> &'static str {
        match self.command {
            CommandQuantity::Current => "A",
            CommandQuantity::Voltage => "V",
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
