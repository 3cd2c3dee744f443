//! Wrong or suspicious readings of one channel.

use std::fmt;

use lissom_text::significant;

use crate::finding::Severity::{Info, Warning};
use crate::finding::result_key as key;
use crate::finding::{findings, trimmed};

/// Digits of a reading.
const DIGITS: usize = 5;

/// A channel of a log.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Channel {
    /// The motor's angle or position.
    Motor,
    /// The command.
    Command,
    /// A tip, by its name.
    Tip(String),
}

impl fmt::Display for Channel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Motor => f.write_str("the motor channel"),
            Self::Command => f.write_str("the command channel"),
            Self::Tip(name) => write!(f, "tip {name}"),
        }
    }
}

/// A reading with its unit, which is empty if it is not known.
fn reading(value: f64, unit: &str) -> String {
    format!("{} {unit}", trimmed(&significant(value, DIGITS))).trim_end().to_owned()
}

/// `, the first of 3 jumps`.
fn first_of(count: usize, more: &str) -> String {
    if count == 1 { String::new() } else { format!(", the first of {count}{more}") }
}

findings! {
    /// The channel of a tip is constant in every run.
    "dead-channel" DeadTip { channel: Channel }
        Warning, [key::COUPLING, key::MODES, key::INERTIA],
        format!("{channel} is constant in every run: it is not used"),
        "check the sensor; if the beam is flexible, estimates without a tip are rough";

    /// The channel is constant in this run.
    "dead-channel" DeadChannel { channel: Channel, value: f64, unit: &'static str }
        Warning,
        if matches!(channel, Channel::Tip(_)) { &[key::COUPLING, key::MODES] } else { key::LINE },
        format!("{channel} is constant at {}: {}", reading(*value, unit), match channel {
            Channel::Tip(_) => "the regression does not use this run",
            _ => "this run is not used",
        }),
        match channel {
            Channel::Tip(_) => "check the sensor; without its readings the beam cannot be identified",
            _ => "check the wiring and the column that is given in the campaign",
        };

    /// A sensor stays at its largest or smallest value.
    "clipped-channel" ClippedChannel { channel: Channel, share: f64 }
        Warning, [key::COULOMB, key::VISCOUS, key::INERTIA, key::TIP_RESPONSES],
        format!("{channel} stays at its largest or smallest value for {:.1} % of the run: the log does not contain the \
            motion beyond it, and estimates from this run are affected", 100.0 * share),
        "use a smaller amplitude: the range of the sensor or the travel of the axis ends there";

    /// Single readings are far from their neighbours.
    "wrong-readings" Spike { channel: Channel, value: f64, neighbours: Vec<f64>, time_s: f64, count: usize, unit: &'static str }
        Warning, key::READINGS,
        format!("{channel} has a spike{}: it reads {} next to {}, {time_s:.4} s after the run's first sample. All estimates \
            from this run are affected", first_of(*count, ""), reading(*value, unit),
            neighbours.iter().map(|x| reading(*x, unit)).collect::<Vec<_>>().join(" and ")),
        "the cause is a wrong reading or a lost count: replace it by the mean of its neighbours, or leave that part of the \
            log out (skip)";

    /// Readings jump to another level and stay there.
    "wrong-readings" ReadingJumps { channel: Channel, step: f64, time_s: f64, count: usize, whole_turns: bool, unit: &'static str }
        Warning, key::READINGS,
        format!("{channel} jumps by {}{} from one sample to the next, {time_s:.4} s after the run's first sample{}. All \
            estimates from this run are affected", reading(*step, unit), if *whole_turns { " (whole turns)" } else { "" },
            first_of(*count, " such jumps")),
        if *whole_turns {
            "the sensor wraps around: unwrap the angle before the identification"
        } else {
            "the cause is lost counts, a sensor that wraps around, or missing samples: subtract the jump from the samples \
                after it, or leave that part of the log out (skip)"
        };

    /// An angle declared in rad has the steps of an encoder in degrees.
    "angle-in-degrees" AngleInDegrees { channel: Channel, bits: i32 }
        Warning, key::READINGS,
        format!("{channel} is declared in rad, but it has steps of 360/2^{bits}, like an encoder of {bits} bits in degrees. \
            If the readings are in degrees, estimates are wrong by a factor of 57.3 or a power of it"),
        "if the readings are in degrees, set unit = \"deg\" for this channel in the campaign";

    /// A tip channel repeats one value while the motor moves, or the motor channel does while the command changes.
    "frozen-channel" FrozenChannel { channel: Channel, value: f64, from_s: f64, to_s: f64, unit: &'static str, left_out: bool }
        Warning, if *left_out { &[] } else { key::READINGS },
        format!("{channel} is frozen: it reads {} from {from_s:.4} s to {to_s:.4} s after the run's first sample while {}. {}",
            reading(*value, unit), match channel {
                Channel::Motor => "the command changes (the axis may also have reached a stop)",
                _ => "the motor moves",
            }, if *left_out { "The run is left out" } else { "All estimates from this run are affected" }),
        "the cause is a lost connection, or a logger that repeats its last value: leave that part of the log out (skip, or \
            cut the log)";

    /// A tip and the motor read different values when the beam is straight.
    "readings-corrected" TipZero { channel: Channel, value: f64 }
        Info, [],
        format!("{channel} has a zero error: it reads {} relative to the motor when the beam is straight (largest of all \
            runs). The error is subtracted in each run", reading(*value, "")),
        "nothing to do; if a constant load bends the beam, its torque is now part of the offset";

    /// A measured command stays at its largest value: the sensor may end there.
    "saturation" SensorEnds { share: f64 }
        Warning, [key::JOINT, &[key::THIRD_HARMONIC, key::CORRECTED_RESPONSE]].concat(),
        format!("the measured command stays at its largest value for {:.1} % of the run: if the sensor ends there and the \
            drive does not, torque is missing and all estimates are wrong", 100.0 * share),
        "if the amplifier is limited there, state it as `limit` in [drive]; if the sensor is, use a smaller amplitude or a \
            larger range";

    /// The command is limited.
    "saturation" Saturation { share: f64, limit_given: bool }
        Warning, [key::THIRD_HARMONIC, key::CORRECTED_RESPONSE],
        format!("the command {} for {:.1} % of the run: the limit adds harmonics, which the third-harmonic method and the \
            corrected response take for friction",
            if *limit_given { "is at its limit" } else { "stays at its largest value" }, 100.0 * share),
        "use a smaller amplitude, or a frequency farther from the resonance";
}
