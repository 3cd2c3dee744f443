//! What kind of motion a run is, and whether it agrees with the other runs.

use std::f64::consts::TAU;

use lissom_text::significant;

use crate::finding::Severity::{Info, Warning};
use crate::finding::result_key as key;
use crate::finding::{counted, findings};
use crate::identify::methods::regression::RunDifference;
use crate::identify::separability::thresholds::LARGE_CHANGE;
use crate::information::ArmParameter;
use crate::plan::percent;

/// Largest number of parameters listed in the message of a run that stands out.
const NAMED_MOST: usize = 3;

/// Degrees per radian, and the relative difference up to which a scale is taken for this ratio.
const DEGREES: f64 = 360.0 / TAU;
const DEGREES_WITHIN: f64 = 0.1;

/// A parameter that would change if a run were left out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MovedParameter {
    /// The parameter.
    pub parameter: ArmParameter,
    /// Its change relative to its value, to first order.
    pub change_share: f64,
    /// The same in standard errors.
    pub change_standard_errors: f64,
}

/// The result key of a parameter.
fn key_of(parameter: ArmParameter) -> &'static str {
    match parameter {
        ArmParameter::Coulomb => key::COULOMB,
        ArmParameter::Viscous => key::VISCOUS,
        ArmParameter::Inertia => key::INERTIA,
        ArmParameter::Coupling => key::COUPLING,
        ArmParameter::Frequency(_) | ArmParameter::Damping(_) => key::MODES,
        ArmParameter::Offset => key::OFFSET,
    }
}

/// "; the motor itself moves at 4.0000 rad/s (0.6366 Hz)" if this is another frequency than the given one.
fn own(omega_rad_s: Option<f64>) -> String {
    omega_rad_s.map_or_else(String::new, |w| {
        format!("; the motor itself moves at {w:.4} rad/s ({:.4} Hz)", w / TAU)
    })
}

/// The changes in words: "Coulomb friction by −2.1 %, inertia by more than 20 %".
fn changes(moved: &[MovedParameter]) -> String {
    let mut largest: Vec<&MovedParameter> = moved.iter().collect();
    largest
        .sort_by(|a, b| b.change_standard_errors.abs().total_cmp(&a.change_standard_errors.abs()));
    let change = |m: &&MovedParameter| {
        let name = m.parameter.name();
        if m.change_share.abs() > LARGE_CHANGE {
            return format!("{name} by more than {}", percent(LARGE_CHANGE));
        }
        let sign = if m.change_share < 0.0 { "−" } else { "+" };
        format!("{name} by {sign}{}", percent(m.change_share.abs()))
    };
    largest.iter().take(NAMED_MOST).map(change).collect::<Vec<_>>().join(", ")
}

/// The difference in words: "Its command, or its angle, has the opposite sign".
fn told(difference: RunDifference, unit: &str) -> String {
    let times = |factor: f64| significant(factor, 3);
    match difference {
        RunDifference::Sign => "Its command, or its angle, has the opposite sign".to_owned(),
        RunDifference::CommandScale { factor } => {
            format!("For the same motion the other runs need {} times its command", times(factor))
        }
        RunDifference::AngleScale { factor } if (factor / DEGREES - 1.0).abs() < DEGREES_WITHIN => {
            "Its angle looks as if it were in radians where the others are in degrees".to_owned()
        }
        RunDifference::AngleScale { factor }
            if (factor.recip() / DEGREES - 1.0).abs() < DEGREES_WITHIN =>
        {
            "Its angle looks as if it were in degrees where the others are in radians".to_owned()
        }
        RunDifference::AngleScale { factor } => {
            format!("Its angle looks {} times too large", times(factor.recip()))
        }
        RunDifference::Inertia { factor } => {
            format!("It looks as if it had {} times the inertia", times(factor))
        }
        RunDifference::Coulomb { factor } => {
            format!("It looks as if it had {} times the Coulomb friction", times(factor))
        }
        RunDifference::Viscous { factor } => {
            format!("It looks as if it had {} times the viscous friction", times(factor))
        }
        RunDifference::Load { torque } => {
            format!("It looks as if a constant load of {} {unit} acted", significant(torque, 3))
        }
        RunDifference::Other => {
            "No single change of load, friction, sign or scale explains it".to_owned()
        }
    }
}

/// Keys of the harmonics of a run.
const HARMONICS: &[&str] =
    &[key::THIRD_HARMONIC, key::RAW_RESPONSE, key::CORRECTED_RESPONSE, key::TIP_RESPONSES];

findings! {
    /// The motor stands still for a large part of the run.
    "mostly-at-rest" MostlyAtRest { share: f64 }
        Info, [key::COULOMB, key::VISCOUS, key::INERTIA, key::RAW_RESPONSE],
        format!("the motor stands still for {:.0} % of the run: this part gives little information", 100.0 * share),
        "use a motion without pauses (sines, a sweep): it gives more information in less time";

    /// The joint sticks at its turning points.
    "sticking" Sticking { share: f64 }
        Info, [key::THIRD_HARMONIC],
        format!("the joint sticks for about {:.0} % of the cycle: the estimate of the third-harmonic method is too low, \
            because it assumes friction without sticking. Other methods are not affected", 100.0 * share),
        "needed for the third-harmonic method only: a larger amplitude or a higher frequency";

    /// The run has too few whole periods of the given frequency.
    "not-sinusoidal" TooFewPeriods { omega_rad_s: f64, blocks: usize, blocks_needed: usize, own_omega_rad_s: Option<f64> }
        Warning, [key::THIRD_HARMONIC, key::CORRECTED_RESPONSE],
        format!("at the given {omega_rad_s:.4} rad/s the log has {blocks} of the {blocks_needed} blocks of whole periods that \
            a steady state needs{}. The run is used as a general motion, not as a sine", own(*own_omega_rad_s)),
        "log at least six periods in steady state";

    /// The motion is not a sinusoid of the given frequency; the shares are not finite for a motor at rest.
    "not-sinusoidal" NotSinusoidal {
        omega_rad_s: f64, unexplained_share: f64, harmonics_share: f64, own_omega_rad_s: Option<f64>
    }
        Warning, [key::THIRD_HARMONIC, key::CORRECTED_RESPONSE],
        if harmonics_share.is_finite() {
            format!("the motion is not a sinusoid of the given {omega_rad_s:.4} rad/s: {:.0} % of the motor's power is not \
                explained, and the harmonics are {:.0} % of the fundamental{}. The run is used as a general motion, not as a \
                sine", 100.0 * unexplained_share, 100.0 * harmonics_share, own(*own_omega_rad_s))
        } else {
            format!("the motor does not move at the given {omega_rad_s:.4} rad/s in the periods used: the run is used as a \
                general motion, not as a sine")
        },
        "check the frequency that the campaign gives for this run";

    /// Few periods are in steady state.
    "not-periodic" FewPeriods { periods: usize }
        Warning, HARMONICS,
        format!("only {} in steady state: standard errors of the harmonics are rough",
            counted(*periods, "period is", "periods are")),
        "log ten periods or more";

    /// The fundamental still changes.
    "not-periodic" NotPeriodic { motor_change: f64, other_change: f64 }
        Warning, HARMONICS,
        format!("the motion is not periodic yet: within the periods used the fundamental of the motor changes by {:.1} %, that \
            of other channels by up to {:.1} %. The harmonics and responses of this run are affected",
            100.0 * motor_change, 100.0 * other_change),
        "wait longer before logging; a lightly damped mode needs several times 1/(ζω)";

    /// A transient at the beginning is left out.
    "transient-dropped" TransientDropped { periods: usize }
        Info, [],
        match periods {
            1 => "the first period is left out: the motion was not periodic yet".to_owned(),
            n => format!("the first {n} periods are left out: the motion was not periodic yet"),
        },
        "";

    /// The third harmonic cannot be measured with this sample time.
    "harmonic-above-nyquist" HarmonicAboveNyquist { omega_rad_s: f64, nyquist_rad_s: f64 }
        Info, [key::THIRD_HARMONIC, key::CORRECTED_RESPONSE],
        format!("the third harmonic ({omega_rad_s:.1} rad/s) is not below 0.9 of the Nyquist frequency \
            ({nyquist_rad_s:.1} rad/s): it is not measured"),
        "sample faster, or do not use this run as the lower one of a pair";

    /// The motor drifts.
    "drift" Drift { share: f64 }
        Warning, [key::OFFSET, key::CORRECTED_RESPONSE],
        format!("the motor drifts by {:.0} % of its amplitude over the periods used: the offset and the corrected response are \
            affected", 100.0 * share),
        "close the position loop: a load or an offset moves the motor away";

    /// The run does not agree with the other runs, and is left out.
    "unlike-others" UnlikeOthers { misfit: f64, difference: RunDifference, unit: &'static str }
        Warning, [],
        format!("this run is left out: its torque differs by {} from the torque that the parameters of the other runs give. {}",
            percent(*misfit), told(*difference, unit)),
        match difference {
            RunDifference::Sign => "check the sign of the command and of the angle in this log; scale = -1 reverses the sign \
                of a channel",
            RunDifference::CommandScale { .. } | RunDifference::AngleScale { .. } =>
                "check the units and the scale of this log's channels",
            RunDifference::Inertia { .. } | RunDifference::Load { .. } =>
                "if the load was changed on purpose, identify these runs separately",
            RunDifference::Coulomb { .. } | RunDifference::Viscous { .. } => "the cause may be another temperature, a brake, \
                or a rubbing part: repeat the run, or identify it separately",
            RunDifference::Other => "look at the log for a loose part, a wrong channel, or a disturbance; repeat the run",
        };

    /// The run does not agree with the other runs.
    "run-stands-out" RunStandsOut { residual_ratio: f64, moved: Vec<MovedParameter>, others_described: bool }
        Warning, moved.iter().map(|m| key_of(m.parameter)).collect::<Vec<_>>(),
        format!("with the parameters of the other runs, the residual of this run is {residual_ratio:.1} times theirs; without \
            it the estimates change: {}{}", changes(moved), match others_described {
                true => "",
                false => ". No arm was found that describes the runs, so the fault may be in another run",
            }),
        "check this run for another load or friction, a loose part, or a wrong sensor scale; leave it out or repeat it, then \
            identify again";
}
