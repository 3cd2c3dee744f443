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

/// Standard gravity \[m/s²\].
const GRAVITY_M_S2: f64 = 9.806_65;
/// Part of the motor's inertia that the body of the load has; any part gives the same motion.
const LOAD_SHARE: f64 = 0.5;

/// An unbalanced load on a rotary motor: a point mass whose inertia is taken from the motor's.
#[derive(Debug, Clone, Copy)]
pub(super) struct Load {
    mass_kg: f64,
    at_m: [f64; 2],
    inertia_kg_m2: f64,
}

impl Load {
    /// The load whose gravity needs the torque `g_s·sin θ + g_c·cos θ` of the motor: the mass m at the distance l in the
    /// direction φ, with `m·g·l·sin(θ + φ)` and gravity g along the x axis. `None` without gravity and for linear axes.
    pub(super) fn of(model: &ExportModel) -> Option<Self> {
        let gravity = model.arm.gravity.filter(|_| model.names.axis == Axis::Rotary)?;
        let moment = gravity.sine_nm.hypot(gravity.cosine_nm) / GRAVITY_M_S2;
        let inertia_kg_m2 = LOAD_SHARE * model.arm.inertia_kg_m2;
        let l = inertia_kg_m2 / moment;
        let (sin, cos) = gravity.cosine_nm.atan2(gravity.sine_nm).sin_cos();
        let load = Self { mass_kg: moment / l, at_m: [l * cos, l * sin], inertia_kg_m2 };
        (moment > 0.0 && l.is_finite()).then_some(load)
    }

    /// Its body.
    pub(super) fn body(&self) -> String {
        let [x, y] = self.at_m.map(number);
        let light = number(1e-9 * self.inertia_kg_m2);
        format!(
            "<body name=\"load\" pos=\"{x} {y} 0\"><inertial pos=\"0 0 0\" mass=\"{}\" diaginertia=\"{light} {light} \
             {light}\"/></body>",
            number(self.mass_kg)
        )
    }
}

/// The start of a model, up to `<worldbody>`: the origin of the numbers, what the model does not contain, further lines,
/// and the options.
pub(super) fn start(
    model: &ExportModel,
    lines: &[String],
    step_s: f64,
    load: Option<&Load>,
) -> String {
    let mut text = String::from("<mujoco model=\"lissom\">\n <!--\n");
    let lost = model.lost_by_pair();
    let lost = lost.iter().map(|lost| format!("Not in this model: {lost}."));
    let lost_gravity = model.arm.gravity.filter(|_| load.is_none());
    let gravity = lost_gravity.map(|_| "Not in this model: gravity of the load.".to_owned());
    for line in model.about().into_iter().chain(lost).chain(gravity).chain(lines.iter().cloned()) {
        let _ = writeln!(text, "  {}", plain(&line));
    }
    let _ = writeln!(
        text,
        "  MuJoCo's friction is a soft constraint: at rest the joint creeps a little, and a stick ends a few steps earlier\n  \
         or later than in a joint that really sticks.\n -->\n \
         <compiler boundmass=\"0\" boundinertia=\"0\"/>\n \
         <option timestep=\"{}\" gravity=\"{} 0 0\" integrator=\"implicitfast\"/>\n <worldbody>",
        number(step_s),
        load.map_or_else(|| "0".to_owned(), |_| number(GRAVITY_M_S2))
    );
    text
}

/// The motor's joint: inertia, friction that sticks within two steps.
pub(super) fn motor_joint(model: &ExportModel, step_s: f64, load: Option<&Load>) -> String {
    let (kind, axis) = joint_kind(model);
    let pair = model.pair();
    format!(
        "<joint name=\"motor\" type=\"{kind}\" axis=\"{axis}\" armature=\"{}\" damping=\"{}\" frictionloss=\"{}\" \
         solreffriction=\"{} 1\" solimpfriction=\"0.99999 0.99999 0.001 0.5 2\"/>",
        number(model.arm.inertia_kg_m2 - load.map_or(0.0, |l| l.inertia_kg_m2)),
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
