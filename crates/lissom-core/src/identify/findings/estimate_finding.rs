//! The estimates of the result: which are given, and what speaks against them.

use std::fmt;

use strum::{IntoStaticStr, VariantNames};

use crate::identify::estimate::Estimate;
use crate::identify::findings::describe::Describe;
use crate::identify::findings::number_text::{significant, with_error};
use crate::identify::findings::result_key as key;
use crate::identify::findings::severity::Severity;
use crate::identify::findings::units::EstimateUnits;

/// A parameter that is refused where the data do not support it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JudgedParameter {
    /// Coulomb friction, the mean of both directions.
    Coulomb,
    /// Viscous friction.
    Viscous,
    /// Inertia or mass.
    Inertia,
    /// Coupling of beam and motor.
    Coupling,
}

impl JudgedParameter {
    fn name(self) -> &'static str {
        match self {
            Self::Coulomb => "Coulomb friction",
            Self::Viscous => "viscous friction",
            Self::Inertia => "inertia",
            Self::Coupling => "coupling",
        }
    }

    fn unit(self, units: EstimateUnits) -> String {
        match self {
            Self::Coulomb => units.torque().to_owned(),
            Self::Viscous => units.viscous(),
            Self::Inertia => units.inertia(),
            Self::Coupling => units.stiffness(),
        }
    }

    fn keys(self) -> Vec<&'static str> {
        match self {
            Self::Coulomb => vec![key::COULOMB],
            Self::Viscous => vec![key::VISCOUS],
            Self::Inertia => vec![key::INERTIA],
            Self::Coupling => vec![key::COUPLING],
        }
    }

    /// What shows it.
    fn hint(self) -> &'static str {
        match self {
            Self::Coulomb => "add slow runs in both directions",
            Self::Viscous => "add runs at higher speed and larger amplitude",
            Self::Inertia => "add runs with more acceleration: faster sines, larger amplitude",
            Self::Coupling => "add runs near the beam's resonance",
        }
    }
}

/// What shows that there is dry friction.
#[derive(Debug, Clone, PartialEq)]
pub enum FrictionSign {
    /// Odd harmonics of the command.
    OddHarmonics {
        /// The run that shows them.
        run: String,
        /// The third harmonic relative to the fundamental.
        third_share: f64,
        /// Odd harmonics relative to the even ones.
        odd_over_even: f64,
    },
    /// A torque that jumps with the direction of motion.
    TorqueJump {
        /// Coulomb friction in standard errors.
        standard_errors: f64,
    },
}

/// A method whose Coulomb friction is compared with the estimate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OtherMethod {
    /// The third-harmonic method.
    ThirdHarmonic,
    /// Constant velocities.
    ConstantVelocity,
}

/// The estimates of the result: which are given, and what speaks against them.
#[derive(Debug, Clone, PartialEq, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "kebab-case")]
#[non_exhaustive]
pub enum EstimateFinding {
    /// A parameter cannot be separated from another term.
    NotSeparable {
        /// Which.
        parameter: JudgedParameter,
    },
    /// The runs hardly show a parameter.
    PoorExcitation {
        /// Which.
        parameter: JudgedParameter,
        /// Its estimate.
        estimate: Estimate,
        /// Unit of the estimate.
        units: EstimateUnits,
        /// Whether it is refused.
        refused: bool,
    },
    /// A parameter that must be positive comes out negative.
    NegativeFigure {
        /// Which.
        parameter: JudgedParameter,
        /// Its estimate.
        estimate: Estimate,
        /// Unit of the estimate.
        units: EstimateUnits,
    },
    /// The motor turns one way only: Coulomb friction and a constant load are one number.
    FrictionWithLoad {
        /// Whether it turns forward.
        forward: bool,
        /// Both together, against the motion.
        sum: Estimate,
        /// Unit of the sum.
        units: EstimateUnits,
    },
    /// Another parameter came out negative.
    OthersDoubtful,
    /// Inertia and Coulomb friction come out negative together.
    CommandSign,
    /// The torque constant is unknown.
    PerUnitOfCommand,
    /// The input is a command, not a measurement.
    CommandNotMeasured,
    /// There is dry friction.
    FrictionVisible {
        /// What shows it.
        sign: FrictionSign,
    },
    /// Friction differs by direction, or a constant load acts.
    Offset {
        /// The offset.
        offset: Estimate,
        /// Unit of the offset.
        units: EstimateUnits,
        /// Offset relative to Coulomb friction.
        share: f64,
    },
    /// Another method gives other Coulomb friction.
    MethodsDisagree {
        /// Which method.
        method: OtherMethod,
        /// Its Coulomb friction relative to the estimate, less one.
        difference_share: f64,
    },
    /// The arm of the estimates does not predict the torque of its own logs.
    ArmNotGiven {
        /// Share of the torque that it leaves.
        residual_share: f64,
    },
    /// No two runs make a pair for the third-harmonic method.
    NoPairs,
}

impl fmt::Display for EstimateFinding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotSeparable { parameter } => write!(
                f,
                "these runs do not separate {} from other terms: it is not given",
                parameter.name()
            ),
            Self::PoorExcitation { parameter, estimate, refused: false, .. } => write!(
                f,
                "these runs hardly show {}: its standard error is {:.0} %",
                parameter.name(),
                100.0 * estimate.std / estimate.value.abs()
            ),
            Self::PoorExcitation { parameter, estimate, units, .. } => {
                let (name, unit) = (parameter.name(), parameter.unit(*units));
                let share = estimate.std / estimate.value.abs();
                if !share.is_finite() {
                    return write!(f, "nothing in these runs shows {name}: it is not given");
                }
                write!(
                    f,
                    "{name} would be {} {unit}, with a standard error of {:.0} %: it is not given",
                    significant(estimate.value, 4),
                    100.0 * share
                )
            }
            Self::NegativeFigure { parameter, estimate, units } => write!(
                f,
                "{} would be {} {}, and must be positive: the model does not fit, and it is not given",
                parameter.name(),
                with_error(*estimate),
                parameter.unit(*units)
            ),
            Self::OthersDoubtful => f.write_str(
                "a parameter that must be positive came out negative: the other estimates rest on the same equation and \
                 may be wrong, too",
            ),
            Self::CommandSign => f.write_str(
                "inertia and friction come out negative together: the sign of the command is opposite to that of the \
                 motor, and no estimate is given",
            ),
            Self::PerUnitOfCommand => f.write_str(
                "the torque constant is unknown: estimates are per unit of command",
            ),
            Self::CommandNotMeasured => f.write_str(
                "the input is the command of the drive, not a measurement: dead band, voltage drop and delay of the \
                 amplifier are counted as those of the joint",
            ),
            Self::FrictionVisible { sign: FrictionSign::OddHarmonics { run, third_share, odd_over_even } } => write!(
                f,
                "the command has odd harmonics, as dry friction causes them (in {run} the third is {:.1} % of the \
                 fundamental, even ones are {} times smaller): the raw response is not linear",
                100.0 * third_share,
                significant(*odd_over_even, 2)
            ),
            Self::FrictionVisible { sign: FrictionSign::TorqueJump { standard_errors } } => write!(
                f,
                "the torque jumps with the direction of motion, as dry friction causes it ({} standard errors): the raw \
                 response is not linear",
                significant(*standard_errors, 2)
            ),
            Self::FrictionWithLoad { forward, sum, units } => write!(
                f,
                "the motor turns {} only: Coulomb friction and a constant load cannot be told apart; together they are \
                 {} {}",
                if *forward { "forward" } else { "backward" },
                with_error(*sum),
                units.torque()
            ),
            // Friction brakes both ways: more than that is a load.
            Self::Offset { offset, units, share } if share.abs() > 1.0 => write!(
                f,
                "a constant load acts, of {} {}: more than Coulomb friction. Friction that differs by direction would \
                 be counted with it",
                with_error(*offset),
                units.torque()
            ),
            Self::Offset { share, .. } => write!(
                f,
                "friction differs by direction, or a constant load acts: the offset is {:.1} % of Coulomb friction",
                100.0 * share
            ),
            Self::MethodsDisagree { method, difference_share } => write!(
                f,
                "Coulomb friction {} differs by {:+.0} % from the estimate",
                match method {
                    OtherMethod::ThirdHarmonic => "by the third harmonic",
                    OtherMethod::ConstantVelocity => "from constant velocities",
                },
                100.0 * difference_share
            ),
            Self::ArmNotGiven { residual_share } => write!(
                f,
                "the arm that these estimates make leaves {:.0} % of the torque of its own logs: it is not given",
                100.0 * residual_share
            ),
            Self::NoPairs => f.write_str(
                "no two runs are at a frequency and at three times that frequency: the third-harmonic method gives \
                 nothing",
            ),
        }
    }
}

impl Describe for EstimateFinding {
    fn code(&self) -> &'static str {
        self.into()
    }

    fn severity(&self) -> Severity {
        match self {
            Self::PoorExcitation { refused: false, .. }
            | Self::OthersDoubtful
            | Self::MethodsDisagree { .. } => Severity::Warning,
            Self::PoorExcitation { .. }
            | Self::NotSeparable { .. }
            | Self::NegativeFigure { .. }
            | Self::FrictionWithLoad { .. }
            | Self::ArmNotGiven { .. }
            | Self::CommandSign => Severity::Refusal,
            Self::PerUnitOfCommand
            | Self::CommandNotMeasured
            | Self::FrictionVisible { .. }
            | Self::Offset { .. }
            | Self::NoPairs => Severity::Info,
        }
    }

    fn affects(&self) -> Vec<&'static str> {
        match self {
            Self::NotSeparable { parameter }
            | Self::PoorExcitation { parameter, .. }
            | Self::NegativeFigure { parameter, .. } => parameter.keys(),
            Self::FrictionWithLoad { .. } => vec![key::COULOMB, key::OFFSET],
            Self::OthersDoubtful => vec![key::COULOMB, key::VISCOUS, key::INERTIA, key::COUPLING],
            Self::CommandSign | Self::PerUnitOfCommand => {
                vec![key::COULOMB, key::VISCOUS, key::INERTIA]
            }
            Self::CommandNotMeasured => vec![key::COULOMB, key::VISCOUS],
            Self::FrictionVisible { .. } => vec![key::COULOMB, key::RAW_RESPONSE],
            Self::Offset { .. } => vec![key::OFFSET],
            Self::MethodsDisagree { method: OtherMethod::ThirdHarmonic, .. } => {
                vec![key::COULOMB, key::THIRD_HARMONIC]
            }
            Self::MethodsDisagree { method: OtherMethod::ConstantVelocity, .. } => {
                vec![key::COULOMB, key::CONSTANT_VELOCITY]
            }
            Self::ArmNotGiven { .. } => vec![key::ARM],
            Self::NoPairs => vec![key::THIRD_HARMONIC],
        }
    }

    fn hint(&self) -> &'static str {
        match self {
            Self::NotSeparable { parameter }
            | Self::PoorExcitation { parameter, .. }
            | Self::NegativeFigure { parameter, .. } => parameter.hint(),
            Self::FrictionWithLoad { .. } => "add a run that turns the other way",
            Self::OthersDoubtful => {
                "the equation does not describe these runs: check signs, units and what acts on the axis"
            }
            Self::CommandSign => "give the command or the motor a negative scale in the campaign",
            Self::PerUnitOfCommand => "give drive.torque_constant in the campaign",
            Self::CommandNotMeasured => "log the motor current where the drive gives it",
            Self::FrictionVisible { .. } => {
                "do not fit a linear model to the raw response; use the corrected response"
            }
            Self::Offset { .. } => {
                "a motion log does not separate the two; a log with the load in another orientation does"
            }
            Self::MethodsDisagree { method: OtherMethod::ThirdHarmonic, .. } => {
                "check for sticking, coarse sensor steps and saturation: they lower the third harmonic's value"
            }
            Self::MethodsDisagree { method: OtherMethod::ConstantVelocity, .. } => {
                "check whether friction grows in proportion to speed: if not, the extrapolation to zero speed is wrong"
            }
            Self::ArmNotGiven { .. } => {
                "friction and inertia stand for themselves; for a prediction measure as many points as the beam has modes"
            }
            Self::NoPairs => "for each frequency ω0 add a run at 3ω0",
        }
    }
}
