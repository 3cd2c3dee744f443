//! Friction from constant velocities. A direction is `forward` or `backward`.

use lissom_text::significant;

use crate::finding::Severity::{Info, Refusal, Warning};
use crate::finding::findings;
use crate::finding::result_key as key;
use crate::identify::estimate::Estimate;
use crate::identify::findings::number_text::with_error;

/// Digits of a command extrapolated to zero speed.
const DIGITS: usize = 4;

/// What a direction without an extrapolation leaves open.
const OF_DIRECTION: [&str; 3] = [key::CONSTANT_VELOCITY, key::COULOMB, key::OFFSET];

findings! {
    /// The motor turns in one direction only, and no part of the run has a constant velocity.
    "no-steady-velocity" NoSteadyVelocity {}
        Info, [key::CONSTANT_VELOCITY],
        "the motor turns in one direction only, and no part of the run has a constant velocity: the run gives no point of \
            friction over speed",
        "hold each speed for seven time constants of the control loop or more; if the joint sticks and slips, turn faster";

    /// The motor turns at constant velocities in every run.
    "constant-velocity-only" ConstantVelocityOnly { flexible: bool }
        Refusal, if *flexible { &[key::INERTIA, key::MODES, key::COUPLING][..] } else { &[key::INERTIA] },
        format!("the motor turns at constant velocities in all runs. These show only friction: {} not given",
            if *flexible { "inertia, modes and coupling are" } else { "inertia is" }),
        "add runs that move back and forth: sines, a sweep, ordinary moves";

    /// Friction is taken from constant velocities.
    "constant-velocity-estimates" ConstantVelocityEstimates {}
        Info, [key::COULOMB, key::OFFSET, key::VISCOUS],
        "friction is taken from constant velocities, extrapolated to zero speed, because no other method gives it",
        "add sines or ordinary moves at the speeds of interest: they show friction without an extrapolation";

    /// Friction over speed is curved, and Coulomb friction is taken from the slowest speeds.
    "constant-velocity-estimates" SlowestSpeedsTaken {}
        Warning, [key::COULOMB, key::OFFSET, key::VISCOUS],
        "friction is taken from constant velocities, because no other method gives it, and does not grow linearly with speed: \
            Coulomb friction is taken from the slowest third of the speeds, viscous friction from the slope over all speeds",
        "use these estimates only at the speeds of interest, or identify from moves at those speeds";

    /// Friction over speed is curved in one direction.
    "extrapolation-doubtful" ExtrapolationCurved {
        direction: &'static str, concave: bool, standard_errors: f64, command: f64, of_slowest: Option<Estimate>,
        unit: &'static str
    }
        Warning, [key::CONSTANT_VELOCITY],
        {
            let (grows, wrong) = if *concave { ("less", "high") } else { ("more", "low") };
            let slowest = of_slowest.map_or_else(String::new, |e| {
                format!("; the slowest third of the speeds gives {} {unit}", with_error(e))
            });
            format!("in the {direction} direction friction grows {grows} than linearly with speed ({standard_errors:.1} standard \
                errors): the command extrapolated to zero speed, {} {unit}, is too {wrong}{slowest}",
                significant(*command, DIGITS))
        },
        "add slower speeds, down to the slowest at which the motor turns evenly, or identify from sines at the speeds of interest";

    /// In one direction the points scatter about their line.
    "extrapolation-doubtful" SpeedsScatter {
        direction: &'static str, rms_standard_errors: f64, command: f64, unit: &'static str
    }
        Warning, [key::CONSTANT_VELOCITY],
        format!("in the {direction} direction the points scatter about their line by {rms_standard_errors:.1} standard errors \
            (rms): the standard error of the command extrapolated to zero speed, {} {unit}, includes this scatter",
            significant(*command, DIGITS)),
        "friction may change with position or temperature: measure each speed over the same whole turns, after a warm-up";

    /// There are only two speeds in one direction.
    "extrapolation-doubtful" TwoSpeeds { direction: &'static str }
        Warning, [key::CONSTANT_VELOCITY],
        format!("in the {direction} direction there are only two speeds: they do not show whether friction grows linearly with \
            speed"),
        "add a third speed, well apart from both";

    /// There is no constant velocity in one direction.
    "extrapolation-refused" OneDirection { direction: &'static str }
        Refusal, OF_DIRECTION,
        format!("no run turns {direction} at a constant velocity: friction cannot be separated from a constant load"),
        "measure the speeds in both directions";

    /// There is only one speed in one direction.
    "extrapolation-refused" TooFewSpeeds { direction: &'static str, speeds: usize }
        Refusal, OF_DIRECTION,
        format!("in the {direction} direction there is only {speeds} speed, but an extrapolation to zero speed needs two, and a \
            test of the line needs three. Constant velocities give no friction"),
        "add speeds that are well apart, down to the slowest at which the motor turns evenly";

    /// The speeds are too close together for an extrapolation.
    "extrapolation-refused" SpeedsTooClose { direction: &'static str, command: Estimate, unit: &'static str }
        Refusal, OF_DIRECTION,
        format!("in the {direction} direction the command extrapolated to zero speed is {} {unit}: its standard error is too \
            large. Constant velocities give no friction", with_error(*command)),
        "add slower speeds";
}
