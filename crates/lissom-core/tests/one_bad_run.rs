//! One run among several that is unlike the others: found, named, left out.

#![expect(clippy::unwrap_used, reason = "tests")]

use lissom::identify::findings::{Channel, rows};
use lissom::identify::{Effort, Estimate, Identified, Options, RunDifference, identify};
use lissom::record::{Axis, Campaign, Channels, Command, CommandQuantity, Hold, Run, TimeBase};
use lissom_testmodels::{RigidJoint, RigidLog};

const TAU: f64 = std::f64::consts::TAU;
const RUNS: usize = 8;
const BAD: usize = 3;

fn identified(runs: Vec<Run>) -> Identified {
    let command = Command {
        quantity: CommandQuantity::Current,
        hold: Hold::Measured,
        torque_per_command: None,
        back_emf_viscous: 0.0,
        limit: None,
    };
    let channels = Channels { axis: Axis::Rotary, command, tips: vec![] };
    let options = Options { effort: Effort::Quick, ..Options::default() };
    identify(&Campaign::new(channels, runs).unwrap(), &options, |_| ()).unwrap()
}

/// Two sines with other frequencies and amplitudes in each run, and noise on the current.
fn log(joint: &RigidJoint, index: usize) -> RigidLog {
    let k = index as f64;
    let mut log = joint.follow(3000, |t| {
        (0.6 + 0.08 * k) * ((0.25 + 0.03 * k) * TAU * t).sin()
            + 0.3 * ((0.9 + 0.05 * k) * TAU * t + k).sin()
    });
    let mut state = 1 + index as u32;
    for value in &mut log.measured {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        *value += 0.01 * 12.0_f64.sqrt() * (f64::from(state >> 8) / f64::from(1 << 24) - 0.5);
    }
    log
}

fn sound() -> RigidJoint {
    RigidJoint { sample_time_s: 2e-3, ..RigidJoint::default() }
}

fn runs(bad: &dyn Fn() -> RigidLog) -> Vec<Run> {
    let joint = sound();
    let run = |index: usize| {
        let log = if index == BAD { bad() } else { log(&joint, index) };
        let time = TimeBase::uniform(0.0, joint.sample_time_s);
        Run::new(format!("run {index}"), time, log.measured, log.angle, vec![]).unwrap()
    };
    (0..RUNS).map(run).collect()
}

/// The difference that is named, after a check that the others' estimates are those without the run.
#[track_caller]
fn named(bad: &dyn Fn() -> RigidLog) -> RunDifference {
    let all = runs(bad);
    let others = all.iter().enumerate().filter(|(i, _)| *i != BAD).map(|(_, run)| run.clone());
    let by_hand = identified(others.collect());
    let found = identified(all);
    same_estimates(&found, &by_hand);
    let differences: Vec<_> = found
        .findings
        .iter()
        .filter_map(|f| Some((f.run.clone()?, f.get::<rows::UnlikeOthers>()?.difference)))
        .collect();
    assert_eq!(differences.len(), 1, "{differences:?}");
    assert_eq!(differences[0].0, format!("run {BAD}"));
    assert_eq!(found.findings[0].code(), "unlike-others");
    differences[0].1
}

/// Within 0.3 standard errors.
#[track_caller]
fn same_estimates(found: &Identified, by_hand: &Identified) {
    let pairs: [(Option<Estimate>, Option<Estimate>); 3] = [
        (found.friction.coulomb, by_hand.friction.coulomb),
        (found.friction.viscous, by_hand.friction.viscous),
        (found.inertia, by_hand.inertia),
    ];
    for (a, b) in pairs {
        let (a, b) = (a.unwrap(), b.unwrap());
        assert!((a.value - b.value).abs() < 0.3 * b.std, "{a:?} {b:?}");
    }
}

#[test]
fn a_reversed_current() {
    let reversed = || {
        let mut log = log(&sound(), BAD);
        log.measured.iter_mut().for_each(|i| *i = -*i);
        log
    };
    assert_eq!(named(&reversed), RunDifference::Sign);
}

#[test]
fn another_load() {
    let heavier = || log(&RigidJoint { inertia: 0.02, ..sound() }, BAD);
    let RunDifference::Inertia { factor } = named(&heavier) else { panic!("no inertia") };
    assert!((factor - 2.0).abs() < 0.05, "{factor}");
}

#[test]
fn another_friction() {
    let rubs = || log(&RigidJoint { coulomb: 0.3, ..sound() }, BAD);
    let RunDifference::Coulomb { factor } = named(&rubs) else { panic!("no Coulomb friction") };
    assert!((factor - 2.0).abs() < 0.05, "{factor}");
}

#[test]
fn another_scale_of_the_current() {
    let scaled = || {
        let mut log = log(&sound(), BAD);
        log.measured.iter_mut().for_each(|i| *i *= 1.25);
        log
    };
    let RunDifference::CommandScale { factor } = named(&scaled) else { panic!("no scale") };
    assert!((factor - 0.8).abs() < 0.01, "{factor}");
}

#[test]
fn an_angle_in_degrees() {
    let in_degrees = || {
        let mut log = log(&sound(), BAD);
        log.angle.iter_mut().for_each(|q| *q *= 360.0 / TAU);
        log
    };
    let RunDifference::AngleScale { factor } = named(&in_degrees) else { panic!("no scale") };
    assert!((factor * 360.0 / TAU - 1.0).abs() < 0.01, "{factor}");
}

#[test]
fn an_angle_that_freezes() {
    let frozen = || {
        let mut log = log(&sound(), BAD);
        let moves = |k: &usize| log.speed[*k].abs() > 1.0;
        let from = (log.angle.len() / 2..log.angle.len()).find(moves).unwrap();
        let last = log.angle[from];
        log.angle[from..].fill(last);
        log
    };
    let all = runs(&frozen);
    let others = all.iter().enumerate().filter(|(i, _)| *i != BAD).map(|(_, run)| run.clone());
    let by_hand = identified(others.collect());
    let found = identified(all);
    same_estimates(&found, &by_hand);
    let is_named = |row: &rows::FrozenChannel| row.channel == Channel::Motor && row.left_out;
    let named = found.findings.iter().find(|f| f.get().is_some_and(is_named)).unwrap();
    assert_eq!(named.run.as_deref(), Some("run 3"));
}

/// Runs that differ by nothing but their motion: none is left out.
#[test]
fn runs_that_agree() {
    let found = identified(runs(&|| log(&sound(), BAD)));
    let about_runs = found.findings.iter().filter(|f| f.code() == "unlike-others");
    assert_eq!(about_runs.count(), 0);
}
