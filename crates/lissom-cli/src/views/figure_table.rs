//! The figures of a result.

use lissom::identify::{ConstantVelocity, Estimate, Identified, Method};
use lissom_io::UnitNames;
use lissom_report::{interval, significant, with_uncertainty};

use super::printer::{counted, line, table};
use crate::tasks::known_arm::Reference;

/// Significant digits of figures known beforehand.
pub(crate) const KNOWN_DIGITS: usize = 6;

/// The figures, each with its 95 % interval and what was known beforehand.
pub(crate) fn figures(names: UnitNames, id: &Identified, reference: Option<&Reference>) {
    let mut heading = vec!["figure", "value", "unit", "95 % interval"];
    heading.extend(reference.map(|r| r.label));
    let mut rows = vec![heading.into_iter().map(str::to_owned).collect::<Vec<_>>()];
    rows.extend(figure_rows(names, id, reference).into_iter().map(|row| {
        let (value, within) = match row.figure {
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
}

/// The line of Coulomb and viscous friction, beside figures that are of another law.
pub(crate) fn line_of_least_squares(names: UnitNames, id: &Identified) {
    let f = &id.friction;
    let plain = f.near_rest.is_none() && f.viscous_by_direction.is_none();
    let plain = plain && id.method != Some(Method::FrictionLaw);
    let Some(fit) = id.least_squares.as_ref().filter(|_| !plain) else { return };
    let (friction, [slowest, fastest]) = (&fit.estimates.friction, fit.speed_range);
    let mut rows = vec![["the line", "value", "unit", "95 % interval"].map(str::to_owned)];
    let mut add = |name: &str, figure: Option<Estimate>, unit: String| {
        let Some(e) = figure else { return };
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
        "least squares of one straight line over speeds from {} to {} {}/s, residual torque {:.2} %",
        significant(slowest, 3),
        significant(fastest, 3),
        names.angle(),
        100.0 * fit.relative_residual
    ));
}

/// The speeds that friction's law and its curve are of, where the figures are of such a law.
pub(crate) fn speeds_of_law(names: UnitNames, id: &Identified) {
    let Some(law) = id.friction_law.as_ref().filter(|law| law.chosen.departs()) else { return };
    let unit = format!("{}/s", names.angle());
    let range = |[slowest, fastest]: [f64; 2]| {
        format!("{} to {} {unit}", significant(slowest, 3), significant(fastest, 3))
    };
    line("");
    line(&format!("friction's law is of speeds from {}", range(law.speed_range)));
    let speeds = || law.curve.iter().map(|p| p.speed);
    if let Some(slowest) = speeds().min_by(f64::total_cmp) {
        let fastest = speeds().fold(slowest, f64::max);
        line(&format!("its curve without a law, in the report, {}", range([slowest, fastest])));
    }
}

/// What steady velocities give, beside the figures taken.
pub(crate) fn constant_velocity(names: UnitNames, id: &Identified) {
    let Some(found) = &id.constant_velocity else { return };
    let mut rows = vec![["constant velocity", "value", "unit", "95 % interval"].map(str::to_owned)];
    rows.extend(classical_rows(names, id, found).into_iter().map(|row| match row.figure {
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
        "by lines through {} forward and {} backward",
        counted(number(1.0), "point"),
        counted(number(-1.0), "point")
    ));
}

/// The figures of steady velocities.
pub(crate) fn classical_rows(
    names: UnitNames,
    id: &Identified,
    found: &ConstantVelocity,
) -> Vec<FigureRow> {
    let constant = id.torque_per_command.unwrap_or(1.0);
    let (forward, backward) = (found.forward.as_ref().ok(), found.backward.as_ref().ok());
    let in_command = |e: Option<Estimate>| e.map(|e| e.scaled(1.0 / constant));
    let command = || names.command_unit().to_owned();
    let row = |name: &str, figure, unit: String| FigureRow {
        name: name.to_owned(),
        figure,
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

/// A figure for people.
pub(crate) struct FigureRow {
    /// Its name; indented where it belongs to the one above.
    pub(crate) name: String,
    /// The figure; `None` where it is refused.
    pub(crate) figure: Option<Estimate>,
    /// Its unit.
    pub(crate) unit: String,
    /// What was known beforehand, in the same unit.
    pub(crate) known: Option<f64>,
}

/// Every figure that the result has.
pub(crate) fn figure_rows(
    names: UnitNames,
    id: &Identified,
    reference: Option<&Reference>,
) -> Vec<FigureRow> {
    // An arm.toml is in SI and rotary: it says nothing of figures per unit of command.
    let reference = reference.filter(|_| names.torque_unit() == "N·m");
    let arm = reference.and_then(|r| r.arm.as_ref());
    let f = &id.friction;
    let constant = id.torque_per_command.unwrap_or(1.0);
    let torque = || names.torque_unit().to_owned();
    let mut rows = Vec::new();
    let mut add = |name: &str, figure, unit: String, known: Option<f64>| {
        rows.push(FigureRow { name: name.to_owned(), figure, unit, known });
    };
    let mean = reference.map(|r| 0.5 * (r.coulomb_nm.0 + r.coulomb_nm.1));
    if names.torque_known {
        let in_command = f.coulomb.map(|e| e.scaled(1.0 / constant));
        let unit = names.command_unit().to_owned();
        add("Coulomb friction", in_command, unit, mean.map(|m| m / constant));
    }
    add("Coulomb friction", f.coulomb, torque(), mean);
    if f.coulomb.is_none() {
        // One direction alone: its friction with the load that acts on it.
        for (name, sum) in [("forward", f.forward), ("backward", f.backward)] {
            if sum.is_some() {
                add(&format!("  friction plus load, {name}"), sum, torque(), None);
            }
        }
    } else if f.forward.is_some() {
        add("  forward", f.forward, torque(), reference.map(|r| r.coulomb_nm.0));
        add("  backward", f.backward, torque(), reference.map(|r| r.coulomb_nm.1));
        let offset = reference.map(|r| 0.5 * (r.coulomb_nm.0 - r.coulomb_nm.1));
        add("  offset", f.offset, torque(), offset);
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
        let (way, size) = if near.torque.value < 0.0 { ("below", -1.0) } else { ("above", 1.0) };
        let name = format!("  at rest {way} Coulomb friction by");
        add(&name, Some(near.torque.scaled(size)), torque(), None);
        add("  falls off over a speed of", Some(near.speed), format!("{}/s", names.angle()), None);
    }
    if f.with_load.is_some() {
        add("friction per load of gravity, μ", f.with_load, "1".to_owned(), None);
    }
    for ripple in &f.ripples {
        add("friction's ripple", Some(ripple.torque), torque(), None);
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
            add("  torque constant by m·g·l", Some(constant), unit, None);
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
        add("", Some(frequency.scaled(hertz(1.0))), "Hz".to_owned(), known.map(hertz));
        add("  damping ratio", mode.given_damping_ratio(), "1".to_owned(), None);
    }
    rows
}
