//! The parameters of a result, one row for each.

use lissom::identify::{ConstantVelocity, Estimate, Identified};
use lissom_io::UnitNames;
use lissom_io::result::finding_keys::{
    CONSTANT_VELOCITY, COULOMB, COUPLING, GRAVITY, INERTIA, MODES, OFFSET, VISCOUS,
};

use crate::known_arm::Reference;

/// Significant digits of parameters that are known beforehand.
pub const KNOWN_DIGITS: usize = 6;
/// An offset within this many of its standard errors is zero: both directions then have the same friction.
const SAME_BY_DIRECTION: f64 = 2.0;

/// A row of a table of parameters.
#[derive(Debug, Clone)]
pub struct ParameterRow {
    /// Name of the parameter; indented if it belongs to the row above.
    pub name: String,
    /// Its key in `result.json`, without the suffix of the unit: what findings affect.
    pub key: &'static str,
    /// The estimate; `None` if it is refused.
    pub estimate: Option<Estimate>,
    /// Its unit.
    pub unit: String,
    /// The value that is known beforehand, in the same unit.
    pub known: Option<f64>,
}

/// Friction by the method of constant velocities, one row for each parameter.
pub fn classical_rows(
    names: UnitNames,
    id: &Identified,
    found: &ConstantVelocity,
) -> Vec<ParameterRow> {
    let constant = id.torque_per_command.unwrap_or(1.0);
    let (forward, backward) = (found.forward.as_ref().ok(), found.backward.as_ref().ok());
    let in_command = |e: Option<Estimate>| e.map(|e| e.scaled(1.0 / constant));
    let command = || names.command_unit().to_owned();
    let row = |name: &str, estimate, unit: String| ParameterRow {
        name: name.to_owned(),
        key: CONSTANT_VELOCITY,
        estimate,
        unit,
        known: None,
    };
    vec![
        row("Coulomb friction", in_command(found.coulomb), command()),
        row("  forward", in_command(forward.map(|l| l.coulomb)), command()),
        row("  backward", in_command(backward.map(|l| l.coulomb)), command()),
        row("viscous friction", found.viscous, names.viscous_unit()),
        row("  forward", forward.map(|l| l.viscous), names.viscous_unit()),
        row("  backward", backward.map(|l| l.viscous), names.viscous_unit()),
    ]
}

/// All parameters of the result.
pub fn parameter_rows(
    names: UnitNames,
    id: &Identified,
    reference: Option<&Reference>,
) -> Vec<ParameterRow> {
    // An arm.toml is rotary and in SI, so it cannot be compared with parameters per unit of command.
    let reference = reference.filter(|_| names.torque_unit() == "N·m");
    let f = &id.friction;
    let constant = id.torque_per_command.unwrap_or(1.0);
    let torque = || names.torque_unit().to_owned();
    let mut rows = Vec::new();
    let mut add = |key: &'static str, name: &str, estimate, unit: String, known: Option<f64>| {
        rows.push(ParameterRow { name: name.to_owned(), key, estimate, unit, known });
    };
    let mean = reference.map(|r| 0.5 * (r.coulomb_nm.0 + r.coulomb_nm.1));
    // With another friction near standstill, this is the part that does not depend on speed.
    let coulomb = if f.near_rest.is_some() {
        "Coulomb friction (of the law, at high speed)"
    } else {
        "Coulomb friction"
    };
    if names.torque_known {
        let in_command = f.coulomb.map(|e| e.scaled(1.0 / constant));
        let unit = names.command_unit().to_owned();
        add(COULOMB, coulomb, in_command, unit, mean.map(|m| m / constant));
        add(COULOMB, "  as a torque", f.coulomb, torque(), mean);
    } else {
        add(COULOMB, coulomb, f.coulomb, torque(), mean);
    }
    if f.coulomb.is_none() {
        // One direction only: friction and a constant load are one number.
        for (name, sum) in [("forward", f.forward), ("backward", f.backward)] {
            if sum.is_some() {
                add(COULOMB, &format!("  friction plus load, {name}"), sum, torque(), None);
            }
        }
    } else if f.forward.is_some() {
        let same = f.offset.is_some_and(|o| o.value.abs() < SAME_BY_DIRECTION * o.std);
        if !same || reference.is_some() {
            add(COULOMB, "  forward", f.forward, torque(), reference.map(|r| r.coulomb_nm.0));
            add(COULOMB, "  backward", f.backward, torque(), reference.map(|r| r.coulomb_nm.1));
        }
        let offset = reference.map(|r| 0.5 * (r.coulomb_nm.0 - r.coulomb_nm.1));
        add(OFFSET, "  offset, (forward − backward)/2", f.offset, torque(), offset);
    }
    let viscous = reference.map(|r| r.viscous_nm_s_per_rad);
    add(VISCOUS, "viscous friction", f.viscous, names.viscous_unit(), viscous);
    if let Some((forward, backward)) = f.viscous_by_direction {
        add(VISCOUS, "  forward", Some(forward), names.viscous_unit(), None);
        add(VISCOUS, "  backward", Some(backward), names.viscous_unit(), None);
    }
    if let Some(near) = f.near_rest {
        if let Some(at_rest) = near.static_friction() {
            add(COULOMB, "static friction", Some(at_rest), torque(), None);
        }
        let (change, size) =
            if near.torque.value < 0.0 { ("lower", -1.0) } else { ("higher", 1.0) };
        let name = format!("friction near standstill {change} by");
        add(COULOMB, &name, Some(near.torque.scaled(size)), torque(), None);
        add(
            COULOMB,
            "  below a speed of about",
            Some(near.speed),
            format!("{}/s", names.angle()),
            None,
        );
    }
    if f.with_load.is_some() {
        add(COULOMB, "friction per gravity torque, μ", f.with_load, "1".to_owned(), None);
    }
    for ripple in &f.ripples {
        add(COULOMB, "friction ripple", Some(ripple.torque), torque(), None);
        add(COULOMB, "  period", Some(ripple.period()), names.angle().to_owned(), None);
    }
    let inertia = reference.map(|r| r.inertia_kg_m2);
    add(INERTIA, names.inertia_name(), id.inertia, names.inertia_unit(), inertia);
    if let Some(gravity) = &id.gravity {
        let known = reference.and_then(|r| r.gravity);
        let mgl = known.map(|load| load.amplitude_nm());
        add(GRAVITY, "gravity, m·g·l", Some(gravity.amplitude()), torque(), mgl);
        let phase = known.map(|load| load.phase_rad().to_degrees());
        let degrees = gravity.phase_rad().scaled(1.0_f64.to_degrees());
        add(GRAVITY, "  phase φ of m·g·l·sin(θ + φ)", Some(degrees), "deg".to_owned(), phase);
        if let Some(constant) = id.torque_constant {
            let unit = format!("N·m/{}", names.command_unit());
            add(GRAVITY, "  torque constant from m·g·l", Some(constant), unit, None);
        }
    }
    rows.extend(beam_rows(names, id, reference));
    rows
}

/// The beam's parameters: coupling and modes.
fn beam_rows(
    names: UnitNames,
    id: &Identified,
    reference: Option<&Reference>,
) -> Vec<ParameterRow> {
    let arm = reference.and_then(|r| r.arm.as_ref());
    let mut rows = Vec::new();
    let mut add = |key: &'static str, name: &str, estimate, unit: String, known: Option<f64>| {
        rows.push(ParameterRow { name: name.to_owned(), key, estimate, unit, known });
    };
    if !id.beam.coupling_by_tip.is_empty() || id.beam.coupling.is_some() {
        let known = arm.map(|a| a.dynamics().coupling_motor);
        add(COUPLING, "coupling to the beam", id.beam.coupling, names.coupling_unit(), known);
    }
    let natural = arm.map_or(Vec::new(), |a| a.beam().natural_frequencies_rad_s());
    for (k, mode) in id.beam.modes.iter().enumerate() {
        let name = format!("mode {} (motor clamped)", k + 1);
        let frequency = mode.natural_frequency_rad_s;
        let known = natural.get(k).copied();
        add(MODES, &name, Some(frequency), "rad/s".to_owned(), known);
        let hertz = |v: f64| v / std::f64::consts::TAU;
        add(
            MODES,
            "  in Hz",
            Some(frequency.scaled(hertz(1.0))),
            "Hz".to_owned(),
            known.map(hertz),
        );
        add(MODES, "  damping ratio", mode.given_damping_ratio(), "–".to_owned(), None);
    }
    rows
}
