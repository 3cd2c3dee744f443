//! Logs that simulators other than this project's rig have made, against the truth: an estimator
//! that shares an error with the rig it was tested on would fail here.
//!
//! `make.py` writes the logs. The reference is a multisine: such a motion has no single frequency,
//! so that all estimates are the regression's, and the third harmonic has no part in them.
//!
//! Errors, and in parentheses standard errors, which the tests show with
//! `cargo test -p lissom-cli --test independent -- --nocapture`:
//!
//! | estimate    | scipy             | MuJoCo            |
//! |-----------|-------------------|-------------------|
//! | Coulomb   | -0.0624 % (-2.08) |  0.0051 %  (0.50) |
//! | forward   | -0.0708 % (-2.15) |  0.0096 %  (0.96) |
//! | backward  | -0.0523 % (-1.68) |  0.0005 %  (0.04) |
//! | viscous   |  0.4543 %  (2.07) | -0.0558 % (-0.63) |
//! | inertia   | -0.0619 % (-1.15) | -0.0108 % (-0.33) |
//! | coupling  |  0.0063 %  (2.22) |  0.0001 %  (0.07) |
//! | frequency |  0.0007 %  (2.19) |  0.0005 %  (1.63) |

#![expect(clippy::unwrap_used, clippy::print_stdout, reason = "tests, which show their errors")]

use std::path::Path;

use serde_json::Value;

// The arm of `make.py`.
const VISCOUS_NM_S_PER_RAD: f64 = 0.004;
const INERTIA_KG_M2: f64 = 0.0012;
const COUPLING_NM_PER_RAD: f64 = 0.4;
const FREQUENCY_RAD_S: f64 = 11.0;

// In the rms of the logs the drive gives 0.31 N·m, of which the beam takes 0.29, inertia 0.032 and
// viscous friction 0.007: the smaller its torque, the wider an estimate's bar.

/// A jump of 0.17 N·m at every reversal, against currents known to 1e-6 A.
const COULOMB_ERROR: f64 = 0.003;
/// Each direction is moved in for 43 % of a log, and a bias of the offset counts here alone.
const DIRECTION_ERROR: f64 = 0.005;
/// A tenth of the drive's torque, and the most sensitive one to the encoder's steps.
const INERTIA_ERROR: f64 = 0.01;
/// The smallest torque, and easily mistaken for the Coulomb friction of the same sign.
const VISCOUS_ERROR: f64 = 0.03;
/// The largest torque, in angles that need no derivative.
const COUPLING_ERROR: f64 = 0.003;
/// A resonance over 21 of its periods, in a ratio of angles that friction has no part in.
const FREQUENCY_ERROR: f64 = 0.001;
/// Two logs are no study of coverage: four standard errors catch intervals that are wishful.
const STANDARD_ERRORS: f64 = 4.0;

/// What the command gives for a log beside this file.
fn identify(file: &str) -> Value {
    let log = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/independent").join(file);
    let folder = tempfile::tempdir().unwrap();
    let campaign = folder.path().join("campaign.toml");
    let text = include_str!("campaign.toml").replace("{file}", log.to_str().unwrap());
    std::fs::write(&campaign, text).unwrap();
    let output = assert_cmd::Command::cargo_bin("lissom")
        .unwrap()
        .args(["identify", campaign.to_str().unwrap(), "--json"])
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

/// Compares all estimates of a log with the truth.
fn check(file: &str, forward_nm: f64, backward_nm: f64) {
    let result = identify(file);
    assert!(result["methods"]["third_harmonic"].is_null(), "{file} has a single frequency");
    let (friction, beam) = (&result["friction"], &result["beam"]);
    let modes = beam["modes"].as_array().unwrap();
    assert_eq!(modes.len(), 1, "{modes:?}");
    let estimates = [
        ("Coulomb", &friction["coulomb"], 0.5 * (forward_nm + backward_nm), COULOMB_ERROR),
        ("forward", &friction["forward"], forward_nm, DIRECTION_ERROR),
        ("backward", &friction["backward"], backward_nm, DIRECTION_ERROR),
        ("viscous", &friction["viscous"], VISCOUS_NM_S_PER_RAD, VISCOUS_ERROR),
        ("inertia", &result["drive"]["inertia"], INERTIA_KG_M2, INERTIA_ERROR),
        ("coupling", &beam["coupling"], COUPLING_NM_PER_RAD, COUPLING_ERROR),
        ("frequency", &modes[0]["natural_frequency_rad_s"], FREQUENCY_RAD_S, FREQUENCY_ERROR),
    ];
    for (name, estimate, truth, largest) in estimates {
        let [value, std] = ["value", "std"].map(|key| estimate[key].as_f64().unwrap());
        let (error, standard_errors) = (value / truth - 1.0, (value - truth) / std);
        println!("{file}: {name} {:.4} % ({standard_errors:.2})", 100.0 * error);
        assert!(error.abs() < largest, "{file}: {name} {value}, in truth {truth}");
        assert!(
            standard_errors.abs() < STANDARD_ERRORS,
            "{file}: {name} {value} ± {std}, in truth {truth}"
        );
    }
}

#[test]
fn figures_from_scipy_with_a_friction_for_each_direction() {
    check("scipy-multisine.csv", 0.09, 0.075);
}

#[test]
fn figures_from_mujoco_with_one_friction() {
    check("mujoco-multisine.csv", 0.085, 0.085);
}
