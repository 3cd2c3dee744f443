//! lissom's own estimates for `evidence/peers/rig.py`, which compares them with those of other tools.
//!
//! `cargo bench -p lissom-core --bench rig_peers -- FILE`: 60 s of the report's arm in its loop,
//! with up to 80 masses too.
#![expect(clippy::unwrap_used, reason = "whoever runs it reads the panic")]

use std::time::{Duration, Instant};

use lissom::arm::Arm;
use lissom::beam::{LumpedBeam, Span};
use lissom::rig::{HeldArm, HeldMotion, Motion};
use lissom_testmodels::report_arm;
use serde_json::json;

const SAMPLE_TIME_S: f64 = 0.003;
const SAMPLES: usize = 20_000;

fn main() {
    // Cargo adds `--bench`. Without a file there is nothing to do.
    let Some(file) = std::env::args().skip(1).find(|a| !a.starts_with('-')) else { return };
    let arm = report_arm();
    let (loop_s, angles) = least_s(|| closed_loop(&arm));
    let growth: Vec<_> = [1, 2, 5, 10, 20, 40, 80]
        .map(|masses| {
            let arm = in_parts(&arm, masses);
            let (prepare_s, held) =
                least_s(|| HeldArm::new(&arm, &[SAMPLE_TIME_S]).unwrap().unwrap());
            let (loop_s, _) = least_s(|| in_loop(&held));
            json!({ "masses": masses, "prepare_s": prepare_s, "loop_s": loop_s })
        })
        .into();
    let estimates = json!({ "growth": growth, "loop_s": loop_s, "angle_rad": angles });
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
    in_loop(&HeldArm::new(arm, &[SAMPLE_TIME_S]).unwrap().unwrap())
}

fn in_loop(held: &HeldArm<'_>) -> Vec<f64> {
    let torque_constant = held.arm().motor.torque_constant_nm_per_a();
    let mut motion = HeldMotion::at_rest(held);
    let mut angles = Vec::with_capacity(SAMPLES);
    let (proportional, derivative) = (8.0, 0.2 / SAMPLE_TIME_S);
    let mut before = 0.0;
    for k in 0..SAMPLES {
        let angle = motion.motor_angle_rad();
        angles.push(angle);
        let error = 0.5 * (3.0 * SAMPLE_TIME_S * k as f64).sin() - angle;
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
