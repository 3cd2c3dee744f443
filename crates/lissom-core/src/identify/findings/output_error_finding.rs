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

/// What a delay of the command looks like.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LagCause {
    /// Half a sample later than measured: the command looks held from sample to sample.
    LooksHeld,
    /// Half a sample earlier than held: the command looks measured.
    LooksMeasured,
    /// Anything else.
    Delay,
}

/// The output-error method: how well the arm describes the runs.
#[derive(Debug, Clone, PartialEq, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "kebab-case")]
#[non_exhaustive]
pub enum OutputErrorFinding {
    /// The command acts at another time than it is logged.
    CommandLag {
        /// How much later \[s\].
        lag_s: Estimate,
        /// What that looks like.
        cause: LagCause,
    },
    /// The motion is not simulated from the command over whole runs, because of the noise of the command.
    CommandNoise {
        /// How far it moves the angle beside the noise of the angle's sensor; `None` where the runs were replayed, and
        /// depart from the log.
        ratio: Option<f64>,
    },
    /// A tip is read at another time than the motor.
    TipLag {
        /// Name of the tip.
        tip: String,
        /// How much later \[s\].
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
        /// The lowest one's frequency with the motor clamped \[rad/s\].
        lowest_rad_s: f64,
        /// Inertia before the springs as a share of all.
        inertia_share: f64,
    },
    /// The highest mode hardly shows.
    FaintMode {
        /// Its frequency \[rad/s\].
        omega_rad_s: f64,
        /// Standard error of its stiffness, relative.
        stiffness_std_share: f64,
    },
    /// Residuals of whole runs are more than the sensors' noise.
    MoreThanNoise {
        /// The channel where this shows most.
        channel: Channel,
        /// Share of its squared residual that is slower than noise.
        share: f64,
    },
    /// Damping within the beam is not separated from damping against the frame.
    DampingKind {
        /// Result keys of the parameters that depend on it, other than damping.
        parameters: Vec<&'static str>,
    },
    /// A damper comes out negative.
    DamperDrives {
        /// Which.
        damper: Parameter,
        /// Its rate \[1/s\].
        rate_per_s: Estimate,
    },
    /// The arm does not describe the runs from beginning to end.
    ReplayDeparts {
        /// Length of the longest windows \[s\].
        window_s: f64,
        /// Length of the first, short windows, and the growth of the residual from these to the longest; `None`
        /// where the residual does not grow \[s\], \[1\].
        grown_from: Option<(f64, f64)>,
        /// Residual over the longest windows relative to the sensors' noise.
        noise_ratio: f64,
        /// Whether its estimates over short windows are used; else the regression's are.
        used: bool,
    },
    /// The output-error method made all evaluations that it may make before it was done.
    BudgetSpent {
        /// Evaluations made.
        evaluations: u64,
        /// Length of the longest windows \[s\].
        window_s: f64,
        /// Whether its estimates are used; else the regression's are.
        used: bool,
        /// Whether somebody asked it to end, or a time was over.
        interrupted: bool,
    },
    /// The runs are described in windows, each from its own initial state.
    MotionsPart {
        /// Length of a window \[s\].
        window_s: f64,
    },
}

impl OutputErrorFinding {
    /// Whether it is a cause that other findings may follow from.
    pub(crate) fn is_cause(&self) -> bool {
        matches!(self, Self::CommandLag { .. } | Self::TipLag { .. } | Self::ModesByTheMotor { .. })
    }
}

impl fmt::Display for OutputErrorFinding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::CommandLag { lag_s, .. } => write!(
                f,
                "the command acts {} {} than it is logged: all estimates account for it",
                milliseconds(*lag_s),
                later(lag_s.value)
            ),
            Self::CommandNoise { ratio: None } => f.write_str(
                "the measured command is too noisy to simulate whole runs from it: most of the residual torque is its \
                 noise. The estimates do not come from whole runs of the output-error method",
            ),
            Self::CommandNoise { ratio: Some(ratio) } => write!(
                f,
                "the measured command is too noisy to simulate the motion from it (its noise, integrated, is {} times that of the \
                 angle's sensor): the estimates do not come from the output-error method",
                significant(*ratio, 2)
            ),
            Self::TipLag { tip, lag_s } => write!(
                f,
                "tip {tip} is read {} {} than the motor: the estimates account for it, the tips' measured frequency \
                 responses do not",
                milliseconds(*lag_s),
                later(lag_s.value)
            ),
            Self::ModesMissing { modes, tips } => write!(
                f,
                "{tips} tips are measured, and the runs show {} only: inertia and coupling contain what the missing \
                 modes add",
                counted(*modes, "mode", "modes")
            ),
            Self::ModesByTheMotor { modes, lowest_rad_s, inertia_share } => write!(
                f,
                "no tip is measured, and the motor's motion shows {}, {} {:.1} Hz with the motor clamped: inertia is that before \
                 the spring, {:.0} % of all that turns. Modes that hardly act on the motor are counted with it",
                counted(*modes, "flexible mode", "flexible modes"),
                if *modes == 1 { "at" } else { "the lowest at" },
                lowest_rad_s / std::f64::consts::TAU,
                100.0 * inertia_share
            ),
            Self::FaintMode { omega_rad_s, stiffness_std_share } => write!(
                f,
                "the runs hardly excite the highest mode, at {omega_rad_s:.1} rad/s: its stiffness is known to {:.1} % \
                 only, and other frequencies fit nearly as well. Its frequency and the coupling may be wrong by more \
                 than their standard errors",
                100.0 * stiffness_std_share
            ),
            Self::MoreThanNoise { channel, share } => write!(
                f,
                "{:.1} % of the squared residual of {channel} is slower than the noise of its sensor: a small effect is \
                 missing in the arm, or the highest mode has a wrong frequency. The intervals do not count this",
                100.0 * share
            ),
            Self::DampingKind { .. } => f.write_str(
                "these runs do not separate damping within the beam from damping against the frame, and estimates depend \
                 on it: their standard errors count both cases",
            ),
            Self::DamperDrives { damper, rate_per_s } => write!(
                f,
                "{} is {} 1/s: a damper cannot add energy. Viscous friction and damping ratios have an error that makes \
                 up for it",
                damper.name(),
                with_error(*rate_per_s)
            ),
            Self::ReplayDeparts { window_s, grown_from, noise_ratio, used } => {
                match grown_from {
                    Some((first_s, growth)) => write!(
                        f,
                        "over windows of {window_s:.2} s the residual of the motion is {growth:.1} times that over \
                         {first_s:.2} s: the arm lacks something that moves the axis"
                    )?,
                    None => write!(
                        f,
                        "over windows of {window_s:.2} s the residual of the motion is {noise_ratio:.1} times the \
                         sensors' noise, and over shorter ones as well: the arm lacks something that moves the axis, or \
                         the search did not find the arm"
                    )?,
                }
                f.write_str(if *used {
                    ". The estimates are those of the windows that it describes"
                } else {
                    ". The estimates are those of the regression"
                })
            }
            Self::BudgetSpent { evaluations, window_s, used, interrupted } => write!(
                f,
                "the output-error method {} {:.1} million evaluations, at windows of {window_s:.2} s. The estimates are those {}",
                if *interrupted { "was stopped after" } else { "was not done after" },
                *evaluations as f64 / 1e6,
                if *used { "that it had come to" } else { "of the regression" }
            ),
            Self::MotionsPart { window_s } => write!(
                f,
                "with friction that changes over the angle or falls with speed, neighbouring motions diverge: the runs \
                 are described {window_s:.2} s at a time, each time from a new initial state"
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
            | Self::CommandLag { .. }
            | Self::CommandNoise { .. }
            | Self::TipLag { .. }
            | Self::ModesByTheMotor { .. }
            | Self::MotionsPart { .. } => Severity::Info,
            Self::ModesMissing { .. }
            | Self::FaintMode { .. }
            | Self::MoreThanNoise { .. }
            | Self::DamperDrives { .. }
            | Self::BudgetSpent { .. }
            | Self::ReplayDeparts { .. } => Severity::Warning,
        }
    }

    fn affects(&self) -> Vec<&'static str> {
        match self {
            Self::CommandNoise { .. } => vec![],
            Self::CommandLag { .. } => vec![key::INERTIA, key::VISCOUS, key::RAW_RESPONSE],
            Self::TipLag { .. } => vec![key::COUPLING, key::MODES, key::TIP_RESPONSES],
            Self::ModesMissing { .. }
            | Self::MoreThanNoise { .. }
            | Self::BudgetSpent { .. }
            | Self::ReplayDeparts { .. } => {
                vec![key::COULOMB, key::VISCOUS, key::INERTIA, key::COUPLING, key::MODES]
            }
            Self::ModesByTheMotor { .. } | Self::FaintMode { .. } => {
                vec![key::COUPLING, key::MODES]
            }
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
            Self::CommandNoise { .. } => {
                "nothing to do: the regression, whose equation has such noise on its right side, gives the estimates"
            }
            Self::CommandLag { cause: LagCause::LooksHeld, .. } => {
                "half a sample: the command looks as if it were held from sample to sample, hold = \"sampled\""
            }
            Self::CommandLag { cause: LagCause::LooksMeasured, .. } => {
                "half a sample: the command looks measured rather than held from sample to sample, hold = \
                 \"measured\""
            }
            Self::CommandLag { cause: LagCause::Delay, .. } => {
                "check for a delay of the amplifier, or channels that are not sampled together"
            }
            Self::TipLag { .. } => {
                "check for a delay of a camera or a filter, or channels that are not sampled together"
            }
            Self::ModesMissing { .. } => {
                "add runs above the modes found: a sweep, or sines at several times the highest frequency"
            }
            Self::ModesByTheMotor { .. } => "measure a tip to see how the arm itself moves",
            Self::FaintMode { .. } => {
                "add a run that excites it, near the frequency that a model of the beam's dimensions gives"
            }
            Self::MoreThanNoise { .. } => {
                "add runs near the highest mode, and look at the residual of a validation"
            }
            Self::DampingKind { .. } => {
                "one steady sine does not separate the two: add a run at another frequency, best a sweep, or log from \
                 the start of the motion"
            }
            Self::DamperDrives { .. } => "add runs near the modes, where damping shows most",
            Self::ReplayDeparts { .. } => {
                "look for other friction than Coulomb and viscous, a load, backlash, or a mode without a tip"
            }
            Self::BudgetSpent { .. } => {
                "allow more evaluations (effort thorough) or more time, or use fewer and shorter runs: ten strokes a run, three to eight runs"
            }
            Self::MotionsPart { .. } => {
                "nothing to do; a prediction from the initial state of a run holds no longer than that"
            }
        }
    }
}
