//! An arm with every term of friction and with torque ripples: described, and exported.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::f64::consts::PI;
use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::Command;

use lissom::replay::{ROOT_SPEED_RAD_S, ROUNDED_LOAD_SHARE};
use lissom::rig::JointFriction;
use lissom_io::ArmFile;
use lissom_io::export::{
    ExportModel, c_files, export_model_of_arm_file, matlab_script, mjcf, python_script,
};

const ARM: &str = r#"
[beam]
rigid = true
[drive]
inertia = 0.02
viscous = { forward = 0.03, backward = 0.05 }
torque_constant = 0.5
coulomb = { forward = 0.4, backward = 0.3 }
rest = { friction = { forward = 0.5, backward = 0.45 }, velocity = 0.2 }
ripple = { share = 0.1, per_turn = 61.7, phase = "20 deg" }
root = { friction = "0.4 N*m", velocity = "4 rad/s" }
with_load = 0.05
torque_ripples = [
  { torque = "0.02 N*m", per_turn = 6 },
  { torque = "0.1 A", per_turn = 73.3, phase = "90 deg" },
]
[load]
gravity_torque = "1.5 N*m"
phase = "30 deg"
[rig]
sample_time = "2 ms"
controller = { proportional = "40 A/rad" }
"#;

/// Relative error of the law in `float`: some roundings of 6e-8. Phases that are rounded to `float` would add 5e-6.
const FLOAT: f64 = 2e-6;

fn file(text: &str) -> ArmFile {
    ArmFile::from_text(Path::new("arm.toml"), text).unwrap()
}

fn model() -> ExportModel {
    export_model_of_arm_file(Path::new("arm.toml"), &file(ARM)).unwrap()
}

/// All torque that the motor has to supply at a constant speed.
fn law(v: f64, q: f64) -> f64 {
    let s = v.signum();
    let root = 0.2 * ((v.abs() + ROOT_SPEED_RAD_S).sqrt() - ROOT_SPEED_RAD_S.sqrt());
    let gravity = 1.5 * (q + PI / 6.0).sin();
    let load = 0.05 * gravity.hypot(ROUNDED_LOAD_SHARE * 1.5);
    let near = (0.125 - 0.025 * s) * (-v.abs() / 0.2).exp();
    let ripple = 0.1 * 0.35 * (61.7 * q + PI / 9.0).cos();
    let dry = 0.35 + 0.05 * s + near + ripple + root + load;
    let viscous = if v > 0.0 { 0.03 } else { 0.05 };
    let cogging = 0.02 * (6.0 * q).cos() + 0.05 * (73.3 * q + PI / 2.0).cos();
    s * dry + viscous * v + gravity + cogging
}

#[test]
fn an_arm_file_describes_every_term() {
    let rig = file(ARM).rig(Path::new("arm.toml")).unwrap();
    let JointFriction::Dry(friction) = &rig.scene.friction else { panic!("{:?}", rig.scene) };
    let position = rig.scene.position_torque();
    for (v, q) in [(1e-9, 0.3), (2.0, -0.5), (-0.1, -0.53), (-30.0, 4.0)] {
        let limits = friction.at(v, q);
        let side = if v > 0.0 { limits.forward() } else { -limits.backward() };
        let found = side + 0.04 * v + position.torque_nm(q);
        assert!((found - law(v, q)).abs() < 1e-12, "{v} {q}: {found} {}", law(v, q));
    }
}

#[test]
fn terms_that_do_not_fit_are_refused() {
    let fails = |from: &str, to: &str, part: &str| {
        let text = ARM.replace(from, to);
        assert_ne!(text, ARM);
        let error = ArmFile::from_text(Path::new("arm.toml"), &text).unwrap_err().to_string();
        assert!(error.contains(part), "{error}");
    };
    let bristles = "bristles = { stiffness = 100 }\nroot";
    let alone = ARM.replace("ripple = { share = 0.1, per_turn = 61.7, phase = \"20 deg\" }\n", "");
    let error = ArmFile::from_text(Path::new("arm.toml"), &alone.replace("root", bristles));
    assert!(error.unwrap_err().to_string().contains("`root`"), "bristles and root");
    fails("with_load = 0.05", "with_load = -0.05", "must be zero or greater");
    fails("[load]\ngravity_torque = \"1.5 N*m\"\nphase = \"30 deg\"", "", "`drive.with_load`");
    fails("velocity = \"4 rad/s\"", "velocity = 0", "`drive.root.velocity`");
    fails("per_turn = 6 }", "per_turn = 0 }", "per_turn");
    let own = "with_load = { coefficient = 0.05, gravity_torque = 1.5, phase = \"30 deg\" }";
    let read = file(&ARM.replace("with_load = 0.05", own));
    assert_eq!(read.drive, file(ARM).drive);
}

#[test]
fn the_c_code_gives_the_law() {
    let folder = tempfile::tempdir().unwrap();
    let files = c_files(&model());
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    write("lissom_feedforward.h", &files.header);
    write("lissom_feedforward.c", &files.source);
    let places: Vec<(f32, f32)> = (0..400_u16)
        .map(|k| {
            let speed = [1e-6, -1e-3, 0.3, -4.0, 55.0, -1e-6, 1e-3][usize::from(k % 7)];
            (speed, 0.1 * f32::from(k) - 20.0)
        })
        .collect();
    let mut main =
        "#include <stdio.h>\n#include \"lissom_feedforward.h\"\nint main(void) {\n".to_owned();
    for (v, q) in &places {
        let _ = writeln!(
            main,
            " printf(\"%.9g\\n\", lissom_friction((float){v:e}, (float){q:e}, 1e-9f));"
        );
    }
    main.push_str(" return 0; }\n");
    write("main.c", &main);
    let flags = ["-std=c99", "-Wall", "-Wextra", "-Werror", "main.c", "lissom_feedforward.c"];
    let compiled = Command::new("cc")
        .current_dir(folder.path())
        .args(flags)
        .args(["-o", "main", "-lm"])
        .output()
        .unwrap();
    assert!(compiled.status.success(), "{}", String::from_utf8_lossy(&compiled.stderr));
    let run = Command::new(folder.path().join("main")).output().unwrap();
    let printed = String::from_utf8(run.stdout).unwrap();
    let found: Vec<f64> = printed.split_whitespace().map(|n| n.parse().unwrap()).collect();
    assert_eq!(found.len(), places.len());
    for (found, (v, q)) in found.iter().zip(places) {
        let wanted = law(f64::from(v), f64::from(q));
        let size = 1.0 + 0.05 * f64::from(v.abs());
        assert!((found - wanted).abs() < FLOAT * size, "{v} {q}: {found} {wanted}");
    }
}

#[test]
fn scripts_have_the_terms_and_models_of_two_numbers_state_them() {
    let model = model();
    let python = python_script(&model);
    for part in ["math.sqrt(abs(velocity) + 1e-8)", "math.hypot(", "math.cos(73.3 * angle)"] {
        assert!(python.contains(part), "{python}");
    }
    let matlab = matlab_script(&model);
    for part in ["sqrt(abs(v) + 1e-8)", "hypot(", "cos(73.3*q)"] {
        assert!(matlab.contains(part), "{matlab}");
    }
    for text in [python, matlab, mjcf(&model).unwrap()] {
        for part in [
            "square root of speed: 2.0000e-1 N*m at 1 rad/s",
            "grows with the torque of gravity: 5.0000e-2 times it, up to 7.5000e-2 N*m",
            "2 torque ripple(s) (cogging), up to 7.0000e-2 N*m",
        ] {
            assert!(text.contains(part), "{part}: {text}");
        }
    }
}
