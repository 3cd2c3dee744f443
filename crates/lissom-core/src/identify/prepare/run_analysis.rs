//! The kind of a run, and how it can be used.

use num_complex::Complex64;

use crate::identify::findings::{Channel, EstimateUnits, Finding, rows};
use crate::identify::prepare::channel_check::{clipped_share, dwell_share, rest_share};
use crate::identify::prepare::phases::slip_sign;
use crate::identify::prepare::repeated_run::repeats;
use crate::identify::prepare::run_phasors::RunPhasors;
use crate::identify::prepare::sensor_check;
use crate::identify::prepare::sensor_check::tip_unit;
use crate::identify::prepare::steady_points::{SteadyPoint, steady_points, steady_share};
use crate::identify::prepare::steady_thresholds::{STEADY_BOTH_WAYS, STEADY_ONE_WAY};
use crate::identify::prepare::thresholds::{
    AT_LIMIT, AT_REST_REPORTED, DRIFT_REPORTED, DRIFT_STEPS, FEW_PERIODS, JITTER_REPORTED, ONE_WAY,
    ONE_WAY_MOVES, SAMPLE_TIME_LEAST_S, SAMPLE_TIME_MOST_S, SAMPLE_TIMES_UNLIKE,
    SATURATION_REPORTED, SINE_DISTORTION_FOUND, SINE_DISTORTION_GIVEN, SINE_UNEXPLAINED,
    STICKING_REPORTED,
};
use crate::identify::thresholds::SAME_FREQUENCY;
use crate::record::extent::{range, step};
use crate::record::{Campaign, Hold, Run};
use crate::spectrum::{
    Harmonics, Phasor, Steady, SteadyError, find_frequency, hold_factor, least_squares,
    steady_state,
};

/// Analysis of one run.
#[derive(Debug, Clone)]
pub struct RunAnalysis {
    /// Name of the run.
    pub name: String,
    /// Number of samples.
    pub samples: usize,
    /// Sample time \[s\].
    pub sample_time_s: f64,
    /// Kind of the run.
    pub kind: RunKind,
    /// Share of samples at which the command saturates \[1\].
    pub saturated_share: f64,
    /// Sticking share of the cycle \[1\]; `None` for runs that are not sinusoidal.
    pub stuck_share: Option<f64>,
    /// Whether the regression can use the run.
    pub usable: bool,
    /// Parts at constant velocity; not searched in sinusoidal runs.
    pub steady: Vec<SteadyPoint>,
}

/// Kind of a run.
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
    /// Whether the frequency was given instead of found from the log.
    pub omega_given: bool,
    /// The steady part of the run.
    pub steady: Steady,
    /// Harmonics of the motor.
    pub motor: Harmonics,
    /// Harmonics of the command in the motor: the zero-order hold is taken into account.
    pub command: Harmonics,
    /// Harmonics of each tip.
    pub tips: Vec<Harmonics>,
}

impl RunAnalysis {
    /// Whether the run was made for the constant-velocity method.
    pub fn is_constant_velocity(&self) -> bool {
        matches!(self.kind, RunKind::ConstantVelocity)
    }
}

impl Sinusoidal {
    /// Phasors for the third-harmonic method; `None` with fewer than three harmonics.
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
    let usable = channels(campaign, run, dead, findings) && !repeats(campaign, index, findings);
    at_rest(run, findings);
    let saturated_share = saturation(campaign, run, findings);
    time_base(run, findings);
    findings.extend(unlike_sample_time(campaign, run));
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
        return analysis;
    }
    if let Some(found) = sinusoidal(campaign, run, harmonics, findings) {
        let kept = &run.motor()[found.steady.first..];
        let share = dwell_share(kept, found.omega_rad_s, run.sample_time_s());
        if share > STICKING_REPORTED {
            findings.push(Finding::of_run(run.name(), rows::Sticking { share }));
        }
        analysis.stuck_share = Some(share);
        analysis.kind = RunKind::Sinusoidal(Box::new(found));
        return analysis;
    }
    let steady = steady_points(campaign, index);
    let one_way = turns_one_way(run);
    let least = if one_way { STEADY_ONE_WAY } else { STEADY_BOTH_WAYS };
    if steady_share(run, &steady, rest_share(run.motor())) > least {
        analysis.kind = RunKind::ConstantVelocity;
    } else if steady.is_empty() && one_way {
        let found = rows::NoSteadyVelocity {};
        findings.push(Finding::of_run(run.name(), found));
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

/// Dead and clipped channels; whether motor and command are alive. The constant command of a motor that turns one way,
/// speeds up, coasts or turns steadily, is alive.
fn channels(campaign: &Campaign, run: &Run, dead: &[bool], findings: &mut Vec<Finding>) -> bool {
    let alive = |x: &[f64]| range(x) > 0.0;
    let units = EstimateUnits::new(&campaign.channels);
    let mut usable = true;
    let mut dead_channel = |channel: Channel, x: &[f64], unit: &'static str| {
        let found = rows::DeadChannel { channel, value: x[0], unit };
        findings.push(Finding::of_run(run.name(), found));
    };
    for (channel, x, unit) in [
        (Channel::Motor, run.motor(), units.angle()),
        (Channel::Command, run.command(), units.command()),
    ] {
        if !alive(x) {
            if channel == Channel::Command && alive(run.motor()) && turns_one_way(run) {
                continue;
            }
            usable = false;
            dead_channel(channel, x, unit);
        }
    }
    for ((tip, x), dead) in campaign.channels.tips.iter().zip(run.tips()).zip(dead) {
        if !alive(x) && !dead {
            usable = false;
            dead_channel(Channel::Tip(tip.name.clone()), x, tip_unit(units, tip));
        }
    }
    let readings = sensor_check::findings(campaign, run);
    let left_out =
        |found: &Finding| found.get().is_some_and(|frozen: &rows::FrozenChannel| frozen.left_out);
    usable &= !readings.iter().any(left_out);
    findings.extend(readings);
    usable
}

/// Long stands, in which a log says nothing but that friction holds.
fn at_rest(run: &Run, findings: &mut Vec<Finding>) {
    let share = rest_share(run.motor());
    if share > AT_REST_REPORTED {
        findings.push(Finding::of_run(run.name(), rows::MostlyAtRest { share }));
    }
}

fn saturation(campaign: &Campaign, run: &Run, findings: &mut Vec<Finding>) -> f64 {
    let (share, limit_given) = match campaign.channels.command.limit {
        Some(limit) => {
            let at = run.command().iter().filter(|u| u.abs() >= AT_LIMIT * limit).count();
            (at as f64 / run.len() as f64, true)
        }
        None => (clipped_share(run.command()), false),
    };
    if share > SATURATION_REPORTED {
        let measured = campaign.channels.command.hold == Hold::Measured;
        findings.push(if measured && !limit_given {
            Finding::of_run(run.name(), rows::SensorEnds { share })
        } else {
            Finding::of_run(run.name(), rows::Saturation { share, limit_given })
        });
    }
    share
}

/// Whether a log of a drive may have samples this far apart \[s\].
pub fn is_possible_sample_time(sample_time_s: f64) -> bool {
    (SAMPLE_TIME_LEAST_S..SAMPLE_TIME_MOST_S).contains(&sample_time_s)
}

/// A sample time that is a large multiple of that of the runs in general, or a small part; one that no drive has is
/// reported with the first run.
fn unlike_sample_time(campaign: &Campaign, run: &Run) -> Option<Finding> {
    let mut times: Vec<f64> = campaign.runs.iter().map(Run::sample_time_s).collect();
    times.sort_by(f64::total_cmp);
    let (sample_time_s, median_s) = (run.sample_time_s(), times[(times.len() - 1) / 2]);
    let first = campaign.runs.first().is_some_and(|first| first.name() == run.name());
    if first && !is_possible_sample_time(median_s) {
        return Some(Finding::new(rows::TimeUnit { sample_time_s: median_s }));
    }
    let ratio = sample_time_s / median_s;
    let found = rows::SampleTimeUnlike { sample_time_s, median_s };
    (ratio.max(ratio.recip()) > SAMPLE_TIMES_UNLIKE).then(|| Finding::of_run(run.name(), found))
}

fn time_base(run: &Run, findings: &mut Vec<Finding>) {
    let time = run.time();
    if time.jitter_rms_s > JITTER_REPORTED * time.sample_time_s {
        let found = rows::Jitter {
            rms_share: time.jitter_rms_s / time.sample_time_s,
            max_share: time.jitter_max_s / time.sample_time_s,
        };
        findings.push(Finding::of_run(run.name(), found));
    }
    let notes = run.notes().iter().cloned();
    findings.extend(notes.map(|note| Finding::of_run(run.name(), note)));
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
    let own =
        || find_frequency(run.motor(), t).filter(|w| (w / omega - 1.0).abs() > SAME_FREQUENCY);
    let steady = match steady_state(run, omega) {
        Ok(steady) => steady,
        Err(SteadyError::TooFewPeriods { found, least }) => {
            if given {
                let found = rows::TooFewPeriods {
                    omega_rad_s: omega,
                    blocks: found,
                    blocks_needed: least,
                    own_omega_rad_s: own(),
                };
                findings.push(Finding::of_run(run.name(), found));
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
            let found = rows::NotSinusoidal {
                omega_rad_s: omega,
                unexplained_share: motor.unexplained(),
                harmonics_share: distortion,
                own_omega_rad_s: own(),
            };
            findings.push(Finding::of_run(run.name(), found));
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
        let found = rows::HarmonicAboveNyquist {
            omega_rad_s: 3.0 * omega,
            nyquist_rad_s: std::f64::consts::PI / t,
        };
        findings.push(Finding::of_run(run.name(), found));
    }
    drift(run, &motor, step(run.motor()), findings);
    Some(Sinusoidal { omega_rad_s: omega, omega_given: given, steady, motor, command, tips })
}

fn steadiness(run: &Run, steady: &Steady, findings: &mut Vec<Finding>) {
    let mut add = |found: Finding| findings.push(Finding::of_run(run.name(), found));
    if !steady.settled {
        let (motor_change, other_change) = (steady.motor_change, steady.other_change);
        add(rows::NotPeriodic { motor_change, other_change }.into());
    }
    if steady.periods < FEW_PERIODS {
        add(rows::FewPeriods { periods: steady.periods }.into());
    }
    if steady.dropped > 0 {
        add(rows::TransientDropped { periods: steady.dropped }.into());
    }
}

fn drift(run: &Run, motor: &Harmonics, quantum: f64, findings: &mut Vec<Finding>) {
    let amplitude = motor.phasors[0].value.norm();
    if motor.drift.abs() > DRIFT_REPORTED * amplitude && motor.drift.abs() > DRIFT_STEPS * quantum {
        let share = motor.drift.abs() / amplitude;
        findings.push(Finding::of_run(run.name(), rows::Drift { share }));
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
