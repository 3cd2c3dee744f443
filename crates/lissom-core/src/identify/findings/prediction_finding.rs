//! Predictions with an identified arm: of a log, and of the arm with another payload.

use lissom_text::significant;

use crate::finding::Severity::{Info, Refusal, Warning};
use crate::finding::result_key as key;
use crate::finding::{counted, findings};
use crate::identify::findings::channel_finding::Channel;
use crate::identify::findings::number_text::minus;
use crate::identify::findings::units::EstimateUnits;
use crate::identify::validation::cause::{Cause, CauseKind};
use crate::identify::validation::moved_mode::{MovedBy, MovedMode};

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

findings! {
    /// No torque is predicted, because the tips do not give the torque between motor and beam.
    "torque-not-predicted" CouplingUnknown {}
        Refusal, [key::TORQUE],
        "these tips do not give the torque between motor and beam: the torque is not predicted",
        "measure the angles of as many points as there are modes; the motion is predicted in any case";

    /// No torque is predicted, because no window fits into the log.
    "torque-not-predicted" NoWindow {}
        Refusal, [key::TORQUE],
        "the log has no window in which the motor moves, all sensors read and the acting command is logged: the torque is not \
            predicted",
        "use a longer log or a shorter window; check the unit of its time";

    /// Sensor noise and reversals alone make a large residual torque, as for the simulated motion of the arm itself.
    "torque-hidden" TorqueHidden { expected_share: f64, window_s: f64 }
        Info, [key::TORQUE],
        format!("with a window of {window_s:.4} s, sensor noise and reversals alone make a residual of {:.0} % of the torque: \
            smaller errors of the arm cannot be seen", 100.0 * expected_share),
        "use a longer window, or a slower and larger motion";

    /// Much of the torque is not predicted, or most of it.
    "prediction-poor" PredictionPoor { residual_share: f64, failed: bool }
        if *failed { Refusal } else { Warning }, [key::TORQUE],
        format!("the residual torque is {:.0} % of the torque: the estimates {}", 100.0 * residual_share,
            if *failed { "do not describe this log" } else { "describe this log only roughly" }),
        "look at the shape of the residual, and at the parts of the log where it is largest";

    /// This log is predicted worse than the logs of the identification, and worse than expected if the arm is right.
    "prediction-worse" PredictionWorse { residual_share: f64, of_identification: f64, expected_share: f64 }
        Warning, [key::TORQUE],
        format!("the residual torque is {:.2} % of the torque, but {:.2} % in the logs of the identification; if the arm were \
            right, it would be {:.2} % in this log", 100.0 * residual_share, 100.0 * of_identification, 100.0 * expected_share),
        "identify from both kinds of motion together: the estimates are valid for the kind of motion that they were identified \
            from";

    /// One term explains much of the residual torque.
    "residual-torque" ResidualTorque { cause: Cause, units: EstimateUnits }
        Warning, [key::TORQUE],
        format!("{:.0} % of the squared residual torque is explained by {}, {}",
            100.0 * cause.share_beyond(), cause.kind.words(), size(cause, *units)),
        cause_hint(cause.kind);

    /// A simulation from one initial state does not follow a whole run; fits are those of the worst channel.
    "motion-departs" MotionDeparts { fit_percent: f64, shorter_s: f64, shorter_fit_percent: f64 }
        Info, [key::MOTION],
        format!("simulated from one initial state, a whole run has a fit of only {fit_percent:.1} %; over {shorter_s:.3} s the \
            fit is {shorter_fit_percent:.1} %"),
        "judge the arm over shorter times: without its control loop a motor drifts with any small error";

    /// A mode has another frequency in this log.
    "mode-moved" ModeMoved { moved: MovedMode }
        Warning, [key::MOTION],
        format!("mode {} looks as if it were at {:.4} rad/s instead of {:.4} rad/s ({} %), with {} stiffness: the squared \
            residual of the motion then drops to {:.1} %", moved.mode + 1, moved.of_log_rad_s, moved.omega_rad_s,
            minus(&format!("{:+.2}", 100.0 * (moved.of_log_rad_s / moved.omega_rad_s - 1.0))), match moved.by {
                MovedBy::Load => "the same",
                MovedBy::Stiffness => "another",
            }, 100.0 * moved.residual_ratio),
        match moved.by {
            MovedBy::Load => "check for another load than in the logs of the identification: identify from logs of this arm, or \
                predict the arm with its new payload",
            MovedBy::Stiffness => "check for a stiffer or softer beam than in the logs of the identification: identify from logs \
                of this arm",
        };

    /// The residual is correlated with the command, at this share of the lags.
    "residual-follows-command" ResidualFollowsCommand { channel: Channel, share: f64 }
        Warning, [key::RESIDUALS],
        format!("the residual of {channel} is correlated with the command at {:.0} % of the lags (5 % by chance): the arm lacks \
            an effect of the command", 100.0 * share),
        "look for a delay, a missing mode, another inertia or other friction";

    /// The residual is not white.
    "residual-not-white" ResidualNotWhite { channel: Channel, noise_ratio: f64 }
        Info, [key::RESIDUALS],
        format!("the residual of {channel} is {} times the noise of its sensor and not white: standard errors that assume a \
            white residual are too small", significant(*noise_ratio, 2)),
        "look at the residual to find what the arm does not describe";

    /// Modes above those found affect how the beam bends under another load.
    "payload-highest-mode" PayloadHighestMode { modes: usize }
        Info, [key::MODES],
        format!("modes above the {} found affect how the beam bends under another load: the interval of the highest mode does \
            not include this", counted(*modes, "mode", "modes")),
        "if the beam has mass along its length, use only the modes below the highest one; if you need the highest one, identify \
            one more mode: add runs near its frequency, or a tip";
}
