//! What one run is and what can be taken from it.

use num_complex::Complex64;

use crate::identify::finding::{Finding, Severity, key};
use crate::identify::methods::constant_velocity::thresholds::{STEADY_BOTH_WAYS, STEADY_ONE_WAY};
use crate::identify::methods::constant_velocity::{
    SteadyPoint, no_stretch, steady_points, steady_share,
};
use crate::identify::methods::regression::slip_sign;
use crate::identify::methods::third_harmonic::RunPhasors;
use crate::identify::prepare::channel_check::{
    clipped_share, dwell_share, range, rest_share, step,
};
use crate::identify::prepare::repeated_run::repeats;
use crate::identify::prepare::sensor_check;
use crate::identify::prepare::thresholds::{
    AT_LIMIT, AT_REST_REPORTED, DRIFT_REPORTED, DRIFT_STEPS, FEW_PERIODS, JITTER_REPORTED, ONE_WAY,
    ONE_WAY_MOVES, SATURATION_REPORTED, SINE_DISTORTION_FOUND, SINE_DISTORTION_GIVEN,
    SINE_UNEXPLAINED, STICKING_REPORTED,
};
use crate::identify::thresholds::SAME_FREQUENCY;
use crate::record::{Campaign, Hold, Note, Run};
use crate::spectrum::{
    Harmonics, Phasor, Steady, find_frequency, hold_factor, least_squares, steady_state,
};

/// What was found in one run.
#[derive(Debug, Clone)]
pub struct RunAnalysis {
    /// Its name.
    pub name: String,
    /// Samples it has.
    pub samples: usize,
    /// Its sample time \[s\].
    pub sample_time_s: f64,
    /// What it is.
    pub kind: RunKind,
    /// Share of samples at which the command saturates.
    pub saturated_share: f64,
    /// Sticking share of the cycle; `None` for runs that are not sinusoidal.
    pub stuck_share: Option<f64>,
    /// Whether the regression may use it.
    pub usable: bool,
    /// Its stretches at constant velocity; none are looked for in a sinusoid.
    pub steady: Vec<SteadyPoint>,
}

/// What a run is.
#[derive(Debug, Clone)]
pub enum RunKind {
    /// One sinusoid in steady state.
    Sinusoidal(Box<Sinusoidal>),
    /// Constant velocities for most of the time in motion.
    ConstantVelocity,
    /// Any other motion.
    General,
}

/// Steady state of a sinusoidal run.
#[derive(Debug, Clone)]
pub struct Sinusoidal {
    /// Drive frequency ω0 \[rad/s\].
    pub omega_rad_s: f64,
    /// Whether it was given rather than found.
    pub omega_given: bool,
    /// What was kept and dropped.
    pub steady: Steady,
    /// Harmonics of the motor.
    pub motor: Harmonics,
    /// Harmonics of the command as the motor saw it: hold compensated.
    pub command: Harmonics,
    /// Harmonics of each tip.
    pub tips: Vec<Harmonics>,
}

impl RunAnalysis {
    /// Whether it was made for the classical measurement.
    pub fn is_constant_velocity(&self) -> bool {
        matches!(self.kind, RunKind::ConstantVelocity)
    }
}

impl Sinusoidal {
    /// Phasors as the third-harmonic method wants them; `None` with fewer than three harmonics.
    pub fn phasors(&self) -> Option<RunPhasors> {
        Some(RunPhasors {
            omega_rad_s: self.omega_rad_s,
            command_1: self.command.get(1)?,
            command_3: self.command.get(3)?,
            motor_1: self.motor.get(1)?,
            motor_3: self.motor.get(3)?,
        })
    }
}

/// Looks at run `index` of the campaign; adds what it finds to `findings`.
pub(crate) fn analyse(
    campaign: &Campaign,
    index: usize,
    harmonics: usize,
    dead: &[bool],
    findings: &mut Vec<Finding>,
) -> RunAnalysis {
    let run = &campaign.runs[index];
    // A motor may turn steadily at a constant command: that is no dead channel.
    let mut steady = if range(run.command()) <= 0.0 && run.command()[0].abs() > 0.0 {
        steady_points(campaign, index)
    } else {
        Vec::new()
    };
    let usable = channels(campaign, run, dead, !steady.is_empty(), findings)
        && !repeats(campaign, index, findings);
    at_rest(run, findings);
    let saturated_share = saturation(campaign, run, findings);
    time_base(run, findings);
    let mut analysis = RunAnalysis {
        name: run.name().to_owned(),
        samples: run.len(),
        sample_time_s: run.sample_time_s(),
        kind: RunKind::General,
        saturated_share,
        stuck_share: None,
        usable,
        steady: Vec::new(),
    };
    if !usable {
        if !steady.is_empty() {
            analysis.kind = RunKind::ConstantVelocity;
            analysis.steady = steady;
        }
        return analysis;
    }
    if let Some(found) = sinusoidal(campaign, run, harmonics, findings) {
        let kept = &run.motor()[found.steady.first..];
        let share = dwell_share(kept, found.omega_rad_s, run.sample_time_s());
        if share > STICKING_REPORTED {
            findings.push(
                Finding::new(
                    "sticking",
                    Severity::Warning,
                    &[key::THIRD],
                    format!("the motor sticks for about {:.0} % of the cycle", 100.0 * share),
                    "friction is no square wave there: drive it with a larger amplitude or faster",
                )
                .of(run.name()),
            );
        }
        analysis.stuck_share = Some(share);
        analysis.kind = RunKind::Sinusoidal(Box::new(found));
        return analysis;
    }
    steady = steady_points(campaign, index);
    let one_way = turns_one_way(run);
    let least = if one_way { STEADY_ONE_WAY } else { STEADY_BOTH_WAYS };
    if steady_share(run, &steady, rest_share(run.motor())) > least {
        analysis.kind = RunKind::ConstantVelocity;
    } else if steady.is_empty() && one_way {
        findings.push(no_stretch(run));
    }
    analysis.steady = steady;
    analysis
}

/// Whether the motor moves one way for nearly all of the time in motion, and is in motion for most
/// of the run.
fn turns_one_way(run: &Run) -> bool {
    let sign = slip_sign(run.motor(), run.sample_time_s());
    let count = |s: f64| sign.iter().filter(|x| **x * s > 0.0).count() as f64;
    let (forward, backward) = (count(1.0), count(-1.0));
    let moves = forward + backward;
    forward.max(backward) > ONE_WAY * moves && moves > ONE_WAY_MOVES * run.len() as f64
}

/// Dead and clipped channels; whether motor and command are alive. A constant command of a motor
/// that `turns` steadily is none of them, though no regression can use it.
fn channels(
    campaign: &Campaign,
    run: &Run,
    dead: &[bool],
    turns: bool,
    findings: &mut Vec<Finding>,
) -> bool {
    let alive = |x: &[f64]| range(x) > 0.0;
    let everything = [key::COULOMB, key::VISCOUS, key::INERTIA];
    let mut usable = true;
    for (name, x) in [("motor", run.motor()), ("command", run.command())] {
        if !alive(x) {
            usable = false;
            if turns && name == "command" {
                continue;
            }
            findings.push(
                Finding::new(
                    "dead-channel",
                    Severity::Warning,
                    &everything,
                    format!("the {name} channel is constant at {}: the run is left out", x[0]),
                    "check the wiring and which column the campaign names",
                )
                .of(run.name()),
            );
        }
    }
    for ((tip, x), dead) in campaign.channels.tips.iter().zip(run.tips()).zip(dead) {
        if !alive(x) && !dead {
            usable = false;
            findings.push(
                Finding::new(
                    "dead-channel",
                    Severity::Warning,
                    &[key::COUPLING, key::MODES],
                    format!(
                        "the tip channel {} is constant at {}: the run is left out of the \
                         regression",
                        tip.name, x[0]
                    ),
                    "check the sensor; without it nothing can be said of the beam",
                )
                .of(run.name()),
            );
        }
    }
    findings.extend(sensor_check::findings(campaign, run));
    usable
}

/// Long stands, in which a log says nothing but that friction holds.
fn at_rest(run: &Run, findings: &mut Vec<Finding>) {
    let share = rest_share(run.motor());
    if share > AT_REST_REPORTED {
        findings.push(
            Finding::new(
                "mostly-at-rest",
                Severity::Info,
                &[key::COULOMB, key::VISCOUS, key::INERTIA, key::RAW],
                format!("the motor stands still for {:.0} % of the run", 100.0 * share),
                "a drive that keeps moving (sines, a sweep) tells more in less time",
            )
            .of(run.name()),
        );
    }
}

fn saturation(campaign: &Campaign, run: &Run, findings: &mut Vec<Finding>) -> f64 {
    let (share, known) = match campaign.channels.command.limit {
        Some(limit) => {
            let at = run.command().iter().filter(|u| u.abs() >= AT_LIMIT * limit).count();
            (at as f64 / run.len() as f64, true)
        }
        None => (clipped_share(run.command()), false),
    };
    if share > SATURATION_REPORTED {
        let how = if known { "is at its limit" } else { "stands at its largest value" };
        findings.push(
            Finding::new(
                "saturation",
                Severity::Warning,
                &[key::THIRD, key::CORRECTED],
                format!("the command {how} for {:.1} % of the run", 100.0 * share),
                "its harmonics are then not friction's: less amplitude, or away from the resonance",
            )
            .of(run.name()),
        );
    }
    share
}

fn time_base(run: &Run, findings: &mut Vec<Finding>) {
    let time = run.time();
    if time.jitter_rms_s > JITTER_REPORTED * time.sample_time_s {
        findings.push(
            Finding::new(
                "jitter",
                Severity::Warning,
                &[key::INERTIA, key::VISCOUS, key::RAW],
                format!(
                    "time stamps lie {:.1} % of the sample time off the grid (rms; {:.0} % at most)",
                    100.0 * time.jitter_rms_s / time.sample_time_s,
                    100.0 * time.jitter_max_s / time.sample_time_s
                ),
                "log on the controller's clock; samples are taken as evenly spaced",
            )
            .of(run.name()),
        );
    }
    for note in run.notes() {
        let (code, hint) = match note {
            Note::GapCut { .. } => ("gap", "log without interruption"),
            Note::PieceDropped { .. } => ("piece-dropped", "log without interruption"),
            Note::Thinned { .. } => ("thinned", "log fewer samples, or cut the log into runs"),
            Note::HeadSkipped { .. } => ("head-skipped", ""),
        };
        let message = note.to_string();
        findings.push(Finding::new(code, Severity::Info, &[], message, hint).of(run.name()));
    }
}

/// The run as one sinusoid in steady state, if it is one.
fn sinusoidal(
    campaign: &Campaign,
    run: &Run,
    harmonics: usize,
    findings: &mut Vec<Finding>,
) -> Option<Sinusoidal> {
    let t = run.sample_time_s();
    let omega = match run.omega_rad_s() {
        Some(omega) => omega,
        None => find_frequency(run.motor(), t)?,
    };
    let given = run.omega_rad_s().is_some();
    // A frequency given in Hz, or of another run, shows beside the log's own.
    let own = || {
        let own =
            find_frequency(run.motor(), t).filter(|w| (w / omega - 1.0).abs() > SAME_FREQUENCY);
        own.map_or_else(String::new, |w| {
            format!("; the motor itself moves at {w:.4} rad/s, {:.4} Hz", w / std::f64::consts::TAU)
        })
    };
    let refuse = |findings: &mut Vec<Finding>, code, severity, message: String, hint| {
        let affects = [key::THIRD, key::CORRECTED];
        findings.push(Finding::new(code, severity, &affects, message, hint).of(run.name()));
    };
    let steady = match steady_state(run, omega) {
        Ok(steady) => steady,
        Err(error) => {
            if given {
                let message = format!("driven at {omega:.4} rad/s: {error}{}", own());
                let hint = "log at least six periods in steady state";
                refuse(findings, "too-few-periods", Severity::Warning, message, hint);
            }
            return None;
        }
    };
    let window = steady.first..steady.first + steady.len;
    // Below the Nyquist frequency, and never more unknowns than a period has samples.
    let count = harmonics.min((0.9 * std::f64::consts::PI / (omega * t)) as usize).max(1);
    let fit = |x: &[f64]| least_squares(&x[window.clone()], omega, t, count);
    let motor = fit(run.motor())?;
    let distortion = motor.phasors[1..].iter().map(|p| p.value.norm_sqr()).sum::<f64>().sqrt()
        / motor.phasors[0].value.norm();
    let allowed = if given { SINE_DISTORTION_GIVEN } else { SINE_DISTORTION_FOUND };
    // At rest in all that is kept, neither is a number: no sinusoid either.
    let sinusoid = motor.unexplained() <= SINE_UNEXPLAINED && distortion <= allowed;
    if !sinusoid {
        if given {
            let message = if distortion.is_finite() {
                format!(
                    "not a sinusoid of {omega:.4} rad/s: {:.0} % of the motor's power is left, \
                     harmonics have {:.0} % of the fundamental{}",
                    100.0 * motor.unexplained(),
                    100.0 * distortion,
                    own()
                )
            } else {
                format!("the motor does not move at {omega:.4} rad/s in the periods kept")
            };
            let hint = "check omega_rad_s; the run is used as a motion of any shape";
            refuse(findings, "not-sinusoidal", Severity::Warning, message, hint);
        }
        return None;
    }
    let command = held(fit(run.command())?, campaign.channels.command.hold, t);
    if command.phasors[0].value.norm() <= 0.0 {
        return None;
    }
    let tips: Vec<Harmonics> = run.tips().iter().map(|x| fit(x)).collect::<Option<_>>()?;
    steadiness(run, &steady, findings);
    if 3.0 * omega > 0.9 * std::f64::consts::PI / t {
        let message = format!(
            "the third harmonic, {:.1} rad/s, is not below the Nyquist frequency {:.1} rad/s",
            3.0 * omega,
            std::f64::consts::PI / t
        );
        let hint = "sample faster, or do not use this run as ω0 of a pair";
        refuse(findings, "harmonic-above-nyquist", Severity::Info, message, hint);
    }
    drift(run, &motor, step(run.motor()), findings);
    Some(Sinusoidal { omega_rad_s: omega, omega_given: given, steady, motor, command, tips })
}

fn steadiness(run: &Run, steady: &Steady, findings: &mut Vec<Finding>) {
    let affects = [key::THIRD, key::RAW, key::CORRECTED, key::TIPS];
    if !steady.settled {
        findings.push(
            Finding::new(
                "not-periodic",
                Severity::Warning,
                &affects,
                format!(
                    "not yet periodic: the fundamental changes by {:.1} % (motor), {:.1} % (others) \
                     within the periods kept",
                    100.0 * steady.motor_change,
                    100.0 * steady.other_change
                ),
                "wait longer before logging; a lightly damped mode needs several times 1/(ζω)",
            )
            .of(run.name()),
        );
    }
    if steady.periods < FEW_PERIODS {
        findings.push(
            Finding::new(
                "few-periods",
                Severity::Warning,
                &affects,
                format!("only {} periods in steady state", steady.periods),
                "log ten periods or more: deviations from so few are rough",
            )
            .of(run.name()),
        );
    }
    if steady.dropped > 0 {
        findings.push(
            Finding::new(
                "transient-dropped",
                Severity::Info,
                &[],
                format!("the first {} periods are a transient and left out", steady.dropped),
                "",
            )
            .of(run.name()),
        );
    }
}

fn drift(run: &Run, motor: &Harmonics, quantum: f64, findings: &mut Vec<Finding>) {
    let amplitude = motor.phasors[0].value.norm();
    if motor.drift.abs() > DRIFT_REPORTED * amplitude && motor.drift.abs() > DRIFT_STEPS * quantum {
        findings.push(
            Finding::new(
                "drift",
                Severity::Warning,
                &[key::OFFSET, key::CORRECTED],
                format!(
                    "the motor drifts by {:.0} % of its amplitude over the periods kept",
                    100.0 * motor.drift.abs() / amplitude
                ),
                "a load or an offset of the loop carries it away: close the position loop",
            )
            .of(run.name()),
        );
    }
}

/// Harmonics of the command as it acted: a held one is delayed and damped by its hold.
fn held(mut command: Harmonics, hold: Hold, sample_time_s: f64) -> Harmonics {
    if hold == Hold::Sampled {
        for (k, p) in command.phasors.iter_mut().enumerate() {
            let factor: Complex64 =
                hold_factor((k as f64 + 1.0) * command.omega_rad_s, sample_time_s);
            *p = Phasor { value: p.value * factor, std: p.std * factor.norm() };
        }
    }
    command
}
