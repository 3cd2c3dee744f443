//! A script for MATLAB and Octave.

use std::fmt::Write as _;

use lissom_core::drive::Falloff;
use lissom_core::replay::{ROOT_SPEED_RAD_S, ROUNDED_LOAD_SHARE};

use super::export_model::ExportModel;
use super::number_text::{number, numbers};

/// A script that defines `motor`, `arm` and `friction(velocity, angle)`. Octave needs its package control.
pub fn matlab_script(model: &ExportModel) -> String {
    let mut text = String::new();
    for line in model.about() {
        let _ = writeln!(text, "% {line}");
    }
    text.push_str(
        "% motor: angle per command, without dry friction. arm: the same as a state space, with the tips.\n\
         % friction(velocity, angle): torque against the motion, to be subtracted from the torque of the drive.\n",
    );
    for lost in model.lost_friction() {
        let _ = writeln!(text, "% Not in motor and arm: {lost}.");
    }
    text.push_str("if exist('OCTAVE_VERSION', 'builtin'), pkg load control, end\n");
    let g = model.motor_function();
    let s = model.state_space();
    let rows = |m: &lissom_core::Matrix| {
        let row = |i: usize| {
            let values: Vec<f64> = (0..m.ncols()).map(|j| m[(i, j)]).collect();
            numbers(&values, ", ")
        };
        format!("[{}]", (0..m.nrows()).map(row).collect::<Vec<_>>().join("; "))
    };
    let _ = writeln!(text, "torque_per_command = {};", number(model.torque_per_command));
    let _ = writeln!(text, "motor = tf([{}], [{}]);", numbers(&g.num, ", "), numbers(&g.den, ", "));
    let _ =
        writeln!(text, "arm = ss({}, {}, {}, {});", rows(&s.a), rows(&s.b), rows(&s.c), rows(&s.d));
    let names = |list: &[String]| {
        let quoted =
            |n: &String| format!("'{}'", n.replace('\'', "_").replace(char::is_control, " "));
        list.iter().map(quoted).collect::<Vec<_>>().join(", ")
    };
    let _ = writeln!(text, "set(arm, 'OutputName', {{{}}});", names(&s.outputs));
    text.push_str(&friction(model));
    if let Some([ks, kv, ka, kg]) = model.wpilib() {
        let _ = writeln!(
            text,
            "% WPILib, in V, V*s, V*s^2 per rad (or m), V\nkS = {}; kV = {}; kA = {}; kG = {};",
            number(ks),
            number(kv),
            number(ka),
            number(kg)
        );
        for lost in model.lost_by_wpilib() {
            let _ = writeln!(text, "% {lost}");
        }
    }
    text
}

/// An anonymous function of velocity and angle.
fn friction(model: &ExportModel) -> String {
    let arm = &model.arm;
    let mut dry = number(arm.coulomb_nm);
    if let Some(near) = &arm.dry_terms.near_rest {
        let ratio = format!("abs(v)/{}", number(near.speed_rad_s));
        let power = match near.falloff {
            Falloff::Exponential => format!("-{ratio}"),
            Falloff::Gaussian => format!("-({ratio}).^2"),
        };
        let _ = write!(
            dry,
            " + ({} + sign(v)*({})).*exp({power})",
            number(near.torque_nm),
            number(near.offset_nm)
        );
    }
    for ripple in &arm.dry_terms.ripples {
        let _ = write!(
            dry,
            " + ({})*cos({k}*q) + ({})*sin({k}*q)",
            number(ripple.cosine_nm),
            number(ripple.sine_nm),
            k = number(ripple.per_rad)
        );
    }
    if let Some(root) = &arm.dry_terms.root {
        let e = number(ROOT_SPEED_RAD_S);
        let _ = write!(
            dry,
            " + ({})*(sqrt(abs(v) + {e}) - sqrt({e}))",
            number(root.torque_nm_per_root_rad_s)
        );
    }
    if let Some(term) = &arm.dry_terms.with_load {
        let _ = write!(
            dry,
            " + ({})*hypot(({})*sin(q) + ({})*cos(q), {})",
            number(term.coefficient),
            number(term.load.sine_nm),
            number(term.load.cosine_nm),
            number(ROUNDED_LOAD_SHARE * term.load.amplitude_nm())
        );
    }
    let mut gravity = arm.gravity.map_or(String::new(), |g| {
        format!(" + ({})*sin(q) + ({})*cos(q)", number(g.sine_nm), number(g.cosine_nm))
    });
    for ripple in &arm.torque_ripples {
        let _ = write!(
            gravity,
            " + ({})*cos({k}*q) + ({})*sin({k}*q)",
            number(ripple.cosine_nm),
            number(ripple.sine_nm),
            k = number(ripple.per_rad)
        );
    }
    format!("friction = @(v, q) sign(v).*({dry}) + ({}){gravity};\n", number(arm.offset_nm))
}
