//! Experiments side by side: each is what it is alone.

#![expect(clippy::unwrap_used, reason = "tests")]

use lissom::arm::Arm;
use lissom::beam::{Damping, LumpedBeam, Span};
use lissom::drive::{Coulomb, Motor};
use lissom::rig::{Batch, HeldArm, HeldMotion, Motion, NoisyRun, Pd, RigError};
use lissom_testmodels::report_arm;
use rand_distr::{Distribution, StandardNormal};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;

const SAMPLE_TIME_S: f64 = 0.003;
const LIMIT_A: f64 = 4.12;
const SETTLE_S: f64 = 2.0;

fn batch(arm: &Arm) -> Batch<'_> {
    Batch {
        arm,
        controller: Pd::new(8.0, 0.2).unwrap(),
        limit_a: LIMIT_A,
        sample_time_s: SAMPLE_TIME_S,
        noise_rad: 4e-4,
        omega_rad_s: 3.0,
        amplitude_rad: 0.5,
        settle_s: SETTLE_S,
        record_s: 10.0,
    }
}

fn bits(run: &NoisyRun) -> Vec<u64> {
    let [a, b] = run.current_a;
    let [c, d] = run.motor_rad;
    let all = [a.re, a.im, b.re, b.im, c.re, c.im, d.re, d.im, run.coulomb_a, run.stuck_s];
    all.iter().map(|v| v.to_bits()).chain([run.seed, run.sticks as u64]).collect()
}

#[test]
fn neighbours_and_threads_change_no_bit() {
    let arm = report_arm();
    let batch = batch(&arm);
    let all = batch.run(0..21).unwrap();
    let one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let again = one_thread.install(|| batch.run(0..21)).unwrap();
    assert_eq!(all, again);
    for (k, run) in all.iter().enumerate() {
        let alone = batch.run(k as u64..k as u64 + 1).unwrap();
        assert_eq!(bits(&alone[0]), bits(run), "seed {k}");
    }
    // The noise is in the loop: every motion differs.
    assert!(all.windows(2).all(|pair| bits(&pair[0])[..10] != bits(&pair[1])[..10]));
}

/// The same experiment written out, sample by sample.
#[test]
fn an_experiment_is_what_its_loop_says() {
    let arm = report_arm();
    let held = HeldArm::new(&arm, &[SAMPLE_TIME_S]).unwrap();
    for seed in 0..3 {
        let run = batch(&arm).run(seed..seed + 1).unwrap()[0];
        let mut motion = HeldMotion::at_rest(&held);
        let mut noise = Xoshiro256PlusPlus::seed_from_u64(seed);
        let mut before = None;
        let samples = ((SETTLE_S + 4.0 * std::f64::consts::TAU / 3.0) / SAMPLE_TIME_S).round();
        for k in 0..samples as usize {
            let unit: f64 = StandardNormal.sample(&mut noise);
            let reference = 0.5 * (3.0 * SAMPLE_TIME_S * k as f64).sin();
            let error = reference - (motion.motor_angle_rad() + 4e-4 * unit);
            let rate = (error - before.replace(error).unwrap_or(error)) / SAMPLE_TIME_S;
            let current = (8.0 * error + 0.2 * rate).clamp(-LIMIT_A, LIMIT_A);
            let torque = arm.motor.torque_constant_nm_per_a() * current;
            motion.advance(torque, SAMPLE_TIME_S).unwrap();
        }
        // The reference is rounded otherwise here; the motion forgets that.
        assert_eq!(run.sticks, motion.sticks());
        assert!((run.stuck_s - motion.stuck_s()).abs() < 1e-9, "{run:?}");
    }
}

/// (27) takes friction for a square wave: without sticking it is, and the estimate exact.
#[test]
fn friction_is_found_where_little_sticks() {
    let arm = report_arm();
    let batch = Batch {
        amplitude_rad: 4.0,
        settle_s: 20.0,
        record_s: 63.0,
        limit_a: 20.0,
        noise_rad: 1e-4,
        ..batch(&arm)
    };
    let runs = batch.run(0..8).unwrap();
    for run in runs {
        let share = run.stuck_s / 83.0;
        let true_a = arm.coulomb.forward() / arm.motor.torque_constant_nm_per_a();
        // The bias is some 0.6 of the share of time stuck (docs/src/decisions/09-third-harmonic.md); 0.3 % for noise and hold.
        let bias = (run.coulomb_a / true_a - 1.0).abs();
        assert!(share < 0.02 && bias < 1.5 * share + 0.003, "{bias} {share}");
    }
}

/// Critical damping: no modes, each experiment by itself with matrices.
#[test]
fn an_arm_without_modes_runs_too() {
    let span =
        Span { length_m: 0.2, flexural_rigidity_n_m2: 0.02, mass_kg: 0.05, damping_n_s_per_m: 0.0 };
    let beam = LumpedBeam::new(&[span]).unwrap();
    let beam = beam.with_damping(Damping::Modal { ratios: vec![1.0] }).unwrap();
    let motor = Motor::new(6e-4, 1e-3, 0.25).unwrap();
    let arm = Arm::new(beam, motor, Coulomb::symmetric(0.03).unwrap()).unwrap();
    assert!(!HeldArm::new(&arm, &[]).unwrap().by_modes());
    let runs = batch(&arm).run(0..2).unwrap();
    assert!(runs.iter().all(|run| run.sticks > 0 && run.coulomb_a > 0.0));
}

#[test]
fn a_loop_that_runs_away_is_an_error() {
    let arm = report_arm();
    let controller = Pd::new(8.0, 5.0).unwrap();
    let found = Batch { controller, limit_a: 1e9, ..batch(&arm) }.run(0..2);
    assert!(matches!(found, Err(RigError::Unstable { .. })), "{found:?}");
    let found = Batch { noise_rad: f64::NAN, ..batch(&arm) }.run(0..2);
    assert!(matches!(found, Err(RigError::NotFinite { .. })));
}
