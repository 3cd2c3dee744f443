//! Friction against speed: plot of the curve without a law and of the friction law, and table of the terms tried.

use lissom::identify::NORMAL_95;
use lissom_io::result::{CurvePointEntry, DirectionName, FrictionLawEntry, LawTermEntry};
use lissom_io::{ResultFile, UnitNames};
use lissom_report::{Axis, Cells, LinePlot, Role, Table, Trace, TraceStyle, significant};

use crate::parameter_rows::given;
use crate::velocity_friction::{self, FrictionOfDirection};

/// Number of points on the line of the law.
const LINE: i32 = 200;
/// Directions with their colours.
const DIRECTIONS: [(&str, DirectionName, Role); 2] = [
    ("forward", DirectionName::Forward, Role::Corrected),
    ("backward", DirectionName::Backward, Role::Other(0)),
];

/// Plot of both directions as magnitudes over speed, with the friction law of the result, and the points and straight lines of
/// constant velocities; `None` without a curve.
pub fn plot(names: UnitNames, result: &ResultFile) -> Option<LinePlot> {
    let curve = &result.friction.curve;
    if curve.is_empty() {
        return None;
    }
    let mut plot = LinePlot::new(
        "Friction against speed",
        Axis::linear(format!("speed ({}/s)", names.angle())),
        Axis::linear(format!("friction against the motion ({})", names.torque_unit())),
    )
    .subtitle("points: without a friction law; bars: 95 % interval; solid lines: the friction law");
    let found = |speed: f64, direction| result.friction.at(speed, direction);
    let point = |p: &CurvePointEntry| Some((p.speed.value, given(p.friction.as_ref())?));
    for (name, direction, role) in DIRECTIONS {
        let of_direction = curve.iter().filter(|p| p.direction == direction);
        let points: Vec<_> = of_direction.filter_map(point).collect();
        let speeds: Vec<f64> = points.iter().map(|(speed, _)| *speed).collect();
        let values = points.iter().map(|(_, friction)| friction.value).collect();
        let bars = points.iter().map(|(_, friction)| NORMAL_95 * friction.std).collect();
        plot = plot.trace(Trace::points_with_bars(name, role, speeds.clone(), values, bars));
        let (Some(from), Some(to)) = (speeds.first(), speeds.last()) else { continue };
        let at = |k: i32| from + (to - from) * f64::from(k) / f64::from(LINE);
        let line: Option<Vec<f64>> = (0..=LINE).map(|k| found(at(k), direction)).collect();
        if let Some(line) = line {
            plot = plot.trace(Trace::line("", role, (0..=LINE).map(at).collect(), line));
        }
    }
    Some(match velocity_friction::in_torque(result) {
        Some(directions) => directions.into_iter().fold(plot, constant_velocities),
        None => plot,
    })
}

/// Adds the points of constant velocities in one direction, and the straight line through them.
fn constant_velocities(plot: LinePlot, found: FrictionOfDirection) -> LinePlot {
    let (name, role) = match found.direction {
        DirectionName::Forward => ("forward, constant velocity", Role::Other(1)),
        DirectionName::Backward => ("backward, constant velocity", Role::Other(2)),
    };
    let plot = plot.trace(Trace::points_with_bars(
        name,
        role,
        found.speed,
        found.friction,
        found.std.into_iter().map(|std| NORMAL_95 * std).collect(),
    ));
    let Some([from, to]) = found.line else { return plot };
    let line = Trace::new("", role, TraceStyle::Dashes, vec![from.0, to.0], vec![from.1, to.1]);
    plot.trace(line)
}

/// Table of all terms that were tried, with the numbers of the tests.
pub fn table(law: &FrictionLawEntry) -> Table {
    let mut table = Table::new(
        "Terms tried in addition to Coulomb friction, one viscous coefficient and an offset",
        &[
            ("term", Cells::Text),
            ("terms before", Cells::Numbers),
            ("amplitude", Cells::Numbers),
            ("standard error", Cells::Numbers),
            ("saved in left-out blocks (%)", Cells::Numbers),
            ("standard errors", Cells::Numbers),
            ("better for left-out kinds of motion", Cells::Text),
            ("", Cells::Text),
        ],
    );
    for c in &law.candidates {
        table = table.row([
            term(&c.term),
            c.beside_terms.to_string(),
            significant(c.amplitude.value, 5),
            significant(c.amplitude.std, 2),
            format!("{:.2}", 100.0 * c.saved),
            c.standard_errors.map_or_else(String::new, |t| format!("{t:.1}")),
            (if c.across_kinds { "yes" } else { "no" }).to_owned(),
            (if c.taken { "adopted" } else { "" }).to_owned(),
        ]);
    }
    table
}

/// Name of a term with its scale.
fn term(term: &LawTermEntry) -> String {
    let name = term.term.name();
    let scale = term.speed.as_ref().or(term.period.as_ref());
    scale.map_or_else(
        || name.to_owned(),
        |scale| format!("{name}, {} {}", significant(scale.value, 4), scale.unit),
    )
}
