//! The parameters of a result.

use lissom::identify::{ConstantVelocity, Estimate, Identified, Method};
use lissom_io::UnitNames;
use lissom_report::{interval, significant, with_uncertainty};

use super::printer::{counted, line, table};
use crate::tasks::known_arm::Reference;

/// Significant digits of parameters that are known beforehand.
pub(crate) const KNOWN_DIGITS: usize = 6;

/// Prints the parameters, each with its 95 % interval and the value that is known beforehand.
pub(crate) fn parameters(names: UnitNames, id: &Identified, reference: Option<&Reference>) {
    if let Some(method) = id.method {
        line(&format!("estimates by {}", method.words()));
    }
    let mut heading = vec!["parameter", "value", "unit", "95 % interval"];
    heading.extend(reference.map(|r| r.label));
    let mut rows = vec![heading.into_iter().map(str::to_owned).collect::<Vec<_>>()];
    rows.extend(parameter_rows(names, id, reference).into_iter().map(|row| {
        let (value, within) = match row.estimate {
            Some(e) => {
                let shown = interval(e.ci95(), e.value, e.std);
                (with_uncertainty(e.value, e.std), shown)
            }
            None => ("refused".to_owned(), "see findings".to_owned()),
        };
        let known = row.known.map(|k| significant(k, KNOWN_DIGITS));
        [row.name, value, row.unit, within].into_iter().chain(known).collect()
    }));
    table(&rows);
    if names.torque_known {
        let per_command = names.torque_unit();
        line(&format!(
            "Values with {per_command} or {} contain any error of the torque constant; the standard errors do not.",
            if per_command == "N" { "kg" } else { "kg·m²" }
        ));
    }
}

/// An offset within this many of its standard errors is zero: both directions then have the same friction.
const SAME_BY_DIRECTION: f64 = 2.0;

/// Prints ordinary least squares with Coulomb and viscous friction, if the result has another friction law.
pub(crate) fn line_of_least_squares(names: UnitNames, id: &Identified) {
    let f = &id.friction;
    let plain = f.near_rest.is_none() && f.viscous_by_direction.is_none();
    let plain = plain && id.method != Some(Method::FrictionLaw);
    let Some(fit) = id.least_squares.as_ref().filter(|_| !plain) else { return };
    let (friction, [slowest, fastest]) = (&fit.estimates.friction, fit.speed_range);
    let mut rows = vec![["least squares", "value", "unit", "95 % interval"].map(str::to_owned)];
    let mut add = |name: &str, estimate: Option<Estimate>, unit: String| {
        let Some(e) = estimate else { return };
        let within = interval(e.ci95(), e.value, e.std);
        rows.push([name.to_owned(), with_uncertainty(e.value, e.std), unit, within]);
    };
    add("Coulomb friction", friction.coulomb, names.torque_unit().to_owned());
    add("offset", friction.offset, names.torque_unit().to_owned());
    add("viscous friction", friction.viscous, names.viscous_unit());
    add(names.inertia_name(), fit.estimates.inertia, names.inertia_unit());
    let gravity = fit.estimates.gravity.map(|g| g.amplitude());
    add("gravity, m·g·l", gravity, names.torque_unit().to_owned());
    line("");
    table(&rows.into_iter().map(Vec::from).collect::<Vec<_>>());
    line(&format!(
        "least squares of all motion with Coulomb friction and one viscous coefficient, at speeds from {} to {} {}/s; \
         residual torque {:.2} %",
        significant(slowest, 3),
        significant(fastest, 3),
        names.angle(),
        100.0 * fit.relative_residual
    ));
}

/// Prints the speeds for which the friction law and the friction curve hold, if the result has such a law.
pub(crate) fn speeds_of_law(names: UnitNames, id: &Identified) {
    let Some(law) = id.friction_law.as_ref().filter(|law| law.chosen.departs()) else { return };
    let unit = format!("{}/s", names.angle());
    let range = |[slowest, fastest]: [f64; 2]| {
        format!("{} to {} {unit}", significant(slowest, 3), significant(fastest, 3))
    };
    line("");
    line(&format!(
        "speeds in the logs, for which the friction law was fitted: {}",
        range(law.speed_range)
    ));
    let speeds = || law.curve.iter().map(|p| p.speed);
    if let Some(slowest) = speeds().min_by(f64::total_cmp) {
        let fastest = speeds().fold(slowest, f64::max);
        line(&format!(
            "the curve of friction against speed (on the report page) is measured from {}",
            range([slowest, fastest])
        ));
    }
}

/// Prints friction by the method of constant velocities.
pub(crate) fn constant_velocity(names: UnitNames, id: &Identified) {
    let Some(found) = &id.constant_velocity else { return };
    let mut rows = vec![["constant velocity", "value", "unit", "95 % interval"].map(str::to_owned)];
    rows.extend(classical_rows(names, id, found).into_iter().map(|row| match row.estimate {
        Some(e) => {
            let within = interval(e.ci95(), e.value, e.std);
            [row.name, with_uncertainty(e.value, e.std), row.unit, within]
        }
        None => [row.name, "refused".to_owned(), row.unit, "see findings".to_owned()],
    }));
    line("");
    table(&rows.into_iter().map(Vec::from).collect::<Vec<_>>());
    let number = |sign: f64| found.points.iter().filter(|p| p.velocity.value * sign > 0.0).count();
    line(&format!(
        "from straight lines of friction against speed, through {} forward and {} backward",
        counted(number(1.0), "point"),
        counted(number(-1.0), "point")
    ));
}

/// Friction by the method of constant velocities, one row for each parameter.
pub(crate) fn classical_rows(
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

/// A row of a table of parameters.
pub(crate) struct ParameterRow {
    /// Name of the parameter; indented if it belongs to the row above.
    pub(crate) name: String,
    /// The estimate; `None` if it is refused.
    pub(crate) estimate: Option<Estimate>,
    /// Its unit.
    pub(crate) unit: String,
    /// The value that is known beforehand, in the same unit.
    pub(crate) known: Option<f64>,
}

/// All parameters of the result.
pub(crate) fn parameter_rows(
    names: UnitNames,
    id: &Identified,
    reference: Option<&Reference>,
) -> Vec<ParameterRow> {
    // An arm.toml is rotary and in SI, so it cannot be compared with parameters per unit of command.
    let reference = reference.filter(|_| names.torque_unit() == "N·m");
    let arm = reference.and_then(|r| r.arm.as_ref());
    let f = &id.friction;
    let constant = id.torque_per_command.unwrap_or(1.0);
    let torque = || names.torque_unit().to_owned();
    let mut rows = Vec::new();
    let mut add = |name: &str, estimate, unit: String, known: Option<f64>| {
        rows.push(ParameterRow { name: name.to_owned(), estimate, unit, known });
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
        add(coulomb, in_command, unit, mean.map(|m| m / constant));
        add("  as a torque", f.coulomb, torque(), mean);
    } else {
        add(coulomb, f.coulomb, torque(), mean);
    }
    if f.coulomb.is_none() {
        // One direction only: friction and a constant load are one number.
        for (name, sum) in [("forward", f.forward), ("backward", f.backward)] {
            if sum.is_some() {
                add(&format!("  friction plus load, {name}"), sum, torque(), None);
            }
        }
    } else if f.forward.is_some() {
        let same = f.offset.is_some_and(|o| o.value.abs() < SAME_BY_DIRECTION * o.std);
        if !same || reference.is_some() {
            add("  forward", f.forward, torque(), reference.map(|r| r.coulomb_nm.0));
            add("  backward", f.backward, torque(), reference.map(|r| r.coulomb_nm.1));
        }
        let offset = reference.map(|r| 0.5 * (r.coulomb_nm.0 - r.coulomb_nm.1));
        add("  offset, (forward − backward)/2", f.offset, torque(), offset);
    }
    let viscous = reference.map(|r| r.viscous_nm_s_per_rad);
    add("viscous friction", f.viscous, names.viscous_unit(), viscous);
    if let Some((forward, backward)) = f.viscous_by_direction {
        add("  forward", Some(forward), names.viscous_unit(), None);
        add("  backward", Some(backward), names.viscous_unit(), None);
    }
    if let Some(near) = f.near_rest {
        if let Some(at_rest) = near.static_friction() {
            add("static friction", Some(at_rest), torque(), None);
        }
        let (change, size) =
            if near.torque.value < 0.0 { ("lower", -1.0) } else { ("higher", 1.0) };
        let name = format!("friction near standstill {change} by");
        add(&name, Some(near.torque.scaled(size)), torque(), None);
        add("  below a speed of about", Some(near.speed), format!("{}/s", names.angle()), None);
    }
    if f.with_load.is_some() {
        add("friction per gravity torque, μ", f.with_load, "1".to_owned(), None);
    }
    for ripple in &f.ripples {
        add("friction ripple", Some(ripple.torque), torque(), None);
        add("  period", Some(ripple.period()), names.angle().to_owned(), None);
    }
    let inertia = reference.map(|r| r.inertia_kg_m2);
    add(names.inertia_name(), id.inertia, names.inertia_unit(), inertia);
    if let Some(gravity) = &id.gravity {
        let known = reference.and_then(|r| r.gravity);
        let mgl = known.map(|load| load.amplitude_nm());
        add("gravity, m·g·l", Some(gravity.amplitude()), torque(), mgl);
        let phase = known.map(|load| load.phase_rad().to_degrees());
        let degrees = gravity.phase_rad().scaled(1.0_f64.to_degrees());
        add("  phase φ of m·g·l·sin(θ + φ)", Some(degrees), "deg".to_owned(), phase);
        if let Some(constant) = id.torque_constant {
            let unit = format!("N·m/{}", names.command_unit());
            add("  torque constant from m·g·l", Some(constant), unit, None);
        }
    }
    if !id.beam.coupling_by_tip.is_empty() || id.beam.coupling.is_some() {
        let known = arm.map(|a| a.dynamics().coupling_motor);
        add("coupling to the beam", id.beam.coupling, names.coupling_unit(), known);
    }
    let natural = arm.map_or(Vec::new(), |a| a.beam().natural_frequencies_rad_s());
    for (k, mode) in id.beam.modes.iter().enumerate() {
        let name = format!("mode {} (motor clamped)", k + 1);
        let frequency = mode.natural_frequency_rad_s;
        let known = natural.get(k).copied();
        add(&name, Some(frequency), "rad/s".to_owned(), known);
        let hertz = |v: f64| v / std::f64::consts::TAU;
        add("  in Hz", Some(frequency.scaled(hertz(1.0))), "Hz".to_owned(), known.map(hertz));
        add("  damping ratio", mode.given_damping_ratio(), "–".to_owned(), None);
    }
    rows
}
