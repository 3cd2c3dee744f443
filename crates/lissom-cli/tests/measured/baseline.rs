//! Lissom against plain least squares, on logs that neither has used: on identical windows the torque left by the
//! estimates of the result is at most 1.03 times what the line leaves.

use std::io::Write as _;

use lissom::identify::{
    ArmSource, DriveEstimates, Effort, FoundArm, LagShape, Options, Prepared, ValidationOptions,
    identify, least_squares, motor_regression, validate,
};
use lissom::record::{Campaign, Run, TimeBase};
use lissom::replay::{DryTerms, ModalArm};

use super::{common, ur10e};

/// Length of the windows \[s\].
const WINDOW_S: f64 = 0.1;
const AT_MOST: f64 = 1.03;

/// A rigid arm with these estimates.
fn rigid(drive: &DriveEstimates, back_emf: f64) -> FoundArm {
    let friction = &drive.friction;
    let viscous = friction.viscous.unwrap().value + back_emf;
    let arm = ModalArm {
        inertia_kg_m2: drive.inertia.unwrap().value,
        viscous_nm_s_per_rad: [viscous; 2],
        coulomb_nm: friction.coulomb.unwrap().value,
        offset_nm: friction.offset.unwrap().value,
        dry_terms: DryTerms::default(),
        modes: vec![],
        shapes: vec![],
        at_points_per_s: vec![],
        gravity: drive.gravity.map(|g| g.load()),
        torque_ripples: Vec::new(),
        command_lag_s: 0.0,
        tip_lags_s: vec![],
    };
    FoundArm {
        arm,
        coupling_alone_nm_per_rad: Vec::new(),
        source: ArmSource::Regression,
        lag_shape: LagShape::Delay,
        torque_used: None,
    }
}

/// Past the capture, so that the table of the evidence can be made of it.
fn say(name: &str, by: &str, shares: [f64; 2]) {
    let [ours, line] = shares.map(|share| 100.0 * share);
    let text = format!("{name}: {ours:.2} % by {by}, {line:.2} % by least squares\n");
    std::io::stderr().write_all(text.as_bytes()).unwrap();
}

/// Shares of the torque of `unseen` that are left by the result of `used` and by its line, told past the capture.
fn left(name: &str, used: &Campaign, unseen: &Campaign) -> [f64; 2] {
    let options = Options { effort: Effort::Quick, ..Options::default() };
    let found = identify(used, &options, |_| ()).unwrap();
    let line = rigid(
        &found.least_squares.as_ref().unwrap().estimates,
        used.channels.command.back_emf_viscous,
    );
    let asked = ValidationOptions { window_s: Some(WINDOW_S), ..ValidationOptions::default() };
    let of = |arm: &FoundArm| validate(arm, unseen, &asked).unwrap().torque.unwrap().relative_error;
    let both = [of(found.arm.as_ref().unwrap()), of(&line)];
    let by = found.method.unwrap().name();
    say(name, by, both);
    assert!(both[0] < AT_MOST * both[1], "{name}: {both:?}");
    both
}

/// The first or the second half of each run.
fn half(campaign: &Campaign, second: bool) -> Campaign {
    let part = |run: &Run| {
        let middle = run.len() / 2;
        let range = if second { middle..run.len() } else { 0..middle };
        let base = TimeBase::uniform(0.0, run.sample_time_s());
        let of = |channel: &[f64]| channel[range.clone()].to_vec();
        let tips = run.tips().iter().map(|tip| of(tip)).collect();
        Run::new(run.name(), base, of(run.command()), of(run.motor()), tips).unwrap()
    };
    let runs = campaign.runs.iter().map(part).collect();
    Campaign { runs, mgl_nm: None, ..campaign.clone() }
}

#[test]
fn emps_second_log() {
    let Some(data) = common::data("emps") else { return };
    let read = |file: &str| common::read(include_str!("emps.toml"), &data, file).campaign;
    left("EMPS", &read("DATA_EMPS.csv"), &read("DATA_EMPS_PULSES.csv"));
}

#[test]
fn ur10e_second_halves() {
    let Some(data) = common::data("ur10e") else { return };
    for joint in [1, 4] {
        let read = common::read(&ur10e::campaign(joint), &data, &ur10e::log(joint)).campaign;
        let read = if joint == 4 { read.with_gravity().unwrap() } else { read };
        left(&format!("UR10E joint {joint}"), &half(&read, false), &half(&read, true));
    }
}

/// A short log of square-wave references: each half has few strokes.
#[test]
fn cu_rigid_second_half() {
    let Some(data) = common::data("cu-flexarm") else { return };
    let read = common::read(include_str!("cu-rigid.toml"), &data, "").campaign;
    left("CU rigid arm", &half(&read, false), &half(&read, true));
}

/// A flexible link whose second stage moves, too: no arm, but the motor's equation with the tip's coupling, in the
/// line's windows of the other half.
#[test]
fn quanser_second_half() {
    let Some(data) = common::data("quanser-2dsfl") else { return };
    let read = common::read(include_str!("quanser.toml"), &data, "").campaign;
    let (used, unseen) = (half(&read, false), half(&read, true));
    let used = Prepared::of(&used);
    let regression = motor_regression(&used, &Options::default()).unwrap().estimates();
    let line = least_squares(&used, None).unwrap().estimates;
    let unseen = least_squares(&Prepared::of(&unseen), None).unwrap();
    let both = [&regression, &line].map(|estimates| unseen.left_by(estimates).unwrap());
    say("Quanser", "regression", both);
    assert!(both[0] < AT_MOST * both[1], "{both:?}");
}
