#![expect(clippy::float_cmp, reason = "these numbers are exact")]

use std::path::Path;

use lissom_core::rig::{Drive, Reference, Settle, Start};

use super::PlanFile;

fn read(text: &str) -> Result<PlanFile, crate::Error> {
    PlanFile::from_text("plan.toml".as_ref(), text)
}

#[track_caller]
fn refused(text: &str, message: &str) {
    let error = read(text).unwrap_err();
    assert_eq!(error.to_string(), message);
    assert!(error.hint().is_some(), "{message}");
}

#[test]
fn lists_stand_for_each_with_each() {
    let plan = read(
        "[[runs]]\nsine = { omega_rad_s = [1, 3], amplitude = [0.5, \"1 rad\"] }\nperiods = 12\nrecord = \"40 s\"",
    )
    .unwrap();
    let names: Vec<&str> = plan.runs.iter().map(|r| r.name.as_str()).collect();
    assert_eq!(names, ["run-01", "run-02", "run-03", "run-04"]);
    let omegas: Vec<Option<f64>> = plan.runs.iter().map(|r| r.omega_rad_s).collect();
    assert_eq!(omegas, [Some(1.0), Some(3.0), Some(1.0), Some(3.0)]);
    let records: Vec<f64> = plan.runs.iter().map(|r| r.experiment.record_s).collect();
    let tau = std::f64::consts::TAU;
    assert_eq!(records, [12.0 * tau, 40.0, 12.0 * tau, 40.0]);
    assert_eq!(plan.runs[0].experiment.settle, Settle::DETECTED);
    let seeds: std::collections::HashSet<u64> = plan.runs.iter().map(|r| r.seed).collect();
    assert_eq!(seeds.len(), 4);
}

#[test]
fn reads_every_kind() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("moves.csv"), "t,r\n5,0\n6,90\n7,0\n").unwrap();
    let path = folder.path().join("plan.toml");
    let text = r#"
title = "All of them"
seed = 7
settle = "12 s"
[[runs]]
square = { frequency = "0.5 Hz", amplitude = "1 A" }
drive = "current"
periods = 4
settle = "none"
[[runs]]
multisine = { frequency = "0.1 Hz", to = "2 Hz", amplitude = 0.5, crest = 1.8, phases = 3 }
periods = 2
repeat = 2
[[runs]]
chirp = { from = "0.1 Hz", to = "5 Hz", amplitude = 0.3, sweep = "linear" }
record = "20 s"
start = { tip_force = "0.1 N" }
[[runs]]
velocity = ["1 rad/s", "-60 rpm"]
record = "10 s"
settle = { tolerance = 1e-3, longest = "50 s" }
[[runs]]
name = "moves"
table = { file = "moves.csv", time = "t", value = "r", unit = "deg" }
[[runs]]
name = "let-go"
release = "1 N"
record = "20 s"
"#;
    let plan = PlanFile::from_text(&path, text).unwrap();
    let names: Vec<&str> = plan.runs.iter().map(|r| r.name.as_str()).collect();
    assert_eq!(
        names,
        ["run-01", "run-02", "run-03", "run-04", "run-05", "run-06", "moves", "let-go"]
    );
    let experiments: Vec<_> = plan.runs.iter().map(|r| &r.experiment).collect();
    assert!(matches!(experiments[0].drive, Drive::Current(Reference::Square(_))));
    assert_eq!((experiments[0].record_s, experiments[0].settle), (8.0, Settle::AtOnce));
    let Drive::Angle(Reference::Multisine(multisine)) = &experiments[1].drive else { panic!() };
    assert!(multisine.crest() <= 1.8);
    assert_eq!(experiments[1].drive, experiments[2].drive);
    assert_ne!(plan.runs[1].seed, plan.runs[2].seed);
    assert_eq!(experiments[1].settle, Settle::Wait { wait_s: 12.0 });
    assert_eq!(experiments[3].start, Start::Deflected { tip_force_n: 0.1 });
    assert_eq!(experiments[5].drive.reference().value(1.0), -std::f64::consts::TAU);
    assert_eq!(experiments[5].settle, Settle::Detected { tolerance: 1e-3, longest_s: 50.0 });
    let moves = experiments[6].drive.reference();
    assert!((moves.value(0.5) - 45.0_f64.to_radians()).abs() < 1e-15);
    assert_eq!(experiments[6].record_s, 2.0);
    assert!(matches!(experiments[7].drive, Drive::Current(Reference::Hold { .. })));
    assert_eq!(experiments[7].settle, Settle::AtOnce);
}

#[test]
fn refuses_what_makes_no_experiment() {
    refused("", "plan.toml has no `runs`");
    refused("runs = []", "plan.toml, line 1: `runs` is an empty list");
    refused(
        "[[runs]]\nrecord = 1",
        "plan.toml, line 1: `runs[1]` has none of `sine`, `multisine`, `square`, `chirp`, `table`, `velocity`, `release`",
    );
    refused(
        "[[runs]]\nsine = { frequency = \"1 Hz\", amplitude = 1 }",
        "plan.toml, line 1: `runs[1]` has none of `periods`, `record`",
    );
    refused(
        "[[runs]]\nsine = { frequency = \"1 Hz\", amplitude = \"1 A\" }\nrecord = 1",
        "plan.toml, line 2: `runs[1].sine.amplitude`: \"1 A\" is a current [A], where a plain number or angle is expected",
    );
    refused(
        "[[runs]]\nvelocity = 1\nperiods = 3",
        "plan.toml, line 3: `runs[1].periods` is allowed only for periodic motions",
    );
    refused(
        "[[runs]]\nmultisine = { frequency = \"5 Hz\", to = \"1 Hz\", amplitude = 1 }\nperiods = 1",
        "plan.toml, line 2: `runs[1].multisine`: the multisine has no lines",
    );
    refused(
        "[[runs]]\nname = \"../x\"\nvelocity = 1\nrecord = 1",
        "plan.toml, line 1: `runs`: `../x` is not a valid name for a log",
    );
    let twice = "[[runs]]\nname = \"a\"\nvelocity = 1\nrecord = 1\n";
    refused(&twice.repeat(2), "plan.toml, line 1: `runs`: two runs have the name `a`");
    let missing = "[[runs]]\ntable = { file = \"none.csv\" }";
    assert!(read(missing).unwrap_err().to_string().contains("none.csv"));
    assert!(PlanFile::read(Path::new("nowhere/plan.toml")).is_err());
}
