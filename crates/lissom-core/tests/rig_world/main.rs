//! Friction laws and worlds at the tip against another integrator: `make.py` beside this file.

#![expect(clippy::unwrap_used, reason = "tests")]

mod properties;

use lissom::arm::Arm;
use lissom::beam::{LumpedBeam, Payload, Span};
use lissom::drive::{Coulomb, DryFriction, Falloff, Motor};
use lissom::rig::{Harmonic, HeldArm, HeldMotion, Hybrid, Motion, Signal, TipWorld, Wall};
use serde_json::Value;

/// Angles agree to this \[rad\] and velocities to this \[rad/s\]: the reference's Runge-Kutta has
/// rtol 1e-12 over some hundred events, each found to 1e-9 s at worst.
const AGREES: f64 = 2e-8;

fn span(length_m: f64, flexural_rigidity_n_m2: f64, mass_kg: f64, damping: f64) -> Span {
    Span { length_m, flexural_rigidity_n_m2, mass_kg, damping_n_s_per_m: damping }
}

fn coulomb() -> Coulomb {
    Coulomb::by_direction(0.03, 0.025).unwrap()
}

fn one(mass_kg: f64) -> Arm {
    let beam = LumpedBeam::new(&[span(0.2, 0.005, mass_kg, 2e-3)]).unwrap();
    Arm::new(beam, Motor::new(6e-4, 1e-3, 1.0).unwrap(), coulomb()).unwrap()
}

fn two() -> Arm {
    let spans = [span(0.15, 0.02, 0.05, 0.0), span(0.15, 0.01, 0.04, 0.0)];
    let motor = Motor::new(8e-4, 1e-3, 1.0).unwrap();
    Arm::new(LumpedBeam::new(&spans).unwrap(), motor, coulomb()).unwrap()
}

fn follow(name: &str, mut hybrid: Hybrid<'_>) {
    let text = include_str!("reference.json");
    let reference: Value = serde_json::from_str(text).unwrap();
    let dt = reference["dt_s"].as_f64().unwrap();
    let case = &reference["cases"][name];
    let mut worst = 0.0_f64;
    for (torque, state) in
        reference["torques"].as_array().unwrap().iter().zip(case["states"].as_array().unwrap())
    {
        hybrid.advance(torque.as_f64().unwrap(), dt);
        for (found, exact) in hybrid.state().iter().zip(state.as_array().unwrap()) {
            worst = worst.max((found - exact.as_f64().unwrap()).abs());
        }
    }
    assert!(worst < AGREES, "{name}: {worst:e}");
    let stuck = (hybrid.stuck_s() - case["stuck_s"].as_f64().unwrap()).abs();
    assert!(stuck < AGREES, "{name}: stuck, {stuck:e} s apart");
}

fn with_rest(rest: (f64, f64), velocity: f64, falloff: Falloff) -> DryFriction {
    let rest = Coulomb::by_direction(rest.0, rest.1).unwrap();
    DryFriction::from(coulomb()).with_rest(rest, velocity, falloff).unwrap()
}

#[test]
fn coulomb_alone() {
    follow("plain", Hybrid::at_rest(&one(0.05)));
}

#[test]
fn stribeck() {
    let law = with_rest((0.05, 0.04), 0.2, Falloff::Exponential);
    follow("stribeck_exponential", Hybrid::at_rest(&one(0.05)).with_friction(law));
    let law = with_rest((0.045, 0.05), 0.3, Falloff::Gaussian);
    follow("stribeck_gaussian", Hybrid::at_rest(&two()).with_friction(law));
}

#[test]
fn friction_that_grows_less_than_linearly() {
    let law = DryFriction::from(Coulomb::by_direction(0.05, 0.045).unwrap()).with_rest(
        Coulomb::symmetric(0.03).unwrap(),
        1.5,
        Falloff::Exponential,
    );
    follow("sublinear", Hybrid::at_rest(&one(0.05)).with_friction(law.unwrap()));
}

#[test]
fn ripple() {
    let law = DryFriction::from(coulomb()).with_ripple(0.4, 12.0, 0.3).unwrap();
    follow("ripple", Hybrid::at_rest(&one(0.05)).with_friction(law));
    let law = with_rest((0.05, 0.04), 0.2, Falloff::Exponential).with_ripple(0.3, 9.0, -0.5);
    follow("ripple_and_stribeck", Hybrid::at_rest(&two()).with_friction(law.unwrap()));
}

#[test]
fn a_tip_that_rubs() {
    let world = TipWorld { viscous_n_s_per_m: 0.05, ..TipWorld::default() };
    follow("tip_viscous", Hybrid::at_rest(&two()).with_world(world).unwrap());
    let dry = |coulomb_n| TipWorld { coulomb_n, ..TipWorld::default() };
    follow("tip_coulomb", Hybrid::at_rest(&one(0.05)).with_world(dry(0.06)).unwrap());
    follow("tip_coulomb_two", Hybrid::at_rest(&two()).with_world(dry(0.08)).unwrap());
}

#[test]
fn walls() {
    let wall = |angle_rad, stiffness_n_per_m, ahead| Wall { angle_rad, stiffness_n_per_m, ahead };
    let walls = vec![wall(0.3, 60.0, true), wall(-0.2, 30.0, false)];
    let world = TipWorld { walls, ..TipWorld::default() };
    follow("walls", Hybrid::at_rest(&one(0.05)).with_world(world).unwrap());
    let walls = vec![wall(0.2, 100.0, true)];
    let world = TipWorld { coulomb_n: 0.02, walls, ..TipWorld::default() };
    follow("wall_two", Hybrid::at_rest(&two()).with_world(world).unwrap());
}

#[test]
fn a_force_that_swings() {
    let sines = [
        Harmonic { amplitude: 0.1, omega_rad_s: 5.0, phase_rad: 0.3 },
        Harmonic { amplitude: 0.02, omega_rad_s: 0.0, phase_rad: std::f64::consts::FRAC_PI_2 },
    ];
    let world = TipWorld { force: Signal::harmonics(&sines).unwrap(), ..TipWorld::default() };
    follow("tip_force", Hybrid::at_rest(&two()).with_world(world).unwrap());
}

#[test]
fn a_payload_that_changes() {
    let (light, heavy, lighter) = (one(0.05), one(0.12), one(0.03));
    let changes = [(0.73, &heavy), (1.41, &lighter)];
    follow("payload", Hybrid::at_rest(&light).with_changes(&changes).unwrap());
}

/// A massless cantilever with a force at its end has there the slope 3/2·y/L.
#[test]
fn a_payload_that_turns_is_taken_up_as_the_beam_stands() {
    let (light, load) = (one(0.05), Payload { mass_kg: 0.02, inertia_kg_m2: 1e-5, offset_m: 0.01 });
    let heavy = LumpedBeam::new(light.beam().spans()).unwrap().with_payload(load).unwrap();
    let heavy = Arm::new(heavy, light.motor, light.coulomb).unwrap();
    let start = vec![0.1, 0.0, 0.3, 0.7];
    let changes = [(1e-12, &heavy), (2e-12, &light)];
    let mut hybrid = Hybrid::with_state(&light, start).with_changes(&changes).unwrap();
    hybrid.advance(0.0, 1e-12);
    let x = hybrid.state();
    assert_eq!(x.len(), 6);
    assert!((x[3] - (0.1 + 1.5 * 0.2)).abs() < 1e-10, "{x:?}");
    assert!((x[5] - 1.5 * 0.7).abs() < 1e-8, "{x:?}");
    hybrid.advance(0.0, 1e-12);
    assert_eq!(hybrid.state().len(), 4);
}

/// A beam that swings on a stuck joint, its torque just reaching what friction holds: the limit is
/// grazed, with no slope, once a swing. A torque that turns about at every sample chatters.
#[test]
fn grazing_and_chattering_come_to_an_end() {
    let base = one(0.05);
    let swing_rad = 0.4;
    let holds = base.dynamics().coupling_motor * swing_rad;
    for off in [0.0, 1e-16, -1e-16, 1e-13, -1e-13, 1e-9, -1e-9, 1e-4, -1e-4] {
        let coulomb = Coulomb::symmetric(holds * (1.0 + off)).unwrap();
        let beam = LumpedBeam::new(&[span(0.2, 0.005, 0.05, 0.0)]).unwrap();
        let arm = Arm::new(beam, base.motor, coulomb).unwrap();
        let held = HeldArm::new(&arm, &[3e-3]).unwrap().unwrap();
        for torque in [0.0, 0.5 * holds] {
            let start = vec![0.0, 0.0, swing_rad, 0.0];
            let mut by_events = Hybrid::with_state(&arm, start.clone());
            let mut by_modes = HeldMotion::with_state(&held, &start).unwrap();
            for k in 0..2000 {
                let torque = if k % 2 == 0 { torque } else { -torque };
                by_events.advance(torque, 3e-3);
                by_modes.advance(torque, 3e-3).unwrap();
            }
            let (a, b) = (by_events.state(), by_modes.state());
            assert!(
                a.iter().chain(b).all(|x| x.is_finite() && x.abs() < 10.0),
                "{off}: {a:?} {b:?}"
            );
            assert!(by_events.events() < 20_000, "{off}: {} events", by_events.events());
            // Beyond rounding of the limit both do the same.
            let apart = a.iter().zip(b).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
            assert!(off.abs() < 1e-9 || apart < 1e-6, "{off}, {torque}: apart by {apart:e}");
        }
    }
}

/// Both ran for ever: a stiff beam whose coupling torque rounds to more than friction's rounding, and
/// friction that falls within 1e-12 rad/s.
#[test]
fn stiff_beams_and_sharp_falls_come_to_an_end() {
    let beam = LumpedBeam::new(&[span(0.178, 3e3, 0.055, 0.0)]).unwrap();
    let arm = Arm::new(beam, Motor::new(6e-4, 1e-3, 1.0).unwrap(), coulomb()).unwrap();
    let mut hybrid = Hybrid::at_rest(&arm);
    for k in 0..300 {
        hybrid.advance(0.1 * (0.01 * f64::from(k)).sin(), 3e-3);
    }
    assert!(hybrid.state().iter().all(|x| x.is_finite()));
    let arm = one(0.05);
    for velocity in [1e-11, 1e-15] {
        let law = with_rest((0.05, 0.04), velocity, Falloff::Exponential);
        let mut hybrid = Hybrid::at_rest(&arm).with_friction(law);
        for k in 0..100 {
            // It either is followed or says that it is lost.
            if hybrid_step(&mut hybrid, 0.1 * (0.1 * f64::from(k)).sin()).is_err() {
                break;
            }
        }
    }
}

fn hybrid_step(hybrid: &mut Hybrid<'_>, torque: f64) -> Result<(), lissom::rig::RigError> {
    lissom::rig::Motion::advance(hybrid, torque, 3e-3)
}
