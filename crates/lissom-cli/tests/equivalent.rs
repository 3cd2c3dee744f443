//! `lissom equivalent` on tables and on a virtual campaign.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::path::Path;

use assert_cmd::Command;
use lissom::beam::{DistributedBeam, LumpedBeam, Piece, Span, TruncatedBeam};
use num_complex::Complex64;
use serde_json::Value;

fn lissom() -> Command {
    Command::new(assert_cmd::cargo::cargo_bin!("lissom"))
}

/// Standard output of a command that succeeds.
fn done(command: &mut Command) -> String {
    let output = command.output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// What a command that fails says on standard error.
fn refused(folder: &Path, arguments: &[&str]) -> String {
    let output = lissom().current_dir(folder).arg("equivalent").args(arguments).output().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(output.stdout.is_empty());
    assert_eq!(said.lines().filter(|l| l.starts_with("error: ")).count(), 1, "{said}");
    assert!(said.contains("\nhint: ") && said.lines().count() == 2, "{said}");
    said
}

fn ruler(points_m: &[f64]) -> TruncatedBeam {
    let piece = Piece {
        length_m: 0.45,
        flexural_rigidity_n_m2: 0.17,
        mass_per_length_kg_per_m: 0.13,
        end_mass_kg: 0.02,
        end_damping_n_s_per_m: 0.0,
    };
    DistributedBeam::new(&[piece]).unwrap().truncated(points_m).unwrap()
}

/// A number between −1 and 1 from a counter, the same on every machine.
fn scatter(state: &mut u64) -> f64 {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    f64::from((*state >> 40) as u32) / f64::from(1u32 << 23) - 1.0
}

/// A table of the first `shown` points and the motor, frequencies in Hz.
fn table(beam: &TruncatedBeam, shown: usize, noise: f64) -> String {
    let poles = &beam.natural_frequencies_rad_s;
    let (low, high) = (0.5 * poles[0], 1.6 * poles[poles.len() - 1]);
    let mut text = "frequency_hz".to_owned();
    for i in 1..=shown {
        write!(text, ",p{i}_re,p{i}_im,p{i}_std").unwrap();
    }
    text.push_str(",motor_db,motor_deg,motor_std [rad/A]\n");
    let mut state = 7;
    for i in 0..300 {
        let w = low * (high / low).powf(f64::from(i) / 299.0);
        let s = Complex64::new(0.0, w);
        let response = beam.response(s);
        let motor = 0.25 / (s * (s * 6e-4 + 1.5e-3) + response.coupling_nm_per_rad);
        write!(text, "{}", w / TAU).unwrap();
        let mut noisy = |value: Complex64| {
            value * (1.0 + noise * Complex64::new(scatter(&mut state), scatter(&mut state)))
        };
        for angle in &response.angles[..shown] {
            let value = noisy(*angle);
            write!(text, ",{},{},{}", value.re, value.im, noise.max(1e-4) * value.norm()).unwrap();
        }
        let value = noisy(motor);
        let (db, deg) = (20.0 * value.norm().log10(), value.arg().to_degrees());
        writeln!(text, ",{db},{deg},{}", noise.max(1e-4) * value.norm()).unwrap();
    }
    text
}

fn number(value: &Value) -> f64 {
    value["value"].as_f64().unwrap()
}

#[test]
fn a_table_gives_the_arm() {
    let folder = tempfile::tempdir().unwrap();
    let truth = ruler(&[0.15, 0.3, 0.45]);
    std::fs::write(folder.path().join("r.csv"), table(&truth, 3, 0.01)).unwrap();
    let run = |more: &[&str]| {
        let mut command = lissom();
        command.current_dir(folder.path()).args(["equivalent", "r.csv"]).args(more);
        done(&mut command)
    };
    let constant = ["--torque-constant", "0.25 N*m/A"];
    let said = run(&[constant[0], constant[1], "--json", "a.json", "--plot", "bode.png"]);
    for words in
        ["3 points at 300 frequencies", "3 modes kept", "inertia", "ĥ", "zeros of", "class"]
    {
        assert!(said.contains(words), "{said}");
    }
    let text = std::fs::read_to_string(folder.path().join("a.json")).unwrap();
    let found: Value = serde_json::from_str(&text).unwrap();
    let found = &found["equivalent"];
    for k in 0..3 {
        let omega = number(&found["modes"][k]["natural_frequency_rad_s"]);
        assert!((omega / truth.natural_frequencies_rad_s[k] - 1.0).abs() < 2e-3);
        let h = number(&found["torque"]["h"][k]);
        assert!((h / truth.h[k] - 1.0).abs() < 2e-2, "{h} {}", truth.h[k]);
        for j in 0..3 {
            let used = found["strainless"]["a_per_s2"][k][j].as_f64().unwrap();
            assert!((used - truth.a[(k, j)]).abs() < 5e-3 * truth.a.amax());
        }
    }
    let h_motor = number(&found["torque"]["h_motor"]);
    assert!((h_motor / truth.h_motor - 1.0).abs() < 2e-2);
    for picture in ["bode.png", "bode-motor.png"] {
        assert!(std::fs::read(folder.path().join(picture)).unwrap().starts_with(b"\x89PNG"));
    }
    // Per unit of command, alone on standard output; without the motor step 5 alone.
    let plain: Value = serde_json::from_str(&run(&["--json"])).unwrap();
    assert!(plain["equivalent"]["torque"]["h"].is_array());
    let fewer = run(&["--modes", "1"]);
    assert!(fewer.contains("modes are kept") && fewer.contains("and therefore as many points"));
}

#[test]
fn refusals_say_why() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let write = |name: &str, text: &str| std::fs::write(at.join(name), text).unwrap();
    write("two.csv", &table(&ruler(&[0.15, 0.3, 0.45]), 2, 0.01));
    let said = refused(at, &["two.csv"]);
    assert!(said.contains("2 points for 3 modes") && said.contains("--modes N"), "{said}");
    write("close.csv", &table(&ruler(&[0.2, 0.449_99, 0.45]), 3, 0.01));
    let said = refused(at, &["close.csv"]);
    assert!(
        said.contains("p2 and p3 move almost alike") && said.contains("cannot be separated"),
        "{said}"
    );
    write(
        "arm.toml",
        "[beam]\nflexural_rigidity = 0.17\nmass_per_length = 0.13\nspans = [{ length = 0.45, mass = 0.02 }]\n",
    );
    let places =
        ["--arm", "arm.toml", "--at", "p1=0.2 m", "--at", "p2=449.99 mm", "--at", "p3=0.45 m"];
    let said = refused(at, &[&["close.csv"], &places[..]].concat());
    assert!(said.contains("hint: put p") && said.contains("0.0731 m"), "{said}");
    let mut state = 3;
    let mut noise = "f_hz,re,im,std\n".to_owned();
    for i in 1..=150 {
        writeln!(noise, "{i},{},{},0.8", scatter(&mut state), scatter(&mut state)).unwrap();
    }
    write("noise.csv", &noise);
    assert!(refused(at, &["noise.csv"]).contains("all noise"));
    let mut late = "omega_rad_s,tip_re,tip_im,tip_std\n".to_owned();
    for i in 1..=150 {
        let w = 0.4 * f64::from(i);
        let value =
            400.0 / Complex64::new(400.0 - w * w, 0.2 * w) * Complex64::from_polar(1.0, -0.02 * w);
        writeln!(late, "{w},{},{},{}", value.re, value.im, 0.01 * value.norm()).unwrap();
    }
    write("late.csv", &late);
    let said = refused(at, &["late.csv"]);
    assert!(
        said.contains("tip has") && said.contains("imaginary part that no damping explains"),
        "{said}"
    );
    write("short.csv", "f_hz,re,im\n1,1,0\n2,1,0\n");
    assert!(refused(at, &["two.csv", "short.csv"]).contains("must share their frequencies"));
    refused(at, &["short.csv"]);
    refused(at, &["absent.csv"]);
    refused(at, &["two.csv", "campaign.toml"]);
    refused(at, &["two.csv", "--torque-constant", "0.25 m"]);
    refused(at, &["two.csv", "--plot", "bode.pdf"]);
    // Before any work: the table is not read.
    for pair in [["x.svg", "./x.svg"], ["x-motor.svg", "x.svg"]] {
        let said = refused(at, &["absent.csv", "--json", pair[0], "--plot", pair[1]]);
        assert!(said.contains("is given for two outputs"), "{said}");
    }
    assert!(refused(at, &["absent.csv", "--json", "no/a.json"]).contains("cannot be written"));
    // Where they are not needed, too.
    write("good.csv", &table(&ruler(&[0.15, 0.3, 0.45]), 3, 0.01));
    let said = refused(at, &["good.csv", "--arm", "absent.toml", "--at", "p1=0.2 m"]);
    assert!(said.contains("absent.toml"), "{said}");
    let said = refused(at, &["good.csv", "--arm", "arm.toml", "--at", "p9=0.2 m"]);
    assert!(said.contains("--at p9: there is no such point; the points are p1, p2, p3"), "{said}");
    refused(at, &["good.csv", "--arm", "arm.toml", "--at", "p1=0.2 m", "--at", "p1=0.3 m"]);
}

/// A point that turns the other way round is no angle: no form for use is given, and the finding says so.
#[test]
fn a_point_of_the_wrong_sign_gives_no_form_for_use() {
    let folder = tempfile::tempdir().unwrap();
    let text = table(&ruler(&[0.45]), 1, 0.01);
    let turned = text.lines().enumerate().map(|(i, line)| {
        let cells: Vec<String> = line.split(',').map(str::to_owned).collect();
        let sign = |cell: &String| (-cell.parse::<f64>().unwrap()).to_string();
        let cells: Vec<String> = cells
            .iter()
            .enumerate()
            .map(|(k, cell)| if i > 0 && (k == 1 || k == 2) { sign(cell) } else { cell.clone() })
            .collect();
        cells.join(",")
    });
    std::fs::write(folder.path().join("r.csv"), turned.collect::<Vec<_>>().join("\n")).unwrap();
    let mut command = lissom();
    let text = done(command.current_dir(folder.path()).args(["equivalent", "r.csv", "--json"]));
    let found: Value = serde_json::from_str(&text).unwrap();
    assert!(found["equivalent"]["torque"].is_object());
    assert!(found["equivalent"]["strainless"].is_null());
    assert!(found["equivalent"]["state_space"].is_null());
    let findings = found["findings"].as_array().unwrap();
    let said = findings.iter().find(|f| f["code"] == "equivalent-gains").unwrap();
    assert!(said["message"].as_str().unwrap().contains("state space are not given"));
}

/// The report's arm of two masses from a virtual campaign: friction, 12 bits, 3 ms. Both frequencies within
/// 0.5 %, the zero of the tip within 2 %.
#[test]
fn the_reports_two_masses_from_a_campaign() {
    let folder = tempfile::tempdir().unwrap();
    let arm = r#"[beam]
young_modulus = "30e6 psi"
section = { round = "0.047 in" }
spans = [{ length = "6 in", mass = "0.121 lb" }, { length = "6 in", mass = "0.121 lb" }]
[drive]
inertia = "0.005529 lbf*in*s^2"
viscous = "0.01216 lbf*in*s/rad"
torque_constant = "2.184 lbf*in/A"
coulomb = "0.132 A"
[rig]
sample_time = "3 ms"
current_limit = "4.12 A"
motor_sensor = { bits = 12, range = "360 deg" }
controller = { proportional = "8 A/rad", derivative = "0.2 A*s/rad" }
"#;
    let plan = r#"[[runs]]
sine = { frequency = ["0.2 Hz", "0.4 Hz", "0.6 Hz", "0.8 Hz", "1.2 Hz", "1.6 Hz", "2 Hz", "3 Hz", "5 Hz", "6 Hz", "7 Hz", "9 Hz"], amplitude = "0.5 rad" }
periods = 12
"#;
    std::fs::write(folder.path().join("arm.toml"), arm).unwrap();
    std::fs::write(folder.path().join("plan.toml"), plan).unwrap();
    let run = |arguments: &[&str]| {
        let mut command = lissom();
        done(command.current_dir(folder.path()).args(arguments))
    };
    run(&["rig", "arm.toml", "--campaign", "plan.toml", "--out", "v"]);
    let text = run(&["identify", "v/campaign.toml", "--quick", "--json"]);
    let whole: Value = serde_json::from_str(&text).unwrap();
    let text = run(&["equivalent", "v/campaign.toml", "--quick", "--json"]);
    let alone: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(whole["equivalent"], alone["equivalent"]);
    let found = &alone["equivalent"];
    let span = Span {
        length_m: 0.1524,
        flexural_rigidity_n_m2: 0.020_622,
        mass_kg: 0.054_885,
        damping_n_s_per_m: 0.0,
    };
    let truth = LumpedBeam::new(&[span, span]).unwrap().natural_frequencies_rad_s();
    for (k, truth) in truth.iter().enumerate() {
        let omega = number(&found["modes"][k]["natural_frequency_rad_s"]);
        assert!((omega / truth - 1.0).abs() < 5e-3, "{omega} {truth}");
    }
    let zero = &found["zeros"][1]["zeros"][0];
    assert_eq!(zero["class"], "b");
    assert!((number(&zero["magnitude_rad_s"]) / 35.691 - 1.0).abs() < 2e-2, "{zero}");
    let h_motor = number(&found["torque"]["h_motor"]);
    assert!((h_motor / 0.463_943 - 1.0).abs() < 2e-2, "{h_motor}");
}
