//! What kind of motion a run is, and whether it agrees with the other runs.

use std::f64::consts::TAU;
use std::fmt;

use strum::{IntoStaticStr, VariantNames};

use crate::identify::findings::describe::Describe;
use crate::identify::findings::number_text::{counted, significant};
use crate::identify::findings::result_key as key;
use crate::identify::findings::severity::Severity;
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

/// What kind of motion a run is, and whether it agrees with the other runs.
#[derive(Debug, Clone, PartialEq, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "kebab-case")]
#[non_exhaustive]
pub enum RunFinding {
    /// The motor stands still for a large part of the run.
    MostlyAtRest {
        /// Share of the run.
        share: f64,
    },
    /// The joint sticks at its turning points.
    Sticking {
        /// Share of the cycle.
        share: f64,
    },
    /// The run has too few whole periods of the given frequency.
    TooFewPeriods {
        /// The given frequency \[rad/s\].
        omega_rad_s: f64,
        /// Blocks of whole periods in the log.
        blocks: usize,
        /// Blocks that a steady state needs.
        blocks_needed: usize,
        /// Frequency of the motor's motion, if it is another one \[rad/s\].
        own_omega_rad_s: Option<f64>,
    },
    /// The motion is not a sinusoid of the given frequency.
    NotSinusoidal {
        /// The given frequency \[rad/s\].
        omega_rad_s: f64,
        /// Share of the motor's power that harmonics do not describe; not finite for a motor at rest.
        unexplained_share: f64,
        /// Amplitude of the higher harmonics relative to the fundamental; not finite for a motor at rest.
        harmonics_share: f64,
        /// Frequency of the motor's motion, if it is another one \[rad/s\].
        own_omega_rad_s: Option<f64>,
    },
    /// Few periods are in steady state.
    FewPeriods {
        /// Number of periods in steady state.
        periods: usize,
    },
    /// The fundamental still changes.
    NotPeriodic {
        /// Relative change of the motor's fundamental.
        motor_change: f64,
        /// The largest relative change of the other channels' fundamentals.
        other_change: f64,
    },
    /// A transient at the beginning is left out.
    TransientDropped {
        /// Periods left out.
        periods: usize,
    },
    /// The third harmonic cannot be measured with this sample time.
    HarmonicAboveNyquist {
        /// Frequency of the third harmonic \[rad/s\].
        omega_rad_s: f64,
        /// Nyquist frequency \[rad/s\].
        nyquist_rad_s: f64,
    },
    /// The motor drifts.
    Drift {
        /// Drift over the periods used, relative to the amplitude.
        share: f64,
    },
    /// The run does not agree with the other runs, and is left out.
    UnlikeOthers {
        /// Difference between its torque and the torque from the other runs' parameters, as a share of its torque.
        misfit: f64,
        /// The difference that explains it.
        difference: RunDifference,
        /// Unit of the torque.
        unit: &'static str,
    },
    /// The run does not agree with the other runs.
    RunStandsOut {
        /// Root mean square of its residual relative to that of the other runs.
        residual_ratio: f64,
        /// Parameters that would change if it were left out.
        moved: Vec<MovedParameter>,
        /// Whether the output-error method describes the other runs.
        others_described: bool,
    },
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

impl fmt::Display for RunFinding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::MostlyAtRest { share } => {
                write!(
                    f,
                    "the motor stands still for {:.0} % of the run: this part gives little information",
                    100.0 * share
                )
            }
            Self::Sticking { share } => write!(
                f,
                "the joint sticks for about {:.0} % of the cycle: the estimate of the third-harmonic method is too low, \
                 because it assumes friction without sticking. Other methods are not affected",
                100.0 * share
            ),
            Self::TooFewPeriods { omega_rad_s, blocks, blocks_needed, own_omega_rad_s } => write!(
                f,
                "at the given {omega_rad_s:.4} rad/s the log has {blocks} of the {blocks_needed} blocks of whole periods \
                 that a steady state needs{}. The run is used as a general motion, not as a sine",
                own(*own_omega_rad_s)
            ),
            Self::NotSinusoidal { omega_rad_s, harmonics_share, .. }
                if !harmonics_share.is_finite() =>
            {
                write!(
                    f,
                    "the motor does not move at the given {omega_rad_s:.4} rad/s in the periods used: the run is used \
                     as a general motion, not as a sine"
                )
            }
            Self::NotSinusoidal {
                omega_rad_s,
                unexplained_share,
                harmonics_share,
                own_omega_rad_s,
            } => write!(
                f,
                "the motion is not a sinusoid of the given {omega_rad_s:.4} rad/s: {:.0} % of the motor's power is not \
                 explained, and the harmonics are {:.0} % of the fundamental{}. The run is used as a general motion, \
                 not as a sine",
                100.0 * unexplained_share,
                100.0 * harmonics_share,
                own(*own_omega_rad_s)
            ),
            Self::FewPeriods { periods } => write!(
                f,
                "only {} in steady state: standard errors of the harmonics are rough",
                counted(*periods, "period is", "periods are")
            ),
            Self::NotPeriodic { motor_change, other_change } => write!(
                f,
                "the motion is not periodic yet: within the periods used the fundamental of the motor changes by {:.1} %, \
                 that of other channels by up to {:.1} %. The harmonics and responses of this run are affected",
                100.0 * motor_change,
                100.0 * other_change
            ),
            Self::TransientDropped { periods } => write!(
                f,
                "{} left out: the motion was not periodic yet",
                match periods {
                    1 => "the first period is".to_owned(),
                    n => format!("the first {n} periods are"),
                }
            ),
            Self::HarmonicAboveNyquist { omega_rad_s, nyquist_rad_s } => write!(
                f,
                "the third harmonic ({omega_rad_s:.1} rad/s) is not below 0.9 of the Nyquist frequency \
                 ({nyquist_rad_s:.1} rad/s): it is not measured"
            ),
            Self::Drift { share } => write!(
                f,
                "the motor drifts by {:.0} % of its amplitude over the periods used: the offset and the corrected response \
                 are affected",
                100.0 * share
            ),
            Self::UnlikeOthers { misfit, difference, unit } => write!(
                f,
                "this run is left out: its torque differs by {} from the torque that the parameters of the other runs give. {}",
                percent(*misfit),
                told(*difference, unit)
            ),
            Self::RunStandsOut { residual_ratio, moved, others_described } => {
                write!(
                    f,
                    "with the parameters of the other runs, the residual of this run is {residual_ratio:.1} times \
                     theirs; without it the estimates change: {}",
                    changes(moved)
                )?;
                if *others_described {
                    return Ok(());
                }
                f.write_str(". No arm was found that describes the runs, so the fault may be in another run")
            }
        }
    }
}

impl Describe for RunFinding {
    fn code(&self) -> &'static str {
        self.into()
    }

    fn severity(&self) -> Severity {
        match self {
            Self::MostlyAtRest { .. }
            | Self::Sticking { .. }
            | Self::TransientDropped { .. }
            | Self::HarmonicAboveNyquist { .. } => Severity::Info,
            Self::TooFewPeriods { .. }
            | Self::NotSinusoidal { .. }
            | Self::FewPeriods { .. }
            | Self::NotPeriodic { .. }
            | Self::Drift { .. }
            | Self::UnlikeOthers { .. }
            | Self::RunStandsOut { .. } => Severity::Warning,
        }
    }

    fn affects(&self) -> Vec<&'static str> {
        match self {
            Self::MostlyAtRest { .. } => {
                vec![key::COULOMB, key::VISCOUS, key::INERTIA, key::RAW_RESPONSE]
            }
            Self::Sticking { .. } => vec![key::THIRD_HARMONIC],
            Self::TooFewPeriods { .. }
            | Self::NotSinusoidal { .. }
            | Self::HarmonicAboveNyquist { .. } => {
                vec![key::THIRD_HARMONIC, key::CORRECTED_RESPONSE]
            }
            Self::FewPeriods { .. } | Self::NotPeriodic { .. } => vec![
                key::THIRD_HARMONIC,
                key::RAW_RESPONSE,
                key::CORRECTED_RESPONSE,
                key::TIP_RESPONSES,
            ],
            Self::TransientDropped { .. } | Self::UnlikeOthers { .. } => Vec::new(),
            Self::Drift { .. } => vec![key::OFFSET, key::CORRECTED_RESPONSE],
            Self::RunStandsOut { moved, .. } => {
                moved.iter().map(|m| key::of(m.parameter)).collect()
            }
        }
    }

    fn hint(&self) -> &'static str {
        match self {
            Self::MostlyAtRest { .. } => {
                "use a motion without pauses (sines, a sweep): it gives more information in less time"
            }
            Self::Sticking { .. } => {
                "needed for the third-harmonic method only: a larger amplitude or a higher frequency"
            }
            Self::TooFewPeriods { .. } => "log at least six periods in steady state",
            Self::NotSinusoidal { .. } => {
                "check the frequency that the campaign gives for this run"
            }
            Self::FewPeriods { .. } => "log ten periods or more",
            Self::NotPeriodic { .. } => {
                "wait longer before logging; a lightly damped mode needs several times 1/(ζω)"
            }
            Self::TransientDropped { .. } => "",
            Self::HarmonicAboveNyquist { .. } => {
                "sample faster, or do not use this run as the lower one of a pair"
            }
            Self::Drift { .. } => {
                "close the position loop: a load or an offset moves the motor away"
            }
            Self::UnlikeOthers { difference, .. } => match difference {
                RunDifference::Sign => {
                    "check the sign of the command and of the angle in this log; scale = -1 reverses the sign of a channel"
                }
                RunDifference::CommandScale { .. } | RunDifference::AngleScale { .. } => {
                    "check the units and the scale of this log's channels"
                }
                RunDifference::Inertia { .. } | RunDifference::Load { .. } => {
                    "if the load was changed on purpose, identify these runs separately"
                }
                RunDifference::Coulomb { .. } | RunDifference::Viscous { .. } => {
                    "the cause may be another temperature, a brake, or a rubbing part: repeat the run, or identify it \
                     separately"
                }
                RunDifference::Other => {
                    "look at the log for a loose part, a wrong channel, or a disturbance; repeat the run"
                }
            },
            Self::RunStandsOut { .. } => {
                "check this run for another load or friction, a loose part, or a wrong sensor scale; leave it out or repeat \
                 it, then identify again"
            }
        }
    }
}
