//! The parts that all whole MuJoCo models have: comment and options, the motor's joint, the actuator.

use std::fmt::Write as _;

use lissom_core::record::Axis;

use super::export_model::ExportModel;
use super::number_text::{number, plain};

/// Type and axis of the joints.
pub(super) fn joint_kind(model: &ExportModel) -> (&'static str, &'static str) {
    match model.names.axis {
        Axis::Rotary => ("hinge", "0 0 1"),
        Axis::Linear => ("slide", "1 0 0"),
    }
}

/// The start of a model, up to `<worldbody>`: the origin of the numbers, what the model does not contain, further lines,
/// and the options.
pub(super) fn start(model: &ExportModel, lines: &[String], step_s: f64) -> String {
    let mut text = String::from("<mujoco model=\"lissom\">\n <!--\n");
    let lost = model.lost_by_pair();
    let lost = lost.iter().map(|lost| format!("Not in this model: {lost}."));
    let gravity = model.arm.gravity.map(|_| "Not in this model: gravity of the load.".to_owned());
    for line in model.about().into_iter().chain(lost).chain(gravity).chain(lines.iter().cloned()) {
        let _ = writeln!(text, "  {}", plain(&line));
    }
    let _ = writeln!(
        text,
        "  MuJoCo's friction is a soft constraint: at rest the joint creeps a little, and a stick ends a few steps earlier\n  \
         or later than in a joint that really sticks.\n -->\n \
         <compiler boundmass=\"0\" boundinertia=\"0\"/>\n \
         <option timestep=\"{}\" gravity=\"0 0 0\" integrator=\"implicitfast\"/>\n <worldbody>",
        number(step_s)
    );
    text
}

/// The motor's joint: inertia, friction that sticks within two steps.
pub(super) fn motor_joint(model: &ExportModel, step_s: f64) -> String {
    let (kind, axis) = joint_kind(model);
    let pair = model.pair();
    format!(
        "<joint name=\"motor\" type=\"{kind}\" axis=\"{axis}\" armature=\"{}\" damping=\"{}\" frictionloss=\"{}\" \
         solreffriction=\"{} 1\" solimpfriction=\"0.99999 0.99999 0.001 0.5 2\"/>",
        number(model.arm.inertia_kg_m2),
        number(pair.viscous_nm_s_per_rad),
        number(pair.coulomb_nm),
        number(2.0 * step_s)
    )
}

/// The actuator, whose control is the command, and the end of a model.
pub(super) fn end(model: &ExportModel) -> String {
    format!(
        " <actuator>\n  <motor name=\"command\" joint=\"motor\" gear=\"{}\"/>\n </actuator>\n</mujoco>\n",
        number(model.torque_per_command)
    )
}
