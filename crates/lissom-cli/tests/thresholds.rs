//! `lissom thresholds`: the list is complete, and says why.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::collections::BTreeSet;

use assert_cmd::Command;
use lissom::ThresholdValue;
use lissom_io::ThresholdsFile;
use lissom_testmodels::SchemaCheck;
use serde_json::Value;

fn printed(arguments: &[&str]) -> String {
    let mut command = Command::new(assert_cmd::cargo::cargo_bin!("lissom"));
    let output = command.args(arguments).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn every_threshold_has_a_unit_a_reason_and_a_name_of_its_own() {
    let text = printed(&["thresholds", "--json"]);
    let mut check = SchemaCheck::new(
        include_str!("../../../docs/src/reference/schemas/thresholds.schema.json"),
        "thresholds",
    );
    let json: Value = serde_json::from_str(&text).unwrap();
    check.look_at(&json);
    check.holds(&["thresholds[].reason"]);
    let list = ThresholdsFile::all().thresholds;
    assert_eq!(serde_json::to_value(ThresholdsFile::all()).unwrap(), json);
    let mut names = BTreeSet::new();
    for t in &list {
        let values = match t.value {
            ThresholdValue::Number(value) => vec![value],
            ThresholdValue::Count(count) => vec![count as f64],
            ThresholdValue::Numbers(values) => values.to_vec(),
        };
        assert!(!t.unit.is_empty() && !values.is_empty(), "{t:?}");
        assert!(values.iter().all(|value| value.is_finite()), "{t:?}");
        assert!(t.reason.ends_with('.') && !t.reason.contains("  "), "{t:?}");
        assert!(names.insert((t.method, t.name)), "twice: {t:?}");
    }
    let table = printed(&["thresholds"]);
    for t in &list {
        assert!(table.contains(&format!("  {} ", t.name)), "{}", t.name);
        assert!(table.lines().any(|line| line == t.method), "{}", t.method);
    }
    assert!(table.lines().all(|line| line.chars().count() <= 100));
}
