//! Friction against speed: plot of the curve without a law and of the friction law, and table of the terms tried.

use lissom::identify::{FrictionLaw, Identified, LawTerm, NORMAL_95, OutputError, ScaleUnit};
use lissom_io::UnitNames;
use lissom_report::{Axis, Cells, LinePlot, Role, Table, Trace, significant};

/// Number of points on the line of the law.
const LINE: i32 = 200;
/// Directions, with their signs and colours.
const DIRECTIONS: [(&str, f64, Role); 2] =
    [("forward", 1.0, Role::Corrected), ("backward", -1.0, Role::Other(0))];

/// Plot of both directions as magnitudes over speed, with the friction law of the result; `None` without a curve.
pub fn plot(names: UnitNames, id: &Identified) -> Option<LinePlot> {
    let law = id.friction_law.as_ref().filter(|law| !law.curve.is_empty())?;
    let mut plot = LinePlot::new(
        "Friction against speed",
        Axis::linear(format!("speed ({}/s)", names.angle())),
        Axis::linear(format!("friction against the motion ({})", names.torque_unit())),
    )
    .subtitle("points: without a friction law; bars: 95 % interval; lines: the friction law");
    let replayed = id.output_error.as_ref().is_some_and(OutputError::stands);
    let found = |speed: f64, sign: f64| {
        if replayed { id.friction.at(speed, sign) } else { law.chosen.friction(speed, sign) }
    };
    for (name, sign, role) in DIRECTIONS {
        let points = || law.curve.iter().filter(move |p| p.direction * sign > 0.0);
        let speeds: Vec<f64> = points().map(|p| p.speed).collect();
        let values = points().map(|p| p.friction.value).collect();
        let bars = points().map(|p| NORMAL_95 * p.friction.std).collect();
        plot = plot.trace(Trace::points_with_bars(name, role, speeds.clone(), values, bars));
        let (Some(from), Some(to)) = (speeds.first(), speeds.last()) else { continue };
        let at = |k: i32| from + (to - from) * f64::from(k) / f64::from(LINE);
        let line: Option<Vec<f64>> = (0..=LINE).map(|k| found(at(k), sign)).collect();
        if let Some(line) = line {
            plot = plot.trace(Trace::line("", role, (0..=LINE).map(at).collect(), line));
        }
    }
    Some(plot)
}

/// Table of all terms that were tried, with the numbers of the tests.
pub fn table(names: UnitNames, law: &FrictionLaw) -> Table {
    let mut table = Table::new(
        "Terms tried in addition to Coulomb friction, one viscous coefficient and an offset",
        &[
            ("term", Cells::Text),
            ("terms before", Cells::Numbers),
            ("amplitude", Cells::Numbers),
            ("standard error", Cells::Numbers),
            ("residual ratio", Cells::Numbers),
            ("gain in left-out slip phases (standard errors)", Cells::Numbers),
            ("residual ratio in left-out stretches", Cells::Numbers),
            ("", Cells::Text),
        ],
    );
    for c in &law.candidates {
        table = table.row([
            term(names, c.term),
            c.beside.to_string(),
            significant(c.amplitude.value, 5),
            significant(c.amplitude.std, 2),
            format!("{:.3}", c.residual_ratio),
            format!("{:.1}", c.paired),
            format!("{:.3}", c.stretch_ratio),
            (if c.taken { "accepted" } else { "" }).to_owned(),
        ]);
    }
    table
}

/// Name of a term with its scale.
fn term(names: UnitNames, term: LawTerm) -> String {
    let (name, angle) = (term.name(), names.angle());
    match term.scale() {
        Some((speed, ScaleUnit::Speed)) => format!("{name}, {} {angle}/s", significant(speed, 4)),
        Some((over, ScaleUnit::Angle)) => format!("{name}, {} {angle}", significant(over, 4)),
        None => name.to_owned(),
    }
}
