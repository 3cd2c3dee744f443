//! Wrong or suspicious readings of one channel.

use std::fmt;

use strum::{IntoStaticStr, VariantNames};

use crate::identify::findings::describe::Describe;
use crate::identify::findings::number_text::{significant, trimmed};
use crate::identify::findings::result_key as key;
use crate::identify::findings::severity::Severity;

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

/// Wrong or suspicious readings of one channel.
#[derive(Debug, Clone, PartialEq, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "kebab-case")]
#[non_exhaustive]
pub enum ChannelFinding {
    /// The channel is constant.
    DeadChannel {
        /// The channel.
        channel: Channel,
        /// Its value in this run; `None` if it is constant in every run.
        value: Option<f64>,
        /// Unit of that value; empty if it has none.
        unit: &'static str,
    },
    /// A sensor stays at its largest or smallest value.
    ClippedChannel {
        /// The channel.
        channel: Channel,
        /// Share of the run.
        share: f64,
    },
    /// Single readings are far from their neighbours.
    Spike {
        /// The channel.
        channel: Channel,
        /// Value of the first one.
        value: f64,
        /// Readings before and after it.
        neighbours: Vec<f64>,
        /// Time since the run's first sample \[s\].
        time_s: f64,
        /// Number of such readings.
        count: usize,
        /// Unit of the readings; empty if it is not known.
        unit: &'static str,
    },
    /// Readings jump to another level and stay there.
    ReadingJumps {
        /// The channel.
        channel: Channel,
        /// Size of the first jump.
        step: f64,
        /// Time since the run's first sample \[s\].
        time_s: f64,
        /// Number of jumps.
        count: usize,
        /// Whether the first jump is a number of whole turns.
        whole_turns: bool,
        /// Unit of the readings; empty if it is not known.
        unit: &'static str,
    },
    /// An angle declared in rad has the steps of an encoder in degrees.
    AngleInDegrees {
        /// The channel.
        channel: Channel,
        /// Resolution of the encoder in bits.
        bits: i32,
    },
    /// A tip channel repeats one value while the motor moves, or the motor channel does while the command changes.
    FrozenChannel {
        /// The channel.
        channel: Channel,
        /// The repeated value.
        value: f64,
        /// Time at which it begins, since the run's first sample \[s\].
        from_s: f64,
        /// Time at which it ends \[s\].
        to_s: f64,
        /// Unit of the readings; empty if it is not known.
        unit: &'static str,
        /// Whether the run is left out.
        left_out: bool,
    },
    /// A tip and the motor read different values when the beam is straight.
    TipZero {
        /// The channel.
        channel: Channel,
        /// Reading of the tip minus that of the motor, the largest of all runs \[rad or m\].
        value: f64,
    },
    /// The command is limited.
    Saturation {
        /// Share of the run.
        share: f64,
        /// Whether the limit is given in the campaign; otherwise it is taken from the log.
        limit_given: bool,
        /// Whether the command is measured: without a known limit, the sensor may end there.
        measured: bool,
    },
}

impl ChannelFinding {
    /// Whether it may be the cause of other findings.
    pub(super) fn is_wrong_reading(&self) -> bool {
        match self {
            Self::Spike { .. }
            | Self::ReadingJumps { .. }
            | Self::AngleInDegrees { .. }
            | Self::FrozenChannel { .. } => true,
            Self::DeadChannel { .. }
            | Self::ClippedChannel { .. }
            | Self::TipZero { .. }
            | Self::Saturation { .. } => false,
        }
    }
}

/// A reading with its unit.
fn reading(value: f64, unit: &str) -> String {
    format!("{} {unit}", trimmed(&significant(value, DIGITS))).trim_end().to_owned()
}

impl fmt::Display for ChannelFinding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::DeadChannel { channel, value: None, .. } => {
                write!(f, "{channel} is constant in every run: it is not used")
            }
            Self::DeadChannel { channel, value: Some(value), unit } => {
                let effect = match channel {
                    Channel::Motor | Channel::Command => "this run is not used",
                    Channel::Tip(_) => "the regression does not use this run",
                };
                write!(f, "{channel} is constant at {}: {effect}", reading(*value, unit))
            }
            Self::ClippedChannel { channel, share } => write!(
                f,
                "{channel} stays at its largest or smallest value for {:.1} % of the run: the log does not contain the \
                 motion beyond it, and estimates from this run are affected",
                100.0 * share
            ),
            Self::Spike { channel, value, neighbours, time_s, count, unit } => {
                let neighbours: Vec<String> =
                    neighbours.iter().map(|x| reading(*x, unit)).collect();
                let others = match count {
                    1 => String::new(),
                    n => format!(", the first of {n}"),
                };
                write!(
                    f,
                    "{channel} has a spike{others}: it reads {} next to {}, {time_s:.4} s after the run's first \
                     sample. All estimates from this run are affected",
                    reading(*value, unit),
                    neighbours.join(" and ")
                )
            }
            Self::ReadingJumps { channel, step, time_s, count, whole_turns, unit } => {
                let turns = if *whole_turns { " (whole turns)" } else { "" };
                let others = match count {
                    1 => String::new(),
                    n => format!(", the first of {n} such jumps"),
                };
                write!(
                    f,
                    "{channel} jumps by {}{turns} from one sample to the next, {time_s:.4} s after the run's first \
                     sample{others}. All estimates from this run are affected",
                    reading(*step, unit)
                )
            }
            Self::AngleInDegrees { channel, bits } => write!(
                f,
                "{channel} is declared in rad, but it has steps of 360/2^{bits}, like an encoder of {bits} bits in degrees. \
                 If the readings are in degrees, estimates are wrong by a factor of 57.3 or a power of it"
            ),
            Self::FrozenChannel { channel, value, from_s, to_s, unit, left_out } => write!(
                f,
                "{channel} is frozen: it reads {} from {from_s:.4} s to {to_s:.4} s after the run's first sample while {}. {}",
                reading(*value, unit),
                if *channel == Channel::Motor {
                    "the command changes (the axis may also have reached a stop)"
                } else {
                    "the motor moves"
                },
                if *left_out {
                    "The run is left out"
                } else {
                    "All estimates from this run are affected"
                }
            ),
            Self::TipZero { channel, value } => write!(
                f,
                "{channel} has a zero error: it reads {} relative to the motor when the beam is straight (largest of all \
                 runs). The error is subtracted in each run",
                reading(*value, "")
            ),
            Self::Saturation { share, limit_given: false, measured: true } => write!(
                f,
                "the measured command stays at its largest value for {:.1} % of the run: if the sensor ends there and the \
                 drive does not, torque is missing and all estimates are wrong",
                100.0 * share
            ),
            Self::Saturation { share, limit_given, .. } => write!(
                f,
                "the command {} for {:.1} % of the run: the limit adds harmonics, which the third-harmonic method and the \
                 corrected response take for friction",
                if *limit_given { "is at its limit" } else { "stays at its largest value" },
                100.0 * share
            ),
        }
    }
}

impl Describe for ChannelFinding {
    fn code(&self) -> &'static str {
        self.into()
    }

    fn severity(&self) -> Severity {
        match self {
            Self::TipZero { .. } => Severity::Info,
            _ => Severity::Warning,
        }
    }

    fn affects(&self) -> Vec<&'static str> {
        match self {
            Self::DeadChannel { channel: Channel::Motor | Channel::Command, .. } => {
                vec![key::COULOMB, key::VISCOUS, key::INERTIA]
            }
            Self::DeadChannel { value: None, .. } => vec![key::COUPLING, key::MODES, key::INERTIA],
            Self::DeadChannel { .. } => vec![key::COUPLING, key::MODES],
            Self::ClippedChannel { .. } => {
                vec![key::COULOMB, key::VISCOUS, key::INERTIA, key::TIP_RESPONSES]
            }
            Self::FrozenChannel { left_out: true, .. } | Self::TipZero { .. } => Vec::new(),
            Self::Spike { .. }
            | Self::ReadingJumps { .. }
            | Self::AngleInDegrees { .. }
            | Self::FrozenChannel { .. } => vec![
                key::COULOMB,
                key::VISCOUS,
                key::INERTIA,
                key::COUPLING,
                key::MODES,
                key::TIP_RESPONSES,
            ],
            Self::Saturation { limit_given: false, measured: true, .. } => vec![
                key::COULOMB,
                key::OFFSET,
                key::VISCOUS,
                key::INERTIA,
                key::GRAVITY,
                key::COUPLING,
                key::THIRD_HARMONIC,
                key::CORRECTED_RESPONSE,
            ],
            Self::Saturation { .. } => vec![key::THIRD_HARMONIC, key::CORRECTED_RESPONSE],
        }
    }

    fn hint(&self) -> &'static str {
        match self {
            Self::DeadChannel { channel: Channel::Motor | Channel::Command, .. } => {
                "check the wiring and the column that is given in the campaign"
            }
            Self::DeadChannel { value: None, .. } => {
                "check the sensor; if the beam is flexible, estimates without a tip are rough"
            }
            Self::DeadChannel { .. } => {
                "check the sensor; without its readings the beam cannot be identified"
            }
            Self::ClippedChannel { .. } => {
                "use a smaller amplitude: the range of the sensor or the travel of the axis ends there"
            }
            Self::Spike { .. } => {
                "the cause is a wrong reading or a lost count: replace it by the mean of its neighbours, or leave that \
                 part of the log out (skip)"
            }
            Self::ReadingJumps { whole_turns: true, .. } => {
                "the sensor wraps around: unwrap the angle before the identification"
            }
            Self::ReadingJumps { .. } => {
                "the cause is lost counts, a sensor that wraps around, or missing samples: subtract the jump from the \
                 samples after it, or leave that part of the log out (skip)"
            }
            Self::AngleInDegrees { .. } => {
                "if the readings are in degrees, set unit = \"deg\" for this channel in the campaign"
            }
            Self::FrozenChannel { .. } => {
                "the cause is a lost connection, or a logger that repeats its last value: leave that part of the log out \
                 (skip, or cut the log)"
            }
            Self::TipZero { .. } => {
                "nothing to do; if a constant load bends the beam, its torque is now part of the offset"
            }
            Self::Saturation { limit_given: false, measured: true, .. } => {
                "if the amplifier is limited there, state it as `limit` in [drive]; if the sensor is, use a smaller amplitude \
                 or a larger range"
            }
            Self::Saturation { .. } => {
                "use a smaller amplitude, or a frequency farther from the resonance"
            }
        }
    }
}
