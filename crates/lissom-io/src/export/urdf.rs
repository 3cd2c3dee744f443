//! URDF: `dynamics` of a joint in a user's robot.

use lissom_core::record::Axis;

use super::export_error::ExportError;
use super::export_model::ExportModel;
use super::number_text::number;
use super::xml_edit::{joint, of_type, parsed, with_attributes, with_child, with_comment};

/// The text of a user's robot in which the joint has damping and friction of the arm. URDF has no inertia of the motor.
///
/// # Errors
/// [`ExportError`] if the torque constant is unknown, the text is no XML, or there is no such joint.
pub fn urdf_into(
    model: &ExportModel,
    file: &str,
    text: &str,
    name: &str,
) -> Result<String, ExportError> {
    model.needs_torque("URDF")?;
    let document = parsed(file, text)?;
    let found = joint(file, &document, name)?;
    let pair = model.pair();
    let (damping, friction) = (number(pair.viscous_nm_s_per_rad), number(pair.coulomb_nm));
    let dynamics = found.node.children().find(|n| n.has_tag_name("dynamics"));
    let allowed: &[&str] = match model.names.axis {
        Axis::Rotary => &["revolute", "continuous"],
        Axis::Linear => &["prismatic"],
    };
    of_type(file, &found, "not stated", allowed)?;
    let changed = if let Some(node) = dynamics {
        with_attributes(text, node, &[("damping", damping), ("friction", friction)])
    } else {
        let child = format!("<dynamics damping=\"{damping}\" friction=\"{friction}\"/>");
        with_child(text, found.node, &child)
    };
    let mut about = model.merged_note();
    about.push(format!(
        "Not in URDF: inertia of the motor's side, {}.",
        number(model.joint_inertia())
    ));
    Ok(with_comment(&changed, found.node.range().start, &about))
}
