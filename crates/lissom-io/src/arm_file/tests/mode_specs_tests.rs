//! A beam by its modes.

use std::path::Path;

use super::arm_fixture::{fails, read};
use crate::arm_file::BeamKind;
use crate::write::{WrittenArm, arm_text};
use lissom_core::beam::{Beam, BeamError};
use lissom_core::drive::{Coulomb, Motor};

const DRIVE: &str = "[drive]\ninertia = 1e-3\ntorque_constant = 0.3\ncoulomb = 0.03\n";

fn beam(modes: &str) -> String {
    format!("[beam]\nmodes = [{modes}]\n{DRIVE}")
}

const TWO: &str = "{ frequency = \"4 Hz\", coupling = \"0.3 N*m\", gains = [0.6, 1.2] }, \
                   { omega_rad_s = 120, damping_ratio = \"1 %\", coupling = 0.5, gains = [0.4, -0.2] }";

#[test]
fn modes_make_an_arm() {
    let path = Path::new("arm.toml");
    let file = read(&beam(TWO)).unwrap();
    assert_eq!(file.beam_kind(path).unwrap(), BeamKind::Modal);
    let arm = file.arm(path).unwrap();
    let Beam::Modal(made) = arm.beam() else { panic!("{:?}", arm.beam()) };
    let modes = made.known_modes();
    assert_eq!((modes[0].omega_rad_s, modes[1].damping_ratio), (8.0 * std::f64::consts::PI, 0.01));
    assert_eq!((modes[1].coupling_nm_per_rad, modes[0].gains[1]), (0.5, 1.2));
    let by_modes = "arm.toml: the beam is given by its modes; here it must have spans";
    assert_eq!(file.lumped_beam(path).unwrap_err().to_string(), by_modes);
    assert_eq!(file.distributed_beam(path).unwrap_err().to_string(), by_modes);
}

#[test]
fn a_written_arm_is_read_as_it_was() {
    let path = Path::new("arm.toml");
    let beam = read(&beam(TWO)).unwrap().modal_beam(path).unwrap();
    let (motor, coulomb) = (Motor::new(1.0 / 3.0, 1e-5, 0.1), Coulomb::by_direction(0.1, 0.2));
    let (motor, coulomb) = (motor.unwrap(), coulomb.unwrap());
    let points = ["elbow", "a\nb"];
    let text =
        arm_text(&WrittenArm { motor, coulomb: Some(coulomb), beam: &beam, points: &points });
    let file = read(&text).unwrap();
    assert_eq!(file.modal_beam(path).unwrap(), beam);
    assert_eq!(file.motor(path).unwrap(), (motor, coulomb));
}

#[test]
fn wrong_modes_are_named() {
    fails(
        &beam("{ coupling = 1, gains = [1] }"),
        "arm.toml, line 2: `beam.modes[1]` has none of `frequency`, `omega_rad_s`",
        Some("add one of them"),
    );
    fails(
        &beam("{ frequency = 1, coupling = -1, gains = [1] }"),
        "arm.toml, line 2: `beam.modes[1].coupling` is -1, but must be greater than zero",
        Some("check its sign"),
    );
    fails(
        "[beam]\nmodes = [{ frequency = 1, coupling = 1, gains = [1] }]\nhub_radius = 1\n",
        "arm.toml, line 3: `beam.hub_radius` is not a known key",
        Some("the known keys are `modes`"),
    );
    let strained = read(&beam("{ frequency = 1, coupling = 1, gains = [0.9] }")).unwrap();
    let error = strained.arm(Path::new("arm.toml")).unwrap_err();
    assert!(error.problem.contains("point 1"), "{error}");
    assert!(error.hint().unwrap().contains("highest mode"));
}

#[test]
fn nothing_hangs_at_its_tip() {
    let rig = "[rig]\nsample_time = 0.001\nmotor_sensor = { bits = 12, range = 6.3 }\n";
    let text = format!("{}{rig}[tip]\nviscous = 0.003\n", beam(TWO));
    let error = read(&text).unwrap().rig(Path::new("arm.toml")).unwrap_err();
    assert_eq!(error.to_string(), format!("arm.toml: {}", BeamError::NoTip));
}
