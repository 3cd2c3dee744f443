//! Settling is detected: against long simulations, on modes that no fixed wait suits.
#![expect(clippy::unwrap_used, reason = "tests")]

use std::f64::consts::TAU;

use lissom::arm::Arm;
use lissom::beam::{LumpedBeam, Payload, Span};
use lissom::drive::{Coulomb, Motor};
use lissom::rig::{Drive, Experiment, Logged, Pd, Pid, Reference, Rig, RigFinding, Settle, Start};
use lissom_testmodels::report_rig;

/// The report's arm at a third of its beam's frequency, 6.56 rad/s, which decays in 33 s.
const OMEGA: f64 = 2.19;
const AMPLITUDE_RAD: f64 = 0.5;
/// The default tolerance, in rad.
const ALLOWED_RAD: f64 = 1e-4 * AMPLITUDE_RAD;

/// A rig whose samples fit the period, so that rows of two logs have one phase.
fn fitting(mut rig: Rig, omega: f64) -> (Rig, usize) {
    let samples = (TAU / omega / 0.003).round();
    rig.instruments.sample_time_s = TAU / omega / samples;
    (rig, samples as usize)
}

fn one_period(omega: f64) -> Experiment {
    Experiment::sine(omega, AMPLITUDE_RAD, TAU / omega).unwrap()
}

/// Largest difference of angles between two logs of the same phase.
fn apart(a: &Logged, b: &Logged) -> f64 {
    let all = |l: &Logged| -> Vec<f64> {
        l.run.motor().iter().chain(l.run.tips().iter().flatten()).copied().collect()
    };
    all(a).iter().zip(all(b)).fold(0.0, |m, (a, b)| m.max((a - b).abs()))
}

/// The same log after `more` further periods.
fn later(
    rig: &Rig,
    samples: usize,
    experiment: &Experiment,
    settled: &Logged,
    more: usize,
) -> Logged {
    let t = rig.instruments.sample_time_s;
    let passed = (settled.settled.waited_s / t).round() as usize + more * samples;
    let wait = Settle::Wait { wait_s: passed as f64 * t };
    rig.run("later", &experiment.clone().settling(wait), 0).unwrap()
}

#[test]
fn a_mode_of_33_s_near_the_third_harmonic() {
    let (rig, samples) = fitting(report_rig(None), OMEGA);
    let experiment = one_period(OMEGA);
    let found = rig.run("detected", &experiment, 0).unwrap();
    let left = found.settled.left_rad.unwrap();
    assert!(found.findings.is_empty() && left <= ALLOWED_RAD);
    // 300 periods, twelve decays, later.
    let truth = later(&rig, samples, &experiment, &found, 300);
    let error = apart(&found, &truth);
    assert!(error <= left, "{error:.2e} rad is left, {left:.2e} were promised");
    // Nor is it far on the safe side: a decay or two at most.
    assert!(error > 0.05 * ALLOWED_RAD, "{error:.2e}");
    // A fixed wait that is ample at other frequencies is wrong by per cents here.
    let fixed = rig.run(
        "60 s",
        &experiment.clone().settling(Settle::Wait { wait_s: 21.0 * TAU / OMEGA }),
        0,
    );
    let fixed = apart(&fixed.unwrap(), &truth);
    assert!(fixed > 50.0 * ALLOWED_RAD, "{fixed:.2e}");
}

#[test]
fn samples_that_do_not_fit_the_period_delay_it_little() {
    let fitting = fitting(report_rig(None), OMEGA).0.run("fits", &one_period(OMEGA), 0).unwrap();
    let found = report_rig(None).run("3 ms", &one_period(OMEGA), 0).unwrap();
    assert!(found.findings.is_empty(), "{:?}", found.findings);
    let ratio = found.settled.waited_s / fitting.settled.waited_s;
    assert!((0.7..1.5).contains(&ratio), "{ratio}");
}

#[test]
fn twelve_bits_settle_to_a_step() {
    for omega in [OMEGA, 5.0, 20.0] {
        let found = report_rig(Some(12)).run("12 bits", &one_period(omega), 0).unwrap();
        assert!(found.findings.is_empty(), "{omega}: {:?}", found.findings);
        assert!((found.settled.tolerance_rad.unwrap() - TAU / 4096.0).abs() < 1e-12);
    }
}

#[test]
fn what_does_not_settle_in_time_is_said() {
    let short = Settle::Detected { tolerance: 1e-4, longest_s: 30.0 };
    let (rig, samples) = fitting(report_rig(None), OMEGA);
    let experiment = one_period(OMEGA).settling(short);
    let found = rig.run("short", &experiment, 0).unwrap();
    let [ref finding @ RigFinding::NotSettled { left_rad, tolerance_rad, waited_s }] =
        found.findings[..]
    else {
        panic!("{:?}", found.findings)
    };
    assert!((tolerance_rad - ALLOWED_RAD).abs() < 1e-12 && (waited_s - 30.0).abs() < 0.01);
    // The log begins within a period of the last look: at worst the bound holds all the same.
    let error = apart(&found, &later(&rig, samples, &experiment, &found, 300));
    assert!(error <= left_rad && error > 0.1 * left_rad, "{error:.2e} of {left_rad:.2e}");
    assert!(
        finding.to_string().starts_with("the transient had not decayed after 30.0 s"),
        "{finding}"
    );
    // Too short to look twice: nothing bounds it.
    let none = Settle::Detected { tolerance: 1e-4, longest_s: 1.0 };
    let found = rig.run("none", &one_period(OMEGA).settling(none), 0).unwrap();
    let [RigFinding::NotSettled { left_rad, .. }] = found.findings[..] else {
        panic!("{:?}", found.findings)
    };
    assert!(left_rad.is_infinite());
}

fn two_masses(damping_n_s_per_m: f64) -> Rig {
    let span = |length_m, mass_kg| Span {
        length_m,
        flexural_rigidity_n_m2: 0.02,
        mass_kg,
        damping_n_s_per_m: damping_n_s_per_m * mass_kg,
    };
    let beam = LumpedBeam::new(&[span(0.15, 0.06), span(0.15, 0.04)]).unwrap();
    let motor = Motor::new(8e-4, 2e-3, 0.3).unwrap();
    let arm = Arm::new(beam, motor, Coulomb::by_direction(0.05, 0.04).unwrap()).unwrap();
    Rig { arm, ..report_rig(None) }
}

#[test]
fn two_modes_and_friction_by_direction() {
    let (rig, samples) = fitting(two_masses(0.2), 4.0);
    let experiment = one_period(4.0);
    let found = rig.run("two", &experiment, 0).unwrap();
    assert!(found.findings.is_empty(), "{:?}", found.findings);
    let error = apart(&found, &later(&rig, samples, &experiment, &found, 200));
    let left = found.settled.left_rad.unwrap();
    assert!(error <= left, "{error:.2e} rad is left, {left:.2e} were promised");
}

#[test]
fn without_damping_the_decay_is_read_off() {
    // The loop alone takes the beam's energy.
    let (rig, samples) = fitting(two_masses(0.0), 4.0);
    let experiment =
        one_period(4.0).settling(Settle::Detected { tolerance: 1e-3, longest_s: 2000.0 });
    let found = rig.run("undamped", &experiment, 0).unwrap();
    assert!(found.findings.is_empty(), "{:?}", found.findings);
    let error = apart(&found, &later(&rig, samples, &experiment, &found, 1000));
    assert!(error <= 1e-3 * AMPLITUDE_RAD, "{error:.2e}");
}

#[test]
fn a_slow_integral_is_waited_for() {
    let (mut rig, samples) = fitting(report_rig(None), 5.0);
    // k_p/k_i = 80 s. Friction by direction: the integral has to find the offset.
    let arm = &rig.arm;
    rig.arm = Arm::new(arm.beam().clone(), arm.motor, Coulomb::by_direction(0.05, 0.01).unwrap())
        .unwrap();
    rig.controller = Pid::new(Pd::new(8.0, 0.2).unwrap(), 0.1).unwrap().into();
    let experiment = one_period(5.0);
    let found = rig.run("slow", &experiment, 0).unwrap();
    assert!(found.findings.is_empty(), "{:?}", found.findings);
    let error = apart(&found, &later(&rig, samples, &experiment, &found, 2000));
    assert!(error <= found.settled.left_rad.unwrap(), "{error:.2e}");
}

#[test]
fn an_open_drive_is_judged_by_what_it_moves() {
    let (rig, samples) = fitting(report_rig(None), 4.0);
    let drive = Drive::Current(Reference::sine(4.0, 0.6).unwrap());
    let experiment = Experiment::new(drive, TAU / 4.0).unwrap();
    let found = rig.run("open", &experiment, 0).unwrap();
    assert!(found.findings.is_empty(), "{:?}", found.findings);
    let truth = later(&rig, samples, &experiment, &found, 200);
    // Deflections: where the motor comes to turn about is its own affair.
    let bent = |l: &Logged| -> Vec<f64> {
        l.run.tips()[0].iter().zip(l.run.motor()).map(|(t, m)| t - m).collect()
    };
    let error =
        bent(&found).iter().zip(bent(&truth)).fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()));
    assert!(error <= found.settled.left_rad.unwrap(), "{error:.2e}");
}

#[test]
fn a_start_that_is_pushed_aside_is_waited_for_too() {
    let rig = report_rig(None);
    let hold = Experiment::new(Drive::Angle(Reference::hold(0.0).unwrap()), 3.0).unwrap();
    let pushed = hold.clone().starting(Start::Deflected { tip_force_n: 0.05 });
    let found = rig.run("waits", &pushed, 0).unwrap();
    // Friction holds the motor, and the beam rings for nine decays of 33 s.
    assert!((250.0..400.0).contains(&found.settled.waited_s), "{:?}", found.settled);
    let tip = &found.run.tips()[0];
    let rings = tip.iter().fold(f64::MIN, |m, q| m.max(*q)) - found.run.motor()[0];
    assert!(rings.abs() <= found.settled.left_rad.unwrap(), "{rings:.2e}");
    let at_rest = rig.run("at rest", &hold, 0).unwrap();
    assert!(
        at_rest.settled.waited_s.abs() < f64::MIN_POSITIVE && at_rest.settled.left_rad.is_none()
    );
}

#[test]
fn a_payload_that_turns_is_judged_by_coordinates() {
    let mut rig = two_masses(0.2);
    let payload = Payload { mass_kg: 0.02, inertia_kg_m2: 1e-5, offset_m: 0.01 };
    let beam = rig.arm.beam().clone().with_payload(payload).unwrap();
    rig.arm = Arm::new(beam, rig.arm.motor, rig.arm.coulomb).unwrap();
    let (rig, samples) = fitting(rig, 3.0);
    let experiment = one_period(3.0);
    let found = rig.run("payload", &experiment, 0).unwrap();
    assert!(found.findings.is_empty(), "{:?}", found.findings);
    let error = apart(&found, &later(&rig, samples, &experiment, &found, 200));
    assert!(error <= found.settled.left_rad.unwrap(), "{error:.2e}");
}

/// The loop is not linear, and the bound is a linear one: frequencies where the joint sticks for a
/// tenth of the cycle, near the beam's own and its halves, and fast ones.
#[test]
fn the_bound_holds_at_all_frequencies() {
    for omega in [1.0, 1.3, 1.7, 2.3, 3.28, 3.9, 5.1, 6.2, 7.0, 10.0, 30.0] {
        let (rig, samples) = fitting(report_rig(None), omega);
        let experiment = one_period(omega);
        let found = rig.run("found", &experiment, 0).unwrap();
        let left = found.settled.left_rad.unwrap();
        let periods = (400.0 * omega / TAU) as usize;
        let error = apart(&found, &later(&rig, samples, &experiment, &found, periods));
        let unsettled = |f: &RigFinding| matches!(f, RigFinding::NotSettled { .. });
        assert!(!found.findings.iter().any(unsettled), "{omega}: {:?}", found.findings);
        assert!(error <= left, "{omega}: {error:.2e} rad is left, {left:.2e} were promised");
    }
}
