//! One sine that is repeated: errors of its sensor are repeated, too, and are no property of the joint.
#![expect(clippy::print_stdout, reason = "a test that shows its errors")]

use std::f64::consts::TAU;

use lissom::arm::Arm;
use lissom::drive::Motor;
use lissom::identify::{Effort, Options, identify};
use lissom::rig::{Experiment, Pd, Rig};

/// Logs, each of its own Coulomb friction and noise.
const LOGS: u64 = 40;
/// Coulomb friction may be wrong by this share.
const WRONG: f64 = 0.01;

/// Five periods of 1 Hz and an encoder of 16384 counts, with noise of an eighth of a count.
#[test]
fn has_no_ripple_of_its_encoder() {
    for seed in 0..LOGS {
        let coulomb_nm = 0.02 * (1.0 + 0.005 * seed as f64);
        let motor = Motor::builder()
            .inertia_kg_m2(2e-3)
            .viscous_nm_s_per_rad(5e-3)
            .torque_constant_nm_per_a(0.2);
        let arm = Arm::builder().motor(motor).coulomb_nm(coulomb_nm).build().unwrap();
        let rig = Rig::builder(arm)
            .sample_time_s(2e-3)
            .encoder_counts(16_384)
            .noise_rad(5e-5)
            .current_limit_a(5.0)
            .controller(Pd::new(4.0, 0.15).unwrap())
            .build()
            .unwrap();
        let logs = rig.campaign_from_seed(100 * seed, [Experiment::sine(TAU, 0.6, 6.0)]).unwrap();
        let options = Options { effort: Effort::Quick, ..Options::default() };
        let found = identify(logs.as_ref(), &options, |_| ()).unwrap();
        let law = found.friction.law.as_ref();
        assert!(law.is_none_or(|law| law.ripples.is_empty()), "seed {seed}");
        let wrong = found.friction.coulomb.unwrap().value / coulomb_nm - 1.0;
        println!("seed {seed}: {:.2} %", 100.0 * wrong);
        assert!(wrong.abs() < WRONG, "seed {seed}: {wrong}");
    }
}
