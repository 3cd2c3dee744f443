//! The output-error method: how well the arm describes the runs.

use std::fmt;

use strum::{IntoStaticStr, VariantNames};

use crate::identify::estimate::Estimate;
use crate::identify::findings::channel_finding::Channel;
use crate::identify::findings::describe::Describe;
use crate::identify::findings::number_text::{
    counted, later, milliseconds, significant, with_error,
};
use crate::identify::findings::result_key as key;
use crate::identify::findings::severity::Severity;
use crate::replay::Parameter;

/// Probable cause of a delay of the command.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LagCause {
    /// A command declared as measured acts half a sample later: it is probably held between samples.
    LooksHeld,
    /// A command declared as held acts half a sample earlier: it is probably measured.
    LooksMeasured,
    /// Any other delay.
    Delay,
}

/// The output-error method: how well the arm describes the runs.
#[derive(Debug, Clone, PartialEq, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "kebab-case")]
#[non_exhaustive]
pub enum OutputErrorFinding {
    /// The command acts at another time than it is logged.
    CommandLag {
        /// The delay; negative if it acts earlier \[s\].
        lag_s: Estimate,
        /// Its probable cause.
        cause: LagCause,
    },
    /// Noise of the command disturbs a simulation of the runs.
    CommandNoise,
    /// A tip is read at another time than the motor.
    TipLag {
        /// Name of the tip.
        tip: String,
        /// The delay; negative if it is read earlier \[s\].
        lag_s: Estimate,
    },
    /// The runs show fewer modes than there are tips.
    ModesMissing {
        /// Modes found.
        modes: usize,
        /// Tips measured.
        tips: usize,
    },
    /// Modes are identified without a tip.
    ModesByTheMotor {
        /// Modes found.
        modes: usize,
        /// Frequency of the lowest mode, with the motor clamped \[rad/s\].
        lowest_rad_s: f64,
        /// Inertia on the motor's side of the springs, as a share of the total.
        inertia_share: f64,
    },
    /// The runs hardly excite the highest mode.
    FaintMode {
        /// Its frequency \[rad/s\].
        omega_rad_s: f64,
        /// Standard error of its stiffness, relative.
        stiffness_std_share: f64,
    },
    /// Residuals of whole runs are larger than the noise of the sensors.
    MoreThanNoise {
        /// The channel with the largest share.
        channel: Channel,
        /// Share of its squared residual that varies more slowly than noise.
        share: f64,
    },
    /// Damping within the beam is not separated from damping against the frame.
    DampingKind {
        /// Result keys of the parameters that depend on it, other than damping.
        parameters: Vec<&'static str>,
    },
    /// The estimate of a damper is negative.
    DamperDrives {
        /// The damper.
        damper: Parameter,
        /// Its rate \[1/s\].
        rate_per_s: Estimate,
    },
    /// The arm does not describe the runs from beginning to end.
    ReplayDeparts {
        /// Length of the longest windows \[s\].
        window_s: f64,
        /// Length of the first, short windows \[s\], and the residual over the longest windows relative to that over the
        /// first ones \[1\]; `None` if the residual does not grow.
        grown_from: Option<(f64, f64)>,
        /// Residual over the longest windows relative to the sensors' noise.
        noise_ratio: f64,
        /// Whether the estimates over short windows are used; otherwise those of the regression.
        used: bool,
        /// Length of windows \[s\] over which the arm describes the motion, if they are too short to show a mode.
        agree_s: Option<f64>,
    },
    /// The output-error method ended before it had finished.
    BudgetSpent {
        /// Evaluations made.
        evaluations: u64,
        /// Length of the longest windows \[s\].
        window_s: f64,
        /// Whether its estimates are used; otherwise those of the regression.
        used: bool,
        /// Whether it was interrupted by the caller or by a time limit; otherwise it had used all evaluations.
        interrupted: bool,
    },
    /// The runs are simulated in windows, each from its own initial state.
    MotionsPart {
        /// Length of a window \[s\].
        window_s: f64,
    },
}

impl OutputErrorFinding {
    /// Whether it may be the cause of other findings.
    pub(crate) fn is_cause(&self) -> bool {
        matches!(self, Self::CommandLag { .. } | Self::TipLag { .. } | Self::ModesByTheMotor { .. })
    }
}

/// How far the simulated arm follows the log.
fn departs(
    window_s: f64,
    grown_from: Option<(f64, f64)>,
    noise_ratio: f64,
    agree_s: Option<f64>,
) -> String {
    match (agree_s, grown_from) {
        (Some(agree_s), _) => format!(
            "simulation and log agree over {agree_s:.2} s only, less than a period of the slowest mode: this does not \
             determine its frequency"
        ),
        (None, Some((first_s, growth))) => format!(
            "in simulations over {window_s:.2} s the error of the motion is {growth:.1} times that over {first_s:.2} s: the \
             model lacks an effect that moves the axis"
        ),
        (None, None) => format!(
            "in simulations over {window_s:.2} s the error of the motion is {} the sensors' noise, and no \
             smaller over shorter times: the model lacks an effect that moves the axis, or the fit did not converge",
            times(noise_ratio)
        ),
    }
}

/// A ratio in words.
fn times(ratio: f64) -> String {
    match ratio {
        ..10.0 => format!("{ratio:.1} times"),
        10.0..1e3 => format!("{ratio:.0} times"),
        _ => "more than 1000 times".to_owned(),
    }
}

impl fmt::Display for OutputErrorFinding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::CommandLag { lag_s, cause } => {
                let but = match cause {
                    LagCause::Delay => "",
                    LagCause::LooksHeld | LagCause::LooksMeasured => {
                        ". Friction may be wrong by more, because it depends on how the command acts between its samples"
                    }
                };
                write!(
                    f,
                    "the command acts {} {} than it is logged: all estimates account for it{but}",
                    milliseconds(*lag_s),
                    later(lag_s.value)
                )
            }
            Self::CommandNoise => f.write_str(
                "most of the residual torque is noise of the measured command, which would move a simulated arm: the \
                 estimates do not come from simulations of whole runs",
            ),
            Self::TipLag { tip, lag_s } => write!(
                f,
                "tip {tip} is read {} {} than the motor: the estimates account for it, but the measured frequency \
                 responses of the tips do not",
                milliseconds(*lag_s),
                later(lag_s.value)
            ),
            Self::ModesMissing { modes, tips } => write!(
                f,
                "{tips} tips are measured, but the runs show only {}: inertia and coupling include the effect of the missing \
                 modes",
                counted(*modes, "mode", "modes")
            ),
            Self::ModesByTheMotor { modes, lowest_rad_s, inertia_share } => write!(
                f,
                "no tip is measured, but the motor's motion shows {}, {} {:.1} Hz with the motor clamped: the inertia given is \
                 that on the motor's side of the spring, {:.0} % of the total. Modes that hardly act on the motor are \
                 included in it",
                counted(*modes, "flexible mode", "flexible modes"),
                if *modes == 1 { "at" } else { "the lowest at" },
                lowest_rad_s / std::f64::consts::TAU,
                100.0 * inertia_share
            ),
            Self::FaintMode { omega_rad_s, stiffness_std_share } => write!(
                f,
                "the runs hardly excite the highest mode, at {omega_rad_s:.1} rad/s: its stiffness is known to {} % \
                 only, and other frequencies fit nearly as well. Its frequency, the inertia and the coupling may be wrong \
                 by more than their standard errors",
                significant(100.0 * stiffness_std_share, 2)
            ),
            Self::MoreThanNoise { channel, share } => write!(
                f,
                "{:.1} % of the squared residual of {channel} varies more slowly than the noise of its sensor: the arm lacks \
                 a small effect, or its highest mode has a wrong frequency. The intervals do not include this error",
                100.0 * share
            ),
            Self::DampingKind { .. } => f.write_str(
                "these runs do not separate damping within the beam from damping against the frame, and estimates depend \
                 on which of them acts: their standard errors include both cases",
            ),
            Self::DamperDrives { damper, rate_per_s } => write!(
                f,
                "{} is {} 1/s, but a damper cannot add energy: viscous friction and damping ratios have errors that \
                 compensate for it",
                damper.name(),
                with_error(*rate_per_s)
            ),
            Self::ReplayDeparts { window_s, grown_from, noise_ratio, used, agree_s } => {
                f.write_str(&departs(*window_s, *grown_from, *noise_ratio, *agree_s))?;
                f.write_str(if *used {
                    ". The estimates come from the longest time over which simulation and log agree"
                } else {
                    ". The estimates come from the regression, which needs no simulation"
                })
            }
            Self::BudgetSpent { evaluations, window_s, used, interrupted } => write!(
                f,
                "the output-error method {} {:.1} million evaluations, at windows of {window_s:.2} s. The estimates are {}",
                if *interrupted { "was stopped after" } else { "had not finished after" },
                *evaluations as f64 / 1e6,
                if *used { "the best ones found so far" } else { "those of another method" }
            ),
            Self::MotionsPart { window_s } => write!(
                f,
                "motions from nearly equal initial states diverge over longer times, by noise of the command, stick-slip, or friction \
                 that changes over the angle: the runs are simulated in windows of {window_s:.2} s, each from a new initial state"
            ),
        }
    }
}

impl Describe for OutputErrorFinding {
    fn code(&self) -> &'static str {
        self.into()
    }

    fn severity(&self) -> Severity {
        match self {
            Self::DampingKind { parameters } if !parameters.is_empty() => Severity::Warning,
            Self::DampingKind { .. }
            | Self::CommandLag { cause: LagCause::Delay, .. }
            | Self::CommandNoise
            | Self::TipLag { .. }
            | Self::ModesByTheMotor { .. }
            | Self::MotionsPart { .. } => Severity::Info,
            Self::CommandLag { .. }
            | Self::ModesMissing { .. }
            | Self::FaintMode { .. }
            | Self::MoreThanNoise { .. }
            | Self::DamperDrives { .. }
            | Self::BudgetSpent { .. }
            | Self::ReplayDeparts { .. } => Severity::Warning,
        }
    }

    fn affects(&self) -> Vec<&'static str> {
        match self {
            Self::CommandNoise => vec![],
            Self::CommandLag { cause: LagCause::Delay, .. } => {
                vec![key::INERTIA, key::VISCOUS, key::RAW_RESPONSE]
            }
            Self::CommandLag { .. } => {
                vec![key::COULOMB, key::INERTIA, key::VISCOUS, key::RAW_RESPONSE]
            }
            Self::TipLag { .. } => vec![key::COUPLING, key::MODES, key::TIP_RESPONSES],
            Self::ModesMissing { .. }
            | Self::MoreThanNoise { .. }
            | Self::BudgetSpent { .. }
            | Self::ReplayDeparts { .. } => {
                let beam = [key::COUPLING, key::MODES];
                [&[key::COULOMB, key::VISCOUS, key::INERTIA, key::GRAVITY][..], &beam].concat()
            }
            Self::ModesByTheMotor { .. } => vec![key::COUPLING, key::MODES],
            Self::FaintMode { .. } => vec![key::INERTIA, key::COUPLING, key::MODES],
            Self::DampingKind { parameters } => {
                let mut keys = parameters.clone();
                keys.push(key::MODES);
                keys.dedup();
                keys
            }
            Self::DamperDrives { .. } => vec![key::VISCOUS, key::MODES],
            Self::MotionsPart { .. } => Vec::new(),
        }
    }

    fn hint(&self) -> &'static str {
        match self {
            Self::CommandNoise => {
                "nothing to do: noise of the command does not disturb the regression, which gives the estimates"
            }
            Self::CommandLag { cause: LagCause::LooksHeld, .. } => {
                "the delay is half a sample, so the command is probably held between samples: set hold = \"sampled\""
            }
            Self::CommandLag { cause: LagCause::LooksMeasured, .. } => {
                "the delay is half a sample, so the command is probably measured and not held between samples: set hold = \
                 \"measured\""
            }
            Self::CommandLag { cause: LagCause::Delay, .. } => {
                "check for a delay of the amplifier, or channels that are not sampled at the same time"
            }
            Self::TipLag { .. } => {
                "check for a delay of a camera or a filter, or channels that are not sampled at the same time"
            }
            Self::ModesMissing { .. } => {
                "add runs at frequencies above the modes found: a sweep, or sines at several times the highest frequency"
            }
            Self::ModesByTheMotor { .. } => "measure a tip to see how the arm itself moves",
            Self::FaintMode { .. } => {
                "add a run that excites this mode, near the frequency that a model with the beam's dimensions gives"
            }
            Self::MoreThanNoise { .. } => {
                "add runs near the highest mode, and look at the residual of a validation"
            }
            Self::DampingKind { .. } => {
                "add a run at another frequency, best a sweep, or log from the start of the motion: one steady sine does \
                 not separate the two"
            }
            Self::DamperDrives { .. } => {
                "add runs near the frequencies of the modes, where damping acts most"
            }
            Self::ReplayDeparts { .. } => {
                "look for friction other than Coulomb and viscous friction, a load, backlash, or a mode without a tip"
            }
            Self::BudgetSpent { .. } => {
                "allow more evaluations (effort thorough) or more time, or use fewer and shorter runs: three to eight runs of \
                 ten strokes each"
            }
            Self::MotionsPart { .. } => {
                "nothing to do; a prediction from one initial state is valid for about this time only"
            }
        }
    }
}
