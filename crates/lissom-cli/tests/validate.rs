//! `lissom validate` on a log of the rig that the result is not from, and on the same with a figure that is wrong.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::fs;
use std::path::Path;
use std::process::Output;

use assert_cmd::Command;
use lissom_testmodels::SchemaCheck;
use serde_json::{Value, json};

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

/// What the result is from.
const USED: &str = r#"
[[runs]]
sine = { frequency = ["0.5 Hz", "2.5 Hz"], amplitude = "0.7 rad" }
periods = 8
[[runs]]
multisine = { frequency = "0.4 Hz", to = "4 Hz", amplitude = "0.3 rad" }
periods = 3
"#;
/// What it is to predict.
const NOT_USED: &str = r#"
[[runs]]
chirp = { from = "1.5 Hz", to = "4 Hz", amplitude = "0.5 rad" }
record = "8 s"
"#;
/// Fit of the motion over a stretch that the true arm follows \[%\].
const FOLLOWED: f64 = 99.0;
/// What the residual looks like is what the figure lacks, to this share: other terms are not counted beside it.
const ABOUT: f64 = 0.3;

fn lissom(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(assert_cmd::cargo::cargo_bin!("lissom"));
    command.current_dir(folder).args(arguments).output().unwrap()
}

fn done(folder: &Path, arguments: &[&str]) -> Output {
    let output = lissom(folder, arguments);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    output
}

fn validated(folder: &Path, result: &str) -> Value {
    let text = done(folder, &["validate", result, "other/campaign.toml", "--json"]).stdout;
    serde_json::from_slice(&text).unwrap()
}

fn codes(validation: &Value) -> Vec<&str> {
    let findings = validation["findings"].as_array().unwrap().iter();
    findings.map(|f| f["code"].as_str().unwrap()).collect()
}

/// Not zero, and a number.
fn is_a_number(value: &Value) -> bool {
    value.as_f64().is_some_and(|v| v.is_finite() && v != 0.0)
}

#[test]
fn a_log_not_used_is_predicted_and_a_wrong_figure_shows() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    for (name, text) in [("arm.toml", ARM), ("used.toml", USED), ("not-used.toml", NOT_USED)] {
        fs::write(at.join(name), text).unwrap();
    }
    done(at, &["rig", "arm.toml", "--campaign", "used.toml", "--out", "logs"]);
    done(at, &["rig", "arm.toml", "--campaign", "not-used.toml", "--out", "other"]);
    done(at, &["identify", "logs/campaign.toml", "--json", "result.json"]);
    let asked = ["validate", "result.json", "other/campaign.toml"];
    done(at, &[&asked[..], &["--plots", "plots", "--json", "validation.json"]].concat());

    let validation: Value =
        serde_json::from_slice(&fs::read(at.join("validation.json")).unwrap()).unwrap();
    let mut check = SchemaCheck::new(
        include_str!("../../../docs/src/reference/schemas/validate.schema.json"),
        "validate",
    );
    check.look_at(&validation);
    let warned = validation["findings"].as_array().unwrap().iter().any(|f| f["severity"] != "info");
    assert!(!warned, "{:?}", codes(&validation));
    assert!(validation["torque"]["relative_error"].as_f64().unwrap() < 0.03, "{validation}");
    let horizons = validation["motion"]["horizons"].as_array().unwrap();
    assert!(horizons.iter().any(|h| h["whole_runs"] == true), "{horizons:?}");
    let shortest = horizons.last().unwrap();
    for channel in shortest["channels"].as_array().unwrap() {
        assert!(channel["fit_percent"].as_f64().unwrap() > FOLLOWED, "{channel}");
    }
    let residuals = validation["residuals"].as_array().unwrap();
    assert_eq!(residuals.len(), 2, "motor and tip");
    for residual in residuals {
        assert!(residual["white_probability"].as_f64().is_some_and(|p| (0.0..=1.0).contains(&p)));
        assert!(residual["outside_share"].as_f64().is_some_and(|p| (0.0..=1.0).contains(&p)));
        for key in ["ljung_box", "autocorrelation_band", "cross_correlation_band", "rms"] {
            assert!(is_a_number(&residual[key]), "{key}: {residual}");
        }
        for key in ["autocorrelation", "cross_correlation"] {
            let lags = residual[key].as_array().unwrap();
            assert!(lags.len() > 10 && lags.iter().any(is_a_number), "{key}: {residual}");
        }
    }

    let of_channels = ["motion", "residual", "autocorrelation", "cross-correlation"];
    let plots = of_channels
        .iter()
        .flat_map(|what| ["motor", "tip-1"].iter().map(move |channel| format!("{what}-{channel}")));
    for plot in plots.chain(["torque".to_owned(), "torque-residual".to_owned()]) {
        let svg = fs::read_to_string(at.join(format!("plots/{plot}.svg"))).unwrap();
        assert!(svg.starts_with("<svg") && svg.contains("<path"), "{plot}");
        let png = fs::read(at.join(format!("plots/{plot}.png"))).unwrap();
        assert!(png.starts_with(b"\x89PNG") && png.len() > 1000, "{plot}");
    }

    let result: Value = serde_json::from_slice(&fs::read(at.join("result.json")).unwrap()).unwrap();
    for (key, term) in [("inertia", "inertia"), ("coulomb", "coulomb")] {
        for factor in [0.8, 1.2] {
            let figure = result["arm"][key].as_f64().unwrap();
            let mut wrong = result.clone();
            wrong["arm"][key] = json!(factor * figure);
            fs::write(at.join("wrong.json"), wrong.to_string()).unwrap();
            let validation = validated(at, "wrong.json");
            let codes = codes(&validation);
            assert!(codes.contains(&"residual-torque"), "{key} {factor}: {codes:?}");
            assert!(codes.contains(&"residual-not-white"), "{key} {factor}: {codes:?}");
            // With another inertia few lags are beyond the band: the residual drifts, and the command hardly does.
            let follows = codes.contains(&"residual-follows-command");
            assert!(follows || term == "inertia", "{key} {factor}: {codes:?}");
            let first = &validation["torque"]["residual_terms"][0];
            assert_eq!(first["term"], term, "{validation}");
            let lacks = (1.0 - factor) * figure;
            let value = first["value"].as_f64().unwrap();
            assert!((value / lacks - 1.0).abs() < ABOUT, "{key} {factor}: {value} for {lacks}");
        }
    }
}
