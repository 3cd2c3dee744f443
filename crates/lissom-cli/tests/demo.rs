//! The demo's accuracy against the truth of its rig, and that it says what it did.

#![expect(clippy::unwrap_used, reason = "tests")]

use std::path::Path;
use std::sync::OnceLock;

use lissom_io::{DemoFile, ResultFile};
use lissom_testmodels::report_arm;
use num_complex::Complex64;
use serde_json::Value;

/// Largest relative errors, by figure: third harmonic, regression. `None` where no bar is set.
const BARS: [(&str, Option<f64>, f64); 5] = [
    ("Coulomb friction", Some(0.08), 0.005),
    ("viscous friction", None, 0.05),
    ("inertia", None, 0.01),
    ("coupling", None, 0.005),
    ("beam frequency", None, 0.002),
];
/// Corrected points may be this much of the raw ones' error in the median.
const MEDIAN_RATIO: f64 = 0.2;
/// At least this share of the points between 3 and 30 rad/s must be free of findings.
const UNFLAGGED: f64 = 0.8;

struct Demo {
    folder: tempfile::TempDir,
    /// What was written with `--json`, and what it says.
    json: String,
    output: Value,
    talk: String,
}

/// The demo, run once for all tests.
fn demo() -> &'static Demo {
    static DEMO: OnceLock<Demo> = OnceLock::new();
    DEMO.get_or_init(|| {
        let folder = tempfile::tempdir().unwrap();
        let json = folder.path().join("comparison.json");
        let output = assert_cmd::Command::cargo_bin("lissom")
            .unwrap()
            .current_dir(folder.path())
            .args(["demo", "--json", json.to_str().unwrap()])
            .output()
            .unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let text = std::fs::read_to_string(json).unwrap();
        Demo {
            folder,
            output: serde_json::from_str(&text).unwrap(),
            json: text,
            talk: String::from_utf8(output.stdout).unwrap(),
        }
    })
}

#[test]
fn figures_are_within_their_bars() {
    let arm = report_arm();
    let rows = demo().output["comparison"].as_array().unwrap();
    // The command's own idea of the truth is the arm's.
    let truth = [
        arm.coulomb.forward() / arm.motor.torque_constant_nm_per_a(),
        arm.motor.viscous_nm_s_per_rad(),
        arm.motor.inertia_kg_m2(),
        arm.dynamics().coupling_motor,
        arm.beam().natural_frequencies_rad_s()[0],
    ];
    for ((row, (name, third, regression)), truth) in rows.iter().zip(BARS).zip(truth) {
        assert_eq!(row["parameter"], name);
        assert!((row["true"].as_f64().unwrap() / truth - 1.0).abs() < 1e-9, "{name}");
        let error = |method: &str| (row[method]["value"].as_f64().unwrap() / truth - 1.0).abs();
        assert!(error("regression") < regression, "{name}: {}", error("regression"));
        assert!(error("output_error") < 1e-4, "{name}: {}", error("output_error"));
        if let Some(bar) = third {
            assert!(error("third_harmonic") < bar, "{name}: {}", error("third_harmonic"));
        }
    }
}

#[test]
fn the_json_is_read_back_by_the_type_that_wrote_it() {
    let demo = demo();
    let read: DemoFile = serde_json::from_str(&demo.json).unwrap();
    assert_eq!(serde_json::to_string_pretty(&read).unwrap() + "\n", demo.json);
    let result = std::fs::read_to_string(demo.folder.path().join("lissom-demo/result.json"));
    assert_eq!(serde_json::from_str::<ResultFile>(&result.unwrap()).unwrap(), read.result);
}

#[test]
fn regression_intervals_are_not_wishful() {
    let arm = report_arm();
    let result = &demo().output["result"];
    let figures = [
        (&result["friction"]["coulomb"], arm.coulomb.forward()),
        (&result["friction"]["viscous"], arm.motor.viscous_nm_s_per_rad()),
        (&result["drive"]["inertia"], arm.motor.inertia_kg_m2()),
        (&result["beam"]["coupling"], arm.dynamics().coupling_motor),
    ];
    for (figure, truth) in figures {
        let value = |key: &str| figure[key].as_f64().unwrap();
        // One campaign is no study of coverage: four standard errors catch wishful ones.
        assert!((value("value") - truth).abs() < 4.0 * value("std"), "{figure} {truth}");
    }
}

#[test]
fn corrected_response_is_closer_than_raw() {
    let arm = report_arm();
    let response = &demo().output["result"]["frequency_response"];
    let number = |v: &Value| v.as_f64().unwrap();
    let omega = response["omega_rad_s"].as_array().unwrap();
    let (mut raw_errors, mut corrected_errors) = (Vec::new(), Vec::new());
    let (mut inside, mut unflagged) = (0, 0);
    for (k, w) in omega.iter().map(number).enumerate() {
        if !(3.0 - 1e-9..=30.0 + 1e-9).contains(&w) {
            continue;
        }
        inside += 1;
        if response["flagged"][k].as_bool().unwrap() {
            continue;
        }
        unflagged += 1;
        let truth = arm.motor_response(w);
        let error = |series: &str| {
            let s = &response[series];
            (Complex64::new(number(&s["re"][k]), number(&s["im"][k])) / truth - 1.0).norm()
        };
        let (raw, corrected) = (error("motor_raw"), error("motor_corrected"));
        assert!(corrected < raw, "{w} rad/s: raw {raw}, corrected {corrected}");
        raw_errors.push(raw);
        corrected_errors.push(corrected);
    }
    assert!(f64::from(unflagged) >= UNFLAGGED * f64::from(inside), "{unflagged} of {inside}");
    let median = |mut v: Vec<f64>| {
        v.sort_by(f64::total_cmp);
        v[v.len() / 2]
    };
    let (raw, corrected) = (median(raw_errors), median(corrected_errors));
    assert!(corrected < MEDIAN_RATIO * raw, "median error: raw {raw}, corrected {corrected}");
}

#[test]
fn flagged_points_have_a_finding_of_their_run() {
    let result = &demo().output["result"];
    let response = &result["frequency_response"];
    for (k, flagged) in response["flagged"].as_array().unwrap().iter().enumerate() {
        let run = &response["run"][k];
        let findings = result["findings"].as_array().unwrap();
        let found = findings.iter().any(|f| {
            let affects = f["affects"].as_array().unwrap();
            f["run"] == *run && affects.iter().any(|a| a == "frequency_response.motor_corrected")
        });
        assert_eq!(found, flagged.as_bool().unwrap(), "{run}");
    }
}

#[test]
fn writes_what_it_says() {
    let demo = demo();
    let out = demo.folder.path().join("lissom-demo");
    let whole = |name: &str| std::fs::read(out.join(name)).unwrap();
    for name in ["bode-motor.png", "bode-tip-1.png"] {
        assert!(whole(name).starts_with(b"\x89PNG"), "{name}");
    }
    for name in ["bode-motor.svg", "bode-tip-1.svg"] {
        assert!(whole(name).starts_with(b"<svg") || whole(name).starts_with(b"<?xml"), "{name}");
    }
    let page = String::from_utf8(whole("report.html")).unwrap();
    assert!(page.contains("<svg"));
    // Nothing is fetched: the only addresses are names of XML namespaces.
    for fetched in ["src=", "<link", "href=\"http", "url("] {
        assert!(!page.contains(fetched), "{fetched}");
    }
    let result: Value = serde_json::from_slice(&whole("result.json")).unwrap();
    assert_eq!(result, demo.output["result"]);
    let heading = demo.talk.lines().find(|l| l.starts_with("parameter")).unwrap();
    for column in ["true", "third harmonic", "regression", "error"] {
        assert!(heading.contains(column), "{heading}");
    }
    // No part of a write is left behind.
    let names = std::fs::read_dir(&out).unwrap().map(|e| e.unwrap().file_name());
    assert!(names.into_iter().all(|n| !Path::new(&n).to_string_lossy().ends_with(".part")));
}

#[test]
fn identify_gives_the_same_from_the_files() {
    let demo = demo();
    let campaign = demo.folder.path().join("lissom-demo/campaign.toml");
    let output = assert_cmd::Command::cargo_bin("lissom")
        .unwrap()
        .args(["identify", campaign.to_str().unwrap(), "--json"])
        .output()
        .unwrap();
    let result: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(result, demo.output["result"]);
}
