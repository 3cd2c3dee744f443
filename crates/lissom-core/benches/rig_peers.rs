//! lissom's own estimates for `evidence/peers/rig.py`, which compares them with those of other tools.
//!
//! `cargo bench -p lissom-core --bench rig_peers -- FILE`: 60 s of the report's arm in its loop, with
//! up to 80 masses too, and a batch of experiments on one thread and on two.
#![expect(clippy::unwrap_used, reason = "whoever runs it reads the panic")]

use std::time::{Duration, Instant};

use lissom::arm::Arm;
use lissom::beam::{LumpedBeam, Span};
use lissom::rig::{Batch, HeldArm, HeldMotion, Motion, Pd, Sines};
use lissom_testmodels::report_arm;
use serde_json::json;

const SAMPLE_TIME_S: f64 = 0.003;
const SAMPLES: usize = 20_000;
const EXPERIMENTS: u64 = 1000;

fn main() {
    // Cargo adds `--bench`. Without a file there is nothing to do.
    let Some(file) = std::env::args().skip(1).find(|a| !a.starts_with('-')) else { return };
    let arm = report_arm();
    let (loop_s, angles) = least_s(|| closed_loop(&arm));
    let mut batches = Vec::new();
    for noise_rad in [1e-4, 4.4e-4] {
        let batch = Batch {
            arm: &arm,
            controller: Pd::new(8.0, 0.2).unwrap(),
            limit_a: 4.12,
            sample_time_s: SAMPLE_TIME_S,
            noise_rad,
            omega_rad_s: 3.0,
            amplitude_rad: 0.5,
            settle_s: 2.0,
            record_s: 58.0,
        };
        let [one_s, two_s] = [1, 2].map(|threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            least_s(|| pool.install(|| batch.run(0..EXPERIMENTS).unwrap())).0
        });
        let runs = batch.run(0..EXPERIMENTS).unwrap();
        let coulomb: Vec<f64> = runs.iter().map(|r| r.coulomb_a).collect();
        let sticks: Vec<usize> = runs.iter().map(|r| r.sticks).collect();
        batches.push(json!({
            "noise_rad": noise_rad, "one_s": one_s, "two_s": two_s, "coulomb_a": coulomb,
            "sticks": sticks,
        }));
    }
    let growth: Vec<_> = [1, 2, 5, 10, 20, 40, 80]
        .map(|masses| {
            let arm = in_parts(&arm, masses);
            let (prepare_s, held) = least_s(|| HeldArm::new(&arm, &[SAMPLE_TIME_S]).unwrap());
            assert!(held.by_modes());
            let (loop_s, _) = least_s(|| in_loop(&held));
            json!({ "masses": masses, "prepare_s": prepare_s, "loop_s": loop_s })
        })
        .into();
    let estimates =
        json!({ "growth": growth, "loop_s": loop_s, "angle_rad": angles, "batches": batches });
    std::fs::write(file, estimates.to_string()).unwrap();
}

/// The arm with equal masses on its beam's length.
fn in_parts(arm: &Arm, masses: usize) -> Arm {
    let span = arm.beam().spans()[0];
    let parts = masses as f64;
    let span = Span { length_m: span.length_m / parts, mass_kg: span.mass_kg / parts, ..span };
    Arm::new(LumpedBeam::new(&vec![span; masses]).unwrap(), arm.motor, arm.coulomb).unwrap()
}

fn closed_loop(arm: &Arm) -> Vec<f64> {
    in_loop(&HeldArm::new(arm, &[SAMPLE_TIME_S]).unwrap())
}

fn in_loop(held: &HeldArm<'_>) -> Vec<f64> {
    let torque_constant = held.arm().motor.torque_constant_nm_per_a();
    let mut motion = HeldMotion::at_rest(held);
    let mut angles = Vec::with_capacity(SAMPLES);
    let (proportional, derivative) = (8.0, 0.2 / SAMPLE_TIME_S);
    let sines = Sines::new(3.0 * SAMPLE_TIME_S);
    let [mut sin, mut cos] = [[0.0; 64]; 2];
    let mut before = 0.0;
    for k in 0..SAMPLES {
        if k % 64 == 0 {
            sines.fill(k, &mut sin, &mut cos);
        }
        let angle = motion.motor_angle_rad();
        angles.push(angle);
        let error = 0.5 * sin[k % 64] - angle;
        let current = (proportional * error + derivative * (error - before)).clamp(-4.12, 4.12);
        before = error;
        motion.advance(torque_constant * current, SAMPLE_TIME_S).unwrap();
    }
    angles
}

/// Least time of a call \[s\] over at least 5 of them and, where they are short, 0.5 s (other work
/// may run beside); and what it gave.
fn least_s<T>(f: impl Fn() -> T) -> (f64, T) {
    let start = Instant::now();
    let mut given = f();
    let mut least_s = f64::INFINITY;
    let mut count = 0;
    while count < 5 || start.elapsed() < Duration::from_millis(500) {
        let begin = Instant::now();
        given = f();
        least_s = least_s.min(begin.elapsed().as_secs_f64());
        count += 1;
    }
    (least_s, given)
}
