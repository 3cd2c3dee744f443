//! Errors of a campaign whose keys are valid.

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
        /// Place of the value.
        place: ConfigPlace,
        /// The dimension found.
        found: Dimension,
    },
    /// The motor's unit is a unit of speed, but its quantity is not a speed.
    #[error("{place}: \"{unit}\" is a unit of speed, but the motor's `quantity` is not \"speed\"")]
    SpeedUnit {
        /// Place of the value.
        place: ConfigPlace,
        /// The unit found.
        unit: String,
    },
    /// A file is outside of the folder of a campaign that may read nothing else.
    #[error("{file}: is not inside the folder of the campaign")]
    Outside {
        /// The file as the campaign names it.
        file: String,
    },
    /// The motor's quantity is a speed, but its unit is not a unit of speed.
    #[error("{place}: \"{unit}\" is not a unit of speed, but the motor's `quantity` is \"speed\"")]
    NotASpeed {
        /// Place of the value.
        place: ConfigPlace,
        /// The unit found.
        unit: String,
    },
    /// The speed of the motor in a log of its own.
    #[error(
        "{place}: a motor's speed must be in the log of the run; its angle may have a log of its own"
    )]
    OwnLogOfSpeed {
        /// Place of the table.
        place: ConfigPlace,
    },
    /// A key of a signal's own log without that log.
    #[error("{place}: this belongs to a signal in a log of its own, and there is no `file`")]
    NoOwnLog {
        /// Place of the value.
        place: ConfigPlace,
    },
    /// A command's unit is not a unit of current, voltage or torque, and not `1`.
    #[error(
        "{place}: the command is measured in {found}, which is neither a current, a voltage nor {effort}"
    )]
    CommandUnit {
        /// Place of the value.
        place: ConfigPlace,
        /// The dimension found.
        found: Dimension,
        /// A torque, or a force on a linear axis.
        effort: &'static str,
    },
    /// A position goal whose unit is not a unit of position.
    #[error("{place}: a position goal is {position}, and \"{unit}\" is not a unit of {position}")]
    GoalUnit {
        /// Place of the value.
        place: ConfigPlace,
        /// The unit found.
        unit: String,
        /// An angle, or a length on a linear axis.
        position: &'static str,
    },
    /// A position goal without the motor's position.
    #[error("{place}: a position goal needs the motor's position, but the log has its speed")]
    GoalWithSpeed {
        /// Place of the value.
        place: ConfigPlace,
    },
    /// A torque constant per current for a voltage channel, without the winding's resistance.
    #[error("{place}: a torque constant per ampere needs `resistance` if the command is a voltage")]
    NoResistance {
        /// Place of the value.
        place: ConfigPlace,
    },
    /// A torque constant per current for a voltage channel, without the back-EMF constant.
    #[error("{place}: a torque constant per ampere needs `back_emf` if the command is a voltage")]
    NoBackEmf {
        /// Place of the value.
        place: ConfigPlace,
    },
    /// A bare number that could be per ampere or per volt.
    #[error("{place}: a torque constant without a unit could be per ampere or per volt")]
    TorqueConstantUnit {
        /// Place of the value.
        place: ConfigPlace,
    },
    /// A key of the drive that does not apply to this kind of command.
    #[error("{place} does not apply if the command is {command}")]
    NotForCommand {
        /// Place of the value.
        place: ConfigPlace,
        /// The kind of command.
        command: &'static str,
    },
    /// A length measured at a tip of a rotary axis, without its distance from the joint.
    #[error("{place}: {found} at a tip of a rotary axis needs `radius`")]
    NoRadius {
        /// Place of the value.
        place: ConfigPlace,
        /// The dimension found.
        found: Dimension,
    },
    /// A radius for a tip that is measured as an angle, or on a linear axis.
    #[error("{place}: a radius does not apply to this tip")]
    NeedlessRadius {
        /// Place of the value.
        place: ConfigPlace,
    },
    /// A run with a drive frequency at or above the Nyquist frequency of its log.
    #[error(
        "{place} is {found_rad_s:.4} rad/s, but must be below {nyquist_rad_s:.4} rad/s, the Nyquist frequency of {log}"
    )]
    AboveNyquist {
        /// Place of the value.
        place: ConfigPlace,
        /// The drive frequency given \[rad/s\].
        found_rad_s: f64,
        /// The log.
        log: String,
        /// π divided by its sample time \[rad/s\].
        nyquist_rad_s: f64,
    },
    /// Gravity on a linear axis.
    #[error("{place}: gravity on a linear axis is a constant force")]
    GravityOnLinearAxis {
        /// Place of the value.
        place: ConfigPlace,
    },
    /// A speed in addition to a motor channel that is a speed.
    #[error("{place}: the motor's channel is a speed already")]
    TwoSpeeds {
        /// Place of the value.
        place: ConfigPlace,
    },
    /// m·g·l of a load without `gravity = true`.
    #[error("{place} has no effect without `gravity = true`")]
    MglAlone {
        /// Place of the value.
        place: ConfigPlace,
    },
    /// Gravity on an arm with tips.
    #[error("{place}: gravity is identified only for a rigid joint, but this campaign has tips")]
    GravityWithTips {
        /// Place of the value.
        place: ConfigPlace,
    },
    /// A gear without a torque constant.
    #[error("{place} has no effect without `torque_constant`")]
    GearAlone {
        /// Place of the value.
        place: ConfigPlace,
    },
    /// A tip with the samples of the motor.
    #[error(
        "tip \"{tip}\" has the same samples as the motor in every run: it shows no bending of the arm"
    )]
    TipIsMotor {
        /// Name of the tip.
        tip: String,
    },
    /// A camera on a linear axis.
    #[error("{place}: x and y of a camera give an angle, but the motor is measured in metres")]
    CameraOnLinear {
        /// Place of the value.
        place: ConfigPlace,
    },
    /// A camera whose quantity is not an angle.
    #[error("{place}: x and y of a camera can only give the angle of the radius to the point")]
    CameraQuantity {
        /// Place of the value.
        place: ConfigPlace,
    },
}

impl CampaignError {
    /// What the user can do.
    pub fn hint(&self) -> Option<String> {
        let hint = match self {
            Self::MotorUnit { .. } => {
                "give \"rad\" or \"deg\" for a rotary axis, \"m\" or \"mm\" for a linear one; counts: unit = \"rad\" with scale = rad per count; speeds: \"rpm\" with quantity = \"speed\""
            }
            Self::Outside { .. } => {
                "name a file that is given together with the campaign, without a folder above it"
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
                "give the column of the motor's angle, or the motor current instead of the goal"
            }
            Self::NoResistance { .. } => {
                "give `resistance` and `back_emf`, or the torque constant per volt, as in \"0.15 N*m/V\""
            }
            Self::NoBackEmf { .. } => {
                "for a DC motor `back_emf` equals the torque constant in SI, as in \"0.0107 V*s/rad\"; with 0 its damping is part of viscous friction"
            }
            Self::TorqueConstantUnit { .. } => "give it a unit: N*m/A or N*m/V, N/A or N/V",
            Self::NotForCommand { .. } => "remove it, or describe the channel that it belongs to",
            Self::NoRadius { .. } => {
                "give the distance of the sensor from the joint and what it measures, as in quantity = \"deflection\", radius = \"0.45 m\""
            }
            Self::NeedlessRadius { .. } => "remove `radius`",
            Self::AboveNyquist { .. } => {
                "`omega_rad_s` is in rad/s; `frequency = \"5 Hz\"` has a unit; check also the unit of the time stamps"
            }
            Self::GravityOnLinearAxis { .. } => {
                "remove it: every result has this force as the offset of friction"
            }
            Self::GravityWithTips { .. } => "remove `gravity`, or the tips",
            Self::TwoSpeeds { .. } => "remove `speed`, or give the angle as `motor`",
            Self::MglAlone { .. } => "add gravity = true, or remove `mgl`",
            Self::GearAlone { .. } => {
                "add the torque constant of the motor, or remove this key: without a constant, estimates are per unit of command"
            }
            Self::TipIsMotor { .. } => {
                "give the channel of the sensor at the tip; for a rigid axis, leave the tip out"
            }
            Self::CameraOnLinear { .. } => "give one column with a unit of length",
            Self::CameraQuantity { .. } => "remove `quantity`",
            Self::OwnLogOfSpeed { .. } => {
                "give the log with the motor's speed as the `file` of the run"
            }
            Self::NoOwnLog { .. } => "add `file`, the log that has this signal, or remove it",
        };
        Some(hint.to_owned())
    }
}
