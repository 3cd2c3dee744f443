//! Estimates of the result: which are refused or uncertain, and why.

use std::fmt;

use strum::{IntoStaticStr, VariantNames};

use crate::identify::drive_estimates::Method;
use crate::identify::estimate::Estimate;
use crate::identify::findings::describe::Describe;
use crate::identify::findings::number_text::{minus, significant, with_error};
use crate::identify::findings::result_key as key;
use crate::identify::findings::severity::Severity;
use crate::identify::findings::units::EstimateUnits;

/// A parameter that is refused if the data do not support it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JudgedParameter {
    /// Coulomb friction, the mean of both directions.
    Coulomb,
    /// Offset of friction, and with it Coulomb friction by direction.
    Offset,
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
            Self::Offset => "the offset of friction (friction by direction)",
            Self::Viscous => "viscous friction",
            Self::Inertia => "inertia",
            Self::Coupling => "coupling",
        }
    }

    fn unit(self, units: EstimateUnits) -> String {
        match self {
            Self::Coulomb | Self::Offset => units.torque().to_owned(),
            Self::Viscous => units.viscous(),
            Self::Inertia => units.inertia(),
            Self::Coupling => units.stiffness(),
        }
    }

    fn keys(self) -> Vec<&'static str> {
        match self {
            Self::Coulomb => vec![key::COULOMB],
            Self::Offset => vec![key::OFFSET],
            Self::Viscous => vec![key::VISCOUS],
            Self::Inertia => vec![key::INERTIA],
            Self::Coupling => vec![key::COUPLING],
        }
    }

    /// Runs that show the parameter better.
    fn hint(self) -> &'static str {
        match self {
            Self::Coulomb => "add slow runs in both directions",
            Self::Offset => "add motion in both directions, over a long arc if gravity acts",
            Self::Viscous => "add runs at higher speed and larger amplitude",
            Self::Inertia => "add runs with more acceleration: faster sines, larger amplitude",
            Self::Coupling => "add runs near the beam's resonance",
        }
    }
}

/// Evidence of dry friction.
#[derive(Debug, Clone, PartialEq)]
pub enum FrictionSign {
    /// Odd harmonics of the command.
    OddHarmonics {
        /// Name of the run.
        run: String,
        /// The third harmonic relative to the fundamental.
        third_share: f64,
        /// Size of the odd harmonics relative to the even ones.
        odd_over_even: f64,
    },
    /// A torque that jumps when the direction of motion changes.
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

/// Estimates of the result: which are refused or uncertain, and why.
#[derive(Debug, Clone, PartialEq, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "kebab-case")]
#[non_exhaustive]
pub enum EstimateFinding {
    /// A parameter cannot be separated from another term.
    NotSeparable {
        /// The parameter.
        parameter: JudgedParameter,
    },
    /// The runs contain little information about a parameter.
    PoorExcitation {
        /// The parameter.
        parameter: JudgedParameter,
        /// Its estimate.
        estimate: Estimate,
        /// Unit of the estimate.
        units: EstimateUnits,
        /// Whether the estimate is refused.
        refused: bool,
    },
    /// A parameter that must be positive comes out negative.
    NegativeEstimate {
        /// The parameter.
        parameter: JudgedParameter,
        /// Its estimate.
        estimate: Estimate,
        /// Unit of the estimate.
        units: EstimateUnits,
    },
    /// The motor turns in one direction only: Coulomb friction and a constant load cannot be separated.
    FrictionWithLoad {
        /// Whether it turns forward.
        forward: bool,
        /// Sum of both, against the motion.
        sum: Estimate,
        /// Unit of the sum.
        units: EstimateUnits,
    },
    /// Another parameter came out negative.
    OthersDoubtful,
    /// Friction falls with speed: the straight line has a negative slope, and its intercept is no friction of the log.
    FrictionFalls {
        /// Mean speed of the log \[rad/s or m/s\].
        speed: f64,
        /// Friction at that speed.
        friction: f64,
        /// Units of both.
        units: EstimateUnits,
    },
    /// The model that predicts best leaves a parameter unknown; the line is given.
    LineTaken {
        /// The parameter.
        parameter: JudgedParameter,
        /// The method that leaves it unknown.
        refused_by: Method,
    },
    /// Inertia and Coulomb friction are both negative.
    CommandSign,
    /// The torque constant is unknown.
    PerUnitOfCommand,
    /// The input is a command, not a measurement.
    CommandNotMeasured,
    /// There is dry friction.
    FrictionVisible {
        /// The evidence.
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
    /// Another method gives a different value of Coulomb friction.
    MethodsDisagree {
        /// The other method.
        method: OtherMethod,
        /// Its Coulomb friction relative to the estimate, minus one.
        difference_share: f64,
    },
    /// The arm of the estimates does not predict the torque of its own logs.
    ArmNotGiven {
        /// Residual torque relative to the torque.
        residual_share: f64,
    },
    /// No two runs make a pair for the third-harmonic method.
    NoPairs,
}

/// A large ratio whose digits say nothing.
const MANY: f64 = 1000.0;

/// A ratio in two digits; a large one as "more than 1000".
fn about(ratio: f64) -> String {
    if ratio > MANY { format!("more than {MANY}") } else { significant(ratio, 2) }
}

impl fmt::Display for EstimateFinding {
    #[expect(clippy::too_many_lines, reason = "one sentence for each finding")]
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotSeparable { parameter } => write!(
                f,
                "these runs do not separate {} from other terms: it is not given",
                parameter.name()
            ),
            Self::PoorExcitation { parameter, estimate, refused: false, .. } => write!(
                f,
                "these runs contain little information about {}: its standard error is {:.0} % of the estimate",
                parameter.name(),
                100.0 * estimate.std / estimate.value.abs()
            ),
            Self::PoorExcitation { parameter, estimate, units, .. } => {
                let (name, unit) = (parameter.name(), parameter.unit(*units));
                if !(estimate.std / estimate.value.abs()).is_finite() {
                    return write!(f, "these runs contain no information about {name}: it is not given");
                }
                write!(
                    f,
                    "{name} would be {} {unit}, so uncertain that it is not given",
                    with_error(*estimate)
                )
            }
            Self::NegativeEstimate { parameter, estimate, units } => write!(
                f,
                "{} would be {} {}, but it must be positive: the model does not fit these runs, and the estimate is not given",
                parameter.name(),
                with_error(*estimate),
                parameter.unit(*units)
            ),
            Self::OthersDoubtful => f.write_str(
                "a parameter that must be positive is negative: the other estimates come from the same equation and may be \
                 wrong as well",
            ),
            Self::FrictionFalls { speed, friction, units } => write!(
                f,
                "friction falls with speed over the speeds of these runs: the line that it is compared by would have a negative \
                 slope, and its Coulomb friction is that of no speed. At the mean speed of {} {}/s friction is {} {}",
                significant(*speed, 3),
                units.angle(),
                significant(*friction, 3),
                units.torque()
            ),
            Self::LineTaken { parameter, refused_by } => write!(
                f,
                "{} is unknown by {}: the line of Coulomb and viscous friction is given in its place",
                parameter.name(),
                refused_by.words()
            ),
            Self::CommandSign => f.write_str(
                "inertia and Coulomb friction are both negative: the command and the motor's angle have opposite signs, and \
                 no estimate is given",
            ),
            Self::PerUnitOfCommand => f.write_str(
                "the torque constant is unknown: estimates are per unit of command",
            ),
            Self::CommandNotMeasured => f.write_str(
                "the input is the command of the drive, not a measurement: the estimates include dead band, voltage drop \
                 and delay of the amplifier as if they were effects of the joint",
            ),
            Self::FrictionVisible { sign: FrictionSign::OddHarmonics { run, third_share, odd_over_even } } => write!(
                f,
                "the command has odd harmonics, which Coulomb friction causes (in {run} the third harmonic is {} % of the \
                 fundamental, and the odd harmonics are {} times the even ones): the raw frequency response is not \
                 that of a linear system",
                significant(100.0 * third_share, 2),
                about(*odd_over_even)
            ),
            Self::FrictionVisible { sign: FrictionSign::TorqueJump { standard_errors } } => write!(
                f,
                "the torque jumps when the direction of motion changes, which Coulomb friction causes ({} standard errors): \
                 the raw frequency response is not that of a linear system",
                about(*standard_errors)
            ),
            Self::FrictionWithLoad { forward, sum, units } => write!(
                f,
                "the motor turns {} only: Coulomb friction and a constant load cannot be separated, and only their sum is \
                 known, {} {}",
                if *forward { "forward" } else { "backward" },
                with_error(*sum),
                units.torque()
            ),
            // Friction brakes in both directions, so an offset above it is a load.
            Self::Offset { offset, units, share } if share.abs() > 1.0 => write!(
                f,
                "a constant load acts: the offset is {} {}, which is more than Coulomb friction. It includes half of any \
                 difference between forward and backward friction",
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
                "Coulomb friction {} differs from the estimate by {} %: one of the two is wrong",
                match method {
                    OtherMethod::ThirdHarmonic => "from the third-harmonic method",
                    OtherMethod::ConstantVelocity => "from constant velocities",
                },
                minus(&format!("{:+.0}", 100.0 * difference_share))
            ),
            Self::ArmNotGiven { residual_share } => write!(
                f,
                "an arm with these estimates leaves {:.0} % of the torque in its own logs unexplained: the arm is not given, \
                 and nothing can be predicted with it",
                100.0 * residual_share
            ),
            Self::NoPairs => f.write_str(
                "no run has three times the frequency of another run: the third-harmonic method gives no estimate",
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
            | Self::LineTaken { .. }
            | Self::MethodsDisagree { .. } => Severity::Warning,
            Self::PoorExcitation { .. }
            | Self::NotSeparable { .. }
            | Self::NegativeEstimate { .. }
            | Self::FrictionWithLoad { .. }
            | Self::ArmNotGiven { .. }
            | Self::FrictionFalls { .. }
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
            | Self::NegativeEstimate { parameter, .. } => parameter.keys(),
            Self::FrictionWithLoad { .. } => vec![key::COULOMB, key::OFFSET],
            Self::OthersDoubtful => {
                vec![key::COULOMB, key::VISCOUS, key::INERTIA, key::COUPLING, key::MODES]
            }
            Self::LineTaken { .. } | Self::CommandSign | Self::PerUnitOfCommand => {
                vec![key::COULOMB, key::VISCOUS, key::INERTIA]
            }
            Self::FrictionFalls { .. } | Self::CommandNotMeasured => {
                vec![key::COULOMB, key::VISCOUS]
            }
            Self::FrictionVisible { .. } => vec![key::COULOMB, key::RAW_RESPONSE],
            Self::Offset { .. } => vec![key::OFFSET],
            Self::MethodsDisagree { method: OtherMethod::ThirdHarmonic, .. } => {
                vec![key::COULOMB, key::THIRD_HARMONIC]
            }
            Self::MethodsDisagree { method: OtherMethod::ConstantVelocity, .. } => {
                vec![key::COULOMB, key::CONSTANT_VELOCITY]
            }
            Self::ArmNotGiven { .. } => vec![key::ARM, key::COUPLING],
            Self::NoPairs => vec![key::THIRD_HARMONIC],
        }
    }

    fn hint(&self) -> &'static str {
        match self {
            Self::NotSeparable { parameter }
            | Self::PoorExcitation { parameter, .. }
            | Self::NegativeEstimate { parameter, .. }
            | Self::LineTaken { parameter, .. } => parameter.hint(),
            Self::FrictionWithLoad { .. } => "add a run that turns the other way",
            Self::OthersDoubtful => {
                "check signs and units, and what else acts on the axis: the equation does not describe these runs"
            }
            Self::FrictionFalls { .. } => {
                "use the friction curve at the speeds driven; runs at higher speeds show whether friction grows there"
            }
            Self::CommandSign => "give the command or the motor a negative scale in the campaign",
            Self::PerUnitOfCommand => "if you know it, give drive.torque_constant in the campaign",
            Self::CommandNotMeasured => "log the motor current where the drive gives it",
            Self::FrictionVisible { .. } => {
                "do not fit a linear model to the raw response; use the corrected response where it is not flagged, or the \
                 linear models of the result"
            }
            Self::Offset { .. } => {
                "to separate friction from a load, add a log with the load in another orientation; motion alone does not \
                 separate them"
            }
            Self::MethodsDisagree { method: OtherMethod::ThirdHarmonic, .. } => {
                "check for sticking, coarse sensor steps and saturation: they make the third-harmonic value too low"
            }
            Self::MethodsDisagree { method: OtherMethod::ConstantVelocity, .. } => {
                "check whether friction grows linearly with speed: if not, the extrapolation to zero speed is wrong"
            }
            Self::ArmNotGiven { .. } => {
                "friction and inertia can be used on their own; for a prediction measure as many points as the beam has modes"
            }
            Self::NoPairs => {
                "needed for the third-harmonic method only: for each frequency ω0 add a run at 3ω0"
            }
        }
    }
}
