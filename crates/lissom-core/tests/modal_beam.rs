//! A beam by its modes beside the beam of point masses that these modes are of.
#![expect(clippy::unwrap_used, reason = "tests")]

use lissom::arm::Arm;
use lissom::beam::{
    Base, BeamError, Damping, KnownMode, LumpedBeam, ModalBeam, Payload, Span, motor_poles,
};
use lissom::drive::{Coulomb, Motor};
use lissom::rig::{Experiment, Rig, RigError, Settle, Signal, TipWorld};
use lissom_testmodels::report_rig;
use num_complex::Complex64;

/// α of the damping proportional to mass: in every mode the same rate against the frame.
const ALPHA: f64 = 0.7;

fn lumped(damping: Damping) -> LumpedBeam {
    let span = |length_m, mass_kg| Span {
        length_m,
        flexural_rigidity_n_m2: 0.02,
        mass_kg,
        damping_n_s_per_m: 0.0,
    };
    LumpedBeam::new(&[span(0.2, 0.05), span(0.25, 0.03), span(0.15, 0.06)])
        .unwrap()
        .with_damping(damping)
        .unwrap()
}

fn proportional(mass_per_s: f64) -> Damping {
    Damping::Proportional { mass_per_s, stiffness_s: 0.0 }
}

fn known(beam: &LumpedBeam, mass_per_s: f64) -> Vec<KnownMode> {
    let mode = |m: lissom::beam::Mode| KnownMode {
        omega_rad_s: m.natural_frequency_rad_s,
        damping_ratio: 0.5 * mass_per_s / m.natural_frequency_rad_s,
        coupling_nm_per_rad: m.inertia_kg_m2 * m.natural_frequency_rad_s.powi(2),
        gains: m.share,
    };
    beam.modes(usize::MAX).into_iter().map(mode).collect()
}

fn pair(mass_per_s: f64) -> (LumpedBeam, ModalBeam) {
    let beam = lumped(proportional(mass_per_s));
    let modal = ModalBeam::new(known(&beam, mass_per_s)).unwrap();
    (beam, modal)
}

fn motor() -> Motor {
    Motor::new(1.1e-3, 0.02, 0.25).unwrap()
}

/// Largest distance of each root to the nearest of the others, relative.
fn apart(a: &[Complex64], b: &[Complex64]) -> f64 {
    assert_eq!(a.len(), b.len(), "{a:?} {b:?}");
    let size = b.iter().fold(0.0_f64, |m, s| m.max(s.norm()));
    let nearest = |z: &Complex64| {
        b.iter().map(|s| (s - z).norm() / s.norm().max(1e-9 * size)).fold(f64::INFINITY, f64::min)
    };
    a.iter().map(nearest).fold(0.0, f64::max)
}

#[test]
fn responses_and_roots_are_those_of_the_beam() {
    for alpha in [0.0, ALPHA] {
        let (beam, modal) = pair(alpha);
        for omega in [0.3, 4.0, 17.0, 61.0, 300.0] {
            let s = Complex64::new(0.0, omega);
            let (a, b) = (beam.response(s), modal.response(s));
            for (a, b) in a.angles.iter().zip(&b.angles) {
                assert!((a - b).norm() < 1e-10 * b.norm(), "{a} {b}");
            }
            let size = b.coupling_nm_per_rad.norm();
            assert!((a.coupling_nm_per_rad - b.coupling_nm_per_rad).norm() < 1e-10 * size);
        }
        assert!((modal.inertia_kg_m2() / beam.inertia_kg_m2() - 1.0).abs() < 1e-12);
        for base in [Base::Clamped, Base::Pinned, Base::Rotor(2e-3)] {
            let (a, b) = (beam.frequencies_rad_s(base, 9), modal.frequencies_rad_s(base, 9));
            assert_eq!(a.len(), b.len(), "{base:?}");
            assert!(a.iter().zip(&b).all(|(a, b)| (a / b - 1.0).abs() < 1e-11), "{a:?} {b:?}");
        }
        assert!(apart(&modal.poles().s, &beam.poles().s) < 1e-11);
        assert!(apart(&modal.motor_poles(&motor()).s, &motor_poles(&beam, &motor()).s) < 1e-9);
        for i in 0..3 {
            let (a, b) = (modal.angle_function(i).unwrap(), beam.angle_function(i).unwrap());
            assert!(apart(&a.zeros, &b.zeros) < 1e-9, "{:?} {:?}", a.zeros, b.zeros);
            assert!((a.gain / b.gain - 1.0).abs() < 1e-8 && a.missing == 0);
        }
        let (a, b) = (modal.coupling_function(), beam.coupling_function());
        assert!(apart(&a.zeros, &b.zeros) < 1e-9, "{:?} {:?}", a.zeros, b.zeros);
        assert!((a.gain / b.gain - 1.0).abs() < 1e-8, "{} {}", a.gain, b.gain);
        assert!(modal.angle_function(3).is_none());
    }
}

#[test]
fn its_matrices_are_those_of_the_beam() {
    let (beam, modal) = pair(ALPHA);
    let friction = Coulomb::symmetric(0.03).unwrap();
    let a = Arm::new(beam, motor(), friction).unwrap();
    let b = Arm::new(modal, motor(), friction).unwrap();
    let (a, b) = (a.dynamics(), b.dynamics());
    assert!((&a.elastic - &b.elastic).amax() < 1e-10 * a.elastic.amax());
    assert!((&a.coupling - &b.coupling).amax() < 1e-10 * a.coupling.amax());
    let (a, b) = (a.absolute.as_ref().unwrap(), b.absolute.as_ref().unwrap());
    assert!((a - b).amax() < 1e-11 * a.amax());
}

/// The report's loop with another arm in it, without sensors' steps.
fn rig(arm: Arm) -> Rig {
    Rig { arm, ..report_rig(None) }
}

fn sine(record_s: f64) -> Experiment {
    Experiment::sine(6.0, 0.3, record_s).unwrap().settling(Settle::Wait { wait_s: 1.0 })
}

#[test]
fn the_rig_moves_it_as_the_beam() {
    let (beam, modal) = pair(ALPHA);
    let friction = Coulomb::symmetric(0.03).unwrap();
    let run = |arm: Arm| rig(arm).run("sine", &sine(4.0), 1).unwrap().run;
    let a = run(Arm::new(beam, motor(), friction).unwrap());
    let b = run(Arm::new(modal, motor(), friction).unwrap());
    let off =
        |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(a.motor().iter().any(|x| x.abs() > 0.2));
    assert!(off(a.motor(), b.motor()) < 1e-9, "{}", off(a.motor(), b.motor()));
    assert!(off(a.command(), b.command()) < 1e-6);
}

#[test]
fn nothing_acts_at_its_tip() {
    let (_, modal) = pair(0.0);
    let arm = Arm::new(modal, motor(), Coulomb::symmetric(0.03).unwrap()).unwrap();
    let payload = Payload { mass_kg: 0.1, ..Payload::default() };
    assert_eq!(arm.beam().clone().with_payload(payload).unwrap_err(), BeamError::NoTip);
    let mut rig = rig(arm);
    rig.scene.tip = TipWorld { force: Signal::constant(1.0).unwrap(), ..TipWorld::default() };
    let failed = rig.run("sine", &sine(1.0), 1).unwrap_err();
    assert!(matches!(failed, RigError::Unsupported { .. }), "{failed}");
}

#[test]
fn numbers_that_make_no_beam_are_refused() {
    let modes = known(&lumped(Damping::None), 0.0);
    let with = |change: &dyn Fn(&mut Vec<KnownMode>)| {
        let mut modes = modes.clone();
        change(&mut modes);
        ModalBeam::new(modes).unwrap_err()
    };
    assert_eq!(with(&|m| m.clear()), BeamError::NoModes);
    let few = with(&|m| m[1].gains.truncate(2));
    assert_eq!(few, BeamError::ModesAndPoints { mode: 2, points: 2, modes: 3 });
    let slack = with(&|m| m[2].coupling_nm_per_rad = 0.0);
    assert!(matches!(slack, BeamError::KnownMode { mode: 3, .. }), "{slack}");
    let strained = with(&|m| m[0].gains[1] += 0.1);
    assert!(matches!(strained, BeamError::GainsSum { point: 2, .. }), "{strained}");
    let alike = with(&|m| m.iter_mut().for_each(|m| m.gains[1] = m.gains[0]));
    assert!(matches!(alike, BeamError::PointsTooClose { .. }), "{alike}");
}
