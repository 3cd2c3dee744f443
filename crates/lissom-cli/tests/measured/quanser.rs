//! Quanser's serial flexible link, first stage: measured current, two closed-loop runs.

use super::common;

#[test]
fn says_what_these_logs_cannot_tell() {
    let Some(data) = common::data("quanser-2dsfl") else { return };
    // Exit code 3: the beam's modes are refused.
    let result = common::identify(include_str!("quanser.toml"), &data, "", 3);
    // The second stage moves too: the first one's equation leaves torque over.
    assert!(common::has_finding(&result, "unexplained-torque"));
    assert!(common::has_finding(&result, "modes-not-found"));
    assert!(common::has_finding(&result, "poor-excitation"));
    assert!(common::has_finding(&result, "friction-visible"));
    // Maker's configuration: viscous 4.0 N·m·s/rad, link stiffness 39.96 (theory), 27 (test).
    let value = |table: &str, key: &str| result[table][key]["value"].as_f64().unwrap();
    assert!((2.0..5.0).contains(&value("friction", "viscous")));
    assert!((25.0..50.0).contains(&value("beam", "coupling")));
    // Provenance, a crude fit: 0.2 to 0.5 N·m "Coulomb-like"; the interval must not be narrower
    // than what two runs that differ allow.
    let coulomb = &result["friction"]["coulomb"];
    assert!(coulomb["value"].as_f64().unwrap() > 0.2);
    assert!(coulomb["std"].as_f64().unwrap() > 0.03);
}

#[test]
fn a_gauge_of_the_other_sign_is_noticed() {
    let Some(data) = common::data("quanser-2dsfl") else { return };
    let text = include_str!("quanser.toml").replace(", scale = -1", "");
    let result = common::identify(&text, &data, "", 3);
    assert!(common::has_finding(&result, "reversed-sign"));
    assert!(result["beam"]["coupling"].is_null());
}
