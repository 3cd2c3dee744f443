//! Known laws on a known motion.

use super::*;
use crate::identify::methods::regression::motor_regression;
use crate::identify::options::Options;
use crate::record::{Axis, Channels, Command, CommandQuantity, Hold, Run, TimeBase};

/// J \[kg·m²\], V \[N·m·s/rad\] and C \[N·m\] of all joints here.
const INERTIA: f64 = 0.02;
const VISCOUS: f64 = 0.05;
const COULOMB: f64 = 0.3;
/// Step of the encoder \[rad\]: 16 bits.
const STEP: f64 = std::f64::consts::TAU / 65536.0;

/// Two runs of two sines each at 500 Hz, the torque that friction(v, θ) and the inertia ask for, read
/// off by an encoder.
fn law_of(mut friction: impl FnMut(f64, f64) -> f64) -> FrictionLaw {
    let sample_s = 0.002;
    let mut run = |name: &str, slow: f64, fast: f64| {
        let time = |k: u32| f64::from(k) * sample_s;
        let angle = |t: f64| 0.8 * (slow * t).sin() + 0.2 * (fast * t + 0.4).sin();
        let motor = (0..12_000).map(|k| (angle(time(k)) / STEP).round() * STEP).collect();
        let torque = (0..12_000)
            .map(|k| {
                let t = time(k);
                let velocity = 0.8 * slow * (slow * t).cos() + 0.2 * fast * (fast * t + 0.4).cos();
                let acceleration = -0.8 * slow * slow * (slow * t).sin()
                    - 0.2 * fast * fast * (fast * t + 0.4).sin();
                INERTIA * acceleration + friction(velocity, angle(t))
            })
            .collect();
        Run::new(name, TimeBase::uniform(0.0, sample_s), torque, motor, vec![]).unwrap()
    };
    let command = Command {
        quantity: CommandQuantity::Current,
        hold: Hold::Measured,
        torque_per_command: Some(1.0),
        back_emf_viscous: 0.0,
        limit: None,
    };
    let channels = Channels { axis: Axis::Rotary, command, tips: vec![] };
    let runs = vec![run("run 1", 1.1, 3.7), run("run 2", 2.3, 7.9)];
    let campaign = Campaign::new(channels, runs).unwrap();
    let prepared = Prepared::of(&campaign);
    let motor = motor_regression(&prepared, &Options::default()).unwrap();
    friction_law(&prepared, &motor).unwrap().0
}

fn simple(v: f64) -> f64 {
    VISCOUS * v + COULOMB * v.signum()
}

#[track_caller]
fn near(found: Estimate, truth: f64, tolerance: f64) {
    assert!((found.value / truth - 1.0).abs() < tolerance, "{found:?}, true {truth}");
}

#[test]
fn coulomb_friction_asks_for_no_term() {
    let law = law_of(|v, _| simple(v));
    assert!(!law.chosen.departs(), "{:?}", law.chosen.terms);
    near(law.chosen.inertia.unwrap(), INERTIA, 2e-3);
    near(law.chosen.coulomb.unwrap(), COULOMB, 2e-3);
    // The curve is the line: within 1 %, from a fiftieth of the fastest speed on.
    assert!(law.curve.len() >= 10, "{}", law.curve.len());
    for p in &law.curve {
        near(p.friction, simple(p.speed), 0.01);
        assert!(p.friction.std < 0.01 * COULOMB, "{p:?}");
    }
}

#[test]
fn stribeck_friction_is_found_with_its_speed() {
    let law = law_of(|v, _| simple(v) + 0.15 * v.signum() * (-v.abs() / 0.2).exp());
    let (term, amplitude) = law.chosen.terms.first().unwrap();
    let LawTerm::NearRest { speed, .. } = *term else { panic!("{term:?}") };
    assert!((speed / 0.2 - 1.0).abs() < 0.1, "{speed}");
    near(amplitude[0], 0.15, 0.05);
    near(law.chosen.inertia.unwrap(), INERTIA, 2e-3);
    near(law.chosen.coulomb.unwrap(), COULOMB, 0.01);
    let [simplest, chosen, _] = law.relative_residual;
    assert!(chosen < 0.2 * simplest, "{chosen} {simplest}");
    let at = law.chosen.friction(0.1, -1.0).unwrap();
    assert!((at / (simple(0.1) + 0.15 * (-0.5_f64).exp()) - 1.0).abs() < 0.02, "{at}");
}

#[test]
fn the_curve_shows_a_law_that_is_no_candidate() {
    // Friction that dips at a middle speed, over some octaves: knots are one apart.
    let dip = |v: f64| 0.1 * (-((v.abs() / 0.8).ln() / 1.2).powi(2)).exp();
    let law = law_of(|v, _| simple(v) - v.signum() * dip(v));
    for p in law.curve.iter().filter(|p| p.speed > 0.05) {
        // Straight between knots a factor of two apart.
        near(p.friction, simple(p.speed) - dip(p.speed), 0.08);
    }
    let [_, chosen, curve] = law.relative_residual;
    assert!(curve < chosen, "{curve} {chosen}");
}

#[test]
fn viscous_friction_by_direction_is_found() {
    let law = law_of(|v, _| simple(v) + 0.01 * v.abs());
    let found = law.chosen.term(|t| *t == LawTerm::ViscousByDirection).unwrap();
    near(found, 0.01, 0.02);
    near(law.chosen.viscous.unwrap(), VISCOUS, 0.01);
}

#[test]
fn a_ripple_is_found_with_its_period() {
    let law = law_of(|v, x| simple(v) + 0.06 * v.signum() * (12.0 * x + 0.3).cos());
    let found = law.chosen.terms.iter().find(|t| t.0.name() == "ripple");
    let (LawTerm::Ripple { per_angle }, amplitude) = found.unwrap() else { unreachable!() };
    assert!((per_angle / 12.0 - 1.0).abs() < 1e-3, "{per_angle}");
    let size = amplitude.iter().take(2).map(|e| e.value.powi(2)).sum::<f64>().sqrt();
    assert!((size / 0.06 - 1.0).abs() < 2e-3, "{size}");
    near(law.chosen.inertia.unwrap(), INERTIA, 0.01);
}
