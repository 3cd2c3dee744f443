//! Rotary flexible arms of a teaching laboratory: commanded voltage, square-wave references.

use serde_json::Value;

use super::common;

fn run_of<'a>(result: &'a Value, code: &str) -> Vec<&'a str> {
    let findings = result["findings"].as_array().unwrap();
    findings.iter().filter(|f| f["code"] == code).filter_map(|f| f["run"].as_str()).collect()
}

#[test]
fn says_what_these_logs_cannot_tell() {
    let Some(data) = common::data("cu-flexarm") else { return };
    let result = common::identify(include_str!("cu.toml"), &data, "", 3);
    // The gauge that is dead, and only that one.
    assert_eq!(run_of(&result, "dead-channel"), ["dead gauge"]);
    // The voltage follows the control law exactly: it is a command.
    assert!(common::has_finding(&result, "command-not-measured"));
    // Provenance: linear fits leave 27 to 73 %, with the wrong sign of friction in some.
    assert!(common::has_finding(&result, "regression-refused"));
    for key in ["coulomb", "viscous"] {
        assert!(result["friction"][key].is_null(), "{key} is given");
    }
    assert!(run_of(&result, "mostly-at-rest").contains(&"proportional"));
}

#[test]
fn a_single_run_is_poor_excitation() {
    let Some(data) = common::data("cu-flexarm") else { return };
    let text = include_str!("cu.toml");
    let first = text.find("[[runs]]").unwrap();
    let second = first + 1 + text[first + 1..].find("[[runs]]").unwrap();
    let result = common::identify(&text[..second], &data, "", 3);
    assert!(common::has_finding(&result, "poor-excitation"));
    assert!(result["drive"]["inertia"].is_null());
}
