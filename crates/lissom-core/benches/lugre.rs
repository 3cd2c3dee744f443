//! Speed of the arm on bristles: `cargo bench -p lissom-core --bench lugre`.
//!
//! The experiment of the bench `rig`, 20 000 samples of the report's arm in its loop, on bristles that
//! bend by 1e-3 to 1e-6 rad, beside Coulomb friction with its events (baseline).
#![expect(clippy::unwrap_used, reason = "the models are fixed and valid")]

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use lissom::drive::LuGre;
use lissom::rig::{Controller, Hybrid, LuGreMotion, Motion, Sensed};
use lissom_testmodels::report_rig;

const SAMPLES: usize = 20_000;

fn closed_loop(motion: &mut impl Motion) -> f64 {
    let rig = report_rig(None);
    let (t, torque_constant) =
        (rig.instruments.sample_time_s, rig.arm.motor.torque_constant_nm_per_a());
    let mut controller = rig.controller.clone();
    let mut last = 0.0;
    for k in 0..SAMPLES {
        let time_s = k as f64 * t;
        let reference_rad = 0.5 * (3.0 * time_s).sin();
        let motor_rad = motion.state()[0];
        let limit_a = rig.instruments.amplifier.most_a();
        let now = Sensed { time_s, period_s: t, reference_rad, motor_rad, tips_rad: &[], limit_a };
        let current = controller.current_a(&now).clamp(-limit_a, limit_a);
        motion.advance(torque_constant * current, t).unwrap();
        last = motor_rad;
    }
    last
}

fn experiment(c: &mut Criterion) {
    let rig = report_rig(None);
    let (arm, fc) = (&rig.arm, rig.arm.coulomb);
    let mut group = c.benchmark_group("60 s on bristles");
    group.sample_size(10).measurement_time(Duration::from_secs(2));
    group.bench_function("Coulomb, events alone (baseline)", |b| {
        b.iter(|| black_box(closed_loop(&mut Hybrid::at_rest(arm))));
    });
    for bend in [1e-3, 1e-4, 1e-6] {
        let law = LuGre::new(fc.forward() / bend, 0.03, fc, fc, 0.1).unwrap();
        for tolerance in [1e-6, 1e-8] {
            group.bench_function(
                format!("Fc/σ0 {bend:.0e} rad, tolerance {tolerance:.0e}"),
                |b| {
                    b.iter(|| {
                        let mut motion = LuGreMotion::at_rest(arm, law, tolerance).unwrap();
                        black_box(closed_loop(&mut motion))
                    });
                },
            );
        }
    }
    group.finish();
}

criterion_group!(benches, experiment);
criterion_main!(benches);
