//! The classical measurement on logs made by formulas: what comes out, how honest its intervals are,
//! and what is refused.
#![expect(clippy::unwrap_used, reason = "tests")]
#![expect(clippy::print_stdout, reason = "the measured shares are for docs")]

use std::f64::consts::{PI, TAU};

use lissom::identify::findings::rows;
use lissom::identify::{
    ConstantVelocity, Estimate, Finding, LineError, LineShape, Options, Prepared, RunKind,
    Severity, constant_velocity, identify,
};
use lissom::record::{Axis, Campaign, Channels, Command, CommandQuantity, Hold, Run, TimeBase};
use rand_distr::{Distribution as _, StandardNormal};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng as _;

/// Sample time of every log \[s\].
const T: f64 = 0.003;
/// Inertia \[kg·m²\], torque constant \[N·m/A\].
const J: f64 = 6.2e-4;
const K: f64 = 0.2468;
/// Friction forward and backward \[N·m\], viscous \[N·m·s/rad\].
const FORWARD: f64 = 0.0326;
const BACKWARD: f64 = 0.0290;
const V: f64 = 1.4e-3;
/// Time constant of the speed loop \[s\].
const LOOP: f64 = 0.08;
/// Speeds of a staircase \[rad/s\].
const SPEEDS: [f64; 6] = [2.0, 4.0, 6.0, 8.0, 10.0, 12.0];
/// Logs of a statistic. A share of 0.95 is then known to 0.013 (one standard error).
const SEEDS: u64 = 300;

/// What a log has beside the law.
#[derive(Clone, Copy)]
struct Bench {
    /// Time at each speed \[s\].
    hold_s: f64,
    /// White noise of the current \[A\].
    noise_a: f64,
    /// The part of it that a sample keeps from the one before.
    memory: f64,
    /// Beam's oscillation in the current at the beginning \[A\]; 6.5 rad/s, 33 s.
    ringing_a: f64,
    seed: u64,
}

const QUIET: Bench = Bench { hold_s: 3.0, noise_a: 0.01, memory: 0.0, ringing_a: 0.0, seed: 1 };

/// A run that climbs through `speeds`; `friction` is the torque that opposes a velocity.
fn staircase(speeds: &[f64], bench: Bench, friction: impl Fn(f64) -> f64) -> Run {
    let mut rng = Xoshiro256PlusPlus::seed_from_u64(bench.seed);
    let per_step = (bench.hold_s / T) as usize;
    let quantum = TAU / 4096.0;
    let (mut angle, mut velocity, mut coloured) = (0.0_f64, speeds[0], 0.0);
    let (mut current, mut motor) = (Vec::new(), Vec::new());
    for k in 0..per_step * speeds.len() {
        let time = k as f64 * T;
        let acceleration = (speeds[k / per_step] - velocity) / LOOP;
        // What the beam takes from the current it gives to the motor's speed.
        let (sin, cos) = (6.5 * time).sin_cos();
        let ringing = bench.ringing_a * (-time / 33.0).exp();
        let swing = -0.02 * ringing * K / (J * 6.5) * cos;
        let white: f64 = StandardNormal.sample(&mut rng);
        coloured = bench.memory * coloured + (1.0 - bench.memory.powi(2)).sqrt() * white;
        let torque = J * acceleration + friction(velocity + swing);
        current.push(torque / K + ringing * sin + bench.noise_a * coloured);
        motor.push((angle / quantum).round() * quantum);
        velocity += T * acceleration;
        angle += T * (velocity + swing);
    }
    Run::new("stairs", TimeBase::uniform(0.0, T), current, motor, vec![]).unwrap()
}

fn coulomb(velocity: f64) -> f64 {
    V * velocity + if velocity > 0.0 { FORWARD } else { -BACKWARD }
}

fn command() -> Command {
    Command {
        quantity: CommandQuantity::Current,
        hold: Hold::Measured,
        torque_per_command: Some(K),
        back_emf_viscous: 0.0,
        limit: None,
    }
}

fn campaign_of(command: Command, axis: Axis, runs: Vec<Run>) -> Campaign {
    Campaign::new(Channels { axis, command, tips: vec![] }, runs).unwrap()
}

/// Staircases up and down.
fn both(bench: Bench, friction: impl Fn(f64) -> f64) -> Campaign {
    let down = SPEEDS.map(|v| -v);
    let other = Bench { seed: bench.seed + 1_000_000, ..bench };
    let runs = vec![staircase(&SPEEDS, bench, &friction), staircase(&down, other, &friction)];
    campaign_of(command(), Axis::Rotary, runs)
}

fn one(run: Run) -> ConstantVelocity {
    constant_velocity(&Prepared::of(&campaign_of(command(), Axis::Rotary, vec![run])))
}

fn covers(e: Estimate, truth: f64) -> bool {
    (e.ci95()[0]..=e.ci95()[1]).contains(&truth)
}

fn codes(findings: &[Finding]) -> Vec<&'static str> {
    findings.iter().map(Finding::code).collect()
}

#[test]
fn friction_by_direction_comes_out_of_two_staircases() {
    let found = constant_velocity(&Prepared::of(&both(QUIET, coulomb)));
    assert_eq!(found.points.len(), 12);
    let (f, b) = (found.forward.unwrap(), found.backward.unwrap());
    // Within 4 standard errors, and these within 2 % of the estimate.
    for (e, truth) in [(f.coulomb, FORWARD), (b.coulomb, BACKWARD), (f.viscous, V), (b.viscous, V)]
    {
        assert!((e.value - truth).abs() < 4.0 * e.std && e.std < 0.02 * truth, "{e:?} {truth}");
    }
    assert_eq!((f.shape, b.shape), (LineShape::Straight, LineShape::Straight));
    assert!(
        (found.coulomb.unwrap().value - 0.5 * (f.coulomb.value + b.coulomb.value)).abs() < 1e-12
    );
    assert!(
        (found.offset.unwrap().value - 0.5 * (f.coulomb.value - b.coulomb.value)).abs() < 1e-12
    );
    // High speeds and a line to rest: what the slope gains the estimate loses.
    assert!((-1.0..-0.5).contains(&f.correlation));
}

#[test]
fn the_points_are_the_means_of_their_stretches() {
    let found = one(staircase(&SPEEDS, QUIET, coulomb));
    for (k, (p, speed)) in found.points.iter().zip(SPEEDS).enumerate() {
        assert!((p.velocity.value / speed - 1.0).abs() < 1e-3, "{p:?}");
        assert!((p.command.value - coulomb(speed) / K).abs() < 4.0 * p.command.std, "{p:?}");
        let begins = 3.0 * k as f64;
        assert!(p.start_s > begins - 0.1 && p.end_s < begins + 3.1, "{p:?}");
        // The transient is over and three quarters of the step are used.
        assert!(p.end_s - p.start_s > 2.0, "{p:?}");
        // Errors in both variables: the velocity's is below a fiftieth of the command's.
        assert!(V / K * p.velocity.std < 0.02 * p.command.std, "{p:?}");
    }
}

#[test]
fn nothing_but_rounding_is_left_without_noise() {
    let bench = Bench { noise_a: 0.0, ..QUIET };
    let found = constant_velocity(&Prepared::of(&both(bench, coulomb)));
    // What 12 bits and the trimmed transients leave: below 2e-4 of the estimate.
    assert!((found.coulomb.unwrap().value / (0.5 * (FORWARD + BACKWARD)) - 1.0).abs() < 2e-4);
}

/// Share of seeds whose interval holds the truth: Coulomb friction, viscous friction, offset.
fn coverage(bench: Bench) -> [f64; 3] {
    let mut held = [0.0; 3];
    for seed in 0..SEEDS {
        let found = constant_velocity(&Prepared::of(&both(Bench { seed, ..bench }, coulomb)));
        let estimates = [
            (found.coulomb, 0.5 * (FORWARD + BACKWARD)),
            (found.viscous, V),
            (found.offset, 0.5 * (FORWARD - BACKWARD)),
        ];
        for (count, (e, truth)) in held.iter_mut().zip(estimates) {
            *count += f64::from(u8::from(covers(e.unwrap(), truth))) / SEEDS as f64;
        }
    }
    held
}

#[test]
fn intervals_hold_the_truth_as_often_as_they_say() {
    for (name, bench) in [
        ("white", QUIET),
        ("coloured", Bench { memory: 0.9, ..QUIET }),
        ("ringing", Bench { ringing_a: 0.02, hold_s: 10.0, ..QUIET }),
    ] {
        let held = coverage(bench);
        println!("coverage of 95 % intervals, {name}: {held:.3?}");
        // Three standard errors of the share below; above, intervals of no use would pass.
        assert!(held.iter().all(|h| *h > 0.95 - 3.0 * 0.013 && *h < 0.999), "{name}: {held:?}");
    }
}

#[test]
fn straight_data_are_seldom_called_curved() {
    let mut alarms = 0.0;
    for seed in 0..SEEDS {
        let found = constant_velocity(&Prepared::of(&both(Bench { seed, ..QUIET }, coulomb)));
        alarms += found.lines().filter(|(_, l)| l.shape != LineShape::Straight).count() as f64;
    }
    let share = alarms / (2 * SEEDS) as f64;
    println!("false alarms: {:.1} %", 100.0 * share);
    // Two tests at 1 % each; 600 lines give the share to 0.6 %.
    assert!(share < 0.04, "{share}");
}

/// Sub-linear viscous friction on the same Coulomb friction.
fn saturating(velocity: f64) -> f64 {
    let dry = if velocity > 0.0 { FORWARD } else { -BACKWARD };
    dry + velocity.signum() * 0.02 * (1.0 - (-velocity.abs() / 8.0).exp())
}

#[test]
fn sub_linear_friction_is_flagged_as_too_high() {
    for seed in 0..20 {
        let campaign = both(Bench { seed, ..QUIET }, saturating);
        let found = constant_velocity(&Prepared::of(&campaign));
        for (line, truth) in [(found.forward, FORWARD), (found.backward, BACKWARD)] {
            let line = line.unwrap();
            assert!(matches!(line.shape, LineShape::Concave { .. }), "{line:?}");
            let slowest = line.slowest.unwrap();
            assert!(line.coulomb.value > slowest.value && slowest.value > truth, "{line:?}");
            // Both intervals own up to the misfit.
            assert!(covers(line.near_rest(), truth), "{line:?} {truth}");
            assert!(line.coulomb.std > 0.9 * (line.coulomb.value - slowest.value));
        }
    }
    let id = identify(&both(QUIET, saturating), &Options::default(), |_| {}).unwrap();
    let curved = id.findings.iter().find(|f| f.is::<rows::ExtrapolationCurved>()).unwrap();
    assert!(curved.message().contains("is too high"), "{}", curved.message());
    // The estimate taken is that of the slowest speeds.
    let taken = id.friction.forward.unwrap();
    let line = id.constant_velocity.as_ref().unwrap().forward.unwrap();
    assert_eq!(taken, line.near_rest());
    assert!(id.findings.iter().any(Finding::is::<rows::SlowestSpeedsTaken>));
}

#[test]
fn friction_that_falls_or_grows_with_the_square_is_flagged_as_too_low() {
    let drag = |v: f64| coulomb(v) + 2e-4 * v * v.abs();
    let stribeck = |v: f64| coulomb(v) + 0.02 * v.signum() * (-v.abs() / 2.0).exp();
    let laws: [&dyn Fn(f64) -> f64; 2] = [&drag, &stribeck];
    for law in laws {
        let found = constant_velocity(&Prepared::of(&both(QUIET, law)));
        for (_, line) in found.lines() {
            assert!(matches!(line.shape, LineShape::Convex { .. }), "{line:?}");
            assert!(line.slowest.unwrap().value > line.coulomb.value);
        }
    }
}

#[test]
fn scatter_beyond_the_noise_widens_the_interval() {
    // Friction that differs from step to step: a stretch knows nothing of it.
    let uneven = |v: f64| coulomb(v) * (1.0 + 0.03 * (1e3 * v.round()).sin());
    let found = constant_velocity(&Prepared::of(&both(QUIET, uneven)));
    let quiet = constant_velocity(&Prepared::of(&both(QUIET, coulomb)));
    let line = found.forward.unwrap();
    assert!(matches!(line.shape, LineShape::Scattered { rms } if rms > 2.0), "{line:?}");
    assert!(line.coulomb.std > 3.0 * quiet.forward.unwrap().coulomb.std, "{line:?}");
}

#[test]
fn motions_without_a_constant_velocity_give_no_point() {
    let n = 20_000;
    let of = |angle: &dyn Fn(f64) -> f64| {
        let motor: Vec<f64> = (0..n).map(|k| angle(k as f64 * T)).collect();
        let velocity = motor.windows(2).map(|w| (w[1] - w[0]) / T);
        let mut current: Vec<f64> = velocity.map(|v| coulomb(v) / K).collect();
        current.push(0.0);
        Run::new("none", TimeBase::uniform(0.0, T), current, motor, vec![]).unwrap()
    };
    let motions: [(&str, &dyn Fn(f64) -> f64); 6] = [
        ("ramp", &|t| 0.1 * t * t),
        ("braking", &|t| 20.0 * t - 0.1 * t * t),
        ("sine", &|t| (2.0 * t).sin()),
        ("slow sine", &|t| 10.0 * (0.15 * t).sin()),
        ("sweep", &|t| (0.2 * t * t).sin()),
        ("two sines", &|t| (1.1 * t).sin() + 0.7 * (3.7 * t + 1.0).sin()),
    ];
    for (name, angle) in motions {
        let found = one(of(angle));
        assert_eq!(found.points, [], "{name}");
        assert_eq!(found.forward, Err(LineError::NoPoints));
    }
    // Stick and slip: 1 rad/s on average, at rest for half of the time.
    let jerky = |t: f64| t.floor() + 0.5 - 0.5 * (PI * (2.0 * t.fract()).min(1.0)).cos();
    assert_eq!(one(of(&jerky)).points, []);
    let at_rest =
        Run::new("rest", TimeBase::uniform(0.0, T), vec![0.1; 900], vec![2.0; 900], vec![]);
    assert_eq!(one(at_rest.unwrap()).points, []);
}

#[test]
fn a_ramp_is_named_as_such() {
    let motor: Vec<f64> = (0..20_000).map(|k| 0.1 * (k as f64 * T).powi(2)).collect();
    let current: Vec<f64> = (0..20_000).map(|k| coulomb(0.2 * T * (k as f64 + 0.5)) / K).collect();
    let run = Run::new("ramp", TimeBase::uniform(0.0, T), current, motor, vec![]).unwrap();
    let campaign = campaign_of(command(), Axis::Rotary, vec![run]);
    let id = identify(&campaign, &Options::default(), |_| {}).unwrap();
    assert!(codes(&id.findings).contains(&"no-steady-velocity"), "{:?}", id.findings);
    assert!(id.constant_velocity.is_none());
}

#[test]
fn an_angle_that_wraps_every_turn_is_used_turn_by_turn() {
    let run = staircase(&[2.0, 4.0, 6.0], Bench { hold_s: 9.0, ..QUIET }, coulomb);
    let wrapped = run.motor().iter().map(|x| x.rem_euclid(TAU)).collect();
    let run = Run::new("turns", run.time(), run.command().to_vec(), wrapped, vec![]).unwrap();
    let line = one(run).forward.unwrap();
    assert!(line.points > 6 && line.speeds == 3, "{line:?}");
    assert!((line.coulomb.value - FORWARD).abs() < 4.0 * line.coulomb.std, "{line:?}");
}

#[test]
fn lines_are_refused_with_a_reason() {
    let refused = |speeds: &[f64], bench: Bench| one(staircase(speeds, bench, coulomb)).forward;
    assert_eq!(refused(&[5.0], QUIET), Err(LineError::TooFewSpeeds { found: 1 }));
    // 4 % apart: one speed.
    assert_eq!(refused(&[5.0, 5.2], QUIET), Err(LineError::TooFewSpeeds { found: 1 }));
    // An ampere of noise from 18 rad/s on: several times the estimate is left unknown.
    let close = (0..20).filter(|&seed| {
        match refused(&[18.0, 19.0, 20.0], Bench { noise_a: 1.0, seed, ..QUIET }) {
            Err(LineError::TooClose { coulomb, std }) => std > coulomb.abs(),
            Err(error) => panic!("{error}"),
            // What noise made larger than its own deviation is not known to be wrong.
            Ok(line) => line.coulomb.value.abs() < line.coulomb.std,
        }
    });
    let close = close.count();
    assert!((8..20).contains(&close), "{close}");
    let two = refused(&[4.0, 8.0], QUIET).unwrap();
    assert_eq!((two.shape, two.slowest), (LineShape::Unchecked, None));
}

#[test]
fn a_campaign_of_constant_velocities_alone_gives_a_clear_result() {
    let id = identify(&both(QUIET, coulomb), &Options::default(), |_| {}).unwrap();
    assert!(id.runs.iter().all(|r| matches!(r.kind, RunKind::ConstantVelocity)));
    assert_eq!(
        codes(&id.findings),
        ["constant-velocity-only", "offset", "constant-velocity-estimates"]
    );
    assert_eq!(id.findings[0].severity(), Severity::Refusal);
    assert!(id.regression.is_none() && id.third_harmonic.is_none() && id.responses.is_empty());
    let classical = id.constant_velocity.unwrap();
    assert_eq!(id.friction.coulomb, classical.coulomb);
    assert_eq!(id.friction.viscous, classical.viscous);
    assert!(id.inertia.is_none());
}

#[test]
fn what_is_missing_of_a_campaign_of_constant_velocities_is_said() {
    let found = |runs: Vec<Run>| {
        let campaign = campaign_of(command(), Axis::Rotary, runs);
        identify(&campaign, &Options::default(), |_| {}).unwrap()
    };
    let up = || staircase(&SPEEDS, QUIET, coulomb);
    let id = found(vec![up()]);
    assert!(id.findings.iter().any(Finding::is::<rows::OneDirection>));
    assert!(id.friction.coulomb.is_none() && id.friction.viscous.is_some());
    let id = found(vec![up(), staircase(&[-5.0], QUIET, coulomb)]);
    assert!(id.findings.iter().any(Finding::is::<rows::TooFewSpeeds>));
    let id = found(vec![up(), staircase(&[-4.0, -8.0], QUIET, coulomb)]);
    assert!(id.findings.iter().any(Finding::is::<rows::TwoSpeeds>));
    assert!(id.friction.coulomb.is_some());
    let close = (0..20).any(|seed| {
        let noisy = Bench { noise_a: 1.0, seed, ..QUIET };
        let id = found(vec![up(), staircase(&[-18.0, -19.0, -20.0], noisy, coulomb)]);
        let is_refused = id.findings.iter().any(Finding::is::<rows::SpeedsTooClose>);
        is_refused && id.friction.coulomb.is_none()
    });
    assert!(close);
}

/// A sine of 2 rad at `omega_rad_s` under [`coulomb`] friction.
fn sine(omega_rad_s: f64) -> Run {
    let time = |k: i32| f64::from(k) * T;
    let motor = (0..8000).map(|k| 2.0 * (omega_rad_s * time(k)).sin()).collect();
    let current = (0..8000)
        .map(|k| {
            let (sin, cos) = (omega_rad_s * time(k)).sin_cos();
            let velocity = 2.0 * omega_rad_s * cos;
            (coulomb(velocity) - 2.0 * J * omega_rad_s.powi(2) * sin) / K
        })
        .collect();
    Run::new("sine", TimeBase::uniform(0.0, T), current, motor, vec![]).unwrap()
}

#[test]
fn other_methods_do_not_see_the_runs() {
    let sines = || [1.0, 3.0, 2.0, 6.0].map(sine).to_vec();
    let found = |runs| {
        let campaign = campaign_of(command(), Axis::Rotary, runs);
        identify(&campaign, &Options::default(), |_| {}).unwrap()
    };
    let without = found(sines());
    let mut runs = sines();
    runs.extend(both(QUIET, |v| 2.0 * saturating(v) - V * v).runs);
    let with = found(runs);
    assert_eq!(with.friction, without.friction);
    assert_eq!(with.inertia, without.inertia);
    assert_eq!(with.regression, without.regression);
    let third =
        |id: &lissom::identify::Identified| id.third_harmonic.as_ref().unwrap().coulomb_command;
    assert_eq!(third(&with), third(&without));
    assert_eq!(with.responses.len(), without.responses.len());
    assert!(without.constant_velocity.is_none() && with.constant_velocity.is_some());
    assert!(codes(&with.findings).contains(&"methods-disagree"));
}

#[test]
fn a_motor_at_a_constant_voltage_is_no_dead_channel() {
    // Open loop: the voltage is exact and the speed follows from it; 0.4 N·m/V, back-EMF 0.01.
    let (per_volt, back_emf) = (0.4, 0.01);
    let run = |volts: f64| {
        let velocity = (per_volt * volts - volts.signum() * FORWARD) / (V + back_emf);
        let mut rng = Xoshiro256PlusPlus::seed_from_u64(volts.to_bits());
        let motor = (0..2000).map(|k| {
            let noise: f64 = StandardNormal.sample(&mut rng);
            velocity * f64::from(k) * T + 1e-3 * noise
        });
        let motor: Vec<f64> = motor.collect();
        Run::new("volts", TimeBase::uniform(0.0, T), vec![volts; 2000], motor, vec![]).unwrap()
    };
    let command = Command {
        quantity: CommandQuantity::Voltage,
        hold: Hold::Sampled,
        torque_per_command: Some(per_volt),
        back_emf_viscous: back_emf,
        limit: None,
    };
    let runs = [-0.4, -0.3, -0.2, 0.2, 0.3, 0.4].map(run).to_vec();
    let campaign = campaign_of(command, Axis::Rotary, runs);
    let id = identify(&campaign, &Options::default(), |_| {}).unwrap();
    assert!(!codes(&id.findings).contains(&"dead-channel"), "{:?}", codes(&id.findings));
    let (c, v) = (id.friction.coulomb.unwrap(), id.friction.viscous.unwrap());
    assert!((c.value - FORWARD).abs() < 4.0 * c.std && c.std < 1e-3 * FORWARD, "{c:?}");
    assert!((v.value - V).abs() < 4.0 * v.std && v.std < 0.01 * V, "{v:?}");
}

#[test]
fn linear_axes_and_unknown_torque_constants_have_their_own_units() {
    let runs = both(QUIET, coulomb).runs;
    let per_command = Command { torque_per_command: None, ..command() };
    let found =
        constant_velocity(&Prepared::of(&campaign_of(per_command, Axis::Rotary, runs.clone())));
    let torque = constant_velocity(&Prepared::of(&campaign_of(command(), Axis::Linear, runs)));
    let (a, n) = (found.coulomb.unwrap(), torque.coulomb.unwrap());
    assert!((a.value * K / n.value - 1.0).abs() < 1e-9 && (a.std * K / n.std - 1.0).abs() < 1e-9);
}

#[test]
fn a_negative_torque_constant_turns_the_directions_about() {
    // The command's sign against the motor's: friction comes out negative and is refused.
    let reversed = Command { torque_per_command: Some(-K), ..command() };
    let campaign = campaign_of(reversed, Axis::Rotary, both(QUIET, coulomb).runs);
    let id = identify(&campaign, &Options::default(), |_| {}).unwrap();
    assert!(id.friction.coulomb.is_none());
    assert!(codes(&id.findings).contains(&"negative-estimate"));
}

#[test]
fn ringing_does_not_move_the_figure() {
    // 15 % of the Coulomb current; a step of 10 s holds ten periods.
    let bench = Bench { ringing_a: 0.02, hold_s: 10.0, noise_a: 0.001, ..QUIET };
    let found = constant_velocity(&Prepared::of(&both(bench, coulomb)));
    assert_eq!(found.points.len(), 12);
    let c = found.coulomb.unwrap();
    assert!((c.value / (0.5 * (FORWARD + BACKWARD)) - 1.0).abs() < 2e-3, "{c:?}");
}
