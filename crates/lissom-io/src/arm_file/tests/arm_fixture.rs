//! An arm for the tests, and how they read and compare.

use std::path::Path;

use crate::arm_file::ArmFile;

/// Relative: a few roundings.
const ROUNDING: f64 = 1e-14;

pub(super) fn near(found: f64, expected: f64) {
    assert!((found / expected - 1.0).abs() < ROUNDING, "{found} is not {expected}");
}

pub(super) fn read(text: &str) -> Result<ArmFile, crate::Error> {
    ArmFile::from_text(Path::new("arm.toml"), text)
}

pub(super) const ARM: &str = r#"
[beam]
young_modulus = "30e6 psi"
section = { round = "0.032 in" }
spans = [{ length = "7 in", mass = "0.121 lb" }]
[drive]
inertia = "0.005529 lbf*in*s^2"
viscous = "0.01216 lbf*in*s/rad"
torque_constant = "2.184 lbf*in/A"
coulomb = "0.132 A"
[rig]
sample_time = "3 ms"
current_limit = "4.12 A"
motor_sensor = { bits = 12, range = "360 deg" }
controller = { proportional = "9 A/rad", derivative = "0.2 A*s/rad" }
"#;

#[track_caller]
pub(super) fn fails(text: &str, message: &str, hint: Option<&str>) {
    let error = read(text).unwrap_err();
    assert_eq!(error.to_string(), message);
    assert_eq!(error.hint().as_deref(), hint);
}
