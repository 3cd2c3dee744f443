//! Speed of the virtual experiment beside the event finder alone.
//!
//! `cargo bench -p lissom-core --bench rig`. The experiment is 60 s of the report's arm in its loop at
//! 3 ms, 20 000 samples of a sine that sticks; the difference to the event finder goes to standard
//! error. Preparations are in the times.
#![expect(clippy::unwrap_used, reason = "the models are fixed and valid")]
#![expect(clippy::print_stderr, reason = "accuracy beside speed")]

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use lissom::arm::Arm;
use lissom::beam::{LumpedBeam, Span};
use lissom::rig::{HeldArm, HeldMotion, Hybrid, Motion, Quantiser};
use lissom_testmodels::report_arm;

const SAMPLE_TIME_S: f64 = 0.003;
const SAMPLES: usize = 20_000;
const LIMIT_A: f64 = 4.12;

/// The loop by `advance`, which moves on under a torque and gives the motor's angle; what the
/// motor did, at each sample.
fn closed_loop(
    arm: &Arm,
    sensor: Option<Quantiser>,
    mut advance: impl FnMut(f64) -> f64,
) -> Vec<f64> {
    let mut motor = Vec::with_capacity(SAMPLES);
    let (mut before, mut angle) = (0.0, 0.0);
    let (proportional, derivative) = (8.0, 0.2 / SAMPLE_TIME_S);
    for k in 0..SAMPLES {
        let read = sensor.map_or(angle, |s| s.read(angle));
        let error = 0.5 * (3.0 * SAMPLE_TIME_S * k as f64).sin() - read;
        let current =
            (proportional * error + derivative * (error - before)).clamp(-LIMIT_A, LIMIT_A);
        before = error;
        motor.push(angle);
        angle = advance(arm.motor.torque_constant_nm_per_a() * current);
    }
    motor
}

/// The report's motor with `masses` equal masses on the beam's length.
fn arm(masses: usize) -> Arm {
    let report = report_arm();
    let span = report.beam().spans()[0];
    let parts = masses as f64;
    let span = Span { length_m: span.length_m / parts, mass_kg: span.mass_kg / parts, ..span };
    let beam = LumpedBeam::new(&vec![span; masses]).unwrap();
    Arm::new(beam, report.motor, report.coulomb).unwrap()
}

fn by_modes(arm: &Arm, sensor: Option<Quantiser>) -> Vec<f64> {
    let held = HeldArm::new(arm, &[SAMPLE_TIME_S]).unwrap().unwrap();
    let mut motion = HeldMotion::at_rest(&held);
    closed_loop(arm, sensor, |torque| {
        motion.advance(torque, SAMPLE_TIME_S).unwrap();
        motion.motor_angle_rad()
    })
}

fn by_events(arm: &Arm, sensor: Option<Quantiser>) -> Vec<f64> {
    let mut hybrid = Hybrid::at_rest(arm);
    closed_loop(arm, sensor, |torque| {
        hybrid.advance(torque, SAMPLE_TIME_S);
        hybrid.state()[0]
    })
}

fn experiment(c: &mut Criterion) {
    let twelve = Quantiser::new(12, std::f64::consts::TAU).unwrap();
    for (masses, sensor, name) in [
        (1, None, "1 mass, ideal sensors"),
        (1, Some(twelve), "1 mass, 12 bits"),
        (2, None, "2 masses, ideal sensors"),
        (10, None, "10 masses, ideal sensors"),
    ] {
        let arm = arm(masses);
        let apart = by_modes(&arm, sensor)
            .iter()
            .zip(by_events(&arm, sensor))
            .fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
        let mut group = c.benchmark_group(format!("60 s, {name}"));
        eprintln!("60 s, {name}: apart by {apart:.1e} rad");
        group.sample_size(10).measurement_time(Duration::from_secs(2));
        group.bench_function("modes", |b| b.iter(|| black_box(by_modes(&arm, sensor))));
        group.bench_function("events alone (baseline)", |b| {
            b.iter(|| black_box(by_events(&arm, sensor)));
        });
        group.finish();
    }
}

fn growth(c: &mut Criterion) {
    let mut group = c.benchmark_group("60 s by modes");
    group.sample_size(10).measurement_time(Duration::from_secs(2));
    for masses in [1, 2, 5, 10, 20, 40, 80] {
        let arm = arm(masses);
        let held = HeldArm::new(&arm, &[SAMPLE_TIME_S]).unwrap().unwrap();
        let run = || {
            let mut motion = HeldMotion::at_rest(&held);
            closed_loop(&arm, None, |torque| {
                motion.advance(torque, SAMPLE_TIME_S).unwrap();
                motion.motor_angle_rad()
            });
            motion.work()
        };
        eprintln!("{masses} masses: {:?}", run());
        group.bench_function(format!("{masses} masses"), |b| b.iter(|| black_box(run())));
    }
    group.finish();
}

criterion_group!(benches, experiment, growth);
criterion_main!(benches);
