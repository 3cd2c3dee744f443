//! `lissom rig` and `lissom figures`: campaigns that can be taken up again, and what is refused.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Output;

use assert_cmd::Command;
use lissom_io::{FiguresFile, RigFile};
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
motor_sensor = { bits = 12, range = "360 deg", noise = "0.3 mrad" }
controller = { proportional = "8 A/rad", derivative = "0.2 A*s/rad" }
"#;

const PLAN: &str = r#"
title = "A test"
settle = { longest = "100 s" }
[[runs]]
sine = { omega_rad_s = [2, 3, 6, 9], amplitude = "0.5 rad" }
periods = 6
[[runs]]
velocity = ["2 rad/s", "-2 rad/s"]
record = "1 s"
[[runs]]
release = "0.5 N"
record = "3 s"
"#;

struct Bench(TempDir);

impl Bench {
    fn new(arm: &str, plan: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("arm.toml"), arm).unwrap();
        fs::write(folder.path().join("plan.toml"), plan).unwrap();
        Self(folder)
    }

    fn run(&self, out: &str, more: &[&str]) -> Output {
        let mut command = Command::cargo_bin("lissom").unwrap();
        command.current_dir(self.0.path());
        command.args(["rig", "arm.toml", "--campaign", "plan.toml", "--out", out]).args(more);
        command.output().unwrap()
    }

    fn done(&self, out: &str, more: &[&str]) -> BTreeMap<String, Vec<u8>> {
        let output = self.run(out, more);
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        files(&self.0.path().join(out))
    }

    #[track_caller]
    fn refused(&self, out: &str, message: &str) {
        let output = self.run(out, &[]);
        let text = String::from_utf8(output.stderr).unwrap();
        assert_eq!((output.status.code(), text.trim_end()), (Some(1), message));
        assert!(output.stdout.is_empty());
    }
}

fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap());
    let entries = entries.filter(|entry| entry.path().is_file());
    entries.map(|e| (e.file_name().into_string().unwrap(), fs::read(e.path()).unwrap())).collect()
}

#[test]
fn the_same_bytes_on_any_number_of_threads_and_after_any_interruption() {
    let bench = Bench::new(ARM, PLAN);
    let whole = bench.done("whole", &["--jobs", "1"]);
    assert_eq!(whole.len(), 7 + 4, "{:?}", whole.keys());
    assert_eq!(bench.done("many", &["--jobs", "4"]), whole);
    assert_eq!(bench.done("whole", &[]), whole, "a campaign that is done stays as it is");
    // As a process killed after some runs leaves it: no log is there in part.
    let cut = bench.0.path().join("cut");
    bench.done("cut", &[]);
    let rig: Value = serde_json::from_slice(&whole["rig.json"]).unwrap();
    fs::remove_file(cut.join("rig.json")).unwrap();
    fs::remove_file(cut.join("campaign.toml")).unwrap();
    fs::create_dir(cut.join("rig-parts")).unwrap();
    let input = serde_json::json!({ "fingerprint": rig["fingerprint"] });
    fs::write(cut.join("rig-parts/input.json"), input.to_string()).unwrap();
    for (index, run) in rig["runs"].as_array().unwrap().iter().enumerate() {
        let log = run["file"].as_str().unwrap();
        if index % 2 == 0 {
            fs::remove_file(cut.join(log)).unwrap();
        } else {
            let part = format!("rig-parts/run.{}.json", log.trim_end_matches(".csv"));
            fs::write(cut.join(part), run.to_string()).unwrap();
        }
    }
    assert_eq!(bench.done("cut", &[]), whole);
}

#[test]
fn the_logs_are_read_back_and_tell_the_truth() {
    let bench = Bench::new(ARM, PLAN);
    let files = bench.done("out", &[]);
    let mut check = SchemaCheck::new(
        include_str!("../../../docs/src/reference/schemas/rig.schema.json"),
        "rig.json",
    );
    let rig: Value = serde_json::from_slice(&files["rig.json"]).unwrap();
    check.look_at(&rig);
    check.holds(&["truth", "runs[].findings[].message"]);
    let mut command = Command::cargo_bin("lissom").unwrap();
    let campaign = bench.0.path().join("out/campaign.toml");
    let output = command.args(["identify"]).arg(campaign).arg("--json").output().unwrap();
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    let near = |found: &Value, truth: &Value, by: f64| {
        let (found, truth) = (found["value"].as_f64().unwrap(), truth.as_f64().unwrap());
        assert!((found / truth - 1.0).abs() < by, "{found} {truth}");
    };
    near(&found["friction"]["coulomb"], &rig["truth"]["forward_nm"], 0.02);
    near(&found["drive"]["inertia"], &rig["truth"]["inertia_kg_m2"], 0.03);
}

#[test]
fn rig_json_is_read_back_by_the_type_that_wrote_it() {
    let bench = Bench::new(ARM, PLAN);
    let files = bench.done("out", &["--json", "copy.json"]);
    let copy = fs::read(bench.0.path().join("copy.json")).unwrap();
    let mut read: Vec<RigFile> = Vec::new();
    for written in [files["rig.json"].as_slice(), &copy] {
        let written = std::str::from_utf8(written).unwrap();
        let file: RigFile = serde_json::from_str(written).unwrap();
        assert_eq!(serde_json::to_string_pretty(&file).unwrap() + "\n", written);
        read.push(file);
    }
    // The fingerprint is of the folder alone.
    assert!(read[0].fingerprint.is_some());
    read[0].fingerprint = None;
    assert_eq!(read[0], read[1]);
}

#[test]
fn another_campaign_is_left_alone() {
    let bench = Bench::new(ARM, PLAN);
    let before = bench.done("out", &[]);
    fs::write(bench.0.path().join("plan.toml"), PLAN.replace("periods = 6", "periods = 7"))
        .unwrap();
    bench.refused(
        "out",
        "error: out: contains another campaign; nothing is overwritten\n\
         hint: give another --out, or delete the folder if you do not need it",
    );
    assert_eq!(files(&bench.0.path().join("out")), before);
    fs::create_dir(bench.0.path().join("mine")).unwrap();
    fs::write(bench.0.path().join("mine/run-01.csv"), "precious").unwrap();
    bench.refused(
        "mine",
        "error: mine: contains run-01.csv, which is not from a virtual campaign; nothing is overwritten\n\
         hint: give another --out, or delete the folder if you do not need it",
    );
}

#[test]
fn what_cannot_be_simulated_is_said_once() {
    let wild = ARM.replace("derivative = \"0.2 A*s/rad\"", "derivative = \"2 A*s/rad\"");
    let wild = wild.replace("current_limit = \"4.12 A\"\n", "");
    let output = Bench::new(&wild, PLAN).run("out", &[]);
    let text = String::from_utf8(output.stderr).unwrap();
    assert!(text.starts_with("error: run `run-01`: the loop is unstable: "), "{text}");
    assert!(text.contains(" s after the start") || text.contains(" s"), "{text}");
    assert!(text.contains("hint: lower the gains"), "{text}");
    assert_eq!(output.status.code(), Some(1));

    let turning = "[[runs]]\nvelocity = \"2 rad/s\"\nrecord = \"5 s\"";
    let output = Bench::new(ARM, turning).run("out", &[]);
    let text = String::from_utf8(output.stderr).unwrap();
    assert!(text.contains("its sensor ends at -3.142 and 3.140 rad"), "{text}");
    assert!(text.contains("counts_per_turn"), "{text}");

    let open = ARM.lines().filter(|l| !l.starts_with("controller")).collect::<Vec<_>>().join("\n");
    Bench::new(&open, PLAN).refused(
        "out",
        "error: arm.toml: run `run-01` needs a controller, but [rig] has none\n\
         hint: add controller = { proportional = \"8 A/rad\", derivative = \"0.2 A*s/rad\" } to [rig], \
         or drive = \"current\" to the run",
    );
    let zero = ARM.replace("\"3 ms\"", "\"0 ms\"");
    Bench::new(&zero, PLAN).refused(
        "out",
        "error: arm.toml, line 11: `rig.sample_time` is \"0 ms\", but must be greater than zero\n\
         hint: check the number and its unit",
    );
    let fast = PLAN.replace("omega_rad_s = [2, 3, 6, 9]", "omega_rad_s = 2000");
    let output = Bench::new(ARM, &fast).run("out", &[]);
    let text = String::from_utf8(output.stderr).unwrap();
    assert!(text.contains("the Nyquist frequency is 1047.19"), "{text}");
}

#[test]
fn findings_say_what_the_log_does_not() {
    let held = ARM.replace("coulomb = \"0.132 A\"", "coulomb = \"20 A\"");
    let weak = ARM.replace("current_limit = \"4.12 A\"", "current_limit = \"0.15 A\"");
    let plan =
        "settle = \"none\"\n[[runs]]\nsine = { omega_rad_s = 9, amplitude = 0.5 }\nperiods = 6";
    for (arm, code) in [(held, "never_moved"), (weak, "current_limited")] {
        let files = Bench::new(&arm, plan).done("out", &[]);
        let rig: Value = serde_json::from_slice(&files["rig.json"]).unwrap();
        let codes = rig["runs"][0]["findings"].as_array().unwrap();
        assert!(codes.iter().any(|f| f["code"] == code), "{code}: {codes:?}");
    }
}

#[test]
fn a_log_that_was_cut_is_made_again_and_a_failed_plan_can_be_mended() {
    let bench = Bench::new(ARM, PLAN);
    let whole = bench.done("out", &[]);
    for cut in ["run-02.csv", "run-05.csv"] {
        let text = &whole[cut];
        fs::write(bench.0.path().join("out").join(cut), &text[..text.len() / 2]).unwrap();
    }
    assert_eq!(bench.done("out", &[]), whole);
    fs::write(bench.0.path().join("plan.toml"), PLAN.replace("\"3 s\"", "\"1e9 s\"")).unwrap();
    assert_eq!(bench.run("again", &[]).status.code(), Some(1));
    for log in files(&bench.0.path().join("again")).keys().filter(|name| name.ends_with("csv")) {
        fs::remove_file(bench.0.path().join("again").join(log)).unwrap();
    }
    fs::write(bench.0.path().join("plan.toml"), PLAN).unwrap();
    assert_eq!(bench.done("again", &[]), whole);
}

#[test]
fn payloads_may_come_and_go_while_it_settles() {
    let beam =
        "payload = { mass = \"0.05 kg\", inertia = \"1e-4 kg*m^2\", offset = \"10 mm\" }\n[drive]";
    let turning = ARM.replace("[drive]", beam);
    let take = "[tip]\npayloads = [{ at = 0.5, mass = 0.05, inertia = 1e-4 }]\n[rig]";
    for arm in [
        turning.replace("[rig]", "[tip]\npayloads = [{ at = 0.5 }]\n[rig]"),
        ARM.replace("[rig]", take),
    ] {
        Bench::new(&arm, PLAN).done("out", &[]);
    }
}

#[test]
fn a_heavy_beam_is_lumped_and_identified() {
    let heavy = ARM.replace("spans = [{", "mass_per_length = \"4 g/m\"\nspans = [{");
    let heavy = heavy.replace("[rig]", "[rig]\nmasses = 1");
    let bench = Bench::new(&heavy, PLAN);
    bench.done("out", &[]);
    let mut command = Command::cargo_bin("lissom").unwrap();
    let campaign = bench.0.path().join("out/campaign.toml");
    let output = command.args(["identify"]).arg(campaign).output().unwrap();
    assert_ne!(output.status.code(), Some(1), "{}", String::from_utf8_lossy(&output.stderr));
}

/// The report's printed 0.161, 0.152 and 0.132 A, and that docs/src/evidence/report-figures.md says what comes out.
#[test]
fn figure_8_is_explained() {
    let folder = tempfile::tempdir().unwrap();
    let mut command = Command::cargo_bin("lissom").unwrap();
    let json = folder.path().join("figures.json");
    command.arg("figures").arg("--out").arg(folder.path()).arg("--json").arg(&json);
    let output = command.output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let printed = String::from_utf8(output.stdout).unwrap();
    let table = printed.split("\n\n").next().unwrap();
    assert!(
        include_str!("../../../docs/src/evidence/report-figures.md").contains(table),
        "{table}"
    );
    for name in ["figure-6", "figure-7", "figure-8"] {
        for ending in ["svg", "png"] {
            assert!(folder.path().join(format!("{name}.{ending}")).exists());
        }
    }
    let figure = |name: &str, column: usize| -> f64 {
        let row = table.lines().find(|line| line.starts_with(name)).unwrap();
        row[name.len()..].split_whitespace().nth(column).unwrap().parse().unwrap()
    };
    for name in ["classical, forward", "classical, backward", "spectral, (26)-(29)"] {
        let (printed, here) = (figure(name, 0), figure(name, 1));
        assert!((printed - here).abs() < 1e-3, "{name}: {printed} {here}");
    }
    // What was written is read back by the type that wrote it.
    let written = fs::read_to_string(json).unwrap();
    let read: FiguresFile = serde_json::from_str(&written).unwrap();
    assert_eq!(serde_json::to_string_pretty(&read).unwrap() + "\n", written);
    assert_eq!(read.coulomb[0].printed_a, Some(0.161));
}

#[test]
fn the_description_beside_the_logs_is_judged() {
    let bench = Bench::new(ARM, PLAN);
    bench.done("out", &[]);
    let out = bench.0.path().join("out");
    let longer = ARM.replace("\"7 in\"", "\"7.35 in\"");
    fs::write(out.join("arm.toml"), longer).unwrap();
    let mut command = Command::cargo_bin("lissom").unwrap();
    command.current_dir(&out);
    command.args(["identify", "campaign.toml", "--json", "--report", "report.html"]);
    let output = command.output().unwrap();
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    let check = &found["geometry"];
    assert_eq!(check["agrees"], false);
    let best = check["explanations"].as_array().unwrap();
    let length = best.iter().find(|e| e["quantity"] == "length").unwrap();
    let ends = length["factor"]["ci95"].as_array().unwrap();
    let (low, high) = (ends[0].as_f64().unwrap(), ends[1].as_f64().unwrap());
    assert!(low < 1.0 / 1.05 && 1.0 / 1.05 < high && high < 0.97, "{length}");
    let page = fs::read_to_string(out.join("report.html")).unwrap();
    assert!(
        page.contains("Comparison with arm.toml") && page.contains("Best explanation"),
        "{check}"
    );
}

/// A rigid joint whose load hangs at −30°.
const LOADED: &str = r#"
[beam]
rigid = true
[drive]
inertia = "0.02 kg*m^2"
viscous = "0.05 N*m*s/rad"
torque_constant = "0.5 N*m/A"
coulomb = "0.3 N*m"
[load]
gravity_torque = "2 N*m"
phase = "30 deg"
[rig]
sample_time = "2 ms"
current_limit = "20 A"
motor_sensor = { counts_per_turn = 65536, noise = "20 urad" }
controller = { proportional = "40 A/rad", derivative = "2 A*s/rad" }
"#;

const LOADED_PLAN: &str = r#"
[[runs]]
sine = { omega_rad_s = [2, 6], amplitude = "1.2 rad" }
periods = 8
[[runs]]
multisine = { omega_rad_s = 1.5, to = 20, amplitude = "0.8 rad" }
periods = 4
"#;

#[test]
fn a_load_is_identified_with_the_rest() {
    let bench = Bench::new(LOADED, LOADED_PLAN);
    let files = bench.done("out", &[]);
    let campaign = std::str::from_utf8(&files["campaign.toml"]).unwrap();
    assert!(campaign.contains("[load]\ngravity = true"), "{campaign}");
    let mut check = SchemaCheck::new(
        include_str!("../../../docs/src/reference/schemas/rig.schema.json"),
        "rig.json",
    );
    let rig: Value = serde_json::from_slice(&files["rig.json"]).unwrap();
    check.look_at(&rig);
    check.holds(&["truth.gravity.sine_nm", "truth.gravity.cosine_nm"]);
    let mut command = Command::cargo_bin("lissom").unwrap();
    let place = bench.0.path().join("out/campaign.toml");
    let output = command.args(["identify"]).arg(place).arg("--json").output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    let truth = &rig["truth"];
    let near = |found: &Value, truth: &Value, by: f64| {
        let value = found["value"].as_f64().unwrap();
        let truth = truth.as_f64().unwrap();
        assert!((value / truth - 1.0).abs() < by, "{value} {truth}");
    };
    near(&found["drive"]["inertia"], &truth["inertia_kg_m2"], 1e-4);
    near(&found["friction"]["coulomb"], &truth["forward_nm"], 1e-4);
    near(&found["friction"]["viscous"], &truth["viscous_nm_s_per_rad"], 1e-4);
    near(&found["gravity"]["sine"], &truth["gravity"]["sine_nm"], 1e-4);
    near(&found["gravity"]["cosine"], &truth["gravity"]["cosine_nm"], 1e-4);
}

#[test]
fn a_load_on_bristles_is_simulated_too() {
    let bristles = LOADED.replace(
        "[load]",
        "bristles = { stiffness = \"4e3 N*m/rad\", damping = \"4 N*m*s/rad\", tolerance = 1e-6 }\n[load]",
    );
    let files = Bench::new(&bristles, LOADED_PLAN).done("out", &[]);
    let rig: Value = serde_json::from_slice(&files["rig.json"]).unwrap();
    assert_eq!(rig["tolerance"], 1e-6);
    for run in rig["runs"].as_array().unwrap() {
        assert_eq!(run["findings"].as_array().unwrap().len(), 0, "{run}");
    }
}

#[test]
fn what_a_load_needs_is_said() {
    let on_beam = ARM.replace("[rig]", "[load]\ngravity_torque = \"2 N*m\"\n[rig]");
    Bench::new(&on_beam, PLAN).refused(
        "out",
        "error: arm.toml: [load] gives gravity to an arm with a beam, but gravity is simulated only for a rigid joint\n\
         hint: remove [load], or write `rigid = true` instead of the other keys of [beam]",
    );
    let wrong = LOADED.replace("\"2 N*m\"", "\"-2 N*m\"");
    Bench::new(&wrong, PLAN).refused(
        "out",
        "error: arm.toml, line 10: `load.gravity_torque` is \"-2 N*m\", but must be greater than zero\n\
         hint: check its sign",
    );
    let release = "[[runs]]\nrelease = \"0.5 N\"\nrecord = \"3 s\"";
    let output = Bench::new(LOADED, release).run("out", &[]);
    assert_eq!(output.status.code(), Some(1));
    let text = String::from_utf8(output.stderr).unwrap();
    assert!(
        text.contains("on a rigid joint, cannot be simulated") && text.contains("hint: "),
        "{text}"
    );
}
