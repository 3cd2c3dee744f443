//! Friction from constant velocities: plot, and table of the stretches.

use lissom_io::result::{DirectionName, LineShapeName, SteadyPointEntry};
use lissom_io::{ResultFile, UnitNames};
use lissom_report::{Axis, Cells, LinePlot, Role, Table, Trace, TraceStyle, with_uncertainty};

use crate::parameter_rows::given;

/// Plot of command over velocity, both directions as magnitudes, with straight lines extrapolated to zero speed.
pub fn friction_plot(names: UnitNames, result: &ResultFile) -> Option<LinePlot> {
    let found = result.methods.constant_velocity.as_ref()?;
    let constant = result.torque_per_command.unwrap_or(1.0);
    let back_emf = found.back_emf.value;
    let unit = names.command_unit();
    let mut plot = LinePlot::new(
        "Friction from constant velocities",
        Axis::linear(format!("velocity, magnitude ({}/s)", names.angle())),
        Axis::linear(format!("{}, magnitude ({unit})", names.command_name())),
    )
    .subtitle("bars: one standard error");
    let directions = [
        ("forward", DirectionName::Forward, Role::Corrected),
        ("backward", DirectionName::Backward, Role::Other(0)),
    ];
    let (mut lines, mut bent) = (Vec::new(), Vec::new());
    for (name, direction, role) in directions {
        let sign = direction.sign();
        let points = || found.points.iter().filter(move |p| p.direction == direction);
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
        let Some(line) = found.lines.iter().find(|line| line.direction == direction) else {
            continue;
        };
        let Some(coulomb) = given(line.coulomb.as_ref()) else { continue };
        let slope = line.viscous.value + back_emf;
        let at = |v: f64| (coulomb.value + slope * v) / constant;
        let rest = coulomb.scaled(1.0 / constant);
        let label = format!("{name} at rest {} {unit}", with_uncertainty(rest.value, rest.std));
        let through = Trace::line("", role, vec![slowest, fastest], vec![at(slowest), at(fastest)]);
        let to_rest = vec![at(0.0), at(slowest)];
        lines.push(through);
        lines.push(Trace::new(label, role, TraceStyle::Dashes, vec![0.0, slowest], to_rest));
        if let (LineShapeName::Concave | LineShapeName::Convex, Some(slow)) =
            (line.shape, given(line.slowest.as_ref()))
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

/// Friction at constant velocities in one direction, as magnitudes, in the unit of torques.
pub(crate) struct FrictionOfDirection {
    /// The direction.
    pub(crate) direction: DirectionName,
    /// Magnitude of each velocity.
    pub(crate) speed: Vec<f64>,
    /// Torque against the motion at each, without the damping by back-EMF.
    pub(crate) friction: Vec<f64>,
    /// Its standard error.
    pub(crate) std: Vec<f64>,
    /// Ends of the straight line, speed and friction.
    pub(crate) line: Option<[(f64, f64); 2]>,
}

/// Friction at constant velocities in torques, both directions; `None` without this method.
pub(crate) fn in_torque(result: &ResultFile) -> Option<[FrictionOfDirection; 2]> {
    let found = result.methods.constant_velocity.as_ref().filter(|c| !c.points.is_empty())?;
    let constant = result.torque_per_command.unwrap_or(1.0);
    let back_emf = found.back_emf.value;
    let of_direction = |direction: DirectionName| {
        let sign = direction.sign();
        let point = |p: &SteadyPointEntry| {
            let speed = sign * p.velocity.value;
            let command = &p.command;
            let friction = sign * constant * command.value - back_emf * speed;
            Some((speed, (friction, constant.abs() * command.std)))
        };
        let points = found.points.iter().filter(|p| p.direction == direction).filter_map(point);
        let (speed, (friction, std)): (Vec<f64>, (Vec<f64>, Vec<f64>)) = points.unzip();
        let fastest = speed.iter().fold(0.0_f64, |most, v| most.max(*v));
        let line = found.lines.iter().find(|line| line.direction == direction);
        let line = line.and_then(|line| {
            let (coulomb, viscous) = (given(line.coulomb.as_ref())?, &line.viscous);
            let at = |v: f64| (v, viscous.value.mul_add(v, coulomb.value));
            Some([at(0.0), at(fastest)])
        });
        FrictionOfDirection { direction, speed, friction, std, line }
    };
    Some([DirectionName::Forward, DirectionName::Backward].map(of_direction))
}

/// Table of all stretches at a constant velocity.
pub fn stretch_table(names: UnitNames, result: &ResultFile) -> Table {
    let velocity = format!("velocity ({}/s)", names.angle());
    let command = format!("{} ({})", names.command_name(), names.command_unit());
    let columns: [(&str, Cells); 6] = [
        ("run", Cells::Text),
        ("from (s)", Cells::Numbers),
        ("to (s)", Cells::Numbers),
        (&velocity, Cells::Numbers),
        (&command, Cells::Numbers),
        ("standard error", Cells::Numbers),
    ];
    // All are of the one run.
    let first = usize::from(result.runs.len() == 1);
    let mut table = Table::new("Stretches at a constant velocity", &columns[first..]);
    for p in result.methods.constant_velocity.iter().flat_map(|c| &c.points) {
        let cells = [
            p.run.clone(),
            format!("{:.3}", p.start_s),
            format!("{:.3}", p.end_s),
            digits(Some(p.velocity.value)),
            digits(Some(p.command.value)),
            digits(Some(p.command.std)),
        ];
        table = table.row(cells.into_iter().skip(first));
    }
    table
}

fn digits(value: Option<f64>) -> String {
    value.map_or_else(String::new, |value| format!("{value:.5}"))
}
