//! Which number of a description is wrong, told from logs of the arm itself.
#![expect(clippy::unwrap_used, clippy::print_stdout, reason = "tests")]

use lissom::arm::Arm;
use lissom::beam::{LumpedBeam, Span};
use lissom::drive::{Coulomb, Motor};
use lissom::identify::{ArmQuantity, Options, geometry_check, identify};
use lissom::record::Campaign;
use lissom::rig::{Amplifier, Experiment, Instruments, Noise, Pd, Quantiser, Rig, Sensor, Settle};

/// Puts a number of the description off by a factor.
type Spoil = fn(&mut [Span], f64);

fn spans() -> Vec<Span> {
    let span = |length_m: f64, flexural_rigidity_n_m2: f64, mass_kg: f64| Span {
        length_m,
        flexural_rigidity_n_m2,
        mass_kg,
        damping_n_s_per_m: 0.02 * mass_kg,
    };
    vec![span(0.15, 0.02, 0.06), span(0.12, 0.02, 0.04)]
}

fn arm(spans: &[Span], inertia_kg_m2: f64) -> Arm {
    let motor = Motor::new(inertia_kg_m2, 2e-3, 0.3).unwrap();
    Arm::new(LumpedBeam::new(spans).unwrap(), motor, Coulomb::symmetric(0.04).unwrap()).unwrap()
}

#[test]
fn the_number_that_is_wrong_is_named() {
    let quantiser = Quantiser::new(13, std::f64::consts::TAU).unwrap();
    let noise = Some(Noise::new(0.5 * quantiser.step()).unwrap());
    let sensor = Sensor { noise, quantiser: Some(quantiser) };
    let mut instruments = Instruments::ideal(0.002).unwrap();
    (instruments.motor, instruments.tips) = (sensor, vec![sensor; 2]);
    instruments.amplifier = Amplifier::ideal().with_limit(6.0).unwrap();
    let rig = Rig::new(arm(&spans(), 8e-4), instruments, Pd::new(8.0, 0.15).unwrap().into());
    let run = |omega_rad_s: f64| {
        let sine = Experiment::sine(omega_rad_s, 0.5, (40.0 / omega_rad_s).max(6.0)).unwrap();
        let sine = sine.settling(Settle::Wait { wait_s: 20.0 });
        rig.run(&format!("{omega_rad_s} rad/s"), &sine, 3).unwrap().run
    };
    let runs = [1.5, 4.5, 12.0, 36.0].map(run).to_vec();
    let campaign = Campaign::new(rig.channels(0..2).unwrap(), runs).unwrap();
    let id = identify(&campaign, &Options::default(), |_| ()).unwrap();
    let found = id.output_error.as_ref().unwrap();

    assert!(geometry_check(&rig.arm, found).unwrap().agrees());
    let second = Some(1);
    let wrong: [(ArmQuantity, f64, Spoil); 4] = [
        (ArmQuantity::Mass(second), 1.06, |s, f| s[1].mass_kg /= f),
        (ArmQuantity::Length(Some(0)), 0.97, |s, f| s[0].length_m /= f),
        (ArmQuantity::Stiffness(None), 1.2, |s, f| {
            for span in s {
                span.flexural_rigidity_n_m2 /= f;
            }
        }),
        (ArmQuantity::Stiffness(second), 0.8, |s, f| s[1].flexural_rigidity_n_m2 /= f),
    ];
    for (quantity, factor, spoil) in wrong {
        let mut described = spans();
        spoil(&mut described, factor);
        let check = geometry_check(&arm(&described, 8e-4), found).unwrap();
        let best = check.explanations[0];
        println!("{quantity:?} {factor}: {:.4} before, {best:?}", check.before);
        assert!(!check.agrees() && best.quantity == quantity, "{check:?}");
        assert!((best.factor.value - factor).abs() < 4.0 * best.factor.std, "{best:?}");
        assert!(best.factor.std < 0.01 && best.left < 0.1 * check.before, "{best:?}");
        assert_eq!(check.as_good().count(), 1, "{check:?}");
    }
    let check = geometry_check(&arm(&spans(), 8e-4 / 1.3), found).unwrap();
    let best = check.explanations[0];
    assert_eq!(best.quantity, ArmQuantity::MotorInertia);
    assert!((best.factor.value - 1.3).abs() < 4.0 * best.factor.std, "{best:?}");
}
