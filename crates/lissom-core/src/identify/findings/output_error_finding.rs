//! The output-error method: how well the arm describes the runs.

use std::f64::consts::TAU;

use lissom_text::significant;

use crate::finding::Severity::{Info, Warning};
use crate::finding::result_key as key;
use crate::finding::{counted, findings};
use crate::identify::estimate::Estimate;
use crate::identify::findings::channel_finding::Channel;
use crate::identify::findings::number_text::{later, milliseconds, with_error};
use crate::record::Hold;
use crate::replay::Parameter;

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

findings! {
    /// The command acts at another time than it is logged (negative: earlier).
    "command-lag" CommandLag { lag_s: Estimate }
        Info, [key::INERTIA, key::VISCOUS, key::RAW_RESPONSE],
        format!("the command acts {} {} than it is logged: all estimates account for it",
            milliseconds(*lag_s), later(lag_s.value)),
        "check for a delay of the amplifier, or channels that are not sampled at the same time";

    /// The command acts half a sample later or earlier, as one with this hold does.
    "command-lag" LooksLikeHold { lag_s: Estimate, hold: Hold }
        Warning, [key::COULOMB, key::INERTIA, key::VISCOUS, key::RAW_RESPONSE],
        format!("the command acts {} {} than it is logged: all estimates account for it. Friction may be wrong by more, because \
            it depends on how the command acts between its samples", milliseconds(*lag_s), later(lag_s.value)),
        match hold {
            Hold::Sampled =>
                "the delay is half a sample, so the command is probably held between samples: set hold = \"sampled\"",
            Hold::Measured => "the delay is half a sample, so the command is probably measured and not held between samples: set \
                hold = \"measured\"",
        };

    /// Noise of the command disturbs a simulation of the runs.
    "command-noise" CommandNoise {}
        Info, [],
        "most of the residual torque is noise of the measured command, which would move a simulated arm: the estimates do not \
            come from simulations of whole runs",
        "nothing to do: noise of the command does not disturb the regression, which gives the estimates";

    /// A tip is read at another time than the motor (negative: earlier).
    "tip-lag" TipLag { tip: String, lag_s: Estimate }
        Info, [key::COUPLING, key::MODES, key::TIP_RESPONSES],
        format!("tip {tip} is read {} {} than the motor: the estimates account for it, but the measured frequency responses of \
            the tips do not", milliseconds(*lag_s), later(lag_s.value)),
        "check for a delay of a camera or a filter, or channels that are not sampled at the same time";

    /// The runs show fewer modes than there are tips.
    "modes-missing" ModesMissing { modes: usize, tips: usize }
        Warning, key::WHOLE_ARM,
        format!("{tips} tips are measured, but the runs show only {}: inertia and coupling include the effect of the missing modes",
            counted(*modes, "mode", "modes")),
        "add runs at frequencies above the modes found: a sweep, or sines at several times the highest frequency";

    /// Modes are identified without a tip. The inertia on the motor's side of the springs is a share of the total.
    "hidden-mode" ModesByTheMotor { modes: usize, lowest_rad_s: f64, inertia_share: f64 }
        Info, [key::COUPLING, key::MODES],
        format!("no tip is measured, but the motor's motion shows {}, {} {:.1} Hz with the motor clamped: the inertia given is \
            that on the motor's side of the spring, {:.0} % of the total. Modes that hardly act on the motor are included in it",
            counted(*modes, "flexible mode", "flexible modes"), if *modes == 1 { "at" } else { "the lowest at" },
            lowest_rad_s / TAU, 100.0 * inertia_share),
        "measure a tip to see how the arm itself moves";

    /// The runs hardly excite the highest mode.
    "faint-mode" FaintMode { omega_rad_s: f64, stiffness_std_share: f64 }
        Warning, [key::INERTIA, key::COUPLING, key::MODES],
        format!("the runs hardly excite the highest mode, at {omega_rad_s:.1} rad/s: its stiffness is known to {} % only, and \
            other frequencies fit nearly as well. Its frequency, the inertia and the coupling may be wrong by more than their \
            standard errors", significant(100.0 * stiffness_std_share, 2)),
        "add a run that excites this mode, near the frequency that a model with the beam's dimensions gives";

    /// Residuals of whole runs are larger than the noise of the sensors, most in this channel.
    "more-than-noise" MoreThanNoise { channel: Channel, share: f64 }
        Warning, key::WHOLE_ARM,
        format!("{:.1} % of the squared residual of {channel} varies more slowly than the noise of its sensor: the arm lacks a \
            small effect, or its highest mode has a wrong frequency. The intervals do not include this error", 100.0 * share),
        "add runs near the highest mode, and look at the residual of a validation";

    /// Damping within the beam is not separated from damping against the frame; other parameters depend on it.
    "damping-kind" DampingKind { parameters: Vec<&'static str> }
        if parameters.is_empty() { Info } else { Warning },
        {
            let mut keys = [&parameters[..], &[key::MODES]].concat();
            keys.dedup();
            keys
        },
        "these runs do not separate damping within the beam from damping against the frame, and estimates depend on which of \
            them acts: their standard errors include both cases",
        "add a run at another frequency, best a sweep, or log from the start of the motion: one steady sine does not separate the \
            two";

    /// The estimate of a damper is negative.
    "damper-drives" DamperDrives { damper: Parameter, rate_per_s: Estimate }
        Warning, [key::VISCOUS, key::MODES],
        format!("{} is {} 1/s, but a damper cannot add energy: viscous friction and damping ratios have errors that compensate \
            for it", damper.name(), with_error(*rate_per_s)),
        "add runs near the frequencies of the modes, where damping acts most";

    /// The arm does not describe the runs from beginning to end. The residual over the longest windows is compared with
    /// that over the first, short ones and with the sensors' noise. Short windows over which simulation and log agree may
    /// be too short to show a mode.
    "replay-departs" ReplayDeparts {
        window_s: f64, grown_from: Option<(f64, f64)>, noise_ratio: f64, used: bool, agree_s: Option<f64>
    }
        Warning, key::WHOLE_ARM,
        format!("{}. The estimates come from {}", departs(*window_s, *grown_from, *noise_ratio, *agree_s), match used {
            true => "the longest time over which simulation and log agree",
            false => "the regression, which needs no simulation",
        }),
        "look for friction other than Coulomb and viscous friction, a load, backlash, or a mode without a tip";

    /// The output-error method ended before it had finished.
    "budget-spent" BudgetSpent { evaluations: u64, window_s: f64, used: bool, interrupted: bool }
        Warning, key::WHOLE_ARM,
        format!("the output-error method {} {:.1} million evaluations, at windows of {window_s:.2} s. The estimates are {}",
            if *interrupted { "was stopped after" } else { "had not finished after" }, *evaluations as f64 / 1e6,
            if *used { "the best ones found so far" } else { "those of another method" }),
        "allow more evaluations (effort thorough) or more time, or use fewer and shorter runs: three to eight runs of ten strokes \
            each";

    /// The runs are simulated in windows, each from its own initial state.
    "motions-part" MotionsPart { window_s: f64 }
        Info, [],
        format!("motions from nearly equal initial states diverge over longer times, by noise of the command, stick-slip, or \
            friction that changes over the angle: the runs are simulated in windows of {window_s:.2} s, each from a new initial \
            state"),
        "nothing to do; a prediction from one initial state is valid for about this time only";
}
