//! `lissom identify` on logs of constant velocities, from files to figures.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::fmt::Write as _;
use std::path::Path;
use std::process::Output;

use assert_cmd::Command;
use serde_json::Value;
use tempfile::TempDir;

/// Torque constant [N·m/A], friction [A] forward and backward, viscous [A·s/rad].
const K: f64 = 0.25;
const FORWARD: f64 = 0.15;
const BACKWARD: f64 = 0.13;
const VISCOUS: f64 = 0.005;
/// Relative error of a figure: the ripple of the current, averaged over 4 s a speed.
const ERROR: f64 = 2e-3;

const CAMPAIGN: &str = r#"[signals]
time = { column = "t", unit = "s" }
current = { column = "i", unit = "A", hold = "measured" }
motor = { column = "m", unit = "rad" }

[drive]
torque_constant = "0.25 N*m/A"
"#;

/// A log that turns at each of `speeds` for 4 s; the current has a ripple of 2 % and five decimals,
/// the angle 12 bits.
fn log(speeds: &[f64], bend: f64) -> String {
    let mut text = String::from("t,i,m\n");
    let (mut angle, mut time) = (0.0_f64, 0.0_f64);
    for &v in speeds {
        let dry = if v > 0.0 { FORWARD } else { -BACKWARD };
        let mean = dry + VISCOUS * v - bend * v * v.abs();
        for _ in 0..800 {
            let ripple = 1.0 + 0.02 * (41.0 * time).sin();
            let read = (angle / 0.001_534).round() * 0.001_534;
            writeln!(text, "{time:.4},{:.5},{read:.6}", mean * ripple).unwrap();
            time += 0.005;
            angle += v * 0.005;
        }
    }
    text
}

/// A folder with logs `0.csv`, `1.csv`, … and their campaign.
fn folder(logs: &[String]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let mut campaign = CAMPAIGN.to_owned();
    for (k, log) in logs.iter().enumerate() {
        std::fs::write(folder.path().join(format!("{k}.csv")), log).unwrap();
        write!(campaign, "\n[[runs]]\nfile = \"{k}.csv\"\n").unwrap();
    }
    std::fs::write(folder.path().join("campaign.toml"), campaign).unwrap();
    folder
}

fn run(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::cargo_bin("lissom").unwrap();
    command.current_dir(folder).args(["identify", "campaign.toml"]).args(arguments);
    command.output().unwrap()
}

fn result(folder: &Path, code: i32) -> Value {
    let output = run(folder, &["--json"]);
    assert_eq!(output.status.code(), Some(code), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

fn value(result: &Value, path: &str) -> f64 {
    result.pointer(path).and_then(Value::as_f64).unwrap_or_else(|| panic!("{path}: {result:#}"))
}

fn codes(result: &Value) -> Vec<&str> {
    result["findings"].as_array().unwrap().iter().map(|f| f["code"].as_str().unwrap()).collect()
}

const UP: [f64; 5] = [1.0, 2.0, 4.0, 6.0, 8.0];

fn down() -> Vec<f64> {
    UP.iter().map(|v| -v).collect()
}

#[test]
fn staircases_give_friction_and_nothing_confusing() {
    let folder = folder(&[log(&UP, 0.0), log(&down(), 0.0)]);
    let result = result(folder.path(), 3);
    let near = |path: &str, truth: f64| {
        let found = value(&result, path);
        assert!((found / truth - 1.0).abs() < ERROR, "{path}: {found}, true {truth}");
    };
    near("/methods/constant_velocity/forward/value", K * FORWARD);
    near("/methods/constant_velocity/backward/value", K * BACKWARD);
    near("/methods/constant_velocity/coulomb/value", K * 0.5 * (FORWARD + BACKWARD));
    near("/methods/constant_velocity/viscous/value", K * VISCOUS);
    near("/friction/coulomb/value", K * 0.5 * (FORWARD + BACKWARD));
    near("/friction/offset/value", K * 0.5 * (FORWARD - BACKWARD));
    assert_eq!(result["drive"]["inertia"], Value::Null);
    assert_eq!(codes(&result), ["constant-velocity-only", "offset", "constant-velocity-estimates"]);
    let points = result["methods"]["constant_velocity"]["points"].as_array().unwrap();
    assert_eq!(points.len(), 10);
    assert_eq!(points[0]["run"], "0.csv");
    assert_eq!(points[0]["direction"], "forward");
    assert!((value(&points[0], "/velocity/value") - 1.0).abs() < 1e-3);
    assert_eq!(points[9]["direction"], "backward");
    for run in result["runs"].as_array().unwrap() {
        assert_eq!(run["kind"], "constant_velocity");
    }
}

#[test]
fn the_table_the_report_and_the_plots_show_it() {
    let folder = folder(&[log(&UP, 0.0), log(&down(), 0.0)]);
    let output = run(folder.path(), &["--report", "report.html", "--plots", "plots"]);
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("2 runs at constant velocities"), "{text}");
    assert!(text.contains("through 5 points forward and 5 points backward"), "{text}");
    let report = std::fs::read_to_string(folder.path().join("report.html")).unwrap();
    assert!(report.contains("Friction from constant velocities"));
    assert!(report.contains("Stretches at a constant velocity"));
    assert!(!report.contains("Frequency responses"));
    let svg = std::fs::read_to_string(folder.path().join("plots/friction-velocity.svg")).unwrap();
    assert!(svg.contains("velocity, magnitude (rad/s)") && svg.contains("stroke-dasharray"));
    let png = std::fs::read(folder.path().join("plots/friction-velocity.png")).unwrap();
    assert!(png.starts_with(b"\x89PNG"));
}

#[test]
fn a_bend_is_said_with_its_direction() {
    let folder = folder(&[log(&UP, 2e-4), log(&down(), 2e-4)]);
    let result = result(folder.path(), 3);
    let findings = result["findings"].as_array().unwrap();
    let bent: Vec<_> = findings.iter().filter(|f| f["code"] == "extrapolation-doubtful").collect();
    assert_eq!(bent.len(), 2, "{findings:#?}");
    assert!(bent[0]["message"].as_str().unwrap().contains("is too high"));
    let line = &result["methods"]["constant_velocity"]["lines"][0];
    assert_eq!(line["shape"], "concave");
    assert!(value(line, "/slowest/value") < value(line, "/coulomb/value"));
    let taken = value(&result, "/friction/forward/value");
    assert!((taken - value(line, "/slowest/value")).abs() < 1e-12);
}

#[test]
fn what_a_campaign_lacks_is_refused() {
    let lacking = [
        (vec![log(&UP, 0.0)], "no run turns backward"),
        (vec![log(&UP, 0.0), log(&[-3.0], 0.0)], "there is only 1 speed"),
    ];
    for (logs, reason) in lacking {
        let folder = folder(&logs);
        let result = result(folder.path(), 3);
        let is_told = |f: &Value| {
            f["code"] == "extrapolation-refused" && f["message"].as_str().unwrap().contains(reason)
        };
        let findings = result["findings"].as_array().unwrap();
        assert!(findings.iter().any(is_told), "{reason}: {findings:?}");
        assert_eq!(result["friction"]["coulomb"], Value::Null);
    }
}
