//! C header and source of the feed-forward of friction and inertia.

use std::fmt::Write as _;

use lissom_core::drive::Falloff;
use lissom_core::replay::{DryTerms, ROOT_SPEED_RAD_S, ROUNDED_LOAD_SHARE};

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
         * voltage), offset, gravity and torque ripple. velocity [{angle}/s] is that of the reference; below blend [{angle}/s] (> 0) dry\n \
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
    if !arm.dry_terms.ripples.is_empty() || !arm.torque_ripples.is_empty() {
        source.push_str(WAVE);
    }
    source.push_str(
        "\nfloat lissom_friction(float velocity, float angle, float blend)\n{\n    \
         float sign = velocity / blend;\n    float dry = COULOMB;\n    float torque;\n\n    \
         if (sign > 1.0f) sign = 1.0f;\n    if (sign < -1.0f) sign = -1.0f;\n",
    );
    dry_terms(&mut source, &arm.dry_terms);
    source.push_str(
        "    torque = sign * dry + OFFSET + velocity * (velocity > 0.0f ? VISCOUS_FORWARD : VISCOUS_BACKWARD);\n",
    );
    if let Some(g) = arm.gravity {
        let _ = writeln!(
            source,
            "    torque += {}f * sinf(angle) + {}f * cosf(angle);",
            number(g.sine_nm),
            number(g.cosine_nm)
        );
    }
    for ripple in &arm.torque_ripples {
        source.push_str(&wave("torque", ripple.per_rad, ripple.cosine_nm, ripple.sine_nm));
    }
    source.push_str("    (void)angle;\n");
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
        for lost in model.lost_by_wpilib() {
            let _ = writeln!(source, "/* {lost} */");
        }
    }
    CFiles { header, source }
}

/// The lines that add the terms of dry friction to `dry`.
fn dry_terms(source: &mut String, terms: &DryTerms) {
    if let Some(near) = &terms.near_rest {
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
    for ripple in &terms.ripples {
        source.push_str(&wave("dry", ripple.per_rad, ripple.cosine_nm, ripple.sine_nm));
    }
    if let Some(root) = &terms.root {
        let (a, e) = (number(root.torque_nm_per_root_rad_s), number(ROOT_SPEED_RAD_S));
        let rest = number(ROOT_SPEED_RAD_S.sqrt());
        let _ = writeln!(
            source,
            "    dry += {a}f * fabsf(velocity) / (sqrtf(fabsf(velocity) + {e}f) + {rest}f);"
        );
    }
    if let Some(term) = &terms.with_load {
        let (g_s, g_c) = (number(term.load.sine_nm), number(term.load.cosine_nm));
        let _ = writeln!(
            source,
            "    dry += {}f * hypotf({g_s}f * sinf(angle) + {g_c}f * cosf(angle), {}f);",
            number(term.coefficient),
            number(ROUNDED_LOAD_SHARE * term.load.amplitude_nm())
        );
    }
}

/// The function of a wave over the angle. In `float` the phase k·angle has an error of half its last digit, which is 3e-5 rad
/// of 500 rad.
const WAVE: &str = "\n/* cosine * cos(k * angle) + sine * sin(k * angle), k being k + k_rest; what k * angle loses by rounding is added. */\n\
    static float wave(float cosine, float sine, float k, float k_rest, float angle)\n{\n    \
    float phase = k * angle;\n    float rest = fmaf(k, angle, -phase) + k_rest * angle;\n    \
    float c = cosf(phase);\n    float s = sinf(phase);\n\n    \
    return cosine * (c - rest * s) + sine * (s + rest * c);\n}\n";

/// The line that adds a wave to a sum.
fn wave(sum: &str, per_rad: f64, cosine_nm: f64, sine_nm: f64) -> String {
    #[expect(clippy::cast_possible_truncation, reason = "the rest is given, too")]
    let k = f64::from(per_rad as f32);
    format!(
        "    {sum} += wave({}f, {}f, {}f, {}f, angle);\n",
        number(cosine_nm),
        number(sine_nm),
        number(k),
        number(per_rad - k)
    )
}
