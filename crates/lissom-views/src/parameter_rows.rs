//! The parameters of a result, one row for each.

use lissom::identify::{Estimate, Method};
use lissom_io::result::finding_keys::{
    CONSTANT_VELOCITY, COULOMB, COUPLING, GRAVITY, INERTIA, MODES, OFFSET, VISCOUS,
};
use lissom_io::result::{
    ChosenTermEntry, ConstantVelocityEntry, DirectionName, EstimateEntry, FrictionLineEntry,
    LawEntry, LawTermName,
};
use lissom_io::{ResultFile, UnitNames};

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
    /// Its key in `result.json`: what findings affect.
    pub key: &'static str,
    /// The estimate; `None` if it is refused.
    pub estimate: Option<Estimate>,
    /// Its unit.
    pub unit: String,
    /// The value that is known beforehand, in the same unit.
    pub known: Option<f64>,
}

/// Friction by the method of constant velocities, one row for each parameter.
pub fn classical_rows(result: &ResultFile, found: &ConstantVelocityEntry) -> Vec<ParameterRow> {
    let names = result.names();
    let per_command = 1.0 / result.torque_per_command.unwrap_or(1.0);
    let line = |direction| found.lines.iter().find(|line| line.direction == direction);
    let (forward, backward) = (line(DirectionName::Forward), line(DirectionName::Backward));
    let command = || names.command_unit().to_owned();
    let row = |name: &str, estimate, unit: String| ParameterRow {
        name: name.to_owned(),
        key: CONSTANT_VELOCITY,
        estimate,
        unit,
        known: None,
    };
    let coulomb =
        |line: Option<&FrictionLineEntry>| Some(given(line?.coulomb.as_ref())?.scaled(per_command));
    let viscous = |line: Option<&FrictionLineEntry>| Some(line?.viscous.estimate());
    let both = given(found.coulomb.as_ref()).map(|e| e.scaled(per_command));
    vec![
        row("Coulomb friction", both, command()),
        row("  forward", coulomb(forward), command()),
        row("  backward", coulomb(backward), command()),
        row("viscous friction", given(found.viscous.as_ref()), names.viscous_unit()),
        row("  forward", viscous(forward), names.viscous_unit()),
        row("  backward", viscous(backward), names.viscous_unit()),
    ]
}

/// An estimate of a result that may be refused.
pub(crate) fn given(entry: Option<&EstimateEntry>) -> Option<Estimate> {
    entry.map(EstimateEntry::estimate)
}

/// All parameters of the result.
pub fn parameter_rows(
    names: UnitNames,
    result: &ResultFile,
    reference: Option<&Reference>,
) -> Vec<ParameterRow> {
    // An arm.toml is rotary and in SI, so it cannot be compared with parameters per unit of command.
    let reference = reference.filter(|_| names.torque_unit() == "N·m");
    let f = &result.friction;
    let c = &f.coulomb;
    let constant = result.torque_per_command.unwrap_or(1.0);
    let torque = || names.torque_unit().to_owned();
    let mut rows = Vec::new();
    let mut add = |key: &'static str, name: &str, estimate, unit: String, known: Option<f64>| {
        rows.push(ParameterRow { name: name.to_owned(), key, estimate, unit, known });
    };
    let mean = reference.map(|r| 0.5 * (r.coulomb_nm.0 + r.coulomb_nm.1));
    let coulomb = "Coulomb friction";
    let mean_coulomb = given(c.coulomb.as_ref());
    let forward = given(c.forward.as_ref());
    let backward = given(c.backward.as_ref());
    let offset = given(c.offset.as_ref());
    if names.command_unit() == names.torque_unit() {
        add(COULOMB, coulomb, mean_coulomb, torque(), mean);
    } else {
        let unit = names.command_unit().to_owned();
        let in_command = mean_coulomb.map(|e| e.scaled(1.0 / constant));
        add(COULOMB, coulomb, in_command, unit, mean.map(|m| m / constant));
        add(COULOMB, "  as a torque", mean_coulomb, torque(), mean);
    }
    if mean_coulomb.is_none() {
        // One direction only: friction and a constant load are one number.
        for (name, sum) in [("forward", forward), ("backward", backward)] {
            if sum.is_some() {
                add(COULOMB, &format!("  friction plus load, {name}"), sum, torque(), None);
            }
        }
    } else if forward.is_some() {
        let same = offset.is_some_and(|o| o.value.abs() < SAME_BY_DIRECTION * o.std);
        if !same || reference.is_some() {
            add(COULOMB, "  forward", forward, torque(), reference.map(|r| r.coulomb_nm.0));
            add(COULOMB, "  backward", backward, torque(), reference.map(|r| r.coulomb_nm.1));
        }
        let known = reference.map(|r| 0.5 * (r.coulomb_nm.0 - r.coulomb_nm.1));
        add(OFFSET, "  offset, (forward − backward)/2", offset, torque(), known);
    }
    let viscous = reference.map(|r| r.viscous_nm_s_per_rad);
    add(VISCOUS, "viscous friction", given(f.viscous.as_ref()), names.viscous_unit(), viscous);
    for row in f.law.iter().flat_map(|law| law_rows(names, law)) {
        add(row.key, &row.name, row.estimate, row.unit, None);
    }
    let inertia = reference.map(|r| r.inertia_kg_m2);
    let estimate = given(result.drive.inertia.as_ref());
    add(INERTIA, names.inertia_name(), estimate, names.inertia_unit(), inertia);
    if let Some(lag) = lag_s(result) {
        add(
            "arm.command_lag_s",
            "lag of the command",
            Some(lag.scaled(1e3)),
            "ms".to_owned(),
            None,
        );
    }
    if let Some(gravity) = &result.gravity {
        let known = reference.and_then(|r| r.gravity);
        let mgl = known.map(|load| load.amplitude_nm());
        add(GRAVITY, "gravity, m·g·l", Some(gravity.amplitude.estimate()), torque(), mgl);
        let phase = known.map(|load| load.phase_rad().to_degrees());
        let degrees = gravity.phase_rad.estimate().scaled(1.0_f64.to_degrees());
        add(GRAVITY, "  phase φ of m·g·l·sin(θ + φ)", Some(degrees), "deg".to_owned(), phase);
        if let Some(constant) = given(gravity.torque_constant.as_ref()) {
            let unit = names.torque_constant_unit();
            add(GRAVITY, "  torque constant from m·g·l", Some(constant), unit, None);
        }
    }
    rows.extend(beam_rows(names, result, reference));
    rows
}

/// Lag of the command behind the angle \[s\], of the method that the estimates are from.
fn lag_s(result: &ResultFile) -> Option<Estimate> {
    match result.from? {
        Method::OutputError => given(result.methods.output_error.as_ref()?.command_lag_s.as_ref()),
        Method::FrictionLaw => {
            let law = result.methods.friction_law.as_ref()?;
            let is_lag = |t: &&ChosenTermEntry| t.term.term == LawTermName::CommandLag;
            law.chosen.terms.iter().find(is_lag)?.amplitude.first().map(EstimateEntry::estimate)
        }
        _ => None,
    }
}

/// The law of friction with its own values.
fn law_rows(names: UnitNames, law: &LawEntry) -> Vec<ParameterRow> {
    let torque = || names.torque_unit().to_owned();
    let mut rows = Vec::new();
    let mut add = |key: &'static str, name: &str, estimate, unit: String| {
        rows.push(ParameterRow { name: name.to_owned(), key, estimate, unit, known: None });
    };
    add(
        COULOMB,
        "law of friction: Coulomb friction",
        given(law.coulomb.coulomb.as_ref()),
        torque(),
    );
    add(VISCOUS, "  viscous friction", given(law.viscous.as_ref()), names.viscous_unit());
    for (name, one_way) in [
        ("  viscous friction forward", &law.viscous_forward),
        ("  viscous friction backward", &law.viscous_backward),
    ] {
        let Some(one_way) = one_way else { continue };
        add(VISCOUS, name, Some(one_way.estimate()), names.viscous_unit());
    }
    let terms = &law.terms;
    if let Some(near) = &terms.near_rest
        && let Some(amplitude) = given(near.amplitude.as_ref())
    {
        if let Some(at_rest) = given(near.static_friction.as_ref()) {
            add(COULOMB, "  static friction", Some(at_rest), torque());
        }
        let (change, size) = if amplitude.value < 0.0 { ("lower", -1.0) } else { ("higher", 1.0) };
        let name = format!("  near standstill {change} by");
        add(COULOMB, &name, Some(amplitude.scaled(size)), torque());
        let speed = Some(near.speed.estimate());
        add(COULOMB, "    below a speed of about", speed, names.speed_unit());
    }
    if let Some(root) = &terms.root {
        add(COULOMB, "  per square root of speed", Some(root.estimate()), names.root_unit());
    }
    if let Some(with_load) = &terms.with_load {
        let estimate = Some(with_load.estimate());
        add(COULOMB, "  per gravity torque, μ", estimate, "1".to_owned());
    }
    for (name, ripples) in
        [("  friction ripple", &terms.ripples), ("  torque ripple", &terms.torque_ripples)]
    {
        for ripple in ripples {
            let period = Some(ripple.period.estimate());
            add(COULOMB, name, given(ripple.amplitude.as_ref()), torque());
            add(COULOMB, "    period", period, names.angle().to_owned());
        }
    }
    rows
}

/// The beam's parameters: coupling and modes.
fn beam_rows(
    names: UnitNames,
    result: &ResultFile,
    reference: Option<&Reference>,
) -> Vec<ParameterRow> {
    let arm = reference.and_then(|r| r.arm.as_ref());
    let mut rows = Vec::new();
    let mut add = |key: &'static str, name: &str, estimate, unit: String, known: Option<f64>| {
        rows.push(ParameterRow { name: name.to_owned(), key, estimate, unit, known });
    };
    let coupling = given(result.beam.coupling.as_ref());
    if !result.beam.coupling_by_tip.is_empty() || coupling.is_some() {
        let known = arm.map(|a| a.dynamics().coupling_motor);
        add(COUPLING, "coupling to the beam", coupling, names.coupling_unit(), known);
    }
    let natural = arm.map_or(Vec::new(), |a| a.beam().natural_frequencies_rad_s());
    for (k, mode) in result.beam.modes.iter().enumerate() {
        let name = format!("mode {} (motor clamped)", k + 1);
        let frequency = mode.natural_frequency_rad_s.estimate();
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
        let damping = mode.damping_ratio.as_ref().map(EstimateEntry::estimate);
        add(MODES, "  damping ratio", damping, "–".to_owned(), None);
    }
    rows
}
