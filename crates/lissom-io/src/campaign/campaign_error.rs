//! What can be wrong with a campaign beyond its keys.

use thiserror::Error;

use crate::config::ConfigPlace;
use crate::units::Dimension;

/// Why a campaign's signals and drive do not fit together.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum CampaignError {
    /// The motor's unit is neither an angle nor a length.
    #[error("{place}: the motor is measured in {found}, which is neither an angle nor a length")]
    MotorUnit {
        /// Where.
        place: ConfigPlace,
        /// Dimension found.
        found: Dimension,
    },
    /// The motor's unit is one of speed, and its quantity is not.
    #[error("{place}: \"{unit}\" is a unit of speed, but the motor's `quantity` is not \"speed\"")]
    SpeedUnit {
        /// Where.
        place: ConfigPlace,
        /// Unit found.
        unit: String,
    },
    /// The motor's quantity is a speed, and its unit is not.
    #[error("{place}: \"{unit}\" is not a unit of speed, but the motor's `quantity` is \"speed\"")]
    NotASpeed {
        /// Where.
        place: ConfigPlace,
        /// Unit found.
        unit: String,
    },
    /// A command's unit is neither of current, voltage or torque nor `1`.
    #[error(
        "{place}: the command is measured in {found}, which is neither a current, a voltage nor {effort}"
    )]
    CommandUnit {
        /// Where.
        place: ConfigPlace,
        /// Dimension found.
        found: Dimension,
        /// A torque, or a force on a linear axis.
        effort: &'static str,
    },
    /// A position goal in another unit than a position.
    #[error("{place}: a position goal is {position}, and \"{unit}\" is not a unit of {position}")]
    GoalUnit {
        /// Where.
        place: ConfigPlace,
        /// Unit found.
        unit: String,
        /// An angle, or a length on a linear axis.
        position: &'static str,
    },
    /// A position goal without the motor's position.
    #[error("{place}: a position goal needs the motor's position, but the log has its speed")]
    GoalWithSpeed {
        /// Where.
        place: ConfigPlace,
    },
    /// A torque constant per current for a voltage channel, without the winding's resistance.
    #[error(
        "{place}: a torque constant per ampere needs `resistance` where the command is a voltage"
    )]
    NoResistance {
        /// Where.
        place: ConfigPlace,
    },
    /// A torque constant per current for a voltage channel, without the back-EMF constant.
    #[error(
        "{place}: a torque constant per ampere needs `back_emf` where the command is a voltage"
    )]
    NoBackEmf {
        /// Where.
        place: ConfigPlace,
    },
    /// A bare number that could be per ampere or per volt.
    #[error("{place}: a torque constant without a unit could be per ampere or per volt")]
    TorqueConstantUnit {
        /// Where.
        place: ConfigPlace,
    },
    /// A drive key that says nothing about this kind of command.
    #[error("{place} says nothing where the command is {command}")]
    NotForCommand {
        /// Where.
        place: ConfigPlace,
        /// The kind of command.
        command: &'static str,
    },
    /// A length measured at a tip of a rotary axis, without its distance from the joint.
    #[error("{place}: {found} at a tip of a rotary axis needs `radius`")]
    NoRadius {
        /// Where.
        place: ConfigPlace,
        /// Dimension found.
        found: Dimension,
    },
    /// A radius where the reading is an angle already, or on a linear axis.
    #[error("{place}: a radius means nothing for this tip")]
    NeedlessRadius {
        /// Where.
        place: ConfigPlace,
    },
    /// A run driven at or above the Nyquist frequency of its log.
    #[error(
        "{place} is {found_rad_s:.4} rad/s, but must be below {nyquist_rad_s:.4} rad/s, the Nyquist frequency of {log}"
    )]
    AboveNyquist {
        /// Where.
        place: ConfigPlace,
        /// The drive frequency given \[rad/s\].
        found_rad_s: f64,
        /// The log.
        log: String,
        /// π over its sample time \[rad/s\].
        nyquist_rad_s: f64,
    },
    /// Gravity on a linear axis.
    #[error("{place}: gravity on a linear axis is a constant force")]
    GravityOnLinearAxis {
        /// Where.
        place: ConfigPlace,
    },
    /// A speed beside a motor that is a speed.
    #[error("{place}: the motor's channel is its speed already")]
    TwoSpeeds {
        /// Where.
        place: ConfigPlace,
    },
    /// A load's m·g·l where its gravity is not asked for.
    #[error("{place} says nothing without `gravity = true`")]
    MglAlone {
        /// Where.
        place: ConfigPlace,
    },
    /// Gravity on an arm with tips.
    #[error("{place}: gravity is identified for a rigid joint, and this campaign has tips")]
    GravityWithTips {
        /// Where.
        place: ConfigPlace,
    },
    /// A gear beside no torque constant.
    #[error("{place} says nothing without `torque_constant`")]
    GearAlone {
        /// Where.
        place: ConfigPlace,
    },
    /// A camera on a linear axis.
    #[error("{place}: a camera's x and y give an angle, and the motor is measured in metres")]
    CameraOnLinear {
        /// Where.
        place: ConfigPlace,
    },
    /// A camera's quantity is not an angle.
    #[error("{place}: a camera's x and y give the angle of the radius to the point, nothing else")]
    CameraQuantity {
        /// Where.
        place: ConfigPlace,
    },
}

impl CampaignError {
    /// What to do about it.
    pub fn hint(&self) -> Option<String> {
        let hint = match self {
            Self::MotorUnit { .. } => {
                "give \"rad\" or \"deg\" for a rotary axis, \"m\" or \"mm\" for a linear one; counts: unit = \"rad\" with scale = rad per count; speeds: \"rpm\" with quantity = \"speed\""
            }
            Self::SpeedUnit { .. } => {
                "add `quantity = \"speed\"`: the angle is then integrated from the speed"
            }
            Self::NotASpeed { .. } => {
                "give \"rad/s\", \"deg/s\" or \"rpm\" for a rotary axis, \"m/s\" for a linear one, or remove `quantity` if the channel is an angle"
            }
            Self::CommandUnit { .. } => {
                "give \"A\", \"V\" or \"N*m\" (\"N\" on a linear axis), or \"1\" for a command of unknown unit"
            }
            Self::GoalUnit { .. } => {
                "give \"rad\" or \"deg\" for a rotary axis, \"m\" or \"mm\" for a linear one; counts: unit = \"rad\" with scale = rad per count"
            }
            Self::GoalWithSpeed { .. } => {
                "give the column of the motor's angle, or the motor current in place of the goal"
            }
            Self::NoResistance { .. } => {
                "give `resistance` and `back_emf`, or the torque constant per volt, as in \"0.15 N*m/V\""
            }
            Self::NoBackEmf { .. } => {
                "of a DC motor it equals the torque constant in SI, as in \"0.0107 V*s/rad\"; 0 leaves its damping in the viscous figure"
            }
            Self::TorqueConstantUnit { .. } => "give it a unit: N*m/A or N*m/V, N/A or N/V",
            Self::NotForCommand { .. } => "remove it, or describe the channel it belongs to",
            Self::NoRadius { .. } => {
                "give the distance of the sensor from the joint, as in radius = \"0.45 m\""
            }
            Self::NeedlessRadius { .. } => "remove it",
            Self::AboveNyquist { .. } => {
                "`omega_rad_s` is in rad/s, and `frequency = \"5 Hz\"` takes a unit; check the unit of the time stamps too"
            }
            Self::GravityOnLinearAxis { .. } => {
                "remove it: the offset of friction, which every result has, is this force"
            }
            Self::GravityWithTips { .. } => "remove it, or the tips",
            Self::TwoSpeeds { .. } => "remove it, or give the angle as motor",
            Self::MglAlone { .. } => "add gravity = true, or remove it",
            Self::GearAlone { .. } => {
                "give the motor's own torque constant beside it, or remove it: without a constant, estimates are per unit of command"
            }
            Self::CameraOnLinear { .. } => "give one column with a unit of length",
            Self::CameraQuantity { .. } => "remove `quantity`",
        };
        Some(hint.to_owned())
    }
}
