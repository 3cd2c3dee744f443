//! The parameters of a result.

use lissom_io::result::DirectionName;
use lissom_io::{ResultFile, UnitNames};
use lissom_report::{interval, significant, with_uncertainty};
use lissom_views::digits::counted;
use lissom_views::known_arm::Reference;
use lissom_views::parameter_rows::{KNOWN_DIGITS, classical_rows, parameter_rows};

use super::printer::{line, table};

/// Prints the parameters, each with its 95 % interval and the value that is known beforehand.
pub(crate) fn parameters(names: UnitNames, result: &ResultFile, reference: Option<&Reference>) {
    if let Some(method) = result.from {
        line(&format!("estimates by {}", method.words()));
    }
    let mut heading = vec!["parameter", "value", "unit", "95 % interval"];
    heading.extend(reference.map(|r| r.label));
    let mut rows = vec![heading.into_iter().map(str::to_owned).collect::<Vec<_>>()];
    rows.extend(parameter_rows(names, result, reference).into_iter().map(|row| {
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
    if names.command_unit() != names.torque_unit() {
        let per_command = names.torque_unit();
        line(&format!(
            "Values with {per_command} or {} contain any error of the torque constant; the standard errors do not.",
            if per_command == "N" { "kg" } else { "kg·m²" }
        ));
    }
}

/// Prints friction by the method of constant velocities.
pub(crate) fn constant_velocity(result: &ResultFile) {
    let Some(found) = &result.methods.constant_velocity else { return };
    let mut rows = vec![["constant velocity", "value", "unit", "95 % interval"].map(str::to_owned)];
    rows.extend(classical_rows(result, found).into_iter().map(|row| match row.estimate {
        Some(e) => {
            let within = interval(e.ci95(), e.value, e.std);
            [row.name, with_uncertainty(e.value, e.std), row.unit, within]
        }
        None => [row.name, "refused".to_owned(), row.unit, "see findings".to_owned()],
    }));
    line("");
    table(&rows.into_iter().map(Vec::from).collect::<Vec<_>>());
    let number = |direction| found.points.iter().filter(|p| p.direction == direction).count();
    line(&format!(
        "from straight lines of friction against speed, through {} forward and {} backward",
        counted(number(DirectionName::Forward), "point"),
        counted(number(DirectionName::Backward), "point")
    ));
}
