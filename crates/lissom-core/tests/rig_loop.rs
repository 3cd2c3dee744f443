//! The sampled loop: its instruments in place, what it finds and what it refuses.
#![expect(clippy::unwrap_used, reason = "tests")]

use std::f64::consts::TAU;

use lissom::arm::Arm;
use lissom::beam::{LumpedBeam, Span};
use lissom::drive::{Coulomb, Motor};
use lissom::rig::{
    Amplifier, Controller, Delay, Drive, Experiment, Hybrid, IntegerPd, Logged, Multisine, Noise,
    Pd, Quantiser, Reference, Rig, RigError, RigFinding, Sensed, Sensor, SensorPlace, Settle,
    Start, Table, TableHold, Word,
};
use lissom_testmodels::{report_arm, report_rig};

/// Two ways to the same motion differ by rounding, which a loop that sticks does not magnify \[rad\].
const ROUNDING_RAD: f64 = 1e-11;

fn wait(experiment: Experiment, wait_s: f64) -> Experiment {
    experiment.settling(Settle::Wait { wait_s })
}

fn sine() -> Experiment {
    wait(Experiment::sine(3.0, 0.5, 3.0).unwrap(), 1.5)
}

fn current(reference: Reference, record_s: f64) -> Experiment {
    Experiment::new(Drive::Current(reference), record_s).unwrap().settling(Settle::AtOnce)
}

#[track_caller]
fn near(a: &[f64], b: &[f64], tolerance: f64) {
    assert_eq!(a.len(), b.len());
    for (k, (a, b)) in a.iter().zip(b).enumerate() {
        assert!((a - b).abs() <= tolerance, "row {k}: {a}, {b}");
    }
}

fn same(a: &Logged, b: &Logged) -> bool {
    a.run.command() == b.run.command()
        && a.run.motor() == b.run.motor()
        && a.run.tips() == b.run.tips()
}

/// What the loop is, once more: PD, limit, delay and dead zone by hand around the event finder.
fn by_hand(delay_s: f64, dead_a: f64, samples: usize) -> [Vec<f64>; 3] {
    let (arm, t) = (report_arm(), 0.003);
    let mut motion = Hybrid::at_rest(&arm);
    let (whole, part) = ((delay_s / t).floor() as usize, delay_s % t);
    let mut commands: Vec<f64> = Vec::new();
    let [mut motor, mut tip] = [Vec::new(), Vec::new()];
    let mut before = None;
    for k in 0..samples {
        let reference = 0.5 * (3.0 * k as f64 * t).sin();
        let error = reference - motion.state()[0];
        let demand = 8.0 * error + 0.2 * (error - before.unwrap_or(error)) / t;
        before = Some(error);
        motor.push(motion.state()[0]);
        tip.push(motion.state()[2]);
        commands.push(demand.clamp(-4.12, 4.12));
        let late = |n: usize| k.checked_sub(n).map_or(0.0, |k| commands[k]);
        for (u, duration) in [(late(whole + 1), part), (late(whole), t - part)] {
            let i = if u.abs() <= dead_a { 0.0 } else { u - dead_a * u.signum() };
            motion.advance(arm.motor.torque_constant_nm_per_a() * i, duration);
        }
    }
    [commands, motor, tip]
}

#[test]
fn delays_of_any_length_split_the_sample() {
    for delay_s in [0.0, 0.0011, 0.0075] {
        let mut rig = report_rig(None);
        rig.instruments.delay = Some(Delay::new(delay_s).unwrap());
        rig.instruments.amplifier = rig.instruments.amplifier.with_dead_band(0.05).unwrap();
        let found = rig.run("delayed", &sine(), 0).unwrap();
        let hand = by_hand(delay_s, 0.05, 1500);
        // 0.2 A·s/rad over 3 ms magnifies the angles' rounding.
        near(found.run.command(), &hand[0][500..], 1e-9);
        near(found.run.motor(), &hand[1][500..], ROUNDING_RAD);
        near(&found.run.tips()[0], &hand[2][500..], ROUNDING_RAD);
    }
}

/// Gives another's demand so many actions later.
struct Late<C> {
    inner: C,
    waiting: std::collections::VecDeque<f64>,
    by: usize,
}

impl<C: Controller> Controller for Late<C> {
    fn current_a(&mut self, now: &Sensed<'_>) -> f64 {
        self.waiting.push_back(self.inner.current_a(now));
        self.waiting.pop_front().unwrap_or(0.0)
    }
    fn reset(&mut self) {
        self.inner.reset();
        self.waiting = vec![0.0; self.by].into();
    }
}

#[test]
fn a_delay_of_whole_samples_is_a_controller_that_answers_late() {
    let rig = report_rig(Some(12));
    let mut late =
        Late { inner: rig.controller.clone(), waiting: std::collections::VecDeque::new(), by: 2 };
    let shifted = rig.run_with(&mut late, "late", &sine(), 0).unwrap();
    let mut delayed = rig.clone();
    delayed.instruments.delay = Some(Delay::new(2.0 * 0.003).unwrap());
    let delayed = delayed.run("delay", &sine(), 0).unwrap();
    assert_eq!(shifted.run.motor(), delayed.run.motor());
    assert_eq!(shifted.run.tips(), delayed.run.tips());
    // The log holds what the controller said, not what acts.
    assert_eq!(shifted.run.command()[2..], delayed.run.command()[..998]);
}

#[test]
fn a_slow_controller_on_fast_instruments_is_the_slow_loop() {
    let slow = report_rig(None);
    let mut fast = slow.clone();
    fast.instruments.sample_time_s = 0.003 / 4.0;
    (fast.instruments.control_every, fast.instruments.log_every) = (4, 4);
    let (a, b) = (slow.run("3 ms", &sine(), 0).unwrap(), fast.run("0.75 ms", &sine(), 0).unwrap());
    near(a.run.motor(), b.run.motor(), ROUNDING_RAD);
    near(&a.run.tips()[0], &b.run.tips()[0], ROUNDING_RAD);
    assert_eq!(a.run.time(), b.run.time());
    assert!(b.findings.is_empty());
    // Every sample logged: each fourth row is the slow log's, the current held between.
    fast.instruments.log_every = 1;
    let all = fast.run("all", &sine(), 0).unwrap().run;
    assert_eq!(all.len(), 4000);
    let fourth: Vec<f64> = all.motor().iter().step_by(4).copied().collect();
    assert_eq!(fourth, b.run.motor());
    assert!(all.command().chunks(4).all(|held| held == [held[0]; 4]));
    // Logged more seldom than controlled: said.
    fast.instruments.log_every = 8;
    let seldom = fast.run("seldom", &sine(), 0).unwrap();
    assert_eq!(
        seldom.findings,
        [RigFinding::CurrentBetweenSamples { control_every: 4, log_every: 8 }]
    );
}

#[test]
fn the_integer_loop_follows_within_its_steps() {
    let mut rig = report_rig(Some(12));
    let (adc, dac) = (Quantiser::new(12, TAU).unwrap(), Quantiser::new(12, 10.0).unwrap());
    rig.instruments.amplifier = rig.instruments.amplifier.with_converter(dac);
    let real = rig.run("real", &sine(), 0).unwrap().run;
    let pd = Pd::new(8.0, 0.2).unwrap();
    rig.controller = IntegerPd::new(&pd, 0.003, adc, dac, Word::Long, 4).unwrap().into();
    let integer = rig.run("integer", &sine(), 0).unwrap().run;
    for i in integer.command() {
        let counts = i / dac.step();
        assert!((counts - counts.round()).abs() < 1e-9 || (i.abs() - 4.12).abs() < 1e-12, "{i}");
    }
    assert_ne!(integer.motor(), real.motor());
    // Both follow alike: a few A/D steps apart.
    near(integer.motor(), real.motor(), 6.0 * adc.step());
}

/// A motor that holds still behind a noisy sensor: the log is the noise.
fn noisy(tip_std: Option<f64>, seed: u64) -> Logged {
    let mut rig = report_rig(None);
    rig.instruments.motor = Noise::new(1e-3).unwrap().into();
    rig.instruments.tips = tip_std.map(|s| Noise::new(s).unwrap().into()).into_iter().collect();
    rig.run("still", &current(Reference::hold(0.0).unwrap(), 60.0), seed).unwrap()
}

#[test]
fn noise_is_the_seeds_and_each_sensors_own() {
    let run = noisy(Some(2e-3), 5).run;
    assert_eq!(run.len(), 20_000);
    let std = |x: &[f64]| (x.iter().map(|v| v * v).sum::<f64>() / x.len() as f64).sqrt();
    // Four standard deviations of a standard deviation from 20 000 draws: 4/√40 000 = 2 %.
    assert!((std(run.motor()) / 1e-3 - 1.0).abs() < 0.02);
    assert!((std(&run.tips()[0]) / 2e-3 - 1.0).abs() < 0.02);
    let product: f64 = run.motor().iter().zip(&run.tips()[0]).map(|(a, b)| a * b).sum();
    assert!((product / 20_000.0 / 2e-6).abs() < 4.0 / 20_000_f64.sqrt());
    // The tip's noise off: the motor's stays to the bit.
    assert_eq!(noisy(None, 5).run.motor(), run.motor());
    assert_eq!(noisy(None, 5).run.tips()[0], vec![0.0; 20_000]);
    assert_ne!(noisy(None, 6).run.motor(), run.motor());
}

#[test]
fn a_seed_gives_the_same_bits() {
    let mut rig = report_rig(Some(12));
    rig.instruments.motor.noise = Some(Noise::new(1e-3).unwrap());
    let detected = Experiment::sine(3.0, 0.5, 3.0).unwrap();
    let run = |seed| rig.run("noisy", &detected, seed).unwrap();
    assert!(same(&run(1), &run(1)));
    assert!(!same(&run(1), &run(2)));
}

#[test]
fn a_release_rings_at_the_clamped_beams_frequency() {
    let base = report_arm();
    let firm = Coulomb::symmetric(10.0).unwrap();
    let arm = Arm::new(base.beam().clone(), base.motor, firm).unwrap();
    let rig = Rig { arm, ..report_rig(None) };
    let release = current(Reference::hold(0.0).unwrap(), 20.0)
        .starting(Start::Deflected { tip_force_n: 0.05 });
    let logged = rig.run("release", &release, 0).unwrap();
    // θ = F·L²/(3·EI)·e^{−0.03·t}·(cos ωt + 0.03/ω·sin ωt), ω² = ω1² − 0.03².
    let span = rig.arm.beam().spans()[0];
    let start = 0.05 * span.length_m.powi(2) / (3.0 * span.flexural_rigidity_n_m2);
    let omega = (rig.arm.beam().natural_frequencies_rad_s()[0].powi(2) - 9e-4).sqrt();
    let expected: Vec<f64> = (0..logged.run.len())
        .map(|k| {
            let x = omega * k as f64 * 0.003;
            start * (-0.03 * x / omega).exp() * (x.cos() + 0.03 / omega * x.sin())
        })
        .collect();
    near(&logged.run.tips()[0], &expected, ROUNDING_RAD);
    assert!((logged.stuck_share - 1.0).abs() < 1e-9);
    let [RigFinding::NeverMoved { torque_nm, coulomb_nm }] = logged.findings[..] else {
        panic!("{:?}", logged.findings)
    };
    assert!(torque_nm.abs() < f64::MIN_POSITIVE && (coulomb_nm - 10.0).abs() < 1e-12);
}

#[test]
fn constant_velocity_needs_the_friction_at_it() {
    let rig = report_rig(None);
    let motor = rig.arm.motor;
    for velocity in [2.0, -5.0] {
        let ramp =
            Experiment::new(Drive::Angle(Reference::ramp(velocity).unwrap()), 300.0).unwrap();
        let logged = rig.run("ramp", &ramp, 0).unwrap();
        assert!(logged.settled.waited_s.abs() < f64::MIN_POSITIVE && logged.findings.is_empty());
        let run = logged.run;
        assert!(run.time().start_s.abs() < f64::MIN_POSITIVE);
        // The air table's damper turns with the arm: 0.06·m·L² more of V.
        let span = rig.arm.beam().spans()[0];
        let table = span.damping_n_s_per_m * span.length_m.powi(2);
        let torque = rig.arm.coulomb.forward().copysign(velocity)
            + (motor.viscous_nm_s_per_rad() + table) * velocity;
        let current = torque / motor.torque_constant_nm_per_a();
        let found = run.command().last().unwrap();
        // What is left of the start: e^{−300·0.03} of it, and less in the loop.
        assert!((found / current - 1.0).abs() < 1e-4, "{found}, {current}");
    }
}

#[test]
fn a_table_begins_where_it_says() {
    let rig = report_rig(None);
    let table = Table::new(vec![0.0, 1.0, 2.0], vec![0.3, 0.3, 0.0], TableHold::Linear).unwrap();
    let moved = Experiment::new(Drive::Angle(Reference::Table(table)), 3.0).unwrap();
    let logged = rig.run("table", &moved, 0).unwrap();
    // The loop has gone to 0.3 rad and waited there; the log's clock begins with the table.
    assert!(logged.settled.waited_s > 1.0 && logged.findings.is_empty(), "{:?}", logged.settled);
    assert!(logged.run.time().start_s.abs() < f64::MIN_POSITIVE);
    let motor = logged.run.motor();
    // A PD leaves the friction's share of its error: CF/K/k_p = 17 mrad.
    assert!((motor[0] - 0.3).abs() < 0.017 && (motor[300] - motor[0]).abs() < 1e-4);
    assert!(motor[999].abs() < 0.017);
}

#[test]
fn a_multisine_drives_the_open_motor() {
    let rig = report_rig(None);
    let wave = Multisine::odd(1.0, 15.0, 1.0, 3).unwrap().with_crest(1.7).unwrap();
    let period = TAU;
    let open = Experiment::new(Drive::Current(Reference::Multisine(wave.clone())), period).unwrap();
    let logged = rig.run("open", &open, 0).unwrap();
    assert!(logged.findings.is_empty(), "{:?}", logged.findings);
    let start = logged.run.time().start_s;
    for (k, i) in logged.run.command().iter().enumerate() {
        assert!((i - wave.value(start + k as f64 * 0.003)).abs() < 1e-9);
    }
}

#[test]
fn a_limit_below_what_the_reference_needs_is_said() {
    let mut rig = report_rig(None);
    rig.instruments.amplifier = Amplifier::ideal().with_limit(0.3).unwrap();
    let fast = wait(Experiment::sine(25.0, 0.5, 3.0).unwrap(), 3.0);
    let logged = rig.run("limited", &fast, 0).unwrap();
    let [ref found @ RigFinding::CurrentLimited { share, limit_a, reached: Some(reached) }] =
        logged.findings[..]
    else {
        panic!("{:?}", logged.findings)
    };
    let at_limit = logged.run.command().iter().filter(|i| i.abs() >= 0.3).count();
    let expected = at_limit as f64 / 1000.0;
    assert!((share - expected).abs() < 1e-12 && share > 0.5, "{share}, {expected}");
    assert!((limit_a - 0.3).abs() < f64::EPSILON);
    let motor = logged.run.motor();
    let range = motor.iter().fold(f64::MIN, |m, v| m.max(*v))
        - motor.iter().fold(f64::MAX, |m, v| m.min(*v));
    // The reference's own extremes lie within 25·1.5 mrad of a sample: 7e-4 of its range.
    assert!((reached - range).abs() < 7e-4 && reached < 0.5, "{reached}");
    assert!(found.to_string().contains("of the requested amplitude"), "{found}");
}

#[test]
fn friction_that_never_gives_way_is_said() {
    let base = report_arm();
    let arm = Arm::new(base.beam().clone(), base.motor, Coulomb::by_direction(2.0, 1.5).unwrap());
    let rig = Rig { arm: arm.unwrap(), ..report_rig(None) };
    let logged = rig.run("stuck", &sine(), 0).unwrap();
    let RigFinding::NeverMoved { torque_nm, coulomb_nm } = logged.findings[0] else {
        panic!("{:?}", logged.findings)
    };
    // 0.5 rad·8 A/rad and the derivative's 0.3, in step: at most the limit.
    let constant = rig.arm.motor.torque_constant_nm_per_a();
    assert!(torque_nm < 1.5 && torque_nm > 4.0 * constant && (coulomb_nm - 1.5).abs() < 1e-12);
    assert!((logged.stuck_share - 1.0).abs() < 1e-9);
    assert!(logged.findings[0].to_string().starts_with("the joint never moved"));
}

#[test]
fn a_command_within_the_dead_zone_moves_nothing() {
    let base = report_arm();
    let arm = Arm::new(base.beam().clone(), base.motor, Coulomb::symmetric(0.0).unwrap()).unwrap();
    let mut rig = Rig { arm, ..report_rig(None) };
    rig.instruments.amplifier = Amplifier::ideal().with_dead_band(0.2).unwrap();
    let push = |value| rig.run("push", &current(Reference::hold(value).unwrap(), 1.0), 0).unwrap();
    let still = push(0.2);
    assert!(matches!(still.findings[..], [RigFinding::NeverMoved { .. }]));
    assert!(still.run.command().iter().all(|i| (i - 0.2).abs() < f64::EPSILON));
    assert!(push(0.21).findings.is_empty());
}

#[test]
fn a_sensor_beyond_its_range_is_said() {
    let mut rig = report_rig(None);
    rig.instruments.tips = vec![Sensor::from(Quantiser::new(12, 0.8).unwrap())];
    let logged = rig.run("narrow", &sine(), 0).unwrap();
    let [ref found @ RigFinding::SensorRange { sensor, share, range_rad }] = logged.findings[..]
    else {
        panic!("{:?}", logged.findings)
    };
    assert_eq!(sensor, SensorPlace::Tip(0));
    assert!((range_rad.0 + 0.4).abs() < 1e-12 && (range_rad.1 - 0.4 + 0.8 / 4096.0).abs() < 1e-12);
    let top = range_rad.1 - 1e-12;
    let at_end = logged.run.tips()[0].iter().filter(|q| **q > top || **q < -0.4 + 1e-12).count();
    // A sample may read the end without having been cut off.
    assert!(
        share > 0.1 && share * 1000.0 <= at_end as f64 && share * 1000.0 > at_end as f64 - 10.0
    );
    assert!(found.to_string().starts_with("the tip 1 sensor was beyond its range"));
    assert_eq!(SensorPlace::Motor.to_string(), "motor");
}

/// Gives a number from a time on.
struct From(f64, f64);

impl Controller for From {
    fn current_a(&mut self, now: &Sensed<'_>) -> f64 {
        if now.time_s < self.0 - 1e-9 { 0.0 } else { self.1 }
    }
    fn reset(&mut self) {}
}

#[test]
fn nan_and_infinity_from_a_controller_end_the_run() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let error =
            report_rig(None).run_with(&mut From(0.6, bad), "bad", &sine(), 0).err().unwrap();
        let RigError::Controller { found, time_s } = error else { panic!("{error}") };
        assert!((time_s - 0.6).abs() < 1e-9 && found.to_bits() == bad.to_bits());
    }
    // A boxed one serves as well.
    let mut boxed: Box<dyn Controller> = Box::new(From(0.0, 0.0));
    assert!(report_rig(None).run_with(boxed.as_mut(), "still", &sine(), 0).is_ok());
}

#[test]
fn an_unstable_loop_is_said_with_time_and_bound() {
    let mut rig = report_rig(None);
    rig.instruments.amplifier = Amplifier::ideal();
    rig.instruments.delay = Some(Delay::new(0.05).unwrap());
    let error = rig.run("unstable", &sine(), 0).err().unwrap();
    let RigError::Unstable { angle_rad, bound_rad, time_s, state } = error else {
        panic!("{error}")
    };
    assert!((bound_rad - 2.5).abs() < 1e-12 && angle_rad.abs() > 2.5 && angle_rad.abs() < 25.0);
    assert!(time_s > 0.05 && time_s < 4.5);
    assert_eq!((state.len(), state[0].to_bits()), (4, angle_rad.to_bits()));
    // Small amplitudes and coarse sensors have a bound that a loop may hunt within.
    rig.instruments.motor = Quantiser::encoder(16).unwrap().into();
    let small = wait(Experiment::sine(3.0, 1e-3, 300.0).unwrap(), 0.0);
    let error = rig.run_with(&mut From(0.0, 5.0), "coarse", &small, 0).err().unwrap();
    let RigError::Unstable { bound_rad, .. } = error else { panic!("{error}") };
    assert!((bound_rad - 50.0 * TAU / 16.0).abs() < 1e-9);
}

#[test]
fn what_cannot_be_run_is_refused() {
    let rig = report_rig(None);
    for sample_time_s in [0.0, -0.003, f64::NAN, f64::INFINITY] {
        let mut rig = rig.clone();
        rig.instruments.sample_time_s = sample_time_s;
        let error = rig.run("bad", &sine(), 0).err().unwrap();
        assert!(matches!(error, RigError::NotPositive { quantity: "sample_time_s", .. }));
    }
    let mut three = rig.clone();
    three.instruments.tips = vec![Sensor::IDEAL; 3];
    let error = three.run("bad", &sine(), 0).err().unwrap();
    assert_eq!(error, RigError::SensorCount { found: 3, masses: 1 });
    let long = |e: Experiment| rig.run("long", &e, 0).err().unwrap().to_string();
    assert_eq!(
        long(Experiment::sine(1.0, 1.0, 3e6).unwrap()),
        "record_s takes 1000000000 samples, but at most 100000000 are simulated"
    );
    assert!(long(wait(sine(), 3e6)).starts_with("wait_s takes 1000000000 samples"));
    let forever = Settle::Detected { tolerance: 1e-4, longest_s: 3e6 };
    assert!(long(sine().settling(forever)).starts_with("longest_s takes 1000000000"));
    let mut late = rig.clone();
    late.instruments.delay = Some(Delay::new(1e6).unwrap());
    assert!(matches!(late.run("late", &sine(), 0), Err(RigError::TooLong { .. })));
    let fast = Experiment::sine(1100.0, 0.1, 1.0).unwrap();
    let error = rig.run("fast", &fast, 0).err().unwrap();
    assert!(matches!(error, RigError::AboveNyquist { omega_rad_s: 1100.0, .. }), "{error}");
    let mut seldom = rig.clone();
    seldom.instruments.control_every = 100;
    let fast = Experiment::sine(11.0, 0.1, 1.0).unwrap();
    assert!(matches!(seldom.run("fast", &fast, 0), Err(RigError::AboveNyquist { .. })));
    // The loop can carry it, the log cannot.
    let mut thin = rig.clone();
    thin.instruments.log_every = 100;
    let fast = wait(Experiment::sine(11.0, 0.1, 3.0).unwrap(), 0.0);
    assert!(matches!(thin.run("thin", &fast, 0), Err(RigError::Record(_))));
    let mut changed = sine();
    changed.record_s = f64::NAN;
    let error = rig.run("bad", &changed, 0).err().unwrap();
    assert!(matches!(error, RigError::NotPositive { quantity: "record_s", .. }));
}

/// The arm of two masses, for sensors of their own.
#[test]
fn each_mass_has_its_sensor() {
    let span = |length_m| Span {
        length_m,
        flexural_rigidity_n_m2: 0.02,
        mass_kg: 0.05,
        damping_n_s_per_m: 1e-3,
    };
    let beam = LumpedBeam::new(&[span(0.15), span(0.15)]).unwrap();
    let motor = Motor::new(8e-4, 2e-3, 0.3).unwrap();
    let arm = Arm::new(beam, motor, Coulomb::symmetric(0.05).unwrap()).unwrap();
    let mut rig = Rig { arm, ..report_rig(None) };
    let ideal = rig.run("ideal", &sine(), 0).unwrap().run;
    let coarse = Quantiser::new(6, TAU).unwrap();
    rig.instruments.tips = vec![Sensor::IDEAL, coarse.into()];
    let mixed = rig.run("mixed", &sine(), 0).unwrap().run;
    assert_eq!(ideal.tips()[0], mixed.tips()[0]);
    let read: Vec<f64> = ideal.tips()[1].iter().map(|q| coarse.read(*q)).collect();
    assert_eq!(read, mixed.tips()[1]);
}
