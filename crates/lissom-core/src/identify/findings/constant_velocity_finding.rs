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

/// How friction bends over speed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Curvature {
    /// It grows less than in proportion: an extrapolation to zero speed is too high.
    Concave,
    /// It grows more than in proportion: an extrapolation to zero speed is too low.
    Convex,
}

/// Friction from constant velocities.
#[derive(Debug, Clone, PartialEq, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "kebab-case")]
#[non_exhaustive]
pub enum ConstantVelocityFinding {
    /// A run that turns one way has no part at a constant velocity.
    NoSteadyVelocity,
    /// Every run turns at constant velocities.
    ConstantVelocityOnly {
        /// Whether tips are measured.
        flexible: bool,
    },
    /// Friction is taken from constant velocities.
    ClassicalFigures,
    /// Friction over speed is curved, and the slowest speeds are used.
    SlowestSpeedsTaken,
    /// Friction over speed is curved in one direction.
    ExtrapolationCurved {
        /// Which direction.
        direction: SlipDirection,
        /// Which way it bends.
        curvature: Curvature,
        /// What bends the line, in standard errors.
        standard_errors: f64,
        /// The command extrapolated to zero speed.
        command: f64,
        /// The same from the slowest third of the speeds alone.
        command_of_slowest: Option<Estimate>,
        /// Unit of the command.
        unit: &'static str,
    },
    /// Points scatter about their line in one direction.
    SpeedsScatter {
        /// Which direction.
        direction: SlipDirection,
        /// Root mean square of the distances from the line, in standard errors.
        rms_standard_errors: f64,
        /// The command extrapolated to zero speed.
        command: f64,
        /// Unit of the command.
        unit: &'static str,
    },
    /// There are two speeds in one direction.
    TwoSpeeds {
        /// Which direction.
        direction: SlipDirection,
    },
    /// There is no constant velocity in one direction.
    OneDirection {
        /// The direction without.
        direction: SlipDirection,
    },
    /// There is one speed in one direction.
    TooFewSpeeds {
        /// Which direction.
        direction: SlipDirection,
        /// Speeds found.
        speeds: usize,
    },
    /// The speeds are too close together for an extrapolation.
    SpeedsTooClose {
        /// Which direction.
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
                "the motor turns one way throughout, and no part of the run is at a constant velocity: the run gives \
                 no point of friction over speed",
            ),
            Self::ConstantVelocityOnly { flexible } => write!(
                f,
                "every run turns at constant velocities, which show friction only: {} not given",
                if *flexible { "inertia, modes and coupling are" } else { "inertia is" }
            ),
            Self::ClassicalFigures => f.write_str(
                "friction is taken from constant velocities, extrapolated to zero speed: no other method gives it to better than \
                 20 %",
            ),
            Self::SlowestSpeedsTaken => f.write_str(
                "friction does not grow in proportion to speed: Coulomb friction is taken from the slowest third of \
                 the speeds, viscous friction from the slope over all speeds",
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
                    "{direction}, friction grows {grows} than in proportion to speed ({standard_errors:.1} standard \
                     errors): the command extrapolated to zero speed, {} {unit}, is too {wrong}{slowest}",
                    significant(*command, DIGITS)
                )
            }
            Self::SpeedsScatter { direction, rms_standard_errors, command, unit } => write!(
                f,
                "{direction}, the points lie {rms_standard_errors:.1} standard errors (rms) from their line, to both \
                 sides: the standard error of the command extrapolated to zero speed, {} {unit}, counts this scatter",
                significant(*command, DIGITS)
            ),
            Self::TwoSpeeds { direction } => write!(
                f,
                "{direction}, there are only two speeds: whether friction grows in proportion to speed is not tested"
            ),
            Self::OneDirection { direction } => write!(
                f,
                "{direction}, no run turns at a constant velocity: friction is not separated from a constant load"
            ),
            Self::TooFewSpeeds { direction, speeds } => write!(
                f,
                "{direction}, there is only {speeds} speed: a line to zero speed needs two, and a test of the line \
                 needs three"
            ),
            Self::SpeedsTooClose { direction, command, unit } => write!(
                f,
                "{direction}, the command extrapolated to zero speed is {} {unit}: its standard error is too large, \
                 and friction is not given",
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
            Self::ClassicalFigures | Self::NoSteadyVelocity => Severity::Info,
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
            Self::ClassicalFigures | Self::SlowestSpeedsTaken => {
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
                "hold each speed for seven time constants of the loop or more; where the joint sticks and slips, turn \
                 faster"
            }
            Self::ConstantVelocityOnly { .. } => {
                "add runs that move back and forth: sines, a sweep, ordinary moves"
            }
            Self::ClassicalFigures => {
                "add sines or ordinary moves at the speeds of interest: they show friction without an extrapolation"
            }
            Self::SlowestSpeedsTaken => {
                "use these estimates only at the speeds of interest, or identify from moves at those speeds"
            }
            Self::ExtrapolationCurved { .. } => {
                "add speeds near zero, as slow as the motor still turns evenly, or identify from sines at the speeds \
                 of interest"
            }
            Self::SpeedsScatter { .. } => {
                "friction changes with position or temperature: hold each speed over the same whole turns, after a \
                 warm-up"
            }
            Self::TwoSpeeds { .. } => "add a third speed, well apart from both",
            Self::OneDirection { .. } => "run the speeds in both directions",
            Self::TooFewSpeeds { .. } => {
                "add speeds well apart, the slowest as slow as the motor still turns evenly"
            }
            Self::SpeedsTooClose { .. } => "add slower speeds",
        }
    }
}
