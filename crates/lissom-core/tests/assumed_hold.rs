//! Logs of steps with a noisy current or a coarse encoder, of which nobody says whether the current is held.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use lissom::identify::{
    Effort, Finding, HoldEvidence, Options, Prepared, hold_shown, identify, motor_regression,
};
use lissom::record::{Axis, Campaign, Channels, Command, CommandQuantity, Hold, Run, TimeBase};
use lissom_testmodels::{RigidJoint, RigidLog};
use rand_distr::{Distribution as _, StandardNormal};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng as _;

const SAMPLE_S: f64 = 2e-3;

fn joint() -> RigidJoint {
    RigidJoint { sample_time_s: SAMPLE_S, ..RigidJoint::default() }
}

/// Twenty seconds of steps of 1 rad.
fn steps() -> RigidLog {
    joint().follow(10_000, |t| if t % 2.0 < 1.0 { 0.0 } else { 1.0 })
}

fn campaign(command: &[f64], angle: Vec<f64>, hold: Hold) -> Campaign {
    let base = TimeBase::uniform(0.0, SAMPLE_S);
    let run = Run::new("steps", base, command.to_vec(), angle, vec![]).unwrap();
    let command = Command {
        quantity: CommandQuantity::Current,
        hold,
        torque_per_command: Some(1.0),
        back_emf_viscous: 0.0,
        limit: None,
    };
    Campaign::new(Channels { axis: Axis::Rotary, command, tips: vec![] }, vec![run]).unwrap()
}

/// Readings with noise of these standard deviations.
fn noisy(command: &[f64], angle: &[f64], noise: [f64; 2], seed: u64) -> Campaign {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
    let mut normal = |size: f64| -> f64 {
        let unit: f64 = StandardNormal.sample(&mut random);
        size * unit
    };
    let command: Vec<f64> = command.iter().map(|u| u + normal(noise[0])).collect();
    let angle = angle.iter().map(|q| q + normal(noise[1])).collect();
    Campaign { hold_assumed: true, ..campaign(&command, angle, Hold::Measured) }
}

/// An encoder of so many counts a turn.
fn coarse(log: &RigidLog, counts: f64) -> Vec<f64> {
    let step = std::f64::consts::TAU / counts;
    log.angle.iter().map(|q| (q / step).round() * step).collect()
}

fn codes(campaign: &Campaign) -> Vec<&'static str> {
    let options = Options { effort: Effort::Quick, ..Options::default() };
    let found = identify(campaign, &options, |_| ()).unwrap();
    found.findings.iter().map(Finding::code).collect()
}

#[test]
fn steps_with_noise_show_that_the_command_is_held() {
    let log = steps();
    for seed in 0..4 {
        let shown = hold_shown(&noisy(&log.held, &log.angle, [0.05, 1e-3], seed)).unwrap();
        assert_eq!(shown.hold, Hold::Sampled, "{seed}: {shown:?}");
        if let HoldEvidence::Viscous { held, .. } = shown.by {
            assert!((held.value - joint().viscous).abs() < 4.0 * held.std, "{seed}: {held:?}");
        }
    }
}

#[test]
fn a_measured_command_of_steps_is_not_taken_as_held() {
    let log = steps();
    for seed in 0..4 {
        let shown = hold_shown(&noisy(&log.measured, &log.angle, [0.1, 0.003], seed));
        assert!(shown.is_none_or(|shown| shown.hold == Hold::Measured), "{seed}: {shown:?}");
    }
}

#[test]
fn what_depends_on_an_assumed_hold_is_reported_and_on_a_stated_one_not() {
    let log = steps();
    let assumed = noisy(&log.held, &log.angle, [0.1, 0.003], 5);
    assert!(codes(&assumed).contains(&"hold-assumed"));
    let stated = Campaign { hold_assumed: false, ..assumed };
    assert!(!codes(&stated).contains(&"hold-assumed"));
}

#[test]
fn an_assumed_hold_that_changes_nothing_is_not_reported() {
    let smooth = |t: f64| 1.5 * (1.3 * t).sin() + 0.5 * (4.1 * t).sin();
    let log = joint().follow(10_000, smooth);
    let assumed = noisy(&log.measured, &log.angle, [0.02, 1e-3], 6);
    assert!(!codes(&assumed).contains(&"hold-assumed"));
}

#[test]
fn a_coarse_encoder_is_no_lag_of_the_angle() {
    let log = steps();
    for counts in [1024.0, 4096.0, 16_384.0, 65_536.0] {
        let campaign = campaign(&log.held, coarse(&log, counts), Hold::Sampled);
        let found = motor_regression(&Prepared::of(&campaign), &Options::default()).unwrap();
        assert!(!codes(&campaign).contains(&"angle-lag"), "{counts}");
        let inertia = found.inertia.unwrap();
        assert!((inertia.value - joint().inertia).abs() < 4.0 * inertia.std, "{counts}: {inertia}");
        assert!(counts < 4000.0 || inertia.std < 0.02 * joint().inertia, "{counts}: {inertia}");
    }
}
