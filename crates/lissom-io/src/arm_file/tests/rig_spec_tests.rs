//! Rigs: instruments, controllers, friction laws, the world at the tip.
#![expect(clippy::float_cmp, reason = "these numbers are exact")]

use std::f64::consts::TAU;

use lissom_core::rig::{ControlLaw, IntegerPd, JointFriction, Pd, Quantiser, Signal, Word};

use super::arm_fixture::{ARM, read};
use crate::arm_file::ArmFile;

#[track_caller]
fn refused(text: &str, message: &str) {
    let error = read(text).unwrap_err();
    assert_eq!(error.to_string(), message);
    assert!(error.hint().is_some(), "{message}");
}

fn rig(text: &str) -> lissom_core::rig::Rig {
    ArmFile::from_text("arm.toml".as_ref(), text).unwrap().rig("arm.toml".as_ref()).unwrap()
}

/// The arm with other lines in `[rig]`, its controller and sensor left out.
fn with_rig(lines: &str) -> String {
    let end = ARM.find("[rig]").unwrap();
    format!("{}[rig]\nsample_time = \"3 ms\"\n{lines}\n", &ARM[..end])
}

#[test]
fn reads_every_instrument() {
    let made = rig(&with_rig(
        "control_every = 2\nlog_every = 4\ncurrent_limit = \"4 A\"\ndead_band = \"20 mA\"\n\
         current_converter = { bits = 12, range = \"10 A\" }\ndelay = \"1.5 ms\"\n\
         motor_sensor = { counts_per_turn = 4096, noise = \"0.1 mrad\" }\n\
         tip_sensors = { bits = 10, range = \"90 deg\" }\n\
         controller = { proportional = \"8 A/rad\", derivative = \"0.2 A*s/rad\", integral = \"3 A/(rad*s)\", filter = \"2 ms\" }",
    ));
    let i = &made.instruments;
    assert_eq!((i.control_every, i.log_every), (2, 4));
    assert_eq!((i.amplifier.limit_a(), i.amplifier.dead_band_a()), (Some(4.0), Some(0.02)));
    assert_eq!(i.amplifier.converter().unwrap().step(), 10.0 / 4096.0);
    assert_eq!(i.delay.unwrap().delay_s(), 0.0015);
    assert_eq!(i.motor.quantiser.unwrap().ends().1, f64::INFINITY);
    assert_eq!(i.motor.noise.unwrap().std(), 1e-4);
    let step = std::f64::consts::FRAC_PI_2 / 1024.0;
    assert!((i.tips[0].quantiser.unwrap().step() - step).abs() < 1e-15);
    assert!(matches!(made.controller, ControlLaw::Pid(_)));
}

#[test]
fn integers_need_converters() {
    let integers =
        "controller = { proportional = \"8 A/rad\", integers = { word = 32, binary_point = 8 } }\n";
    let both = "motor_sensor = { bits = 12, range = \"360 deg\" }\n\
                current_converter = { bits = 12, range = \"10 A\" }";
    let made = rig(&with_rig(&format!("{integers}{both}")));
    let pd = Pd::new(8.0, 0.0).unwrap();
    let steps = [TAU, 10.0].map(|range| Quantiser::new(12, range).unwrap());
    let law = IntegerPd::new(&pd, 0.003, steps[0], steps[1], Word::Long, 8).unwrap();
    assert_eq!(made.controller, law.into());
    let error = read(&with_rig(integers)).unwrap_err().to_string();
    assert!(error.starts_with("arm.toml, line 13: `rig.controller.integers`: "), "{error}");
    assert!(error.contains("`motor_sensor` with steps"), "{error}");
}

#[test]
fn reads_friction_laws_and_the_world_at_the_tip() {
    let text = ARM.replace(
        "[rig]",
        "rest = { friction = { forward = \"0.2 A\", backward = \"0.18 A\" }, velocity = \"0.1 rad/s\", falloff = \"gaussian\" }\n\
         ripple = { share = 0.2, per_turn = 12, phase = \"30 deg\" }\n\
         [tip]\nforce = { amplitude = \"0.1 N\", frequency = \"1 Hz\", offset = \"0.02 N\" }\n\
         torque = { times = [0, \"1 s\"], values = [0, \"2e-3 N*m\"], hold = \"lines\" }\n\
         viscous = \"0.003 N*s/m\"\ncoulomb = \"5e-3 N\"\n\
         walls = [{ angle = \"20 deg\", stiffness = \"300 N/m\" }, { angle = -0.3, stiffness = 100, side = \"behind\" }]\n\
         payloads = [{ at = \"10 s\", mass = \"50 g\" }, { at = \"20 s\" }]\n[rig]",
    );
    let made = rig(&text);
    let JointFriction::Dry(law) = made.scene.friction else { panic!() };
    let with_sides = text.replace(
        "viscous = \"0.01216 lbf*in*s/rad\"",
        "viscous = { forward = 0.003, backward = 0.002 }",
    );
    let sides = rig(&with_sides);
    let JointFriction::Dry(apart) = sides.scene.friction else { panic!() };
    assert!((sides.arm.motor.viscous_nm_s_per_rad() - 0.0025).abs() < 1e-15);
    let more = |v: f64| apart.at(v, 0.0).forward() - law.at(v, 0.0).forward();
    assert!(more(0.0).abs() < 1e-15 && (more(2.0) - 0.001).abs() < 1e-15, "{}", more(2.0));
    let constant = made.arm.motor.torque_constant_nm_per_a();
    let mean = 0.5 * (law.sliding().forward() + law.sliding().backward());
    let held = 0.2 * constant + 0.2 * mean * (30.0_f64.to_radians()).cos();
    assert!((law.at(0.0, 0.0).forward() - held).abs() < 1e-15);
    let tip = &made.scene.tip;
    assert!((tip.force.at(0.25) - 0.12).abs() < 1e-15);
    assert!((tip.torque.at(0.5) - 1e-3).abs() < 1e-15);
    assert_eq!((tip.viscous_n_s_per_m, tip.coulomb_n), (0.003, 5e-3));
    assert_eq!((tip.walls[0].ahead, tip.walls[1].ahead), (true, false));
    let masses: Vec<f64> =
        made.scene.later.iter().map(|(_, arm)| arm.beam().payload().mass_kg).collect();
    assert_eq!(masses, [0.05, 0.0]);
    let spec = read(&text).unwrap().tip.unwrap();
    assert_eq!(spec.world.torque, Signal::lines(&[(0.0, 0.0), (1.0, 2e-3)]).unwrap());
}

#[test]
fn a_distributed_beam_is_lumped() {
    let text = ARM.replace("spans = [", "mass_per_length = \"4 g/m\"\nspans = [");
    assert_eq!(rig(&text).arm.beam().len(), 10);
    let few = text.replace("[rig]", "[rig]\nmasses = 3");
    assert_eq!(rig(&few).arm.beam().len(), 3);
}

#[test]
fn refuses_what_makes_no_sense() {
    refused(
        &ARM.replace("[rig]", "[rig]\ncontrol_every = 0"),
        "arm.toml, line 12: `rig.control_every` is 0, but must be a whole number from 1 to 1000000",
    );
    refused(
        &ARM.replace("[rig]", "ripple = { share = 1.2, per_turn = 3 }\n[rig]"),
        "arm.toml, line 11: `drive.ripple.share` is 1.2, but must be below 1",
    );
    refused(
        &ARM.replace("[rig]", "[tip]\nwalls = [{ angle = 1, stiffness = 0 }]\n[rig]"),
        "arm.toml, line 12: `tip.walls[1].stiffness` is 0, but must be greater than zero",
    );
    refused(
        &ARM.replace("[rig]", "[tip]\nforce = { times = [0, 1], values = [1] }\n[rig]"),
        "arm.toml, line 12: `tip.force.values` is a list, where a list as long as `times` is expected",
    );
    refused(
        &with_rig("motor_sensor = { counts_per_turn = 100, range = 1 }"),
        "arm.toml, line 13: `rig.motor_sensor.range` needs `bits`",
    );
}
