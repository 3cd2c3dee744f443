//! `lissom compare` on results of logs that differ in one parameter.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use assert_cmd::Command;
use lissom_io::ComparedFile;
use lissom_io::result::{ComparedParameterEntry, ParameterDifferenceEntry};
use lissom_testmodels::SchemaCheck;

const CAMPAIGN: &str = r#"[signals]
time = { column = "t", unit = "s" }
current = { column = "i", unit = "A", hold = "measured" }
motor = { column = "m", unit = "rad" }

[drive]
torque_constant = "0.25 N*m/A"

[[runs]]
file = "run.csv"
"#;

/// The rigid joint: inertia \[kg·m²\], viscous friction \[N·m·s/rad\], Coulomb friction \[N·m\].
const INERTIA: f64 = 0.01;
const VISCOUS: f64 = 0.02;
const COULOMB: f64 = 0.05;
/// Largest width of the table of two results.
const WIDTH: usize = 110;

/// Noise between −1 and 1, the same for the same seed.
struct Noise(u64);

impl Noise {
    fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        2.0 * f64::from((self.0 >> 32) as u32) / f64::from(u32::MAX) - 1.0
    }
}

/// A log of the joint with another Coulomb friction: two sines, read with noise.
fn log(coulomb: f64, seed: u64) -> String {
    let mut noise = Noise(seed);
    let mut text = String::from("t,i,m\n");
    for k in 0..6000 {
        let t = 0.004 * f64::from(k);
        let [mut angle, mut speed, mut acceleration] = [0.0; 3];
        for (amplitude, omega) in [(0.8, 3.0), (0.2, 11.0)] {
            let (sin, cos) = (omega * t + 0.3_f64).sin_cos();
            angle += amplitude * sin;
            speed += amplitude * omega * cos;
            acceleration -= amplitude * omega * omega * sin;
        }
        let torque = INERTIA * acceleration + VISCOUS * speed + coulomb * speed.signum();
        let (current, angle) = (torque / 0.25 + 0.02 * noise.next(), angle + 2e-4 * noise.next());
        writeln!(text, "{t:.6},{current:.6},{angle:.7}").unwrap();
    }
    text
}

fn lissom(folder: &Path, arguments: &[&str]) -> String {
    let mut command = Command::new(assert_cmd::cargo::cargo_bin!("lissom"));
    let output = command.current_dir(folder).args(arguments).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// `NAME.json` in the folder: the result of a log.
fn identify(folder: &Path, name: &str, coulomb: f64, seed: u64) {
    fs::write(folder.join("run.csv"), log(coulomb, seed)).unwrap();
    fs::write(folder.join("campaign.toml"), CAMPAIGN).unwrap();
    lissom(folder, &["identify", "campaign.toml", "--quick", "--json", name]);
}

/// The text without its line ends.
fn joined(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn parameter<'a>(found: &'a ComparedFile, key: &str) -> &'a ComparedParameterEntry {
    found.parameters.iter().find(|p| p.key == key).unwrap()
}

fn difference(found: &ComparedFile, key: &str, result: usize) -> ParameterDifferenceEntry {
    parameter(found, key).differences[result - 1].clone().unwrap()
}

#[test]
fn only_the_parameter_that_changed_differs_clearly() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    identify(at, "before.json", COULOMB, 1);
    identify(at, "after.json", 1.3 * COULOMB, 2);
    identify(at, "again.json", COULOMB, 5);

    let text = lissom(at, &["compare", "before.json", "after.json", "again.json", "--json"]);
    let mut check = SchemaCheck::new(
        include_str!("../../../docs/src/reference/schemas/compare.schema.json"),
        "compare",
    );
    check.look_at(&serde_json::from_str(&text).unwrap());
    check.holds(&["parameters[].differences[].standard_errors", "results[].torque_per_command"]);
    let found: ComparedFile = serde_json::from_str(&text).unwrap();
    let d = difference(&found, "friction.coulomb", 1);
    assert!(d.clear && (d.relative.unwrap() - 0.3).abs() < 0.02, "{d:?}");
    let p = parameter(&found, "friction.coulomb");
    let [a, b] = [0, 1].map(|k| p.values[k].clone().unwrap());
    assert!((d.value - (b.value - a.value)).abs() < 1e-12, "{d:?}");
    assert!((d.std - a.std.hypot(b.std)).abs() < 1e-12, "{d:?}");
    let d = difference(&found, "drive.inertia", 1);
    assert!(!d.clear && d.relative.unwrap().abs() < 0.01, "{d:?}");
    for p in &found.parameters {
        let d = p.differences[1].as_ref().unwrap();
        assert!(!d.clear, "{}: {d:?}", p.key);
    }

    let table = lissom(at, &["compare", "before.json", "after.json"]);
    let (rows, words) = table.split_once("B differs clearly from A").unwrap();
    let words = joined(words);
    assert!(words.contains("in Coulomb friction +30."), "{table}");
    assert!(!words.contains("viscous") && !words.contains("inertia"), "{table}");
    assert!(rows.lines().all(|row| row.chars().count() <= WIDTH), "{table}");
    let same = lissom(at, &["compare", "before.json", "again.json"]);
    assert!(same.contains("No parameter of B differs clearly from A,"), "{same}");
}

#[test]
fn a_parameter_that_is_doubtful_or_absent_is_marked() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    identify(at, "before.json", COULOMB, 1);
    identify(at, "after.json", 1.3 * COULOMB, 2);
    let text = fs::read_to_string(at.join("after.json")).unwrap();
    let mut after: serde_json::Value = serde_json::from_str(&text).unwrap();
    after["drive"]["inertia"] = serde_json::Value::Null;
    after["findings"].as_array_mut().unwrap().push(serde_json::json!({
        "code": "few-phases", "severity": "warning", "run": null,
        "affects": ["friction.coulomb"], "message": "", "hint": ""
    }));
    let estimate = after["friction"]["coulomb"].clone();
    let mut law = after["friction"].clone();
    law.as_object_mut().unwrap().retain(|key, _| key != "law" && key != "curve");
    law["near_rest"] = serde_json::json!({
        "amplitude": estimate, "static_friction": null, "speed": estimate,
        "falloff": "exponential"
    });
    after["friction"]["law"] = law;
    fs::write(at.join("after.json"), after.to_string()).unwrap();
    let table = lissom(at, &["compare", "before.json", "after.json"]);
    let row = |name: &str| table.lines().find(|line| line.starts_with(name)).unwrap();
    assert_eq!(row("inertia").matches(" —").count(), 3, "{table}");
    assert!(row("Coulomb friction").ends_with(" B"), "{table}");
    assert!(!row("viscous friction").ends_with(" B"), "{table}");
    let words = joined(&table);
    assert!(words.contains("(doubtful)") && words.contains("few-phases (B)"), "{table}");
    assert!(words.contains("The friction laws differ: A has Coulomb and viscous friction only"));
}
