//! An arm from measured responses, in use: model, rig and identification take what `--save-arm` writes.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::fmt::Write as _;
use std::path::Path;

use assert_cmd::Command;
use lissom::beam::{LumpedBeam, Span};
use num_complex::Complex64;
use serde_json::Value;

/// The loop of the arm: that of a light drive.
const RIG: &str = r#"
[rig]
sample_time = "3 ms"
current_limit = "6 A"
motor_sensor = { bits = 14, range = "360 deg" }
controller = { proportional = "9 A/rad", derivative = "0.25 A*s/rad" }
"#;

const PLAN: &str = r#"
[[runs]]
sine = { omega_rad_s = [2.0, 4.0, 7.0, 12.0, 18.0, 25.0], amplitude = "0.4 rad" }
periods = 10
"#;

fn run(folder: &Path, arguments: &[&str]) -> String {
    let mut command = Command::new(assert_cmd::cargo::cargo_bin!("lissom"));
    let output = command.current_dir(folder).args(arguments).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

fn json(folder: &Path, arguments: &[&str]) -> Value {
    serde_json::from_str(&run(folder, arguments)).unwrap()
}

/// Two masses on a strip.
fn beam() -> LumpedBeam {
    let span = |length_m, mass_kg| Span {
        length_m,
        flexural_rigidity_n_m2: 0.03,
        mass_kg,
        damping_n_s_per_m: 0.0,
    };
    LumpedBeam::new(&[span(0.15, 0.05), span(0.2, 0.04)]).unwrap()
}

/// Exact responses of the arm, K = 0.3 N·m/A, J = 1.2 g·m², V = 2 mN·m·s.
fn table() -> String {
    let mut text =
        "omega_rad_s,elbow_re,elbow_im,tip_re,tip_im,motor_re [rad/A],motor_im [rad/A]\n"
            .to_owned();
    let beam = beam();
    let highest = beam.natural_frequencies_rad_s()[1];
    for i in 0..200 {
        let w = 0.8 * (2.0 * highest / 0.8).powf(f64::from(i) / 199.0);
        let s = Complex64::new(0.0, w);
        let at = beam.response(s);
        let motor = 0.3 / (s * (s * 1.2e-3 + 2e-3) + at.coupling_nm_per_rad);
        write!(text, "{w:?}").unwrap();
        for value in [at.angles[0], at.angles[1], motor] {
            write!(text, ",{:?},{:?}", value.re, value.im).unwrap();
        }
        text.push('\n');
    }
    text
}

/// The same table with the elbow's acceleration and the tip's velocity per angle.
fn rates() -> String {
    let text = table();
    let mut lines = text.lines();
    let head = lines.next().unwrap();
    let head = head.replace("elbow_re", "elbow_re [1/s^2]").replace("elbow_im", "elbow_im [1/s^2]");
    let mut rates = head.replace("tip_re", "tip_re [1/s]").replace("tip_im", "tip_im [1/s]") + "\n";
    for line in lines {
        let cells: Vec<f64> = line.split(',').map(|c| c.parse().unwrap()).collect();
        let s = Complex64::new(0.0, cells[0]);
        let elbow = s * s * Complex64::new(cells[1], cells[2]);
        let tip = s * Complex64::new(cells[3], cells[4]);
        let cells = [cells[0], elbow.re, elbow.im, tip.re, tip.im, cells[5], cells[6]];
        let cells: Vec<String> = cells.iter().map(|c| format!("{c:?}")).collect();
        rates += &(cells.join(",") + "\n");
    }
    rates
}

#[test]
fn velocities_and_accelerations_have_zeros_at_the_origin() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    std::fs::write(at.join("angles.csv"), table()).unwrap();
    std::fs::write(at.join("rates.csv"), rates()).unwrap();
    let found = |file: &str| json(at, &["equivalent", file, "--json"]);
    let (of_angles, of_rates) = (found("angles.csv"), found("rates.csv"));
    for pointer in [
        "/equivalent/modes/1/natural_frequency_rad_s/value",
        "/equivalent/modes/0/static_gains/1/value",
    ] {
        let value = |v: &Value| v.pointer(pointer).unwrap().as_f64().unwrap();
        assert!((value(&of_rates) / value(&of_angles) - 1.0).abs() < 1e-9, "{pointer}");
    }
    std::fs::write(at.join("jerk.csv"), rates().replace("[1/s^2]", "[1/s^3]")).unwrap();
    let mut command = Command::new(assert_cmd::cargo::cargo_bin!("lissom"));
    let output = command.current_dir(at).args(["equivalent", "jerk.csv"]).output().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("an angle, velocity or acceleration per angle"), "{said}");
}

#[test]
fn a_saved_arm_is_modelled_simulated_and_identified() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    std::fs::write(at.join("r.csv"), table()).unwrap();
    let constant = "0.3 N*m/A";
    run(at, &["equivalent", "r.csv", "--torque-constant", constant, "--save-arm", "arm.toml"]);

    let truth = beam();
    let model = json(at, &["model", "arm.toml", "--json"]);
    assert_eq!(model["kind"], "modal");
    for (found, omega) in model["natural_frequencies_rad_s"]
        .as_array()
        .unwrap()
        .iter()
        .zip(truth.natural_frequencies_rad_s())
    {
        assert!((found.as_f64().unwrap() / omega - 1.0).abs() < 1e-7, "{found} {omega}");
    }
    let inertia = model["inertia_kg_m2"].as_f64().unwrap();
    assert!((inertia / truth.inertia_kg_m2() - 1.0).abs() < 1e-6, "{inertia}");
    assert!(model["state_space"]["a"].is_array() && model["payload"].is_null());

    // Its own file again is no slip; another's is.
    run(at, &["equivalent", "r.csv", "--torque-constant", constant, "--save-arm", "arm.toml"]);
    let arm = std::fs::read_to_string(at.join("arm.toml")).unwrap();
    let whole = arm.replace("# coulomb = \"0.03 N*m\"", "coulomb = \"0.03 N*m\" #") + RIG;
    std::fs::write(at.join("rig.toml"), whole).unwrap();
    std::fs::write(at.join("plan.toml"), PLAN).unwrap();
    run(at, &["rig", "rig.toml", "--campaign", "plan.toml", "--out", "logs"]);
    let found = json(at, &["identify", "logs/campaign.toml", "--json"]);
    let figure = |pointer: &str| found.pointer(pointer).unwrap().as_f64().unwrap();
    assert!((figure("/friction/coulomb/value") / 0.03 - 1.0).abs() < 5e-3);
    assert!((figure("/drive/inertia/value") / 1.2e-3 - 1.0).abs() < 1e-2);
    for (k, omega) in truth.natural_frequencies_rad_s().iter().enumerate() {
        let found = figure(&format!("/beam/modes/{k}/natural_frequency_rad_s/value"));
        assert!((found / omega - 1.0).abs() < 2e-3, "{found} {omega}");
    }
}
