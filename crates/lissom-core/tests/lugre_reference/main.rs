//! Motion on LuGre bristles against scipy, closed forms, Coulomb's limit and the energy balance.
//!
//! `make_lugre.py` made `lugre.json`: two methods of scipy agree there to 1.5e-11.
#![expect(clippy::unwrap_used, reason = "tests")]

use lissom::arm::Arm;
use lissom::beam::{LumpedBeam, Span};
use lissom::drive::{Coulomb, LuGre};
use lissom::rig::{Hybrid, LuGreMotion, Motion, RigError};
use lissom_testmodels::report_arm;
use serde_json::Value;

const SAMPLE_TIME_S: f64 = 0.003;

/// A tolerance, and what angles \[rad\], speeds \[rad/s\] and z·σ0/Fs are off by at most: twice what the worst case here
/// is. Errors of steps add up.
const BOUNDS: [(f64, [f64; 3]); 4] = [
    (1e-5, [4e-5, 1.1e-4, 1e-4]),
    (1e-6, [6e-6, 2e-5, 2e-5]),
    (1e-8, [3e-7, 8e-7, 1e-6]),
    (1e-12, [7e-10, 2e-9, 4e-9]),
];

fn reference() -> Value {
    serde_json::from_str(include_str!("lugre.json")).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

fn by_direction(value: &Value) -> Coulomb {
    Coulomb::by_direction(number(&value[0]), number(&value[1])).unwrap()
}

fn law_of(case: &Value) -> LuGre {
    let law = &case["law"];
    let (coulomb, at_rest) = (by_direction(&law["coulomb"]), by_direction(&law["at_rest"]));
    let [sigma0, sigma1, stribeck] = ["sigma0", "sigma1", "stribeck"].map(|k| number(&law[k]));
    LuGre::new(sigma0, sigma1, coulomb, at_rest, stribeck).unwrap()
}

/// Largest errors of angles, speeds and z·σ0/Fs over the samples of a case.
fn errors(case: &Value, tolerance: f64) -> [f64; 3] {
    let (arm, law) = (report_arm(), law_of(case));
    let start: Vec<f64> = case["initial"].as_array().unwrap().iter().map(number).collect();
    let mut motion = LuGreMotion::with_state(&arm, law, tolerance, &start[..4], start[4]).unwrap();
    let mut samples = case["samples"].as_array().unwrap().iter().peekable();
    let mut worst = [0.0_f64; 3];
    let mut k = 0;
    while let Some(next) = samples.peek() {
        let t = k as f64 * SAMPLE_TIME_S;
        let torque = number(&case["a"]) * (3.0 * t).sin() + number(&case["b"]) * (19.0 * t).cos();
        motion.advance(torque, SAMPLE_TIME_S).unwrap();
        k += 1;
        if next["k"].as_u64() == Some(k) {
            let apart = |i: usize, found: f64| (found - number(&next["state"][i])).abs();
            let x = motion.state();
            worst[0] = worst[0].max(apart(0, x[0])).max(apart(2, x[2]));
            worst[1] = worst[1].max(apart(1, x[1])).max(apart(3, x[3]));
            let deflection = apart(4, motion.deflection_rad()) / law.deflection_most_rad();
            worst[2] = worst[2].max(deflection);
            samples.next();
        }
    }
    worst
}

#[test]
fn errors_against_scipy_follow_the_tolerance() {
    for case in reference()["cases"].as_array().unwrap() {
        for (tolerance, most) in BOUNDS {
            let found = errors(case, tolerance);
            let kept = found.iter().zip(most).all(|(found, most)| *found <= most);
            assert!(kept, "{} at {tolerance}: {found:?}", case["name"]);
        }
    }
}

/// An arm whose motion dies out: the bristles and the beam are damped beyond oscillation.
fn creeping_arm() -> Arm {
    let report = report_arm();
    let span = Span { damping_n_s_per_m: 2.0, ..report.beam().spans()[0] };
    Arm::new(LumpedBeam::new(&[span]).unwrap(), report.motor, report.coulomb).unwrap()
}

/// Without Stribeck's part `dF/dθ = σ0·(1 − F/Fc·sgn v)` whatever the speed, so that a slow torque
/// traces `θ = −Fc/σ0·ln(1 − F/Fc)` first and branches of the same form after each reversal.
#[test]
fn presliding_is_a_spring_with_hysteresis() {
    /// Share of Fc/σ0. The tolerance is 1e-9; steps add up.
    const ERROR: f64 = 1e-5;
    let arm = creeping_arm();
    let (fc, sigma0) = (0.0326, 326.0);
    let friction = Coulomb::symmetric(fc).unwrap();
    let law = LuGre::new(sigma0, 2.0, friction, friction, 0.1).unwrap();
    let unit = fc / sigma0;
    // Stiffness σ0 where the torque is small.
    let mut motion = LuGreMotion::at_rest(&arm, law, 1e-9).unwrap();
    motion.advance(1e-4 * fc, 20.0).unwrap();
    let stiffness = 1e-4 * fc / motion.state()[0];
    assert!((stiffness / sigma0 - 1.0).abs() < 1e-4, "{stiffness}"); // 1e-4/2 by ln(1 − x)

    let mut motion = LuGreMotion::at_rest(&arm, law, 1e-9).unwrap();
    motion.advance(0.7 * fc, 20.0).unwrap();
    let virgin = -unit * (1.0_f64 - 0.7).ln();
    assert!((motion.state()[0] - virgin).abs() < ERROR * unit, "{:?}", motion.state());
    motion.advance(-0.5 * fc, 20.0).unwrap();
    let back = virgin + unit * ((1.0_f64 - 0.5) / (1.0 + 0.7)).ln();
    assert!((motion.state()[0] - back).abs() < ERROR * unit, "{:?} {back}", motion.state());
    motion.advance(0.7 * fc, 20.0).unwrap();
    let again = back - unit * ((1.0_f64 - 0.7) / (1.0 + 0.5)).ln();
    assert!((motion.state()[0] - again).abs() < ERROR * unit, "{:?} {again}", motion.state());
}

/// A held joint comes to rest where its spring does, whatever the tolerance: errors of steps excite no motion that goes on.
#[test]
fn a_held_joint_does_not_creep() {
    /// Share of the angle.
    const ERROR: f64 = 1e-4;
    let arm = creeping_arm();
    let friction = Coulomb::symmetric(0.0326).unwrap();
    let law = LuGre::new(326.0, 2.0, friction, friction, 0.1).unwrap();
    for tolerance in [1e-6, 1e-9, 1e-12] {
        let mut motion = LuGreMotion::at_rest(&arm, law, tolerance).unwrap();
        motion.advance(1e-4 * 0.0326, 10.0).unwrap();
        let (angle, steps) = (motion.state()[0], motion.steps());
        motion.advance(1e-4 * 0.0326, 200.0).unwrap();
        let crept = motion.state()[0] / angle - 1.0;
        assert!(crept.abs() < ERROR, "{tolerance}: {crept}");
        assert!(motion.steps() - steps < 100, "{tolerance}: {} steps", motion.steps());
    }
}

/// Bristles that bend by 1e-7 rad swing at 23 000 rad/s under a load that is held for 30 s in one sample.
#[test]
fn stiff_bristles_do_not_make_long_samples_endless() {
    const STEPS: usize = 300_000;
    let arm = report_arm();
    let law =
        LuGre::new(arm.coulomb.forward() / 1e-7, 0.05, arm.coulomb, arm.coulomb, 0.1).unwrap();
    for share in [0.5, 1.5] {
        let mut motion = LuGreMotion::at_rest(&arm, law, 1e-6).unwrap();
        motion.advance(share * arm.coulomb.forward(), 30.0).unwrap();
        assert!(motion.steps() < STEPS, "{} steps", motion.steps());
    }
}

/// With Fs = Fc the law tends to Coulomb's as the bristles stiffen. A joint on bristles breaks loose
/// when it has moved by about Fc/σ0. Under a torque that rises, Coulomb's moves as t³ and is by then
/// as fast as (Fc/σ0)^⅔; where the bristles are so stiff that this is within one sample, its torque
/// is constant, and it moves as t² and is as fast as (Fc/σ0)^½. That speed is what they differ by.
#[test]
fn stiff_bristles_are_coulomb_friction() {
    /// Fc/σ0 \[rad\], and the power of it that the distance goes with from the one before.
    const BENDS: [(f64, f64); 5] =
        [(1e-3, f64::NAN), (1e-4, 2.0 / 3.0), (1e-5, 2.0 / 3.0), (1e-7, f64::NAN), (1e-8, 0.5)];
    /// How near to that power it comes: the next terms of both series.
    const POWER_ERROR: f64 = 0.03;
    let arm = report_arm();
    let torque = |k: usize| 0.12 * (3.0 * k as f64 * SAMPLE_TIME_S).sin();
    let mut exact = Hybrid::at_rest(&arm);
    let wanted: Vec<f64> = (0..500)
        .map(|k| {
            exact.advance(torque(k), SAMPLE_TIME_S);
            exact.state()[0]
        })
        .collect();
    assert!(exact.sticks() > 0 && exact.stuck_s() > 0.0);
    let (mut before, mut held) = (f64::NAN, f64::NAN);
    for (bend, power) in BENDS {
        let law = LuGre::new(arm.coulomb.forward() / bend, 0.05, arm.coulomb, arm.coulomb, 0.1);
        let mut motion = LuGreMotion::at_rest(&arm, law.unwrap(), 1e-9).unwrap();
        let mut apart = 0.0_f64;
        for (k, wanted) in wanted.iter().enumerate() {
            motion.advance(torque(k), SAMPLE_TIME_S).unwrap();
            apart = apart.max((motion.state()[0] - wanted).abs());
        }
        if power.is_finite() {
            let found = (before / apart).log10();
            assert!((found - power).abs() < POWER_ERROR, "{bend}: {found}");
        }
        before = apart;
        held = motion.stuck_s() / exact.stuck_s();
    }
    // Held until nine tenths of the way to breaking away.
    assert!((held - 0.95).abs() < 0.05, "{held}");
    assert!(before < 1e-4, "{before} rad at the stiffest");
}

/// Energy in the motor, the beam and the bristles \[J\], of the report's arm.
fn energy_j(arm: &Arm, motion: &LuGreMotion, law: &LuGre) -> f64 {
    let span = arm.beam().spans()[0];
    let (l, x, z) = (span.length_m, motion.state(), motion.deflection_rad());
    let stiffness = 3.0 * span.flexural_rigidity_n_m2 / l;
    0.5 * (arm.motor.inertia_kg_m2() * x[1] * x[1]
        + span.mass_kg * l * l * x[3] * x[3]
        + stiffness * (x[0] - x[2]) * (x[0] - x[2])
        + law.stiffness_nm_per_rad() * z * z)
}

/// Work in less energy stored: never negative while σ1·|v| ≤ 4·g, and over a long run what friction
/// in steady motion takes.
#[test]
fn friction_takes_energy_in_every_sample() {
    /// The method's share of the energies that pass in a sample.
    const ERROR: f64 = 1e-6;
    let arm = report_arm();
    let friction = arm.coulomb;
    let law = LuGre::new(326.0, 0.004, friction, friction, 0.1).unwrap();
    let mut motion = LuGreMotion::at_rest(&arm, law, 1e-9).unwrap();
    let (mut lost, mut way) = (0.0, 0.0);
    let mut fastest = 0.0_f64;
    for k in 0..2000 {
        let t = k as f64 * SAMPLE_TIME_S;
        let torque = 0.12 * (3.0 * t).sin() + 0.05 * (11.0 * t).sin();
        let (angle, stored) = (motion.state()[0], energy_j(&arm, &motion, &law));
        motion.advance(torque, SAMPLE_TIME_S).unwrap();
        let work = torque * (motion.state()[0] - angle);
        let dissipated = work - (energy_j(&arm, &motion, &law) - stored);
        assert!(dissipated >= -ERROR * (work.abs() + stored), "sample {k}: {dissipated} J");
        lost += dissipated;
        way += (motion.state()[0] - angle).abs();
        fastest = fastest.max(motion.state()[1].abs());
    }
    assert!(0.004 * fastest <= 4.0 * friction.forward(), "{fastest} rad/s");
    // Friction alone takes Fc over the way; V, the beam's damper and v·ż add to it.
    assert!(lost > friction.forward() * way && way > 1.0, "{lost} J over {way} rad");
}

#[test]
fn what_cannot_be_solved_is_an_error_and_moves_nothing() {
    let arm = report_arm();
    let law = LuGre::new(326.0, 0.03, arm.coulomb, arm.coulomb, 0.1).unwrap();
    for bad in [0.0, 1e-13, 0.1, f64::NAN] {
        let refused = LuGreMotion::at_rest(&arm, law, bad);
        assert!(matches!(refused.err(), Some(RigError::Tolerance { .. })));
    }
    let refused = LuGreMotion::with_state(&arm, law, 1e-6, &[f64::NAN], 0.0);
    assert!(matches!(refused.err(), Some(RigError::NotFollowed { .. })));
    let mut motion = LuGreMotion::at_rest(&arm, law, 1e-6).unwrap();
    motion.advance(0.05, 0.01).unwrap();
    let before = motion.state().to_vec();
    for (torque, duration) in [(f64::NAN, 0.1), (f64::INFINITY, 0.1), (0.1, f64::NAN), (1e300, 0.1)]
    {
        let refused = motion.advance(torque, duration);
        assert!(matches!(refused, Err(RigError::NotFollowed { .. })), "{torque} {duration}");
        assert_eq!(motion.state(), before);
    }
    motion.advance(0.05, 0.0).unwrap();
    assert_eq!(motion.state(), before);
    motion.advance(0.05, 1e-15).unwrap();
    motion.advance(0.05, 30.0).unwrap(); // one long sample
}
