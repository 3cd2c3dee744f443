//! Writes an `arm.toml` of a beam that is given by its modes.

use std::fmt::{self, Write as _};

use lissom_core::beam::ModalBeam;
use lissom_core::drive::{Coulomb, Motor};

/// First line of a written arm.
pub const ARM_HEAD: &str = "# Written by `lissom equivalent`";

/// An equivalent arm for an `arm.toml`.
#[derive(Debug, Clone, Copy)]
pub struct WrittenArm<'a> {
    /// Its motor.
    pub motor: Motor,
    /// Coulomb friction, if it is known.
    pub coulomb: Option<Coulomb>,
    /// Its beam.
    pub beam: &'a ModalBeam,
    /// Names of the beam's points.
    pub points: &'a [&'a str],
}

/// The text of an `arm.toml` that [`ArmFile`](crate::ArmFile) reads, with all digits of every number.
pub fn arm_text(arm: &WrittenArm<'_>) -> String {
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = put(&mut text, arm);
    text
}

fn put(text: &mut String, arm: &WrittenArm<'_>) -> fmt::Result {
    writeln!(text, "{ARM_HEAD}: the equivalent arm, given by its modes.")?;
    writeln!(text, "[beam]")?;
    let points: Vec<String> =
        arm.points.iter().map(|name| name.escape_default().to_string()).collect();
    writeln!(text, "# gains are for the points {}", points.join(", "))?;
    writeln!(text, "modes = [")?;
    for mode in arm.beam.known_modes() {
        let gains: Vec<String> = mode.gains.iter().map(|g| format!("{g:?}")).collect();
        writeln!(
            text,
            "  {{ omega_rad_s = {:?}, damping_ratio = {:?}, coupling = \"{:?} N*m\", gains = [{}] }},",
            mode.omega_rad_s,
            mode.damping_ratio,
            mode.coupling_nm_per_rad,
            gains.join(", ")
        )?;
    }
    writeln!(text, "]\n\n[drive]")?;
    writeln!(text, "inertia = \"{:?} kg*m^2\"", arm.motor.inertia_kg_m2())?;
    writeln!(text, "viscous = \"{:?} N*m*s/rad\"", arm.motor.viscous_nm_s_per_rad())?;
    writeln!(text, "torque_constant = \"{:?} N*m/A\"", arm.motor.torque_constant_nm_per_a())?;
    match arm.coulomb {
        Some(coulomb) => writeln!(
            text,
            "coulomb = {{ forward = \"{:?} N*m\", backward = \"{:?} N*m\" }}",
            coulomb.forward(),
            coulomb.backward()
        ),
        None => writeln!(text, "# coulomb = \"0.03 N*m\"  # responses do not determine it"),
    }
}
