//! Friction that grows with speed and load, and torque ripple, in the rig: against an integrator of its own and closed forms.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use lissom::arm::Arm;
use lissom::beam::{Beam, LumpedBeam, Span};
use lissom::drive::{Coulomb, DryFriction, LuGre, Motor};
use lissom::load::{GravityLoad, PositionTorque, TorqueRipple};
use lissom::replay::{ROOT_SPEED_RAD_S, ROUNDED_LOAD_SHARE};
use lissom::rig::{Hybrid, LuGreMotion};

/// J \[kg·m²\], V \[N·m·s/rad\] and Coulomb friction \[N·m\] of the joint.
const INERTIA: f64 = 0.02;
const VISCOUS: f64 = 0.03;
const COULOMB: f64 = 0.1;
/// Step of the integrator \[s\]: its error of order 4 is below rounding of the comparison.
const STEP_S: f64 = 1e-5;

fn joint(coulomb: f64) -> Arm {
    let motor = Motor::new(INERTIA, VISCOUS, 1.0).unwrap();
    Arm::new(Beam::Rigid, motor, Coulomb::symmetric(coulomb).unwrap()).unwrap()
}

/// The end of a motion without a reversal, by the Runge-Kutta method of order 4.
fn integrated(mut x: [f64; 2], steps: usize, acceleration: impl Fn(f64, f64) -> f64) -> [f64; 2] {
    let h = STEP_S;
    let rate = |x: [f64; 2]| [x[1], acceleration(x[0], x[1])];
    let moved = |x: [f64; 2], k: [f64; 2], h: f64| [x[0] + h * k[0], x[1] + h * k[1]];
    for _ in 0..steps {
        let a = rate(x);
        let b = rate(moved(x, a, 0.5 * h));
        let c = rate(moved(x, b, 0.5 * h));
        let d = rate(moved(x, c, h));
        x = [0, 1].map(|i| x[i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]));
    }
    x
}

fn near(found: &[f64], wanted: [f64; 2], most: f64) {
    for (found, wanted) in found.iter().zip(wanted) {
        assert!((found - wanted).abs() < most, "{found} {wanted}");
    }
}

const LOAD: GravityLoad = GravityLoad { sine_nm: 1.5, cosine_nm: 0.5 };
const RIPPLE: TorqueRipple = TorqueRipple { per_rad: 7.0, cosine_nm: 0.05, sine_nm: -0.08 };

/// Torque that the motor has to supply at an angle and a velocity.
type Torque<'a> = &'a dyn Fn(f64, f64) -> f64;

#[test]
fn a_joint_with_each_term_moves_as_an_integrator_says() {
    let arm = joint(COULOMB);
    let dry = || DryFriction::from(arm.coulomb);
    let root = |v: f64| 0.2 * ((v + ROOT_SPEED_RAD_S).sqrt() - ROOT_SPEED_RAD_S.sqrt());
    let rounded = ROUNDED_LOAD_SHARE * LOAD.amplitude_nm();
    let load = |q: f64| 0.06 * LOAD.torque_nm(q).hypot(rounded);
    let cases: [(Hybrid<'_>, Torque<'_>); 3] = [
        (
            Hybrid::with_state(&arm, vec![0.2, 1.0]).with_friction(dry().with_root(0.2).unwrap()),
            &|_, v| root(v),
        ),
        (
            // It passes the angle at which the load changes its sign.
            Hybrid::with_state(&arm, vec![-0.6, 1.0])
                .with_friction(dry().with_load(0.06, LOAD).unwrap())
                .with_gravity(LOAD),
            &|q, _| load(q) + LOAD.torque_nm(q),
        ),
        (Hybrid::with_state(&arm, vec![0.2, 1.0]).with_torque_ripples(&[RIPPLE]), &|q, _| {
            RIPPLE.torque_nm(q)
        }),
    ];
    for (mut hybrid, torque) in cases {
        let start = [hybrid.state()[0], hybrid.state()[1]];
        let driven = 1.6;
        (0..100).for_each(|_| hybrid.advance(driven, 2e-3));
        let end = integrated(start, 20_000, |q, v| {
            (driven - VISCOUS * v - COULOMB - torque(q, v)) / INERTIA
        });
        near(hybrid.state(), end, 1e-9);
    }
}

/// The joint stops by itself: from v_0 under friction F + A·√v it takes the time and the way of the closed form, with
/// u = √v: t = J·∫ 2u/(F + A·u) du.
#[test]
fn a_joint_comes_to_rest_and_starts_under_the_root_of_speed() {
    let (friction, growth, v0) = (0.1, 0.2, 4.0_f64);
    let motor = Motor::new(INERTIA, 0.0, 1.0).unwrap();
    let arm = Arm::new(Beam::Rigid, motor, Coulomb::symmetric(friction).unwrap()).unwrap();
    let law = DryFriction::from(arm.coulomb).with_root(growth).unwrap();
    let u = v0.sqrt();
    let ratio = friction / growth;
    let stop_s = 2.0 * INERTIA / growth * (u - ratio * (1.0 + u / ratio).ln());
    let mut hybrid = Hybrid::with_state(&arm, vec![0.0, -v0]).with_friction(law.clone());
    let time_s = hybrid.advance_to_event(0.0, 10.0);
    // The law is less than A·√v by 1e-4·A at most.
    assert!((time_s / stop_s - 1.0).abs() < 1e-3, "{time_s} {stop_s}");
    assert!(hybrid.state()[1] == 0.0 && hybrid.sticks() == 1);
    // It rests under a torque below F, and starts above it.
    hybrid.advance(0.099, 1.0);
    let rest = hybrid.state()[0];
    hybrid.advance(0.15, 0.05);
    assert!(hybrid.state()[0] > rest);
    let end = integrated([rest, 1e-12], 5_000, |_, v| {
        let v = v.max(0.0) + ROOT_SPEED_RAD_S;
        (0.15 - friction - growth * (v.sqrt() - ROOT_SPEED_RAD_S.sqrt())) / INERTIA
    });
    near(hybrid.state(), end, 1e-6);
}

/// Energy of a swing in the torque ripple of a joint without friction, `J·v²/2 + (B·sin kθ − C·cos kθ)/k`, does not change.
#[test]
fn torque_ripple_keeps_energy_and_holds_a_joint_with_friction() {
    let motor = Motor::new(INERTIA, 0.0, 1.0).unwrap();
    let free = Arm::new(Beam::Rigid, motor, Coulomb::symmetric(0.0).unwrap()).unwrap();
    let energy = |x: &[f64]| {
        let (sin, cos) = (RIPPLE.per_rad * x[0]).sin_cos();
        let stored = (RIPPLE.cosine_nm * sin - RIPPLE.sine_nm * cos) / RIPPLE.per_rad;
        0.5 * INERTIA * x[1] * x[1] + stored
    };
    let mut hybrid = Hybrid::with_state(&free, vec![0.1, 0.5]).with_torque_ripples(&[RIPPLE]);
    let before = energy(hybrid.state());
    hybrid.advance(0.0, 20.0);
    assert!((energy(hybrid.state()) - before).abs() < 1e-12, "{before}");
    // At rest it acts, too: it moves a joint whose friction is less, and holds no other.
    for (coulomb, moves) in [(0.045, true), (0.055, false)] {
        let arm = joint(coulomb);
        let mut hybrid = Hybrid::at_rest(&arm).with_torque_ripples(&[RIPPLE]);
        hybrid.advance(0.0, 1.0);
        assert_eq!(hybrid.state()[0] < 0.0, moves, "{coulomb}");
    }
}

/// Stiff bristles come near to Coulomb's law, and a beam does not change how the ripple acts on the motor.
#[test]
fn torque_ripple_acts_on_bristles_and_on_a_motor_with_a_beam() {
    let arm = joint(COULOMB);
    let law = LuGre::new(4e5, 1.0, arm.coulomb, arm.coulomb, 0.1).unwrap();
    let ripple = PositionTorque::new(None, &[RIPPLE]);
    let bristles = LuGreMotion::at_rest(&arm, law, 1e-9).unwrap();
    let mut bristles = bristles.with_position_torque(ripple);
    let mut hybrid = Hybrid::at_rest(&arm).with_torque_ripples(&[RIPPLE]);
    for _ in 0..200 {
        bristles.advance(0.3, 2e-3).unwrap();
        hybrid.advance(0.3, 2e-3);
    }
    assert!(hybrid.state()[0] > 0.3);
    near(bristles.state(), [hybrid.state()[0], hybrid.state()[1]], 2e-3);
    let span = Span {
        length_m: 0.2,
        flexural_rigidity_n_m2: 400.0,
        mass_kg: 0.05,
        damping_n_s_per_m: 0.0,
    };
    let beam = LumpedBeam::new(&[span]).unwrap();
    let whole = INERTIA;
    let motor = Motor::new(whole - 0.05 * 0.04, VISCOUS, 1.0).unwrap();
    let flexible = Arm::new(beam, motor, arm.coulomb).unwrap();
    let mut stiff = Hybrid::at_rest(&flexible).with_torque_ripples(&[RIPPLE]);
    (0..200).for_each(|_| stiff.advance(0.3, 2e-3));
    near(stiff.state(), [hybrid.state()[0], stiff.state()[1]], 1e-3);
}
