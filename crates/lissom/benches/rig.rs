//! Speed of the virtual experiment beside the event finder alone.
//!
//! `cargo bench -p lissom --bench rig`. The experiment is 60 s of the report's arm in its loop at
//! 3 ms, 20 000 samples of a sine that sticks; the difference of both ways goes to standard error.
#![expect(clippy::unwrap_used, reason = "the models are fixed and valid")]
#![expect(clippy::print_stderr, reason = "accuracy beside speed")]

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use lissom::arm::Arm;
use lissom::beam::{LumpedBeam, Span};
use lissom::rig::{Controller, HeldStep, Hybrid, Pd, Quantiser, Sensed};
use lissom_testmodels::report_arm;

const SAMPLE_TIME_S: f64 = 0.003;
const SAMPLES: usize = 20_000;

/// The loop; what the motor did, at each sample.
fn closed_loop(
    arm: &Arm,
    sensor: Option<Quantiser>,
    mut advance: impl FnMut(&mut Hybrid<'_>, f64),
) -> Vec<f64> {
    let mut pd = Pd::new(8.0, 0.2).unwrap();
    let mut motor = Vec::with_capacity(SAMPLES);
    let mut hybrid = Hybrid::at_rest(arm);
    for k in 0..SAMPLES {
        let angle = hybrid.state()[0];
        let time_s = k as f64 * SAMPLE_TIME_S;
        let now = Sensed {
            time_s,
            period_s: SAMPLE_TIME_S,
            reference_rad: 0.5 * (3.0 * time_s).sin(),
            motor_rad: sensor.map_or(angle, |s| s.read(angle)),
            tips_rad: &[],
            limit_a: 4.12,
        };
        let current = pd.current_a(&now).clamp(-4.12, 4.12);
        motor.push(angle);
        advance(&mut hybrid, arm.motor.torque_constant_nm_per_a * current);
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

fn experiment(c: &mut Criterion) {
    let twelve = Quantiser::new(12, std::f64::consts::TAU).unwrap();
    for (masses, sensor, name) in [
        (1, None, "1 mass, ideal sensors"),
        (1, Some(twelve), "1 mass, 12 bits"),
        (2, None, "2 masses, ideal sensors"),
        (10, None, "10 masses, ideal sensors"),
    ] {
        let arm = arm(masses);
        let held = || {
            let step = HeldStep::new(&arm, SAMPLE_TIME_S);
            closed_loop(&arm, sensor, |h, torque| h.advance_held(&step, torque))
        };
        let events = || closed_loop(&arm, sensor, |h, torque| h.advance(torque, SAMPLE_TIME_S));
        let apart = held().iter().zip(events()).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
        eprintln!("60 s, {name}: apart by {apart:.1e} rad");
        let mut group = c.benchmark_group(format!("60 s, {name}"));
        group.sample_size(10).measurement_time(Duration::from_secs(2));
        group.bench_function("held samples", |b| b.iter(|| black_box(held())));
        group.bench_function("events alone (baseline)", |b| b.iter(|| black_box(events())));
        group.finish();
    }
}

criterion_group!(benches, experiment);
criterion_main!(benches);
