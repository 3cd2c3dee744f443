//! Logs whose rows are not what a driven motor does at their times: a bus that was polled faster than the device answers, speed
//! readings that rest between two levels, a stretch in which somebody moves the joint, a servo's goal.
#![expect(clippy::unwrap_used, reason = "tests")]

use std::fmt::Write as _;
use std::process::Command;

use lissom_testmodels::{RigidJoint, RigidLog, two_sines};
use serde_json::Value;

const SEEDS: std::ops::Range<u32> = 0..3;

/// A sequence of uniform numbers.
struct Draw(u32);

impl Draw {
    fn of(seed: u32) -> Self {
        Self(seed.wrapping_mul(2_654_435_761).wrapping_add(41))
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        low + (high - low) * f64::from(self.0 >> 8) / f64::from(1 << 24)
    }

    fn joint(&mut self) -> RigidJoint {
        RigidJoint {
            inertia: self.between(0.008, 0.012),
            viscous: self.between(0.02, 0.04),
            coulomb: self.between(0.1, 0.2),
            ..RigidJoint::default()
        }
    }
}

/// The lines of a log with this header, and what `identify --quick` makes of them with these signals.
fn identified(header: &str, rows: &[Vec<f64>], signals: &str) -> Value {
    let folder = tempfile::tempdir().unwrap();
    let mut text = format!("{header}\n");
    for row in rows {
        let cells: Vec<String> = row.iter().map(|x| format!("{x:.9}")).collect();
        let _ = writeln!(text, "{}", cells.join(","));
    }
    std::fs::write(folder.path().join("log.csv"), text).unwrap();
    let campaign = format!(
        "[signals]\ntime = {{ column = \"t\", unit = \"s\" }}\n{signals}\n[[runs]]\nfile = \"log.csv\"\n"
    );
    std::fs::write(folder.path().join("campaign.toml"), campaign).unwrap();
    let mut lissom = Command::new(assert_cmd::cargo::cargo_bin!("lissom"));
    let lissom = lissom.args(["identify", "campaign.toml", "--quick", "--json"]);
    let output = lissom.current_dir(folder.path()).output().unwrap();
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(matches!(output.status.code(), Some(0 | 3)), "{error}");
    serde_json::from_slice(&output.stdout).unwrap()
}

#[track_caller]
fn near(result: &Value, truth: [f64; 3], shares: [f64; 3]) {
    let keys = ["/friction/coulomb/value", "/friction/viscous/value", "/drive/inertia/value"];
    for ((key, truth), share) in keys.into_iter().zip(truth).zip(shares) {
        let value = result.pointer(key).and_then(Value::as_f64);
        let value = value.unwrap_or_else(|| panic!("{key} is refused: {}", result["findings"]));
        assert!((value / truth - 1.0).abs() < share, "{key}: {value}, in truth {truth}");
    }
}

/// The message of a finding.
#[track_caller]
fn finding<'a>(result: &'a Value, code: &str) -> &'a str {
    let findings = result["findings"].as_array().unwrap();
    let found = findings.iter().find(|f| f["code"] == code);
    found.unwrap_or_else(|| panic!("no {code}: {findings:?}"))["message"].as_str().unwrap()
}

fn moves(time_s: f64) -> f64 {
    const PLACES: [f64; 5] = [0.0, 1.2, -0.7, 0.9, -1.1];
    let k = (time_s / 2.0) as usize;
    let x = (1.8 * (time_s / 2.0 - k as f64)).min(1.0);
    let step = x * x * x * (10.0 - 15.0 * x + 6.0 * x * x);
    PLACES[k % 5] + (PLACES[(k + 1) % 5] - PLACES[k % 5]) * step
}

/// A device answers about every 10 ms; somebody asks it about every 0.8 ms, and most rows repeat the row before.
#[test]
fn rows_of_a_polled_bus() {
    for seed in SEEDS {
        let mut draw = Draw::of(seed);
        let joint = draw.joint();
        let log = joint.follow(15_000, two_sines);
        let (mut rows, mut now, mut answered) = (Vec::new(), 0.0, 0);
        let mut repeated = 0;
        while answered + 8 < log.time_s.len() {
            let next = answered + draw.between(4.0, 6.99) as usize;
            let due = log.time_s[next];
            let before = rows.len();
            while now < due {
                rows.push(vec![now, log.measured[answered], log.angle[answered]]);
                now += draw.between(0.5e-3, 1.1e-3);
            }
            repeated += rows.len() - before - 1;
            answered = next;
        }
        let share = repeated as f64 / rows.len() as f64;
        assert!(share > 0.9, "{share}");
        let signals = "command = { column = \"i\", unit = \"N*m\", hold = \"measured\" }\n\
                       motor = { column = \"q\", unit = \"rad\" }";
        let result = identified("t,i,q", &rows, signals);
        near(&result, [joint.coulomb, joint.viscous, joint.inertia], [0.03, 0.05, 0.05]);
        finding(&result, "repeated-readings");
    }
}

/// Levels of speed that lie half a step beside zero: at rest the reading is half a step, one way or the other.
#[test]
fn readings_that_rest_between_two_steps() {
    for seed in SEEDS {
        let mut draw = Draw::of(seed);
        let joint = draw.joint();
        let log = joint.follow(15_000, moves);
        let quantum = draw.between(0.02, 0.04);
        let mut level = |speed: f64| {
            let about = speed + quantum * draw.between(-0.3, 0.3);
            ((about / quantum).floor() + 0.5) * quantum
        };
        let rows = (0..log.time_s.len())
            .map(|k| vec![log.time_s[k], log.measured[k], level(log.speed[k])])
            .collect::<Vec<_>>();
        let signals = "command = { column = \"i\", unit = \"N*m\", hold = \"measured\" }\n\
                       motor = { column = \"w\", unit = \"rad/s\", quantity = \"speed\" }";
        let result = identified("t,i,w", &rows, signals);
        near(&result, [joint.coulomb, joint.viscous, joint.inertia], [0.03, 0.03, 0.03]);
    }
}

/// Between two parts of a log the amplifier is off and the joint is moved by hand: left out, and the finding says when.
#[test]
fn a_stretch_moved_by_hand() {
    for seed in SEEDS {
        let mut draw = Draw::of(seed);
        let joint = draw.joint();
        let RigidLog { time_s, measured, angle, speed, .. } = joint.follow(20_000, two_sines);
        // It begins where the motor turns round.
        let from = (8_000..12_000).find(|&k| speed[k] * speed[k + 1] <= 0.0).unwrap();
        let hand = 5_000;
        let shape = |k: usize| {
            let x = k as f64 / f64::from(hand);
            0.8 * (4.0 * std::f64::consts::PI * x).sin() * (std::f64::consts::PI * x).sin()
        };
        let rows = (0..time_s.len() + hand as usize).map(|k| {
            let t = 2e-3 * k as f64;
            match k.checked_sub(from) {
                None => vec![t, measured[k], angle[k]],
                Some(beyond) if beyond < hand as usize => vec![t, 0.0, angle[from] + shape(beyond)],
                Some(_) => vec![t, measured[k - hand as usize], angle[k - hand as usize]],
            }
        });
        let rows: Vec<_> = rows.collect();
        let signals = "command = { column = \"i\", unit = \"N*m\", hold = \"measured\" }\n\
                       motor = { column = \"q\", unit = \"rad\" }";
        let result = identified("t,i,q", &rows, signals);
        near(&result, [joint.coulomb, joint.viscous, joint.inertia], [0.03, 0.03, 0.04]);
        let message = finding(&result, "left-out");
        assert!(message.contains(&format!("from {:.2}", 2e-3 * from as f64)), "{message}");
    }
}

/// A servo that compares its goal with its angle all the time, and damps by its own speed: viscous friction contains that gain.
#[test]
fn a_servo_with_derivative_gain() {
    for seed in SEEDS {
        let mut draw = Draw::of(seed);
        let joint = RigidJoint { sample_time_s: 2.5e-4, steps: 2, ..draw.joint() };
        let (gain, damping) = (draw.between(3.0, 6.0), draw.between(0.1, 0.2));
        let (rows_s, per_row) = (4e-3, 16);
        let goal = |t: f64| {
            let t = (t / rows_s + 1e-6).floor() * rows_s;
            two_sines(t) * t.min(1.0)
        };
        let log = joint.drive(25 * 4_000, |t, q, w| gain * (goal(t) - q) - damping * w);
        let rows = (0..log.time_s.len()).step_by(per_row);
        let rows: Vec<_> =
            rows.map(|k| vec![log.time_s[k], goal(log.time_s[k]), log.angle[k]]).collect();
        let signals = format!(
            "command = {{ column = \"goal\", unit = \"rad\", hold = \"sampled\", quantity = \"goal\" }}\n\
             motor = {{ column = \"q\", unit = \"rad\" }}\n[drive]\nposition_gain = \"{gain:.9} N*m/rad\""
        );
        let result = identified("t,goal,q", &rows, &signals);
        let viscous = joint.viscous + damping;
        near(&result, [joint.coulomb, viscous, joint.inertia], [0.02, 0.015, 0.03]);
    }
}
