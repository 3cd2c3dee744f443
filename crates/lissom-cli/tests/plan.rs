//! `lissom plan`: what it writes is run by `lissom rig`, and what it cannot do is said.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::fs;
use std::path::Path;
use std::process::Output;

use assert_cmd::Command;
use lissom_io::PlannedFile;
use lissom_testmodels::SchemaCheck;
use serde_json::Value;
use tempfile::TempDir;

const ARM: &str = r#"
[beam]
flexural_rigidity = "0.00443 N*m^2"
spans = [{ length = "7 in", mass = "0.121 lb", damping = "0.01 N*s/m" }]
[drive]
inertia = "6.2e-4 kg*m^2"
viscous = "1.4e-3 N*m*s/rad"
torque_constant = "0.247 N*m/A"
coulomb = "0.132 A"
[rig]
sample_time = "3 ms"
current_limit = "4.12 A"
motor_sensor = { bits = 12, range = "360 deg", noise = "0.8 mrad" }
controller = { proportional = "8 A/rad", derivative = "0.2 A*s/rad" }
"#;

fn folder(arm: &str) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("arm.toml"), arm).unwrap();
    folder
}

fn lissom(folder: &Path, args: &[&str]) -> Output {
    let mut command = Command::cargo_bin("lissom").unwrap();
    command.current_dir(folder).args(args).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

#[track_caller]
fn refused(folder: &Path, args: &[&str], message: &str) {
    let output = lissom(folder, args);
    assert_eq!((output.status.code(), text(&output.stderr).trim_end()), (Some(1), message));
}

/// A column of a table that was written.
fn column(table: &str, index: usize) -> Vec<f64> {
    let cell = |row: &str| row.split(',').nth(index).unwrap().parse().unwrap();
    table.lines().skip(1).map(cell).collect()
}

#[test]
fn a_plan_is_run_as_it_was_foreseen() {
    let folder = folder(ARM);
    let at = folder.path();
    let options = ["--out", "plan.toml", "--json", "plan.json", "--tables", "tables"];
    let planned = lissom(at, &[&["plan", "arm.toml"][..], &options].concat());
    assert!(planned.status.success(), "{}", text(&planned.stderr));
    assert!(text(&planned.stdout).contains("Coulomb friction"), "{}", text(&planned.stdout));

    let plan: Value = serde_json::from_slice(&fs::read(at.join("plan.json")).unwrap()).unwrap();
    let made = lissom(at, &["rig", "arm.toml", "--campaign", "plan.toml", "--out", "virtual"]);
    assert!(made.status.success(), "{}", text(&made.stderr));
    let rig: Value =
        serde_json::from_slice(&fs::read(at.join("virtual/rig.json")).unwrap()).unwrap();
    let runs = plan["runs"].as_array().unwrap();
    assert_eq!(runs.len(), rig["runs"].as_array().unwrap().len());
    assert!(runs.iter().filter(|run| run["paired"] == true).count() >= 2);
    for (index, (run, made)) in runs.iter().zip(rig["runs"].as_array().unwrap()).enumerate() {
        // Another seed of the noise: nearly the same.
        let number = |value: &Value| value.as_f64().unwrap();
        assert!((number(&run["waited_s"]) - number(&made["waited_s"])).abs() < 20.0);
        assert!((number(&run["stuck_share"]) - number(&made["stuck_share"])).abs() < 0.03);
        let samples = number(&run["record_s"]) / 0.003;
        assert!((number(&made["samples"]) - samples).abs() < 1.0);
        assert_eq!(made["findings"].as_array().unwrap().len(), 0, "{made}");

        let table =
            fs::read_to_string(at.join(format!("tables/run-{:02}.csv", index + 1))).unwrap();
        let (reference, log) = (column(&table, 1), column(&table, 2));
        let largest = reference.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        let amplitude = number(&run["amplitude_rad"]);
        assert!(largest <= 1.000_001 * amplitude && largest > 0.8 * amplitude);
        assert!((log.iter().sum::<f64>() - samples).abs() < 2.0);
    }

    // Logs of those tables, here the virtual drive's, are identified by the campaign.toml beside them.
    for index in 1..=runs.len() {
        let (log, place) = (format!("run-{index:02}.csv"), format!("tables/log-{index:02}.csv"));
        fs::copy(at.join("virtual").join(log), at.join(place)).unwrap();
    }
    let own = lissom(at, &["identify", "tables/campaign.toml", "--quick", "--json"]);
    assert!(own.status.success(), "{}", text(&own.stderr));
    let found: Value = serde_json::from_slice(&own.stdout).unwrap();
    assert!(found["friction"]["coulomb"]["value"].is_number(), "{found}");
    fs::write(at.join("tables/campaign.toml"), "# mine\n").unwrap();
    let again = lissom(at, &["plan", "arm.toml", "--tables", "tables"]);
    assert!(again.status.success() && text(&again.stderr).contains("left as it is"));
    assert_eq!(fs::read_to_string(at.join("tables/campaign.toml")).unwrap(), "# mine\n");
}

#[test]
fn the_json_and_its_schema_name_the_same_keys() {
    let folder = folder(ARM);
    let any = ["--runs", "any", "--json"];
    let mut check = SchemaCheck::new(
        include_str!("../../../docs/src/reference/schemas/planned.schema.json"),
        "planned",
    );
    let output = lissom(folder.path(), &[&["plan", "arm.toml"][..], &any].concat());
    assert!(output.status.success(), "{}", text(&output.stderr));
    check.look_at(&serde_json::from_slice(&output.stdout).unwrap());
    let sines = ["--runs", "sines", "--within", "3 min", "--coulomb", "1e-6", "--json"];
    let output = lissom(folder.path(), &[&["plan", "arm.toml"][..], &sines].concat());
    assert_eq!(output.status.code(), Some(3), "{}", text(&output.stderr));
    let unreached: Value = serde_json::from_slice(&output.stdout).unwrap();
    check.look_at(&unreached);
    check.holds(&["runs[].without.relative_std", "parameters[].std", "notes[].code"]);
    let notes = unreached["notes"].as_array().unwrap();
    let told = notes.iter().find(|n| n["code"] == "unreached").unwrap();
    assert!(told["message"].as_str().unwrap().contains("within 180 s"), "{told}");
    assert!(unreached["time_s"].as_f64().unwrap() <= 180.0);
}

#[test]
fn the_json_is_read_back_by_the_type_that_wrote_it() {
    let folder = folder(ARM);
    let sines = ["--runs", "sines", "--within", "3 min", "--coulomb", "1e-6"];
    let output =
        lissom(folder.path(), &[&["plan", "arm.toml", "--json", "plan.json"][..], &sines].concat());
    assert_eq!(output.status.code(), Some(3), "{}", text(&output.stderr));
    let written = fs::read_to_string(folder.path().join("plan.json")).unwrap();
    let read: PlannedFile = serde_json::from_str(&written).unwrap();
    assert!(read.notes.iter().any(|note| note.code == "unreached"), "{read:?}");
    assert_eq!(serde_json::to_string_pretty(&read).unwrap() + "\n", written);
}

#[test]
fn what_cannot_be_planned_is_one_error() {
    let no_loop: String = ARM
        .lines()
        .filter(|l| !l.contains("controller"))
        .fold(String::new(), |text, line| text + line + "\n");
    refused(
        folder(&no_loop).path(),
        &["plan", "arm.toml"],
        "error: arm.toml: [rig] has no controller, but a plan needs a position loop\n\
         hint: add controller = { proportional = \"8 A/rad\", derivative = \"0.2 A*s/rad\" } to [rig]",
    );
    let weak = folder(&ARM.replace("4.12 A", "0.1 A"));
    let output = lissom(weak.path(), &["plan", "arm.toml"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(text(&output.stderr).contains("motions can be used"), "{}", text(&output.stderr));
    refused(
        folder(ARM).path(),
        &["plan", "arm.toml", "--within", "1 s"],
        "error: arm.toml: no run fits within 1 s; the shortest takes 15.0 s\n\
         hint: allow more time with --within",
    );
    let fast = folder(&ARM.replace("3 ms", "1 us"));
    let output = lissom(fast.path(), &["plan", "arm.toml"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(text(&output.stderr).contains("too many to try"), "{}", text(&output.stderr));
    // In g·mm² rather than kg·m², or damped by mega in place of milli: simulations would not end.
    for (right, wrong) in [("6.2e-4 kg", "6.2e-13 kg"), ("0.01 N*s/m", "1e7 N*s/m")] {
        let stiff = folder(&ARM.replace(right, wrong));
        let output = lissom(stiff.path(), &["plan", "arm.toml"]);
        assert_eq!(output.status.code(), Some(1));
        let message = text(&output.stderr);
        assert!(message.contains("within a sample") && message.contains("units"), "{message}");
    }
}

#[test]
fn a_file_that_is_no_plan_is_not_written_over() {
    let folder = folder(ARM);
    refused(
        folder.path(),
        &["plan", "arm.toml", "--out", "arm.toml"],
        "error: arm.toml: exists and is not an earlier output; it is not overwritten\n\
         hint: put the input before `--json FILE`, give another name, or delete the file if you do not need it",
    );
}

/// A rigid joint whose load hangs at −30°.
const LOADED: &str = r#"
[beam]
rigid = true
[drive]
inertia = "2e-3 kg*m^2"
viscous = "0.01 N*m*s/rad"
torque_constant = "0.2 N*m/A"
coulomb = "0.06 N*m"
[load]
gravity_torque = "0.3 N*m"
phase = "30 deg"
[rig]
sample_time = "2 ms"
current_limit = "5 A"
motor_sensor = { counts_per_turn = 16384 }
controller = { proportional = "8 A/rad", derivative = "0.25 A*s/rad" }
"#;

#[test]
fn a_load_is_planned_and_run() {
    let folder = folder(LOADED);
    let at = folder.path();
    let any = ["--runs", "any", "--gravity", "0.3%", "--out", "plan.toml", "--json", "plan.json"];
    let planned = lissom(at, &[&["plan", "arm.toml", "--tables", "tables"][..], &any].concat());
    assert!(planned.status.success(), "{}", text(&planned.stderr));
    assert!(text(&planned.stdout).contains("gravity-by-regression"), "{}", text(&planned.stdout));
    let plan: Value = serde_json::from_slice(&fs::read(at.join("plan.json")).unwrap()).unwrap();
    let mut check = SchemaCheck::new(
        include_str!("../../../docs/src/reference/schemas/planned.schema.json"),
        "planned",
    );
    check.look_at(&plan);
    let gravity = plan["expected"].as_array().unwrap().iter().find(|e| e["parameter"] == "gravity");
    let gravity = gravity.unwrap();
    assert_eq!((gravity["wanted"].as_f64(), gravity["value"].as_f64()), (Some(0.003), Some(0.3)));
    assert!(gravity["relative_std"].as_f64().unwrap() < 0.003, "{gravity}");
    let campaign = fs::read_to_string(at.join("tables/campaign.toml")).unwrap();
    assert!(campaign.contains("[load]\ngravity = true"), "{campaign}");
    let made = lissom(at, &["rig", "arm.toml", "--campaign", "plan.toml", "--out", "virtual"]);
    assert!(made.status.success(), "{}", text(&made.stderr));
    let found = lissom(at, &["identify", "virtual/campaign.toml", "--json"]);
    assert!(found.status.success(), "{}", text(&found.stderr));
    let found: Value = serde_json::from_slice(&found.stdout).unwrap();
    let amplitude = found["gravity"]["amplitude"].clone();
    assert!((amplitude["value"].as_f64().unwrap() / 0.3 - 1.0).abs() < 0.003, "{amplitude}");
}
