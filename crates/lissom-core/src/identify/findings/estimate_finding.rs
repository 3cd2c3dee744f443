//! Estimates of the result: which are refused or uncertain, and why.

use lissom_text::significant;

use crate::finding::Severity::{Info, Refusal, Warning};
use crate::finding::findings;
use crate::finding::result_key as key;
use crate::identify::drive_estimates::Method;
use crate::identify::estimate::Estimate;
use crate::identify::findings::number_text::{minus, with_error};
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

    fn key(self) -> &'static str {
        match self {
            Self::Coulomb => key::COULOMB,
            Self::Offset => key::OFFSET,
            Self::Viscous => key::VISCOUS,
            Self::Inertia => key::INERTIA,
            Self::Coupling => key::COUPLING,
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

/// A large ratio whose digits say nothing.
const MANY: f64 = 1000.0;

/// A ratio in two digits; a large one as "more than 1000".
fn about(ratio: f64) -> String {
    if ratio > MANY { format!("more than {MANY}") } else { significant(ratio, 2) }
}

/// What to do where friction is visible.
const RAW_IS_NOT_LINEAR: &str = "do not fit a linear model to the raw response; use the corrected response where it is not \
                                 flagged, or the linear models of the result";

findings! {
    /// A parameter cannot be separated from another term.
    "poor-excitation" NotSeparable { parameter: JudgedParameter }
        Refusal, [parameter.key()],
        format!("these runs do not separate {} from other terms: it is not given", parameter.name()),
        parameter.hint();

    /// The runs contain little information about a parameter.
    "poor-excitation" PoorExcitation { parameter: JudgedParameter, estimate: Estimate, units: EstimateUnits, refused: bool }
        if *refused { Refusal } else { Warning }, [parameter.key()],
        {
            let (name, share) = (parameter.name(), estimate.std / estimate.value.abs());
            match (*refused, share.is_finite()) {
                (false, _) => format!("these runs contain little information about {name}: its standard error is {:.0} % of \
                    the estimate", 100.0 * share),
                (true, false) => format!("these runs contain no information about {name}: it is not given"),
                (true, true) => format!("{name} would be {} {}, so uncertain that it is not given",
                    with_error(*estimate), parameter.unit(*units)),
            }
        },
        parameter.hint();

    /// A parameter that must be positive comes out negative.
    "negative-estimate" NegativeEstimate { parameter: JudgedParameter, estimate: Estimate, units: EstimateUnits }
        Refusal, [parameter.key()],
        format!("{} would be {} {}, but it must be positive: the model does not fit these runs, and the estimate is not given",
            parameter.name(), with_error(*estimate), parameter.unit(*units)),
        parameter.hint();

    /// Another parameter came out negative.
    "others-doubtful" OthersDoubtful {}
        Warning, [key::COULOMB, key::VISCOUS, key::INERTIA, key::COUPLING, key::MODES],
        "a parameter that must be positive is negative: the other estimates come from the same equation and may be wrong as well",
        "check signs and units, and what else acts on the axis: the equation does not describe these runs";

    /// The motor turns in one direction only: Coulomb friction and a constant load cannot be separated. Their sum acts
    /// against the motion.
    "friction-with-load" FrictionWithLoad { forward: bool, sum: Estimate, units: EstimateUnits }
        Refusal, [key::COULOMB, key::OFFSET],
        format!("the motor turns {} only: Coulomb friction and a constant load cannot be separated, and only their sum is \
            known, {} {}", if *forward { "forward" } else { "backward" }, with_error(*sum), units.torque()),
        "add a run that turns the other way";

    /// Friction falls with speed: the straight line has a negative slope, and its intercept is no friction of the log.
    "friction-falls" FrictionFalls { speed: f64, friction: f64, units: EstimateUnits }
        Refusal, [key::COULOMB, key::VISCOUS],
        format!("friction falls with speed over the speeds of these runs: the line that it is compared by would have a negative \
            slope, and its Coulomb friction is that of no speed. At the mean speed of {} {}/s friction is {} {}",
            significant(*speed, 3), units.angle(), significant(*friction, 3), units.torque()),
        "use the friction curve at the speeds driven; runs at higher speeds show whether friction grows there";

    /// The model that predicts best leaves a parameter unknown; the line is given.
    "line-taken" LineTaken { parameter: JudgedParameter, refused_by: Method }
        Warning, key::LINE,
        format!("{} is unknown by {}: the line of Coulomb and viscous friction is given in its place",
            parameter.name(), refused_by.words()),
        parameter.hint();

    /// Inertia and Coulomb friction are both negative.
    "reversed-sign" CommandSign {}
        Refusal, key::LINE,
        "inertia and Coulomb friction are both negative: the command and the motor's angle have opposite signs, and no estimate \
            is given",
        "give the command or the motor a negative scale in the campaign";

    /// The torque constant is unknown.
    "per-unit-of-command" PerUnitOfCommand {}
        Info, key::LINE,
        "the torque constant is unknown: estimates are per unit of command",
        "if you know it, give drive.torque_constant in the campaign";

    /// The input is a command, not a measurement.
    "command-not-measured" CommandNotMeasured {}
        Info, [key::COULOMB, key::VISCOUS],
        "the input is the command of the drive, not a measurement: the estimates include dead band, voltage drop and delay of \
            the amplifier as if they were effects of the joint",
        "log the motor current where the drive gives it";

    /// Odd harmonics of the command show dry friction.
    "friction-visible" OddHarmonics { run: String, third_share: f64, odd_over_even: f64 }
        Info, [key::COULOMB, key::RAW_RESPONSE],
        format!("the command has odd harmonics, which Coulomb friction causes (in {run} the third harmonic is {} % of the \
            fundamental, and the odd harmonics are {} times the even ones): the raw frequency response is not that of a linear \
            system", significant(100.0 * third_share, 2), about(*odd_over_even)),
        RAW_IS_NOT_LINEAR;

    /// A torque that jumps when the direction of motion changes shows dry friction.
    "friction-visible" TorqueJump { standard_errors: f64 }
        Info, [key::COULOMB, key::RAW_RESPONSE],
        format!("the torque jumps when the direction of motion changes, which Coulomb friction causes ({} standard errors): the \
            raw frequency response is not that of a linear system", about(*standard_errors)),
        RAW_IS_NOT_LINEAR;

    /// Friction differs by direction, or a constant load acts; the share is that of Coulomb friction.
    "offset" Offset { offset: Estimate, units: EstimateUnits, share: f64 }
        Info, [key::OFFSET],
        // Friction brakes in both directions, so an offset above it is a load.
        if share.abs() > 1.0 {
            format!("a constant load acts: the offset is {} {}, which is more than Coulomb friction. It includes half of any \
                difference between forward and backward friction", with_error(*offset), units.torque())
        } else {
            format!("friction differs by direction, or a constant load acts: the offset is {:.1} % of Coulomb friction",
                100.0 * share)
        },
        "to separate friction from a load, add a log with the load in another orientation; motion alone does not separate them";

    /// The third-harmonic method gives a different value of Coulomb friction.
    "methods-disagree" ThirdHarmonicDisagrees { difference_share: f64 }
        Warning, [key::COULOMB, key::THIRD_HARMONIC],
        format!("Coulomb friction from the third-harmonic method differs from the estimate by {} %: one of the two is wrong",
            minus(&format!("{:+.0}", 100.0 * difference_share))),
        "check for sticking, coarse sensor steps and saturation: they make the third-harmonic value too low";

    /// Constant velocities give a different value of Coulomb friction.
    "methods-disagree" ConstantVelocityDisagrees { difference_share: f64 }
        Warning, [key::COULOMB, key::CONSTANT_VELOCITY],
        format!("Coulomb friction from constant velocities differs from the estimate by {} %: one of the two is wrong",
            minus(&format!("{:+.0}", 100.0 * difference_share))),
        "check whether friction grows linearly with speed: if not, the extrapolation to zero speed is wrong";

    /// The arm of the estimates does not predict the torque of its own logs.
    "arm-not-given" ArmNotGiven { residual_share: f64 }
        Refusal, [key::ARM, key::COUPLING],
        format!("an arm with these estimates leaves {:.0} % of the torque in its own logs unexplained: the arm is not given, and \
            nothing can be predicted with it", 100.0 * residual_share),
        "friction and inertia can be used on their own; for a prediction measure as many points as the beam has modes";

    /// No two runs make a pair for the third-harmonic method.
    "no-pairs" NoPairs {}
        Info, [key::THIRD_HARMONIC],
        "no run has three times the frequency of another run: the third-harmonic method gives no estimate",
        "needed for the third-harmonic method only: for each frequency ω0 add a run at 3ω0";
}
