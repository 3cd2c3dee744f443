//! `lissom payload` beside the arm built with the other payload, and what it refuses.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::fs;
use std::path::Path;

use assert_cmd::Command;
use lissom_testmodels::SchemaCheck;
use serde_json::Value;

fn lissom(folder: &Path, arguments: &[&str]) -> std::process::Output {
    let mut command = Command::new(assert_cmd::cargo::cargo_bin!("lissom"));
    command.current_dir(folder).args(arguments).output().unwrap()
}

fn done(folder: &Path, arguments: &[&str]) -> String {
    let output = lissom(folder, arguments);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

fn refused(folder: &Path, arguments: &[&str]) -> String {
    let output = lissom(folder, arguments);
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.code() == Some(1) && output.stdout.is_empty(), "{said}");
    assert!(said.starts_with("error: ") && said.contains("\nhint: "), "{said}");
    said
}

fn arm(mass: &str) -> String {
    format!(
        "[beam]\n\
         flexural_rigidity = \"0.02 N*m^2\"\n\
         spans = [{{ length = \"25 cm\", mass = \"{mass}\", damping = \"1e-3 N*s/m\" }}]\n\
         [drive]\n\
         inertia = 8e-4\n\
         viscous = 2e-3\n\
         torque_constant = 0.3\n\
         coulomb = \"0.04 N*m\"\n\
         [rig]\n\
         sample_time = \"2 ms\"\n\
         current_limit = \"6 A\"\n\
         motor_sensor = {{ bits = 13, range = \"360 deg\" }}\n\
         controller = {{ proportional = \"8 A/rad\", derivative = \"0.15 A*s/rad\" }}\n"
    )
}

const PLAN: &str = "[[runs]]\nsine = { frequency = [\"0.3 Hz\", \"2.5 Hz\"], amplitude = \"0.5 rad\" }\nperiods = 6\n";

#[test]
fn another_payload_is_that_of_the_arm_built_with_it() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    fs::write(at.join("arm.toml"), arm("50 g")).unwrap();
    fs::write(at.join("other.toml"), arm("120 g")).unwrap();
    fs::write(at.join("plan.toml"), PLAN).unwrap();
    done(at, &["rig", "arm.toml", "--campaign", "plan.toml", "--out", "logs"]);
    let asked = ["payload", "logs/campaign.toml", "--mass", "50 g", "--at", "25 cm"];
    let with = |more: &[&'static str]| [&asked[..], more].concat();
    let text = done(at, &with(&["--to", "120 g", "--to", "25 g", "--json", "--plot", "tip.svg"]));
    let json: Value = serde_json::from_str(&text).unwrap();
    let model: Value = serde_json::from_str(&done(at, &["model", "other.toml", "--json"])).unwrap();
    let truth = model["natural_frequencies_rad_s"][0].as_f64().unwrap();
    let found = &json["payloads"][0]["modes"][0]["natural_frequency_rad_s"];
    let (value, std) = (found["value"].as_f64().unwrap(), found["std"].as_f64().unwrap());
    assert!(
        (value / truth - 1.0).abs() < 1e-3 && (value - truth).abs() < 5.0 * std,
        "{found} {truth}"
    );
    let mut check = SchemaCheck::new(
        include_str!("../../../docs/src/reference/schemas/payload.schema.json"),
        "payload",
    );
    check.look_at(&json);
    check.holds(&["payloads[].modes[].damping_ratio.ci95", "payloads[].tip[].std"]);
    assert!(fs::read_to_string(at.join("tip.svg")).unwrap().starts_with("<svg"));
    let table = done(at, &with(&["--to", "120 g"]));
    assert!(table.contains("with 0.12 kg, motor clamped:"), "{table}");

    let too_much =
        ["payload", "logs/campaign.toml", "--mass", "9 kg", "--at", "25 cm", "--to", "1 g"];
    assert!(refused(at, &too_much).contains("cannot be predicted"));
    assert!(
        refused(at, &with(&["--to", "60 g", "--tip", "elbow"]))
            .contains("\"elbow\" is none of the tips")
    );
    assert!(
        refused(at, &["payload", "logs/campaign.toml", "--mass", "50 g", "--to", "1 g"])
            .contains("--at")
    );
    assert!(
        refused(at, &with(&["--to", "60 g", "--plot", "tip.gif"]))
            .contains("neither .svg nor .png")
    );
}

/// What can be said at once is said before the runs are identified.
#[test]
fn what_is_wrong_is_said_before_the_work() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    fs::write(at.join("run.csv"), "t,i,theta\n0,0,0\n").unwrap();
    let asked = ["payload", "campaign.toml", "--mass", "50 g", "--at", "25 cm", "--to", "120 g"];
    let said = refused(at, &[&asked[..], &["--json", "no/where.json"]].concat());
    assert!(said.contains("no/where.json: cannot be written"), "{said}");
    let said = refused(at, &[&asked[..], &["--plot", "no/where.svg"]].concat());
    assert!(said.contains("no/where.svg: cannot be written"), "{said}");
    let said = refused(at, &[&asked[..], &["--plot", "a.svg", "--json", "a.svg"]].concat());
    assert!(said.contains("is given for two outputs"), "{said}");
    let said = refused(at, &["payload", "run.csv", "--mass", "50 g", "--to", "120 g"]);
    assert!(
        said.contains("run.csv: is not a campaign.toml") && !said.contains("TOML parse"),
        "{said}"
    );
}
