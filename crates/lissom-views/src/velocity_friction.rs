//! Friction from constant velocities: plot, and table of the stretches.

use lissom::identify::{Identified, LineShape};
use lissom::record::Channels;
use lissom_io::UnitNames;
use lissom_report::{Axis, Cells, LinePlot, Role, Table, Trace, TraceStyle, with_uncertainty};

/// Plot of command over velocity, both directions as magnitudes, with straight lines extrapolated to zero speed.
pub fn friction_plot(channels: &Channels, names: UnitNames, id: &Identified) -> Option<LinePlot> {
    let found = id.constant_velocity.as_ref()?;
    let constant = id.torque_per_command.unwrap_or(1.0);
    let unit = names.command_unit();
    let mut plot = LinePlot::new(
        "Friction from constant velocities",
        Axis::linear(format!("velocity, magnitude ({}/s)", names.angle())),
        Axis::linear(format!("{}, magnitude ({unit})", names.command_name())),
    )
    .subtitle("bars: one standard error");
    let directions = [
        ("forward", 1.0, Role::Corrected, &found.forward),
        ("backward", -1.0, Role::Other(0), &found.backward),
    ];
    let (mut lines, mut bent) = (Vec::new(), Vec::new());
    for (name, sign, role, line) in directions {
        let points = || found.points.iter().filter(move |p| p.velocity.value * sign > 0.0);
        let speeds: Vec<f64> = points().map(|p| sign * p.velocity.value).collect();
        let (slowest, fastest) =
            speeds.iter().fold((f64::INFINITY, 0.0_f64), |(l, h), v| (l.min(*v), h.max(*v)));
        plot = plot.trace(Trace::points_with_bars(
            name,
            role,
            speeds,
            points().map(|p| sign * p.command.value).collect(),
            points().map(|p| p.command.std).collect(),
        ));
        let Ok(line) = line else { continue };
        let slope = line.viscous.value + channels.command.back_emf_viscous;
        let at = |v: f64| (line.coulomb.value + slope * v) / constant;
        let rest = line.coulomb.scaled(1.0 / constant);
        let label = format!("{name} at rest {} {unit}", with_uncertainty(rest.value, rest.std));
        let through = Trace::line("", role, vec![slowest, fastest], vec![at(slowest), at(fastest)]);
        let to_rest = vec![at(0.0), at(slowest)];
        lines.push(through);
        lines.push(Trace::new(label, role, TraceStyle::Dashes, vec![0.0, slowest], to_rest));
        if let (LineShape::Concave { .. } | LineShape::Convex { .. }, Some(slow)) =
            (line.shape, line.slowest)
        {
            bent.push(slow.scaled(1.0 / constant));
        }
    }
    plot.traces.extend(lines);
    if !bent.is_empty() {
        plot = plot.trace(Trace::points_with_bars(
            "at rest, from the slowest third",
            Role::Fitted,
            vec![0.0; bent.len()],
            bent.iter().map(|e| e.value).collect(),
            bent.iter().map(|e| e.std).collect(),
        ));
    }
    (!found.points.is_empty()).then_some(plot)
}

/// Table of all stretches at a constant velocity.
pub fn stretch_table(names: UnitNames, id: &Identified) -> Table {
    let velocity = format!("velocity ({}/s)", names.angle());
    let command = format!("{} ({})", names.command_name(), names.command_unit());
    let mut table = Table::new(
        "Stretches at a constant velocity",
        &[
            ("run", Cells::Text),
            ("from (s)", Cells::Numbers),
            ("to (s)", Cells::Numbers),
            (&velocity, Cells::Numbers),
            (&command, Cells::Numbers),
            ("standard error", Cells::Numbers),
        ],
    );
    for p in id.constant_velocity.iter().flat_map(|c| &c.points) {
        table = table.row([
            id.runs[p.run].name.clone(),
            format!("{:.3}", p.start_s),
            format!("{:.3}", p.end_s),
            format!("{:.5}", p.velocity.value),
            format!("{:.5}", p.command.value),
            format!("{:.5}", p.command.std),
        ]);
    }
    table
}
