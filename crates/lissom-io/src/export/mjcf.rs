//! MuJoCo: parameters of a joint in a user's model, or a whole model.

use std::fmt::Write as _;

use super::export_error::ExportError;
use super::export_model::ExportModel;
use super::mjcf_text::{Load, end, joint_kind, motor_joint, start};
use super::number_text::number;
use super::xml_edit::{joint, of_type, parsed, with_attributes, with_comment};

/// Time step of a whole model [s].
const STEP_S: f64 = 1e-4;

/// The text of a user's model in which the joint has armature, damping and frictionloss of the arm.
///
/// The inertia goes into `armature`: for a rigid axis the bodies of the model must not count it again.
///
/// # Errors
/// [`ExportError`] if the torque constant is unknown, the text is no XML, or there is no such joint.
pub fn mjcf_into(
    model: &ExportModel,
    file: &str,
    text: &str,
    name: &str,
) -> Result<String, ExportError> {
    model.needs_torque("MuJoCo")?;
    let document = parsed(file, text)?;
    let found = joint(file, &document, name)?;
    let (kind, _) = joint_kind(model);
    of_type(file, &found, "hinge", &[kind])?;
    let pair = model.pair();
    let set = [
        ("armature", number(model.joint_inertia())),
        ("damping", number(pair.viscous_nm_s_per_rad)),
        ("frictionloss", number(pair.coulomb_nm)),
    ];
    let mut about = model.merged_note();
    about.push(
        "armature is the inertia of all that turned in the logs: give bodies on this joint no inertia that is in it already."
            .to_owned(),
    );
    let changed = with_attributes(text, found.node, &set);
    Ok(with_comment(&changed, found.node.range().start, &about))
}

/// A whole model: the motor as a joint with friction, and each mode of the beam as an inertia on the same axis that a
/// spring and a damper hold to the motor. The actuator's control is the command.
///
/// # Errors
/// [`ExportError::NoTorque`] if the torque constant is unknown.
pub fn mjcf(model: &ExportModel) -> Result<String, ExportError> {
    model.needs_torque("MuJoCo")?;
    let arm = &model.arm.clone().without_light_modes();
    let (kind, axis) = joint_kind(model);
    let load = Load::of(model);
    let mut lines = Vec::new();
    if load.is_some() {
        lines.push(
            "The body load has the gravity of the load; gravity acts along the x axis, and at angle zero of the motor the load \
             is where its body is. A part of the motor's inertia is in it, the rest in armature."
                .to_owned(),
        );
    }
    if !arm.at_points_per_s.is_empty() {
        lines.push(
            "Dampers at points are added to the modes; they couple them in the arm.".to_owned(),
        );
    }
    let mut text = start(model, &lines, STEP_S, load.as_ref());
    let light = "<inertial pos=\"0 0 0\" mass=\"1e-9\" diaginertia=\"1e-12 1e-12 1e-12\"/>";
    let motor = motor_joint(model, STEP_S, load.as_ref());
    let _ = writeln!(text, "  <body name=\"motor\">{light}\n   {motor}");
    if let Some(load) = &load {
        let _ = writeln!(text, "   {}", load.body());
    }
    text.push_str("  </body>\n");
    let ratios = arm.damping_ratios();
    for (k, mode) in arm.modes.iter().enumerate() {
        // Dampers at points, to first order, are what the damping ratio has beyond the mode's own dampers.
        let own = mode.within_per_s + mode.grounded_per_s;
        let points = 2.0 * ratios[k] * mode.omega_rad_s - own;
        let grounded = (mode.grounded_per_s + points) * mode.inertia_kg_m2();
        let _ = writeln!(
            text,
            "  <body name=\"mode_{n}\">{light}\n   <joint name=\"mode_{n}\" type=\"{kind}\" axis=\"{axis}\" armature=\"{}\" \
             damping=\"{}\"/>\n  </body>",
            number(mode.inertia_kg_m2()),
            number(grounded.max(0.0)),
            n = k + 1
        );
    }
    text.push_str(" </worldbody>\n");
    if !arm.modes.is_empty() {
        text.push_str(" <tendon>\n");
        for (k, mode) in arm.modes.iter().enumerate() {
            let _ = writeln!(
                text,
                "  <fixed name=\"spring_{n}\" stiffness=\"{}\" damping=\"{}\" springlength=\"0\">\n   \
                 <joint joint=\"motor\" coef=\"1\"/>\n   <joint joint=\"mode_{n}\" coef=\"-1\"/>\n  </fixed>",
                number(mode.stiffness_nm_per_rad),
                number((mode.within_per_s * mode.inertia_kg_m2()).max(0.0)),
                n = k + 1
            );
        }
        text.push_str(" </tendon>\n");
    }
    text.push_str(&end(model));
    Ok(text)
}
