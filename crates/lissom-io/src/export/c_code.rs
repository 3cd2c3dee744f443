//! C header and source of the feed-forward of friction and inertia.

use std::fmt::Write as _;

use lissom_core::drive::Falloff;

use super::export_model::ExportModel;
use super::number_text::{number, plain};

/// A header and a source.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CFiles {
    /// `lissom_feedforward.h`.
    pub header: String,
    /// `lissom_feedforward.c`.
    pub source: String,
}

/// The feed-forward of a motor in C99 with `float`, without allocation and without state.
pub fn c_files(model: &ExportModel) -> CFiles {
    let mut about = String::new();
    for line in model.about() {
        let _ = writeln!(about, " * {}", plain(&line));
    }
    if !model.arm.modes.is_empty() {
        about.push_str(
            " * The modes of the arm are not in it: its inertia is that of motor and arm together, turning as one body.\n",
        );
    }
    let angle = model.names.angle();
    let torque = model.torque_unit();
    let header = format!(
        "/*\n{about} */\n#ifndef LISSOM_FEEDFORWARD_H\n#define LISSOM_FEEDFORWARD_H\n\n\
         /* Torque [{torque}] against the motion: dry and viscous friction (with the damping by back-EMF, if the command is a\n \
         * voltage), offset and gravity. velocity [{angle}/s] is that of the reference; below blend [{angle}/s] (> 0) dry\n \
         * friction grows in proportion to the velocity, so that noise of a measured velocity does not switch it. */\n\
         float lissom_friction(float velocity, float angle, float blend);\n\n\
         /* Command for a wanted acceleration [{angle}/s^2]: (inertia * acceleration + friction) / torque_per_command. */\n\
         float lissom_command(float acceleration, float velocity, float angle, float blend);\n\n#endif\n"
    );
    let mut source = String::from("#include \"lissom_feedforward.h\"\n\n#include <math.h>\n\n");
    let arm = &model.arm;
    let inertia = model.total_inertia();
    let constant =
        |name: &str, value: f64| format!("static const float {name} = {}f;\n", number(value));
    for (name, value) in [
        ("INERTIA", inertia),
        ("VISCOUS_FORWARD", arm.viscous_nm_s_per_rad[0]),
        ("VISCOUS_BACKWARD", arm.viscous_nm_s_per_rad[1]),
        ("COULOMB", arm.coulomb_nm),
        ("OFFSET", arm.offset_nm),
        ("TORQUE_PER_COMMAND", model.torque_per_command),
    ] {
        source.push_str(&constant(name, value));
    }
    source.push_str(
        "\nfloat lissom_friction(float velocity, float angle, float blend)\n{\n    \
         float sign = velocity / blend;\n    float dry = COULOMB;\n    float torque;\n\n    \
         if (sign > 1.0f) sign = 1.0f;\n    if (sign < -1.0f) sign = -1.0f;\n",
    );
    if let Some(near) = &arm.dry_terms.near_rest {
        let ratio = format!("fabsf(velocity) / {}f", number(near.speed_rad_s));
        let power = match near.falloff {
            Falloff::Exponential => format!("-({ratio})"),
            Falloff::Gaussian => format!("-({ratio}) * ({ratio})"),
        };
        let _ = writeln!(
            source,
            "    dry += ({}f + sign * {}f) * expf({power});",
            number(near.torque_nm),
            number(near.offset_nm)
        );
    }
    for ripple in &arm.dry_terms.ripples {
        let _ = writeln!(
            source,
            "    dry += {}f * cosf({k}f * angle) + {}f * sinf({k}f * angle);",
            number(ripple.cosine_nm),
            number(ripple.sine_nm),
            k = number(ripple.per_rad)
        );
    }
    source.push_str(
        "    torque = sign * dry + OFFSET + velocity * (velocity > 0.0f ? VISCOUS_FORWARD : VISCOUS_BACKWARD);\n",
    );
    match arm.gravity {
        Some(g) => {
            let _ = writeln!(
                source,
                "    torque += {}f * sinf(angle) + {}f * cosf(angle);",
                number(g.sine_nm),
                number(g.cosine_nm)
            );
        }
        None => source.push_str("    (void)angle;\n"),
    }
    source.push_str(
        "    return torque;\n}\n\nfloat lissom_command(float acceleration, float velocity, float angle, float blend)\n{\n    \
         return (INERTIA * acceleration + lissom_friction(velocity, angle, blend)) / TORQUE_PER_COMMAND;\n}\n",
    );
    if let Some([ks, kv, ka, kg]) = model.wpilib() {
        let _ = writeln!(
            source,
            "\n/* WPILib, in V, V*s, V*s^2 per rad (or m), V: kS {}, kV {}, kA {}, kG {} */",
            number(ks),
            number(kv),
            number(ka),
            number(kg)
        );
    }
    CFiles { header, source }
}
