//! Prediction of a log with an identified arm.

use std::fmt;

use strum::{IntoStaticStr, VariantNames};

use crate::identify::findings::channel_finding::Channel;
use crate::identify::findings::describe::Describe;
use crate::identify::findings::number_text::{minus, significant};
use crate::identify::findings::result_key as key;
use crate::identify::findings::severity::Severity;
use crate::identify::findings::units::EstimateUnits;
use crate::identify::validation::cause::{Cause, CauseKind};
use crate::identify::validation::moved_mode::{MovedBy, MovedMode};

/// Prediction of a log with an identified arm.
#[derive(Debug, Clone, PartialEq, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "kebab-case")]
#[non_exhaustive]
pub enum ValidationFinding {
    /// No torque is predicted.
    TorqueNotPredicted {
        /// Whether the tips give the torque between motor and beam; then the reason is that no window fits into the log.
        coupling_known: bool,
    },
    /// Sensor noise and reversals alone make a large residual torque.
    TorqueHidden {
        /// Residual torque relative to the torque, for the simulated motion of the arm itself.
        expected_share: f64,
        /// Length of the window \[s\].
        window_s: f64,
    },
    /// Most of the torque is not predicted.
    PredictionFailed {
        /// Residual torque relative to the torque.
        residual_share: f64,
    },
    /// Much of the torque is not predicted.
    PredictionPoor {
        /// Residual torque relative to the torque.
        residual_share: f64,
    },
    /// This log is predicted worse than the logs of the identification.
    PredictionWorse {
        /// Residual torque relative to the torque.
        residual_share: f64,
        /// The same of the logs of the identification.
        residual_share_of_identification: f64,
        /// The same as expected for this log if the arm is right.
        expected_share: f64,
    },
    /// One term explains much of the residual torque.
    ResidualTorque {
        /// The term.
        cause: Cause,
        /// Units of its size.
        units: EstimateUnits,
    },
    /// A simulation from one initial state does not follow a whole run.
    MotionDeparts {
        /// The worst channel's fit over whole runs \[%\].
        fit_percent: f64,
        /// A shorter time \[s\].
        shorter_s: f64,
        /// The worst channel's fit over that time \[%\].
        shorter_fit_percent: f64,
    },
    /// A mode has another frequency in this log.
    ModeMoved {
        /// The mode and its frequencies.
        moved: MovedMode,
    },
    /// The residual is correlated with the command.
    ResidualFollowsCommand {
        /// Channel of the residual.
        channel: Channel,
        /// Share of the lags outside the 95 % band.
        share: f64,
    },
    /// The residual is not white.
    ResidualNotWhite {
        /// Channel of the residual.
        channel: Channel,
        /// Its root mean square relative to the sensor's noise.
        noise_ratio: f64,
    },
}

/// Size of a term with its unit, less the size that the simulated motion of the arm itself shows.
fn size(cause: &Cause, units: EstimateUnits) -> String {
    let value = cause.value - cause.expected_value;
    let sign = if value < 0.0 { "−" } else { "+" };
    let with = |unit: &str| format!("{sign}{} {unit}", significant(value.abs(), 3));
    match cause.kind {
        CauseKind::Delay => {
            format!("{sign}{} ms", significant(1e3 * value.abs(), 3))
        }
        CauseKind::Coupling => format!("{sign}{} %", significant(100.0 * value.abs(), 3)),
        CauseKind::Inertia => with(&units.inertia()),
        CauseKind::Viscous | CauseKind::ViscousByDirection => with(&units.viscous()),
        CauseKind::Position => with(&units.stiffness()),
        CauseKind::Coulomb | CauseKind::Offset | CauseKind::NearRest => with(units.torque()),
    }
}

fn cause_hint(kind: CauseKind) -> &'static str {
    match kind {
        CauseKind::Delay => {
            "check for a delay of the amplifier, or channels that are not sampled at the same time"
        }
        CauseKind::Inertia => {
            "check for another load than in the logs of the identification, or a wrong torque constant"
        }
        CauseKind::Viscous | CauseKind::ViscousByDirection => {
            "identify from this log as well: friction changes with temperature and load, and it may not grow linearly \
             with speed"
        }
        CauseKind::Coulomb | CauseKind::Offset => {
            "identify from this log as well: friction changes with temperature, load and position, and a constant torque \
             is a load or an offset"
        }
        CauseKind::Position => "check for gravity, a spring, or a wrong scale of a tip",
        CauseKind::Coupling => {
            "check for a stiffer or softer beam than in the logs of the identification, or a wrong scale of a tip"
        }
        CauseKind::NearRest => {
            "identify from this log as well: the cause may be Stribeck friction or presliding, which the friction law of \
             the result does not have"
        }
    }
}

impl fmt::Display for ValidationFinding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TorqueNotPredicted { coupling_known: true } => f.write_str(
                "the log has no window in which the motor moves, all sensors read and the acting command is logged: the \
                 torque is not predicted",
            ),
            Self::TorqueNotPredicted { coupling_known: false } => f.write_str(
                "these tips do not give the torque between motor and beam: the torque is not predicted",
            ),
            Self::TorqueHidden { expected_share, window_s } => write!(
                f,
                "with a window of {window_s:.4} s, sensor noise and reversals alone make a residual of {:.0} % of the \
                 torque: smaller errors of the arm cannot be seen",
                100.0 * expected_share
            ),
            Self::PredictionFailed { residual_share } => write!(
                f,
                "the residual torque is {:.0} % of the torque: the estimates do not describe this log",
                100.0 * residual_share
            ),
            Self::PredictionPoor { residual_share } => write!(
                f,
                "the residual torque is {:.0} % of the torque: the estimates describe this log only roughly",
                100.0 * residual_share
            ),
            Self::PredictionWorse {
                residual_share,
                residual_share_of_identification,
                expected_share,
            } => write!(
                f,
                "the residual torque is {:.2} % of the torque, but {:.2} % in the logs of the identification; if the arm \
                 were right, it would be {:.2} % in this log",
                100.0 * residual_share,
                100.0 * residual_share_of_identification,
                100.0 * expected_share
            ),
            Self::ResidualTorque { cause, units } => write!(
                f,
                "{:.0} % of the squared residual torque is explained by {}, {}",
                100.0 * cause.share_beyond(),
                cause.kind.words(),
                size(cause, *units)
            ),
            Self::MotionDeparts { fit_percent, shorter_s, shorter_fit_percent } => write!(
                f,
                "simulated from one initial state, a whole run has a fit of only {fit_percent:.1} %; over {shorter_s:.3} s \
                 the fit is {shorter_fit_percent:.1} %"
            ),
            Self::ModeMoved { moved } => write!(
                f,
                "mode {} looks as if it were at {:.4} rad/s instead of {:.4} rad/s ({} %), with {}: the squared \
                 residual of the motion then drops to {:.1} %",
                moved.mode + 1,
                moved.of_log_rad_s,
                moved.omega_rad_s,
                minus(&format!("{:+.2}", 100.0 * (moved.of_log_rad_s / moved.omega_rad_s - 1.0))),
                match moved.by {
                    MovedBy::Load => "the same stiffness",
                    MovedBy::Stiffness => "another stiffness",
                },
                100.0 * moved.residual_ratio
            ),
            Self::ResidualFollowsCommand { channel, share } => write!(
                f,
                "the residual of {channel} is correlated with the command at {:.0} % of the lags (5 % by chance): the \
                 arm lacks an effect of the command",
                100.0 * share
            ),
            Self::ResidualNotWhite { channel, noise_ratio } => write!(
                f,
                "the residual of {channel} is {} times the noise of its sensor and not white: standard errors that assume \
                 a white residual are too small",
                significant(*noise_ratio, 2)
            ),
        }
    }
}

impl Describe for ValidationFinding {
    fn code(&self) -> &'static str {
        self.into()
    }

    fn severity(&self) -> Severity {
        match self {
            Self::TorqueNotPredicted { .. } | Self::PredictionFailed { .. } => Severity::Refusal,
            Self::PredictionPoor { .. }
            | Self::PredictionWorse { .. }
            | Self::ResidualTorque { .. }
            | Self::ModeMoved { .. }
            | Self::ResidualFollowsCommand { .. } => Severity::Warning,
            Self::TorqueHidden { .. }
            | Self::MotionDeparts { .. }
            | Self::ResidualNotWhite { .. } => Severity::Info,
        }
    }

    fn affects(&self) -> Vec<&'static str> {
        vec![match self {
            Self::TorqueNotPredicted { .. }
            | Self::TorqueHidden { .. }
            | Self::PredictionFailed { .. }
            | Self::PredictionPoor { .. }
            | Self::PredictionWorse { .. }
            | Self::ResidualTorque { .. } => key::TORQUE,
            Self::MotionDeparts { .. } | Self::ModeMoved { .. } => key::MOTION,
            Self::ResidualFollowsCommand { .. } | Self::ResidualNotWhite { .. } => key::RESIDUALS,
        }]
    }

    fn hint(&self) -> &'static str {
        match self {
            Self::TorqueNotPredicted { coupling_known: true } => {
                "use a longer log or a shorter window; check the unit of its time"
            }
            Self::TorqueNotPredicted { coupling_known: false } => {
                "measure the angles of as many points as there are modes; the motion is predicted in any case"
            }
            Self::TorqueHidden { .. } => "use a longer window, or a slower and larger motion",
            Self::PredictionFailed { .. } | Self::PredictionPoor { .. } => {
                "look at the shape of the residual, and at the parts of the log where it is largest"
            }
            Self::PredictionWorse { .. } => {
                "identify from both kinds of motion together: the estimates are valid for the kind of motion that they were \
                 identified from"
            }
            Self::ResidualTorque { cause, .. } => cause_hint(cause.kind),
            Self::MotionDeparts { .. } => {
                "judge the arm over shorter times: without its control loop a motor drifts with any small error"
            }
            Self::ModeMoved { moved: MovedMode { by: MovedBy::Load, .. } } => {
                "check for another load than in the logs of the identification: identify from logs of this arm, or predict \
                 the arm with its new payload"
            }
            Self::ModeMoved { .. } => {
                "check for a stiffer or softer beam than in the logs of the identification: identify from logs of this arm"
            }
            Self::ResidualFollowsCommand { .. } => {
                "look for a delay, a missing mode, another inertia or other friction"
            }
            Self::ResidualNotWhite { .. } => {
                "look at the residual to find what the arm does not describe"
            }
        }
    }
}
