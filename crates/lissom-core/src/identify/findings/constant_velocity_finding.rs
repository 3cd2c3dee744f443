//! Friction from constant velocities.

use std::fmt;

use strum::{IntoStaticStr, VariantNames};

use crate::identify::estimate::Estimate;
use crate::identify::findings::describe::Describe;
use crate::identify::findings::number_text::{significant, with_error};
use crate::identify::findings::result_key as key;
use crate::identify::findings::severity::Severity;

/// Digits of a command extrapolated to zero speed.
const DIGITS: usize = 4;

/// Direction in which the joint slips.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SlipDirection {
    /// Positive velocity.
    Forward,
    /// Negative velocity.
    Backward,
}

impl fmt::Display for SlipDirection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Forward => "forward",
            Self::Backward => "backward",
        })
    }
}

/// Curvature of friction over speed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Curvature {
    /// Friction grows less than linearly: the value extrapolated to zero speed is too high.
    Concave,
    /// Friction grows more than linearly: the value extrapolated to zero speed is too low.
    Convex,
}

/// Friction from constant velocities.
#[derive(Debug, Clone, PartialEq, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "kebab-case")]
#[non_exhaustive]
pub enum ConstantVelocityFinding {
    /// The motor turns in one direction only, and no part of the run has a constant velocity.
    NoSteadyVelocity,
    /// The motor turns at constant velocities in every run.
    ConstantVelocityOnly {
        /// Whether tips are measured.
        flexible: bool,
    },
    /// Friction is taken from constant velocities.
    ConstantVelocityEstimates,
    /// Friction over speed is curved, and Coulomb friction is taken from the slowest speeds.
    SlowestSpeedsTaken,
    /// Friction over speed is curved in one direction.
    ExtrapolationCurved {
        /// The direction.
        direction: SlipDirection,
        /// Sign of the curvature.
        curvature: Curvature,
        /// Size of the curvature, in standard errors.
        standard_errors: f64,
        /// The command extrapolated to zero speed.
        command: f64,
        /// The same from the slowest third of the speeds alone.
        command_of_slowest: Option<Estimate>,
        /// Unit of the command.
        unit: &'static str,
    },
    /// In one direction the points scatter about their line.
    SpeedsScatter {
        /// The direction.
        direction: SlipDirection,
        /// Root mean square of the distances from the line, in standard errors.
        rms_standard_errors: f64,
        /// The command extrapolated to zero speed.
        command: f64,
        /// Unit of the command.
        unit: &'static str,
    },
    /// There are only two speeds in one direction.
    TwoSpeeds {
        /// The direction.
        direction: SlipDirection,
    },
    /// There is no constant velocity in one direction.
    OneDirection {
        /// The direction without a constant velocity.
        direction: SlipDirection,
    },
    /// There is only one speed in one direction.
    TooFewSpeeds {
        /// The direction.
        direction: SlipDirection,
        /// Speeds found.
        speeds: usize,
    },
    /// The speeds are too close together for an extrapolation.
    SpeedsTooClose {
        /// The direction.
        direction: SlipDirection,
        /// The command extrapolated to zero speed.
        command: Estimate,
        /// Unit of the command.
        unit: &'static str,
    },
}

impl fmt::Display for ConstantVelocityFinding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoSteadyVelocity => f.write_str(
                "the motor turns in one direction only, and no part of the run has a constant velocity: the run gives \
                 no point of friction over speed",
            ),
            Self::ConstantVelocityOnly { flexible } => write!(
                f,
                "the motor turns at constant velocities in all runs. These show only friction: {} not given",
                if *flexible { "inertia, modes and coupling are" } else { "inertia is" }
            ),
            Self::ConstantVelocityEstimates => f.write_str(
                "friction is taken from constant velocities, extrapolated to zero speed, because no other method gives it",
            ),
            Self::SlowestSpeedsTaken => f.write_str(
                "friction does not grow linearly with speed: Coulomb friction is taken from the slowest third of the \
                 speeds, viscous friction from the slope over all speeds",
            ),
            Self::ExtrapolationCurved {
                direction,
                curvature,
                standard_errors,
                command,
                command_of_slowest,
                unit,
            } => {
                let (grows, wrong) = match curvature {
                    Curvature::Concave => ("less", "high"),
                    Curvature::Convex => ("more", "low"),
                };
                let slowest = command_of_slowest.map_or_else(String::new, |e| {
                    format!("; the slowest third of the speeds gives {} {unit}", with_error(e))
                });
                write!(
                    f,
                    "in the {direction} direction friction grows {grows} than linearly with speed ({standard_errors:.1} \
                     standard errors): the command extrapolated to zero speed, {} {unit}, is too {wrong}{slowest}",
                    significant(*command, DIGITS)
                )
            }
            Self::SpeedsScatter { direction, rms_standard_errors, command, unit } => write!(
                f,
                "in the {direction} direction the points scatter about their line by {rms_standard_errors:.1} standard \
                 errors (rms): the standard error of the command extrapolated to zero speed, {} {unit}, includes this \
                 scatter",
                significant(*command, DIGITS)
            ),
            Self::TwoSpeeds { direction } => write!(
                f,
                "in the {direction} direction there are only two speeds: they do not show whether friction grows linearly \
                 with speed"
            ),
            Self::OneDirection { direction } => write!(
                f,
                "no run turns {direction} at a constant velocity: friction cannot be separated from a constant load"
            ),
            Self::TooFewSpeeds { direction, speeds } => write!(
                f,
                "in the {direction} direction there is only {speeds} speed, but an extrapolation to zero speed needs two, \
                 and a test of the line needs three. Constant velocities give no friction"
            ),
            Self::SpeedsTooClose { direction, command, unit } => write!(
                f,
                "in the {direction} direction the command extrapolated to zero speed is {} {unit}: its standard error is \
                 too large. Constant velocities give no friction",
                with_error(*command)
            ),
        }
    }
}

impl Describe for ConstantVelocityFinding {
    fn code(&self) -> &'static str {
        self.into()
    }

    fn severity(&self) -> Severity {
        match self {
            Self::ConstantVelocityEstimates | Self::NoSteadyVelocity => Severity::Info,
            Self::SlowestSpeedsTaken
            | Self::ExtrapolationCurved { .. }
            | Self::SpeedsScatter { .. }
            | Self::TwoSpeeds { .. } => Severity::Warning,
            Self::ConstantVelocityOnly { .. }
            | Self::OneDirection { .. }
            | Self::TooFewSpeeds { .. }
            | Self::SpeedsTooClose { .. } => Severity::Refusal,
        }
    }

    fn affects(&self) -> Vec<&'static str> {
        match self {
            Self::ConstantVelocityOnly { flexible: true } => {
                vec![key::INERTIA, key::MODES, key::COUPLING]
            }
            Self::ConstantVelocityOnly { flexible: false } => vec![key::INERTIA],
            Self::ConstantVelocityEstimates | Self::SlowestSpeedsTaken => {
                vec![key::COULOMB, key::OFFSET, key::VISCOUS]
            }
            Self::NoSteadyVelocity
            | Self::ExtrapolationCurved { .. }
            | Self::SpeedsScatter { .. }
            | Self::TwoSpeeds { .. } => vec![key::CONSTANT_VELOCITY],
            Self::OneDirection { .. } | Self::TooFewSpeeds { .. } | Self::SpeedsTooClose { .. } => {
                vec![key::CONSTANT_VELOCITY, key::COULOMB, key::OFFSET]
            }
        }
    }

    fn hint(&self) -> &'static str {
        match self {
            Self::NoSteadyVelocity => {
                "hold each speed for seven time constants of the control loop or more; if the joint sticks and slips, \
                 turn faster"
            }
            Self::ConstantVelocityOnly { .. } => {
                "add runs that move back and forth: sines, a sweep, ordinary moves"
            }
            Self::ConstantVelocityEstimates => {
                "add sines or ordinary moves at the speeds of interest: they show friction without an extrapolation"
            }
            Self::SlowestSpeedsTaken => {
                "use these estimates only at the speeds of interest, or identify from moves at those speeds"
            }
            Self::ExtrapolationCurved { .. } => {
                "add slower speeds, down to the slowest at which the motor turns evenly, or identify from sines at the \
                 speeds of interest"
            }
            Self::SpeedsScatter { .. } => {
                "friction may change with position or temperature: measure each speed over the same whole turns, after \
                 a warm-up"
            }
            Self::TwoSpeeds { .. } => "add a third speed, well apart from both",
            Self::OneDirection { .. } => "measure the speeds in both directions",
            Self::TooFewSpeeds { .. } => {
                "add speeds that are well apart, down to the slowest at which the motor turns evenly"
            }
            Self::SpeedsTooClose { .. } => "add slower speeds",
        }
    }
}
