//! The two arms that the figures show.

use std::path::Path;

use lissom::beam::LumpedBeam;
use lissom::rig::{Noise, Rig, Sensor};
use lissom_io::{ArmFile, Error};

/// The arm of `lissom demo`: one mass, 12-bit motor sensor, position loop at 3 ms.
const DEMO: &str = include_str!("../../src/commands/demo/arm.toml");
/// The beam of two equal masses in the README.
const TWO_MASSES: &str = r#"
[beam]
young_modulus = "30e6 psi"
section = { round = "0.047 in" }
spans = [{ length = "6 in", mass = "0.121 lb" }, { length = "6 in", mass = "0.121 lb" }]
"#;

/// The demo's rig, as it is.
pub(crate) fn demo_rig() -> Result<Rig, Error> {
    let path = Path::new("arm.toml");
    Ok(ArmFile::from_text(path, DEMO)?.rig(path)?)
}

/// The demo's rig with a motor sensor without steps: they make the velocity rough.
pub(crate) fn smooth_rig() -> Result<Rig, Error> {
    let mut rig = demo_rig()?;
    rig.instruments.motor = Sensor::IDEAL;
    Ok(rig)
}

/// The demo's rig with white noise of this standard deviation on both angles \[rad\], in place of the sensor's steps.
pub(crate) fn noisy_rig(std_rad: f64) -> Result<Rig, Box<dyn std::error::Error>> {
    let mut rig = demo_rig()?;
    let sensor = Noise::new(std_rad)?;
    rig.instruments.motor = sensor.into();
    rig.instruments.tips = vec![sensor.into()];
    Ok(rig)
}

/// The beam of two equal masses.
pub(crate) fn two_masses() -> Result<LumpedBeam, Error> {
    let path = Path::new("arm.toml");
    Ok(ArmFile::from_text(path, TWO_MASSES)?.lumped_beam(path)?)
}
