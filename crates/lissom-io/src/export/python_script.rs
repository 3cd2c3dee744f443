//! A script for python-control.

use std::fmt::Write as _;

use lissom_core::drive::Falloff;
use lissom_core::replay::{ROOT_SPEED_RAD_S, ROUNDED_LOAD_SHARE};

use super::export_model::ExportModel;
use super::number_text::{number, numbers, plain};

/// A script that defines `motor`, `arm` and `friction(velocity, angle)` for python-control.
pub fn python_script(model: &ExportModel) -> String {
    let mut text = String::from("\"\"\"");
    for line in model.about() {
        let _ = writeln!(text, "{}", line.replace(['"', '\\'], "'"));
    }
    text.push_str(
        "\nmotor: angle per command, without dry friction. arm: the same as a state space, with the tips.\n\
         friction(velocity, angle): torque against the motion, to be subtracted from the torque of the drive.\n",
    );
    for lost in not_linear(model) {
        let _ = writeln!(text, "Not in motor and arm: {lost}.");
    }
    text.push_str("\"\"\"\n\nimport math\n\nimport control\n\n");
    let g = model.motor_function();
    let s = model.state_space();
    let rows = |m: &lissom_core::Matrix| {
        let row = |i: usize| {
            let values: Vec<f64> = (0..m.ncols()).map(|j| m[(i, j)]).collect();
            format!("[{}]", numbers(&values, ", "))
        };
        format!("[{}]", (0..m.nrows()).map(row).collect::<Vec<_>>().join(", "))
    };
    let _ = writeln!(text, "torque_per_command = {}", number(model.torque_per_command));
    let _ = writeln!(
        text,
        "motor = control.tf([{}], [{}])",
        numbers(&g.num, ", "),
        numbers(&g.den, ", ")
    );
    let names = |list: &[String]| {
        list.iter()
            .map(|n| format!("\"{}\"", plain(n).replace(['"', '\\'], "_")))
            .collect::<Vec<_>>()
            .join(", ")
    };
    let _ = writeln!(
        text,
        "arm = control.ss(\n    {},\n    {},\n    {},\n    {},\n    states=[{}],\n    inputs=[{}],\n    outputs=[{}],\n)\n\n",
        rows(&s.a),
        rows(&s.b),
        rows(&s.c),
        rows(&s.d),
        names(&s.states),
        names(&s.inputs),
        names(&s.outputs)
    );
    text.push_str(&friction(model));
    if let Some([ks, kv, ka, kg]) = model.wpilib() {
        let _ = writeln!(
            text,
            "\n# WPILib, in V, V*s, V*s^2 per rad (or m), V\nkS, kV, kA, kG = {}, {}, {}, {}",
            number(ks),
            number(kv),
            number(ka),
            number(kg)
        );
        for lost in model.lost_by_wpilib() {
            let _ = writeln!(text, "# {lost}");
        }
    }
    text
}

/// What the linear model does not contain.
fn not_linear(model: &ExportModel) -> Vec<String> {
    let mut lost = vec!["Coulomb friction".to_owned()];
    lost.extend(model.lost_friction());
    if model.arm.gravity.is_some() {
        lost.push("gravity".to_owned());
    }
    lost
}

fn friction(model: &ExportModel) -> String {
    let arm = &model.arm;
    let mut text = String::from(
        "def friction(velocity, angle=0.0):\n    \"\"\"Dry friction, offset, gravity and torque ripple; viscous friction is in the linear model.\"\"\"\n    \
         sign = math.copysign(1.0, velocity) if velocity != 0.0 else 0.0\n",
    );
    let _ = writeln!(text, "    dry = {}", number(arm.coulomb_nm));
    if let Some(near) = &arm.dry_terms.near_rest {
        let ratio = format!("abs(velocity) / {}", number(near.speed_rad_s));
        let power = match near.falloff {
            Falloff::Exponential => format!("-{ratio}"),
            Falloff::Gaussian => format!("-(({ratio}) ** 2)"),
        };
        let _ = writeln!(
            text,
            "    dry += ({} + sign * {}) * math.exp({power})",
            number(near.torque_nm),
            number(near.offset_nm)
        );
    }
    for ripple in &arm.dry_terms.ripples {
        let _ = writeln!(
            text,
            "    dry += {} * math.cos({k} * angle) + {} * math.sin({k} * angle)",
            number(ripple.cosine_nm),
            number(ripple.sine_nm),
            k = number(ripple.per_rad)
        );
    }
    if let Some(root) = &arm.dry_terms.root {
        let e = number(ROOT_SPEED_RAD_S);
        let _ = writeln!(
            text,
            "    dry += {} * (math.sqrt(abs(velocity) + {e}) - math.sqrt({e}))",
            number(root.torque_nm_per_root_rad_s)
        );
    }
    if let Some(term) = &arm.dry_terms.with_load {
        let _ = writeln!(
            text,
            "    dry += {} * math.hypot({} * math.sin(angle) + {} * math.cos(angle), {})",
            number(term.coefficient),
            number(term.load.sine_nm),
            number(term.load.cosine_nm),
            number(ROUNDED_LOAD_SHARE * term.load.amplitude_nm())
        );
    }
    let mut gravity = arm.gravity.map_or(String::new(), |g| {
        format!(
            " + {} * math.sin(angle) + {} * math.cos(angle)",
            number(g.sine_nm),
            number(g.cosine_nm)
        )
    });
    for ripple in &arm.torque_ripples {
        let _ = write!(
            gravity,
            " + {} * math.cos({k} * angle) + {} * math.sin({k} * angle)",
            number(ripple.cosine_nm),
            number(ripple.sine_nm),
            k = number(ripple.per_rad)
        );
    }
    let _ = writeln!(text, "    return sign * dry + {}{gravity}", number(arm.offset_nm));
    text
}
