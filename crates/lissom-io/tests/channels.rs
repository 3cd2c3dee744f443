//! Logs with a speed, a goal or a torque in place of angle and current.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::fmt::Write as _;

use lissom::identify::{Effort, Finding, Identified, Options, identify};
use lissom::record::note;
use lissom_io::campaign::read_campaign;
use lissom_testmodels::{RigidJoint, RigidLog, two_sines};

/// Relative error of inertia and friction.
const ERROR: f64 = 0.02;

fn log_text(log: &RigidLog, every: usize, columns: [&dyn Fn(usize) -> f64; 2]) -> String {
    let mut text = String::from("t,u,x\n");
    for k in (0..log.time_s.len()).step_by(every) {
        writeln!(text, "{:.6},{:.7},{:.7}", log.time_s[k], columns[0](k), columns[1](k)).unwrap();
    }
    text
}

fn identified(signals: &str, text: &str) -> Identified {
    let folder = tempfile::tempdir().unwrap();
    let campaign = format!(
        "[signals]\ntime = {{ column = \"t\", unit = \"s\" }}\n{signals}\n[[runs]]\nfile = \"log.csv\"\n"
    );
    std::fs::write(folder.path().join("campaign.toml"), campaign).unwrap();
    std::fs::write(folder.path().join("log.csv"), text).unwrap();
    let file = read_campaign(&folder.path().join("campaign.toml")).unwrap();
    let options = Options { effort: Effort::Quick, ..Options::default() };
    identify(&file.campaign, &options, |_| ()).unwrap()
}

#[track_caller]
fn has(found: &Identified, inertia: f64, coulomb: f64, viscous: f64) {
    let friction = &found.friction;
    for (found, exact) in
        [(found.inertia, inertia), (friction.coulomb, coulomb), (friction.viscous, viscous)]
    {
        let found = found.unwrap().value;
        assert!((found / exact - 1.0).abs() < ERROR, "{found} where {exact} is right");
    }
}

#[test]
fn a_speed_in_rpm_and_a_torque() {
    let joint = RigidJoint { sample_time_s: 1e-3, ..RigidJoint::default() };
    let log = joint.follow(20_000, two_sines);
    let rpm = |k: usize| (log.speed[k] * 300.0 / std::f64::consts::PI).round() / 10.0;
    let torque = |k: usize| log.measured[k];
    let text = log_text(&log, 1, [&torque, &rpm]);
    let signals = r#"command = { column = "u", unit = "N*m", hold = "measured" }
        motor = { column = "x", unit = "rpm", quantity = "speed" }"#;
    let found = identified(signals, &text);
    assert!(found.findings.iter().any(|finding| finding.code() == "speed-integrated"));
    assert!(found.findings.iter().all(|finding| finding.code() != "per-unit-of-command"));
    has(&found, joint.inertia, joint.coulomb, joint.viscous);
}

#[test]
fn a_negative_torque_constant_and_an_encoder_that_wraps() {
    let joint = RigidJoint::default();
    let log = joint.follow(20_000, |t| 5.0 * two_sines(t));
    let degrees = |k: usize| log.angle[k].to_degrees().rem_euclid(360.0);
    let current = |k: usize| -4.0 * log.held[k];
    let text = log_text(&log, 1, [&current, &degrees]);
    let signals = r#"current = { column = "u", unit = "A", hold = "sampled" }
        motor = { column = "x", unit = "deg" }
        [drive]
        torque_constant = "-0.25 N*m/A""#;
    let found = identified(signals, &text);
    assert!(found.findings.iter().any(Finding::is::<note::TurnsRemoved>));
    has(&found, joint.inertia, joint.coulomb, joint.viscous);
}

#[test]
fn a_servo_with_its_position_goal() {
    // A loop of 10 kHz, whose goal changes every 2 ms, and a log of these.
    let joint = RigidJoint { sample_time_s: 1e-4, steps: 2, ..RigidJoint::default() };
    let goal = |t: f64| two_sines((t * 500.0 + 1e-6).floor() / 500.0);
    let log = joint.follow(400_000, goal);
    let degrees = |k: usize| log.angle[k].to_degrees();
    let goal_degrees = |k: usize| goal(log.time_s[k]).to_degrees();
    let text = log_text(&log, 20, [&goal_degrees, &degrees]);
    let omega = std::f64::consts::TAU * 10.0;
    let gain = joint.inertia * omega * omega;
    let motor = "motor = { column = \"x\", unit = \"deg\" }";
    let signals = format!(
        "command = {{ column = \"u\", unit = \"deg\", hold = \"sampled\", quantity = \"goal\" }}\n{motor}\n\
         [drive]\nposition_gain = {gain}"
    );
    let damping = 1.4 * omega * joint.inertia;
    has(&identified(&signals, &text), joint.inertia, joint.coulomb, joint.viscous + damping);
    // Not declared, it is reported.
    let signals =
        format!("command = {{ column = \"u\", unit = \"1\", hold = \"sampled\" }}\n{motor}");
    let found = identified(&signals, &text);
    assert!(found.findings.iter().any(|finding| finding.code() == "command-follows-motor"));
}
