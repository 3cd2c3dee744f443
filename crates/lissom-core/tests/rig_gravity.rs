//! Gravity of an unbalanced load in the rig: against closed forms, an integrator of its own, and a balance of energy.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::f64::consts::{PI, TAU};

use lissom::arm::Arm;
use lissom::beam::Beam;
use lissom::drive::{Coulomb, DryFriction, LuGre, Motor};
use lissom::load::GravityLoad;
use lissom::rig::{
    Drive, Experiment, Hybrid, Instruments, JointFriction, LuGreMotion, Pd, Reference, Rig,
    RigError, Scene, Settle, Start,
};

/// J of all arms here \[kg·m²\].
const INERTIA: f64 = 0.02;
/// m·g·l of all loads here \[N·m\].
const MGL: f64 = 2.0;
/// Largest error of an angle of order one that is rounding and the series' last terms, over seconds of motion \[rad\].
const ROUNDING_RAD: f64 = 1e-10;

fn rigid(viscous: f64, coulomb: f64) -> Arm {
    let motor = Motor::new(INERTIA, viscous, 1.0).unwrap();
    Arm::new(Beam::Rigid, motor, Coulomb::symmetric(coulomb).unwrap()).unwrap()
}

/// A loop of 2 ms on an arm with the load `mgl·sin(θ + φ)`.
fn loaded(arm: Arm, phase_rad: f64) -> Rig {
    let pd = Pd::new(20.0, 1.5).unwrap();
    let mut rig = Rig::new(arm, Instruments::ideal(0.002).unwrap(), pd.into());
    rig.scene.gravity = Some(GravityLoad::of_amplitude(MGL, phase_rad));
    rig
}

/// Arithmetic-geometric mean.
fn agm(mut a: f64, mut b: f64) -> f64 {
    for _ in 0..40 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    a
}

/// The period of a pendulum of amplitude θ0 is `2π·√(J/mgl)/agm(1, cos θ0/2)` (Gauss).
#[test]
fn a_pendulum_comes_back_after_its_period() {
    let arm = rigid(0.0, 0.0);
    for (amplitude, phase) in [(1e-3, 0.0), (0.5, 0.3), (1.5, 0.0), (2.5, -2.0), (3.1, 0.0)] {
        let load = GravityLoad::of_amplitude(MGL, phase);
        let period_s = TAU * (INERTIA / MGL).sqrt() / agm(1.0, (0.5_f64 * amplitude).cos());
        let start = amplitude - phase;
        let mut hybrid = Hybrid::with_state(&arm, vec![start]).with_gravity(load);
        hybrid.advance(0.0, 0.5 * period_s);
        let other = -amplitude - phase;
        assert!((hybrid.state()[0] - other).abs() < ROUNDING_RAD, "{:?}", hybrid.state());
        hybrid.advance(0.0, 2.5 * period_s);
        assert!((hybrid.state()[0] - start).abs() < ROUNDING_RAD, "{:?}", hybrid.state());
    }
}

#[test]
fn a_pendulum_keeps_its_energy() {
    let arm = rigid(0.0, 0.0);
    let load = GravityLoad::of_amplitude(MGL, 0.7);
    // Swinging, and going round.
    for speed in [15.0, 25.0] {
        let energy = |x: &[f64]| 0.5 * INERTIA * x[1] * x[1] - MGL * (x[0] + 0.7).cos();
        let mut hybrid = Hybrid::with_state(&arm, vec![0.2, speed]).with_gravity(load);
        let before = energy(hybrid.state());
        let swings = 0.5 * INERTIA * speed * speed;
        for _ in 0..10_000 {
            hybrid.advance(0.0, 2e-3);
            let after = energy(hybrid.state());
            assert!((after - before).abs() < 1e-12 * swings, "{after} {before}");
        }
    }
}

/// What the motor gives, less what friction takes, is what the load gains.
#[test]
fn friction_takes_its_share_of_the_energy() {
    let (coulomb, torque) = (0.3, 1.0);
    let arm = rigid(0.0, coulomb);
    let load = GravityLoad::of_amplitude(MGL, 0.0);
    let mut hybrid = Hybrid::with_state(&arm, vec![-1.0]).with_gravity(load);
    let time_s = hybrid.advance_to_event(torque, 10.0);
    assert!(time_s > 0.0);
    // The first event lets it go, the next one is its first stop.
    hybrid.advance_to_event(torque, 10.0);
    let (from, to) = (-1.0_f64, hybrid.state()[0]);
    let gained = MGL * (from.cos() - to.cos());
    let given = (torque - coulomb) * (to - from);
    assert!(to > 0.5 && (gained - given).abs() < 1e-12, "{to}: {gained} {given}");
}

#[test]
fn friction_holds_a_load_up_to_its_limit() {
    let arm = rigid(0.01, 0.5);
    let load = GravityLoad::of_amplitude(MGL, 0.0);
    let slides = (0.5_f64 / MGL).asin();
    let at = |angle: f64, torque: f64| {
        let mut hybrid = Hybrid::with_state(&arm, vec![angle]).with_gravity(load);
        hybrid.advance(torque, 1e-3);
        hybrid.state()[0] - angle
    };
    assert!(at(slides - 1e-9, 0.0) == 0.0 && at(1e-9 - slides, 0.0) == 0.0);
    assert!(at(slides + 1e-6, 0.0) < 0.0 && at(-slides - 1e-6, 0.0) > 0.0);
    // A motor holds as much as it gives.
    assert!(at(0.5 * PI, MGL) == 0.0 && at(0.5 * PI, MGL + 0.4999) == 0.0);
    assert!(at(0.5 * PI, MGL + 0.5001) > 0.0 && at(0.5 * PI, MGL - 0.5001) < 0.0);
}

/// θ and θ̇ of a joint by the classical Runge-Kutta method, stops found by halving the step.
struct Joint {
    viscous: f64,
    coulomb: f64,
    load: GravityLoad,
    x: [f64; 2],
}

impl Joint {
    fn rate(&self, x: [f64; 2], torque: f64, direction: f64) -> [f64; 2] {
        let net = torque
            - self.viscous * x[1]
            - direction * self.coulomb
            - self.load.sine_nm * x[0].sin()
            - self.load.cosine_nm * x[0].cos();
        [x[1], net / INERTIA]
    }

    fn stepped(&self, torque: f64, direction: f64, h: f64) -> [f64; 2] {
        let to = |k: [f64; 2], h: f64| [self.x[0] + h * k[0], self.x[1] + h * k[1]];
        let k1 = self.rate(self.x, torque, direction);
        let k2 = self.rate(to(k1, 0.5 * h), torque, direction);
        let k3 = self.rate(to(k2, 0.5 * h), torque, direction);
        let k4 = self.rate(to(k3, h), torque, direction);
        [0, 1].map(|i| self.x[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]))
    }

    fn advance(&mut self, torque: f64, duration_s: f64, steps: usize) {
        let mut left = duration_s;
        let most = duration_s / steps as f64;
        while left > 1e-15 {
            let h = most.min(left);
            let net = INERTIA * self.rate([self.x[0], 0.0], torque, 0.0)[1];
            let direction = if self.x[1] == 0.0 {
                if net.abs() <= self.coulomb {
                    // At rest nothing changes while the torque is held.
                    return;
                }
                net.signum()
            } else {
                self.x[1].signum()
            };
            let next = self.stepped(torque, direction, h);
            if next[1] * direction >= 0.0 {
                self.x = next;
                left -= h;
                continue;
            }
            let (mut low, mut high) = (0.0, h);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if self.stepped(torque, direction, middle)[1] * direction >= 0.0 {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            self.x = [self.stepped(torque, direction, low)[0], 0.0];
            left -= high;
        }
    }
}

/// Of 5 s in a loop: slowly, where the joint sticks at each turn, and fast, where it turns at once.
#[test]
fn a_loop_with_friction_and_gravity_is_that_of_another_integrator() {
    let (viscous, coulomb) = (0.05, 0.4);
    let rig = loaded(rigid(viscous, coulomb), 0.6);
    for (omega, amplitude, sticks) in [(3.0, 1.2, true), (20.0, 0.2, false)] {
        let sine = Experiment::sine(omega, amplitude, 5.0).unwrap().settling(Settle::AtOnce);
        let logged = rig.run("sine", &sine, 1).unwrap();
        let mut joint = Joint { viscous, coulomb, load: rig.scene.gravity.unwrap(), x: [0.0, 0.0] };
        let mut most = 0.0_f64;
        for (current, angle) in logged.run.command().iter().zip(logged.run.motor()) {
            most = most.max((joint.x[0] - angle).abs());
            joint.advance(*current, 0.002, 20);
        }
        assert_eq!(logged.stuck_share > 0.01, sticks, "{}", logged.stuck_share);
        assert!(most < 1e-9, "{most}");
    }
}

/// A PD loop lets a load sag by `mgl·cos θ/k`; the log begins when the sagging is over.
#[test]
fn the_rig_waits_until_a_load_has_sagged() {
    let rig = loaded(rigid(0.05, 0.0), 0.5 * PI);
    let hold = Experiment::new(Drive::Angle(Reference::hold(0.0).unwrap()), 1.0).unwrap();
    let logged = rig.run("hold", &hold, 1).unwrap();
    assert!(logged.settled.waited_s > 0.0);
    for angle in logged.run.motor() {
        assert!((20.0 * angle + MGL * angle.cos()).abs() < 1e-3, "{angle}");
    }
    // One that rests on its friction need not be waited for.
    let rubbing = loaded(rigid(0.05, 2.5), 0.5 * PI);
    assert!(rubbing.run("hold", &hold, 1).unwrap().settled.waited_s.abs() < 1e-12);
}

/// Errors fall with the tolerance, and the stiffer the bristles, the nearer they come to Coulomb's law.
#[test]
fn bristles_carry_a_load() {
    let friction = Coulomb::symmetric(0.4).unwrap();
    let arm = rigid(0.05, 0.4);
    let load = GravityLoad::of_amplitude(MGL, 0.6);
    let torque = |k: u32| 2.6 * (0.03 * f64::from(k)).sin() + 1.0;
    let by_bristles = |stiffness: f64, tolerance: f64| {
        let law = LuGre::new(stiffness, 1.0, friction, friction, 0.1).unwrap();
        let motion = LuGreMotion::at_rest(&arm, law, tolerance).unwrap();
        let mut motion = motion.with_gravity(load);
        let moved = |k| {
            motion.advance(torque(k), 2e-3).unwrap();
            motion.state()[0]
        };
        (0..1000).map(moved).collect::<Vec<f64>>()
    };
    let mut hybrid = Hybrid::at_rest(&arm).with_gravity(load);
    let moved = |k| {
        hybrid.advance(torque(k), 2e-3);
        hybrid.state()[0]
    };
    let by_law: Vec<f64> = (0..1000).map(moved).collect();
    let largest =
        |a: &[f64], b: &[f64]| a.iter().zip(b).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
    assert!(largest(&by_law, &[0.0; 1000]) > 0.5);
    let exact = by_bristles(4e4, 1e-11);
    let off = |tolerance| largest(&by_bristles(4e4, tolerance), &exact);
    assert!(off(1e-6) < 1e-4 && off(1e-8) < 5e-6, "{} {}", off(1e-6), off(1e-8));
    let soft = largest(&exact, &by_law);
    let stiff = largest(&by_bristles(4e5, 1e-9), &by_law);
    assert!(soft < 2e-3 && stiff < 0.5 * soft, "{soft} {stiff}");
}

/// Without a load a rigid joint moves by matrices, with one by the event engine.
#[test]
fn a_rigid_joint_without_a_load_is_the_same_by_every_engine() {
    let mut rig = loaded(rigid(0.05, 0.4), 0.0);
    let sine = Experiment::sine(6.0, 0.5, 4.0).unwrap();
    let angles = |rig: &Rig| rig.run("sine", &sine, 1).unwrap().run.motor().to_vec();
    rig.scene = Scene::default();
    let held = angles(&rig);
    rig.scene.friction = JointFriction::Dry(DryFriction::from(rig.arm.coulomb));
    let by_events = angles(&rig);
    rig.scene.gravity = Some(GravityLoad { sine_nm: 0.0, cosine_nm: 0.0 });
    let with_none = angles(&rig);
    for ((a, b), c) in held.iter().zip(&by_events).zip(&with_none) {
        assert!((a - b).abs() < ROUNDING_RAD && (a - c).abs() < ROUNDING_RAD, "{a} {b} {c}");
    }
}

#[test]
fn what_a_rigid_joint_has_not_is_refused() {
    let rig = loaded(rigid(0.05, 0.4), 0.0);
    let release =
        Experiment::sine(6.0, 0.5, 4.0).unwrap().starting(Start::Deflected { tip_force_n: 1.0 });
    let error = rig.run("release", &release, 1).unwrap_err();
    assert!(matches!(error, RigError::Unsupported { .. }), "{error}");
    let mut infinite = rig;
    infinite.scene.gravity = Some(GravityLoad { sine_nm: f64::NAN, cosine_nm: 0.0 });
    let sine = Experiment::sine(6.0, 0.5, 4.0).unwrap();
    let error = infinite.run("sine", &sine, 1).unwrap_err();
    assert!(matches!(error, RigError::NotFinite { .. }), "{error}");
}
