//! Rigid joints and their unbalanced loads.

use std::path::Path;

use super::arm_fixture::{fails, near, read};

/// A rigid joint in its loop, with these lines before `[rig]`.
fn with(lines: &str) -> String {
    format!(
        "[beam]\nrigid = true\n[drive]\ninertia = 0.02\ntorque_constant = 0.5\n{lines}\n\
         [rig]\nsample_time = \"2 ms\"\ncontroller = {{ proportional = \"40 A/rad\" }}\n"
    )
}

#[test]
fn a_load_is_read_in_its_units() {
    let text = with("[load]\ngravity_torque = \"200 N*cm\"\nphase = \"30 deg\"");
    let load = read(&text).unwrap().load.unwrap();
    near(load.gravity_torque_nm, 2.0);
    near(load.phase_rad, 30.0_f64.to_radians());
    let rig = read(&text).unwrap().rig(Path::new("arm.toml")).unwrap();
    let gravity = rig.scene.gravity.unwrap();
    near(gravity.torque_nm(60.0_f64.to_radians()), 2.0);
    near(gravity.torque_nm(0.0), 1.0);
    assert!(rig.arm.beam().is_empty());
    let bare = read(&with("[load]\ngravity_torque = 1.5")).unwrap().load.unwrap();
    near(bare.gravity().sine_nm, 1.5);
    assert!(bare.gravity().cosine_nm == 0.0);
}

#[test]
fn a_rigid_joint_is_no_beam() {
    let path = Path::new("arm.toml");
    let file = read(&with("")).unwrap();
    assert!(file.rigid && file.beam.is_none() && file.modes.is_none());
    assert!(file.rig(path).unwrap().scene.gravity.is_none());
    for error in [
        file.lumped_beam(path).unwrap_err(),
        file.distributed_beam(path).unwrap_err(),
        file.beam_kind(path).unwrap_err(),
    ] {
        assert!(error.problem.contains("the joint is rigid"), "{error}");
        assert_eq!(
            error.hint().as_deref(),
            Some("give `spans` or `modes` instead of `rigid` in [beam]")
        );
    }
    let tip = read(&with("[tip]\nviscous = 0.003")).unwrap().rig(path).unwrap_err();
    assert_eq!(
        tip.to_string(),
        "arm.toml: a rigid joint or a beam given by its modes has no tip on which something could act"
    );
}

#[test]
fn wrong_loads_are_refused_with_line_and_key() {
    let sign = Some("check its sign");
    for (lines, message, hint) in [
        (
            "gravity_torque = -2",
            "arm.toml, line 7: `load.gravity_torque` is -2, but must be greater than zero",
            sign,
        ),
        (
            "gravity_torque = 0",
            "arm.toml, line 7: `load.gravity_torque` is 0, but must be greater than zero",
            Some("check the number and its unit"),
        ),
        (
            "phase = 0.1",
            "arm.toml, line 6: `load` has no `gravity_torque`",
            Some("add `gravity_torque` to load"),
        ),
    ] {
        fails(&with(&format!("[load]\n{lines}")), message, hint);
    }
    for (lines, part) in [
        ("gravity_torque = true", "line 7: `load.gravity_torque` is true"),
        ("gravity_torque = \"2 N\"", "line 7: `load.gravity_torque`"),
        ("gravity_torque = 2\nphase = \"3 N*m\"", "line 8: `load.phase`"),
        ("gravity_torque = 2\nphase = [1]", "line 8: `load.phase`"),
        ("gravity = true", "line 7: `load.gravity`"),
        ("mgl = 2", "line 7: `load.mgl`"),
    ] {
        let error = read(&with(&format!("[load]\n{lines}"))).unwrap_err();
        assert!(error.to_string().contains(part), "{error}");
        assert!(error.hint().is_some(), "{error}");
    }
    for beam in ["rigid = false", "rigid = 1", "rigid = true\nspans = [{ length = 1, mass = 1 }]"] {
        let text = with("").replace("rigid = true", beam);
        let error = read(&text).unwrap_err();
        assert!(error.to_string().contains("`beam."), "{error}");
        assert!(error.hint().is_some(), "{error}");
    }
}

#[test]
fn gravity_on_a_beam_is_refused() {
    let text = super::arm_fixture::ARM.replace("[rig]", "[load]\ngravity_torque = 2\n[rig]");
    let error = read(&text).unwrap().rig(Path::new("arm.toml")).unwrap_err();
    assert_eq!(
        error.to_string(),
        "arm.toml: [load] gives gravity to an arm with a beam, but gravity is simulated only for a rigid joint"
    );
    assert_eq!(
        error.hint().as_deref(),
        Some("remove [load], or write `rigid = true` instead of the other keys of [beam]")
    );
}
