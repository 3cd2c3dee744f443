//! `lissom report`, `lissom plot` and `lissom compare --report` on stored results.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::fs;
use std::path::Path;
use std::process::Output;

use assert_cmd::Command;

const ARM: &str = r#"
[beam]
flexural_rigidity = "0.02 N*m^2"
spans = [{ length = "25 cm", mass = "60 g", damping = "1e-3 N*s/m" }]
[drive]
inertia = 8e-4
viscous = 2e-3
torque_constant = 0.3
coulomb = "0.04 N*m"
[rig]
sample_time = "2 ms"
current_limit = "6 A"
motor_sensor = { bits = 14, range = "360 deg", noise = "0.2 mrad" }
tip_sensors = { bits = 14, range = "360 deg", noise = "0.2 mrad" }
controller = { proportional = "8 A/rad", derivative = "0.15 A*s/rad" }
"#;
const PLAN: &str = r#"
[[runs]]
sine = { frequency = ["0.5 Hz", "1.5 Hz", "2.5 Hz"], amplitude = "0.7 rad" }
periods = 8
"#;
const OTHER_PLAN: &str = r#"
seed = 7
[[runs]]
multisine = { frequency = "0.4 Hz", to = "4 Hz", amplitude = "0.3 rad" }
record = "9 s"
"#;

fn lissom(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(assert_cmd::cargo::cargo_bin!("lissom"));
    command.current_dir(folder).args(arguments).output().unwrap()
}

fn done(folder: &Path, arguments: &[&str]) -> String {
    let output = lissom(folder, arguments);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// What a command that fails prints.
fn refused(folder: &Path, arguments: &[&str]) -> String {
    let output = lissom(folder, arguments);
    assert_eq!(output.status.code(), Some(1), "{arguments:?}");
    String::from_utf8(output.stderr).unwrap()
}

/// A campaign in `logs`, its `result.json` and `report.html`, and another campaign in `others`.
fn stored() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    for (name, text) in [("arm.toml", ARM), ("plan.toml", PLAN), ("other.toml", OTHER_PLAN)] {
        fs::write(at.join(name), text).unwrap();
    }
    done(at, &["rig", "arm.toml", "--campaign", "plan.toml", "--out", "logs"]);
    done(at, &["rig", "arm.toml", "--campaign", "other.toml", "--out", "others"]);
    let logs = "logs/campaign.toml";
    done(at, &["identify", logs, "--quick", "--json", "result.json", "--report", "report.html"]);
    folder
}

fn read(folder: &Path, name: &str) -> String {
    fs::read_to_string(folder.join(name)).unwrap()
}

#[test]
fn the_page_made_later_is_that_of_the_identification() {
    let folder = stored();
    let at = folder.path();
    let told = done(at, &["report", "result.json", "logs/campaign.toml"]);
    assert_eq!(told, "written: result.html\n");
    let page = read(at, "result.html").replace("result.json", "logs/campaign.toml");
    assert!(page == read(at, "report.html"), "another page");

    done(at, &["report", "result.json", "--out", "alone.html"]);
    let alone = read(at, "alone.html");
    assert!(alone.contains("Frequency responses</h2>") && !alone.contains("predicted motion</h2>"));
    let arguments = ["report", "result.json", "others/campaign.toml", "--out", "others.html"];
    done(at, &arguments);
    assert!(read(at, "others.html").contains("The result is not from these runs"));
    let log = fs::read_dir(at.join("others")).unwrap().map(|file| file.unwrap().path());
    let log = log.filter(|file| file.extension().is_some_and(|e| e == "csv")).min().unwrap();
    let log = log.to_str().unwrap();
    done(at, &["report", "result.json", log, "--like", "logs/campaign.toml", "--out", "one.html"]);
    assert!(read(at, "one.html").contains("predicted motion</h2>"));
}

#[test]
fn what_is_no_result_and_what_does_not_fit_is_refused() {
    let folder = stored();
    let at = folder.path();
    let error = refused(at, &["report", "arm.toml"]);
    assert!(
        error.contains("arm.toml: is not JSON") && error.contains("hint: give first the result")
    );
    fs::write(at.join("other.json"), "{}").unwrap();
    let error = refused(at, &["report", "other.json"]);
    assert!(error.contains("is not a result of `lissom identify`: it has no `lissom`"), "{error}");
    // Nothing foreign is overwritten, and no input.
    for (out, why) in [("arm.toml", "not an earlier output"), ("result.json", "is an input")] {
        let error = refused(at, &["report", "result.json", "--out", out]);
        assert!(error.contains(why), "{error}");
    }
    let campaign = read(at, "logs/campaign.toml");
    assert!(campaign.contains("\ntorque_constant = "), "{campaign}");
    let other = campaign.replace("\ntorque_constant = ", "\n# torque_constant = ");
    fs::write(at.join("logs/other.toml"), other).unwrap();
    let error = refused(at, &["report", "result.json", "logs/other.toml"]);
    assert!(error.contains("with a torque constant of 0.3 in SI units, but the log"), "{error}");
    let error = refused(at, &["plot", "result.json", "logs/run.csv", "--figure", "motion"]);
    assert!(error.contains("is not a campaign.toml"), "{error}");
    assert_eq!(read(at, "arm.toml"), ARM);
}

#[test]
fn figures_are_listed_and_drawn_by_name() {
    let folder = stored();
    let at = folder.path();
    let list = done(at, &["plot", "result.json"]);
    let named = |name: &str| list.lines().any(|line| line.split(' ').next() == Some(name));
    for name in ["bode-motor", "bode-tip-1", "poles-motor", "third-harmonic", "harmonics"] {
        assert!(named(name), "{name} in {list}");
    }
    assert!(!named("motion") && list.contains("with logs also: motion"), "{list}");
    let list = done(at, &["plot", "result.json", "logs/campaign.toml"]);
    let runs = list.lines().find(|line| line.starts_with("motion ")).unwrap();
    let run = runs.split("--run ").nth(1).unwrap().split([',', ')']).nth(1).unwrap().trim();

    let logs = ["plot", "result.json", "logs/campaign.toml"];
    for (name, begins) in
        [("m.svg", b"<svg".as_slice()), ("m.png", b"\x89PNG"), ("m.pdf", b"%PDF-1.7")]
    {
        done(at, &[&logs[..], &["--figure", "motion", "--run", run, "--out", name]].concat());
        assert!(fs::read(at.join(name)).unwrap().starts_with(begins), "{name}");
    }
    assert!(read(at, "m.svg").contains(&format!("{run}: measured and predicted")));
    let told = done(at, &["plot", "result.json", "--figure", "bode-motor", "--format", "pdf"]);
    assert_eq!(told, "written: bode-motor.pdf\n");
    for (arguments, why) in [
        (&["--figure", "bode-moter"][..], "did you mean `bode-motor`?"),
        (&["--figure", "motion"], "give the logs too"),
        (&["--figure", "harmonics", "--run", "no run"], "without --figure"),
        (&["--figure", "bode-motor", "--out", "a.gif"], "ends in none of .svg, .png and .pdf"),
        (&["--figure", "bode-motor", "--out", "a.png", "--format", "pdf"], "another ending"),
        (&["--figure", "bode-motor", "--out", "arm.toml", "--format", "svg"], "not an earlier"),
    ] {
        let error = refused(at, &[&["plot", "result.json"], arguments].concat());
        assert!(error.contains(why), "{error}");
    }
}

#[test]
fn a_comparison_has_a_page() {
    let folder = stored();
    let at = folder.path();
    // One run does not identify all parameters.
    lissom(at, &["identify", "others/campaign.toml", "--quick", "--json", "other.json"]);
    let table = done(at, &["compare", "result.json", "other.json", "--report", "compared.html"]);
    let page = read(at, "compared.html");
    assert!(
        page.contains("class=\"forest\"") && page.contains("95 % intervals relative to A"),
        "{page}"
    );
    let words = if table.contains("No parameter of B differs clearly from A") {
        "No parameter of B differs clearly from A"
    } else {
        "B differs clearly from A"
    };
    assert!(page.contains(words) && page.contains("other.json"), "{page}");
    let error = refused(at, &["compare", "result.json", "other.json", "--report", "arm.toml"]);
    assert!(error.contains("not an earlier output"), "{error}");
}
