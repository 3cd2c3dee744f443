//! From a result back to its arm, and to what it predicts.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::path::PathBuf;

use lissom::identify::{FoundArm, Options, ValidationOptions, identify, validate};
use lissom::load::{GravityLoad, TorqueRipple};
use lissom::record::{
    Axis, Campaign, Channels, Command, CommandQuantity, Hold, Run, Tip, TipQuantity,
};
use lissom::replay::{Root, WithLoad};
use lissom::rig::{Experiment, Settle};
use lissom_io::{Error, ResultError, ResultFile, ValidationFile, read_arm};
use lissom_testmodels::SchemaCheck;
use serde_json::{Value, json};

/// Torque constant of the test's arm \[N·m/A\].
const CONSTANT: f64 = 0.246_759;

fn channels(constant: Option<f64>) -> Channels {
    let command = Command {
        quantity: CommandQuantity::Current,
        hold: Hold::Sampled,
        torque_per_command: constant,
        back_emf_viscous: 0.0,
        limit: Some(4.12),
    };
    let tip = Tip { name: "tip".to_owned(), quantity: TipQuantity::Angle, calibrated: true };
    Channels { axis: Axis::Rotary, command, tips: vec![tip] }
}

fn sine(omega_rad_s: f64, seed: u64) -> Run {
    let rig = lissom_testmodels::report_rig(Some(12));
    let sine = Experiment::sine(omega_rad_s, 0.7, 12.0).unwrap();
    rig.run("sine", &sine.settling(Settle::Wait { wait_s: 60.0 }), seed).unwrap().run
}

fn campaign(omega_rad_s: &[f64]) -> Campaign {
    let runs = omega_rad_s.iter().map(|w| sine(*w, 0)).collect();
    Campaign::new(channels(Some(CONSTANT)), runs).unwrap()
}

/// A result of two sines, and the arm in it.
fn result() -> (Value, FoundArm) {
    let used = campaign(&[3.1, 9.3]);
    let id = identify(&used, &Options::default(), |_| ()).unwrap();
    let result = serde_json::to_value(ResultFile::of(&used.channels, &id, None)).unwrap();
    (result, id.arm.unwrap())
}

struct Placed {
    _folder: tempfile::TempDir,
    path: PathBuf,
}

fn place(text: &str) -> Placed {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("result.json");
    std::fs::write(&path, text).unwrap();
    Placed { _folder: folder, path }
}

#[test]
fn an_arm_that_was_written_is_read_back_and_predicts() {
    let (written, found) = result();
    // As some editors save it.
    let placed = place(&format!("\u{feff}{written}"));
    let read = read_arm(&placed.path, &channels(Some(CONSTANT))).unwrap();
    assert_eq!(read, found);
    // Frequencies that no run had; near the resonance the tip's sensor comes to its end.
    let other = campaign(&[4.7, 6.0]);
    let validation = validate(&read, &other, &ValidationOptions::default()).unwrap();
    let torque = validation.torque.as_ref().unwrap();
    assert!(torque.relative_error < 0.05, "{}", torque.relative_error);
    let whole = &validation.horizons[0];
    assert!(whole.whole_runs);
    for fit in &whole.channels {
        assert!(fit.fit_percent > 99.0, "{fit:?}");
    }
    let mut check = SchemaCheck::new(
        include_str!("../../../docs/src/reference/schemas/validate.schema.json"),
        "it",
    );
    let file = ValidationFile::of(&other, &read, &validation);
    let json = serde_json::to_value(&file).unwrap();
    check.look_at(&json);
    assert_eq!(serde_json::from_value::<ValidationFile>(json).unwrap(), file);
    // An arm that is off has findings.
    let mut wrong = read;
    wrong.arm.coulomb_nm *= 1.5;
    let validation = validate(&wrong, &other, &ValidationOptions::default()).unwrap();
    assert!(!validation.findings.is_empty());
    wrong.coupling_alone_nm_per_rad = vec![1.25];
    wrong.arm.dry_terms.root = Some(Root { torque_nm_per_root_rad_s: 0.2 });
    let load = GravityLoad { sine_nm: 1.5, cosine_nm: -0.4 };
    wrong.arm.dry_terms.with_load = Some(WithLoad { coefficient: 0.05, load });
    wrong.arm.torque_ripples = vec![TorqueRipple { per_rad: 12.0, cosine_nm: 0.05, sine_nm: 0.02 }];
    let file = ValidationFile::of(&other, &wrong, &validation);
    check.look_at(&serde_json::to_value(&file).unwrap());
    check.holds(&["torque.residual_terms[].term", "torque.stretches[].start_s", "findings[].code"]);
}

/// Where no mode is known, the arm has the coupling of its tips.
#[test]
fn coupling_without_modes_is_read_back() {
    let (mut result, _) = result();
    result["arm"]["modes"] = json!([]);
    result["arm"]["tips"][0]["shape"] = json!([]);
    result["arm"]["damping_at_points_per_s"] = json!([]);
    result["arm"]["coupling_by_tip"] = json!([1.25]);
    let placed = place(&result.to_string());
    let read = read_arm(&placed.path, &channels(Some(CONSTANT))).unwrap();
    assert_eq!(read.coupling_alone_nm_per_rad, [1.25]);
    assert!(!read.moves());
    for (wrong, unit) in
        [(vec![1.25, 2.0], "N·m/rad"), (vec![1e300], "N·m/rad"), (vec![1.25], "A/rad")]
    {
        result["arm"]["coupling_by_tip"] = json!({ "value": wrong, "unit": unit });
        let error = refused(&result, &channels(Some(CONSTANT)));
        assert!(error.to_string().contains("arm.coupling_by_tip"), "{error}");
    }
}

fn refused(result: &Value, channels: &Channels) -> ResultError {
    let placed = place(&result.to_string());
    match read_arm(&placed.path, channels) {
        Err(Error::Result(error)) => error,
        other => panic!("{other:?}"),
    }
}

#[test]
fn what_is_no_arm_of_this_log_is_refused_with_a_way_out() {
    let (good, _) = result();
    let own = channels(Some(CONSTANT));
    let mut no_arm = good.clone();
    no_arm["arm"] = Value::Null;
    assert!(matches!(refused(&no_arm, &own), ResultError::NoArm { .. }));
    let mut older = good.clone();
    older.as_object_mut().unwrap().remove("arm");
    assert!(matches!(refused(&older, &own), ResultError::NoResult { key: "arm", .. }));
    let error = refused(&good, &channels(None));
    assert!(matches!(error, ResultError::OtherDrive { .. }) && error.hint().is_some());
    let mut no_tips = own.clone();
    no_tips.tips.clear();
    assert!(matches!(refused(&good, &no_tips), ResultError::OtherTips { .. }));
    let ripple = json!({ "wave_number": 1e9, "cosine": 0.01, "sine": 0.0 });
    for (key, value) in [
        ("/arm/inertia", json!(-1.0)),
        ("/arm/modes/0/natural_frequency_rad_s", json!(0.0)),
        ("/arm/modes/0/stiffness", json!(-0.1)),
        ("/arm/coulomb", json!(1e300)),
        ("/arm/torque_unit", json!("A")),
        ("/arm/ripples", json!([ripple])),
        ("/arm/tips/0/shape", json!([1.0, 2.0])),
        ("/arm/damping_at_points_per_s", json!([1.0, 2.0, 3.0])),
    ] {
        let mut changed = good.clone();
        *changed.pointer_mut(key).unwrap() = value;
        assert!(matches!(refused(&changed, &own), ResultError::Key { .. }), "{key}");
    }
    for (key, value, message) in [
        (
            "/arm/inertia",
            json!("heavy"),
            "`arm.inertia` cannot be read: invalid type: string \"heavy\", expected f64",
        ),
        (
            "/arm/from",
            json!("hearsay"),
            "`arm.from` cannot be read: unknown variant `hearsay`, expected `output_error` or `regression`",
        ),
        (
            "/arm/modes/0/damping_within_per_s",
            json!(null),
            "`arm.modes[0].damping_within_per_s` cannot be read: invalid type: null, expected f64",
        ),
    ] {
        let mut changed = good.clone();
        *changed.pointer_mut(key).unwrap() = value;
        let error = refused(&changed, &own);
        assert!(error.to_string().contains(message), "{error}");
        assert!(error.hint().is_some());
    }
    assert!(matches!(refused(&json!([1]), &own), ResultError::NoResult { .. }));
    let placed = place("t,i,theta\n");
    assert!(matches!(read_arm(&placed.path, &own), Err(Error::Result(ResultError::Json { .. }))));
}
