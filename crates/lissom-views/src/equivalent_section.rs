//! Section of the report page about the equivalent arm, and the equations of this arm as rows.

use lissom_io::UnitNames;
use lissom_io::result::{EquivalentEntry, StrainlessEntry};
use lissom_report::{Cells, Page, Table};

use crate::digits::{counted, shown};

/// Digits of numbers without a standard error.
const DIGITS: usize = 7;

/// Adds the equivalent arm to the page. `intervals` is a sentence about how to get the 95 % intervals.
pub(crate) fn section(
    page: Page,
    names: UnitNames,
    found: Option<&EquivalentEntry>,
    intervals: Option<&str>,
) -> Page {
    let Some((found, form)) = found.and_then(|e| Some((e, e.strainless.as_ref()?))) else {
        return page;
    };
    let rows = rows_for_use(names, found, form);
    let columns: Vec<(&str, Cells)> = rows[0]
        .iter()
        .enumerate()
        .map(|(i, title)| match i {
            0 => ("", Cells::Text),
            _ => (title.as_str(), Cells::Numbers),
        })
        .collect();
    let caption = "Each row is an equation: the sum over its columns, with angles in rad";
    let table = rows[1..].iter().fold(Table::new(caption, &columns), |t, row| t.row(row.clone()));
    let mut words = format!(
        "{} from the responses per motor angle. The gains are adjusted such that turning the whole arm bends \
         nothing.",
        counted(found.modes.len(), "mode")
    );
    if let Some(intervals) = intervals {
        words.push(' ');
        words.push_str(intervals);
    }
    page.heading("Equivalent arm").paragraph(&words).table(&table)
}

/// The equations for use, in which turning the whole arm bends nothing: a heading, then a row for each equation.
pub fn rows_for_use(
    names: UnitNames,
    found: &EquivalentEntry,
    form: &StrainlessEntry,
) -> Vec<Vec<String>> {
    let number = |x: f64| shown(x, DIGITS).replace('-', "−");
    let mut rows = vec![heading(&found.points, "for use (turning the whole arm bends nothing)")];
    for (point, (a, b)) in found.points.iter().zip(form.a_per_s2.iter().zip(&form.b_per_s2)) {
        let mut row = vec![equation(point)];
        row.extend(a.iter().chain([b]).map(|x| number(*x)));
        rows.push(row);
    }
    if let (Some(h), Some(h_motor)) = (&form.h, &form.h_motor) {
        let h = h.value.iter().chain([&h_motor.value]).map(|x| number(*x));
        rows.push(std::iter::once(torque_name(names)).chain(h).collect());
    }
    rows
}

/// Heading of a table with one row for each equation and one column for each variable.
pub fn heading(points: &[String], title: &str) -> Vec<String> {
    let points = points.iter().map(|point| format!("·θ({point})"));
    std::iter::once(title.to_owned()).chain(points).chain(["·θ_m".to_owned()]).collect()
}

/// Left side of the equation of a point.
pub fn equation(point: &str) -> String {
    format!("θ̈({point}) [1/s²] =")
}

/// Left side of the equation of the torque on the motor.
pub fn torque_name(names: UnitNames) -> String {
    format!("torque [{}] =", names.coupling_unit())
}
