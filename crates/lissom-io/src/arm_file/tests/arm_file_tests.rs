//! What the tables of an `arm.toml` give.
#![expect(clippy::float_cmp, reason = "these numbers are exact")]

use std::f64::consts::{PI, TAU};
use std::path::Path;

use proptest::prelude::*;

use super::arm_fixture::{ARM, fails, near, read};
use crate::arm_file::{ArmFile, RigSpec};
use lissom_core::rig::{Amplifier, Instruments, Pd, Quantiser, Sensor};

#[test]
fn reads_an_arm() {
    let arm = read(ARM).unwrap();
    let inch = 0.0254;
    let lbf_in = 4.448_221_615_260_5 * inch;
    let beam = arm.beam.unwrap();
    assert_eq!(beam.tip_inertia_kg_m2, None);
    let span = beam.spans[0];
    near(span.length_m, 7.0 * inch);
    near(span.mass_kg, 0.121 * 0.453_592_37);
    let modulus = 30e6 * 4.448_221_615_260_5 / (inch * inch);
    near(span.flexural_rigidity_n_m2, modulus * PI * (0.032 * inch).powi(4) / 64.0);
    assert_eq!(span.damping_n_s_per_m, 0.0);
    let drive = arm.drive.unwrap();
    near(drive.coulomb.forward(), 0.132 * 2.184 * lbf_in);
    near(drive.coulomb.backward(), 0.132 * 2.184 * lbf_in);
    near(drive.motor.inertia_kg_m2(), 0.005_529 * lbf_in);
    near(drive.motor.viscous_nm_s_per_rad(), 0.012_16 * lbf_in);
    let motor = Sensor { noise: None, quantiser: Some(Quantiser::new(12, TAU).unwrap()) };
    let instruments = Instruments {
        motor,
        tips: vec![motor],
        amplifier: Amplifier::ideal().with_limit(4.12).unwrap(),
        ..Instruments::ideal(0.003).unwrap()
    };
    let controller = Some(Pd::new(9.0, 0.2).unwrap().into());
    assert_eq!(arm.rig, Some(RigSpec { instruments, controller, masses: None }));
}

#[test]
fn every_table_may_be_absent() {
    assert_eq!(read("").unwrap(), ArmFile::default());
    let arm = read("[drive]\ninertia = 1\ntorque_constant = 2.0\n").unwrap();
    let drive = arm.drive.unwrap();
    assert_eq!((drive.motor.viscous_nm_s_per_rad(), drive.coulomb.forward()), (0.0, 0.0));
}

#[test]
fn spans_may_differ() {
    let arm = read(
        r#"
[beam]
young_modulus = "200 GPa"
section = { rectangle = ["25.4 mm", "0.8 mm"] }
[[beam.spans]]
length = 0.2
mass = 0.1
damping = "0.3 N*s/m"
[[beam.spans]]
length = 0.3
mass = 0.05
damping = "0.3 N*s/rad"
section = { round = "1 mm" }
[[beam.spans]]
length = 0.5
mass = 0.05
flexural_rigidity = "2 N*m^2"
inertia = "0.001 kg*m^2"
"#,
    )
    .unwrap();
    let beam = arm.beam.unwrap();
    assert_eq!(beam.tip_inertia_kg_m2, Some(0.001));
    let rigidity: Vec<f64> = beam.spans.iter().map(|span| span.flexural_rigidity_n_m2).collect();
    near(rigidity[0], 200e9 * 0.0254 * 0.0008_f64.powi(3) / 12.0);
    near(rigidity[1], 200e9 * PI * 1e-12 / 64.0);
    near(rigidity[2], 2.0);
    near(beam.spans[0].damping_n_s_per_m, 0.3);
    near(beam.spans[1].damping_n_s_per_m, 0.3 / 0.5);
}

#[test]
fn coulomb_may_be_torque_and_differ_by_direction() {
    let text = "[drive]\ninertia = 1\ntorque_constant = 2\n\
                coulomb = { forward = \"0.5 A\", backward = \"300 mN*m\" }\n";
    let drive = read(text).unwrap().drive.unwrap();
    near(drive.coulomb.forward(), 1.0);
    near(drive.coulomb.backward(), 0.3);
}

#[test]
fn wrong_values_are_named_with_line_and_key() {
    let replaced = |from: &str, to: &str| ARM.replace(from, to);
    let sign = Some("check its sign");
    for (from, to, message, hint) in [
        (
            "\"7 in\"",
            "\"-7 in\"",
            "arm.toml, line 5: `beam.spans[1].length` is \"-7 in\", but must be greater than zero",
            sign,
        ),
        (
            "\"0.121 lb\"",
            "0",
            "arm.toml, line 5: `beam.spans[1].mass` is 0, but must be greater than zero",
            Some("check the number and its unit"),
        ),
        (
            "\"30e6 psi\"",
            "\"-30e6 psi\"",
            "arm.toml, line 3: `beam.young_modulus` is \"-30e6 psi\", but must be greater than zero",
            sign,
        ),
        (
            "\"0.005529 lbf*in*s^2\"",
            "-0.006",
            "arm.toml, line 7: `drive.inertia` is -0.006, but must be greater than zero",
            sign,
        ),
        (
            "\"0.01216 lbf*in*s/rad\"",
            "\"-1 N*m*s/rad\"",
            "arm.toml, line 8: `drive.viscous` is \"-1 N*m*s/rad\", but must be zero or greater",
            sign,
        ),
        (
            "\"0.132 A\"",
            "\"-0.132 A\"",
            "arm.toml, line 10: `drive.coulomb` is \"-0.132 A\", but must be zero or greater",
            sign,
        ),
        (
            "\"0.132 A\"",
            "\"0.132 V\"",
            "arm.toml, line 10: `drive.coulomb`: \"0.132 V\" is a voltage [kg*m^2*s^-3*A^-1], where a torque [kg*m^2*s^-2] is expected",
            Some("write it as in \"0.25 N*m\""),
        ),
        (
            "\"0.121 lb\"",
            "\"0.121 lbf\"",
            "arm.toml, line 5: `beam.spans[1].mass`: \"0.121 lbf\" is a force [kg*m*s^-2], where a mass [kg] is expected",
            Some("`lbf`, `ozf` and `kgf` are forces; the masses are `lb`, `oz` and `kg`"),
        ),
        (
            "bits = 12",
            "bits = 40",
            "arm.toml, line 14: `rig.motor_sensor.bits` is 40, but must be a whole number from 1 to 32",
            Some("give a whole number within these limits"),
        ),
        (
            "\"3 ms\"",
            "true",
            "arm.toml, line 12: `rig.sample_time` is true, where text with a unit or an SI number is expected",
            Some("`lissom demo` writes an example"),
        ),
        (
            "\"3 ms\"",
            "inf",
            "arm.toml, line 12: `rig.sample_time` is inf, where text with a unit or an SI number is expected",
            Some("`lissom demo` writes an example"),
        ),
    ] {
        fails(&replaced(from, to), message, hint);
    }
}

#[test]
fn wrong_keys_are_named_with_the_nearest() {
    fails(
        &ARM.replace("viscous", "viscos"),
        "arm.toml, line 8: `drive.viscos` is not a known key",
        Some("did you mean `viscous`?"),
    );
    fails(
        &ARM.replace("[rig]", "[camera]"),
        "arm.toml, line 11: `camera` is not a known key",
        Some("the known keys are `beam`, `drive`, `load`, `tip`, `rig`"),
    );
    fails(
        &ARM.replace("sample_time", "current_limit").replacen(
            "current_limit = \"4.12 A\"\n",
            "",
            1,
        ),
        "arm.toml, line 11: `rig` has no `sample_time`",
        Some("add `sample_time` to rig"),
    );
    fails(
        &ARM.replace("young_modulus = \"30e6 psi\"", ""),
        "arm.toml, line 2: `beam` has no `young_modulus`",
        Some("add `young_modulus` to beam"),
    );
    fails(
        "[beam]\nspans = [{ length = 1, mass = 1 }]\n",
        "arm.toml, line 1: `beam` has none of `flexural_rigidity`, `young_modulus`",
        Some("add one of them"),
    );
    fails(
        &ARM.replace("young_modulus", "flexural_rigidity"),
        "arm.toml, line 2: `beam` has both `flexural_rigidity` and `section`",
        Some("give one of the two"),
    );
    fails(
        "[beam]\nflexural_rigidity = 1\nspans = [{ length = 1, mass = 1, inertia = 1 }, { length = 1, mass = 1 }]\n",
        "arm.toml, line 3: `beam.spans[1].inertia` is allowed only in the last entry",
        Some("move it to the last entry, or remove it"),
    );
    fails(
        "[beam]\nflexural_rigidity = 1\nspans = []\n",
        "arm.toml, line 3: `beam.spans` is a list, where a list of at least one span is expected",
        Some("`lissom demo` writes an example"),
    );
    fails(
        &ARM.replace("{ round = \"0.032 in\" }", "{ rectangle = [\"1 in\"] }"),
        "arm.toml, line 4: `beam.section.rectangle` is a list, where a list of width and thickness is expected",
        Some("`lissom demo` writes an example"),
    );
}

#[test]
fn what_is_no_toml_is_shown_with_line_and_column() {
    let error = read("[beam\n").unwrap_err().to_string();
    assert!(error.starts_with("arm.toml, line 1, column 6: "), "{error}");
    let error = ArmFile::read(Path::new("no/arm.toml")).unwrap_err();
    assert_eq!(
        error.to_string(),
        "no/arm.toml: cannot be read: No such file or directory (os error 2)"
    );
}

proptest! {
    #[test]
    fn no_text_panics(text in "\\PC{0,120}") {
        let _ = read(&text);
    }

    #[test]
    fn no_change_of_a_good_file_panics(at in 0..ARM.len(), length in 0..20_usize, with in "[-\"{}=,. 0-9a-z\\[\\]\n]{0,6}") {
        let end = (at + length).min(ARM.len());
        let _ = read(&format!("{}{with}{}", &ARM[..at], &ARM[end..]));
    }
}
