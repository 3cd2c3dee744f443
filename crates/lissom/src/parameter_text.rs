//! Parameters as a text table.

use std::fmt::{self, Write as _};

use lissom_io::ParameterList;
use lissom_text::{interval, with_uncertainty};

/// Between two columns.
const GAP: usize = 2;

/// Writes name, value with standard error, unit and 95 % interval of each parameter, a line each.
pub(crate) fn table(f: &mut fmt::Formatter<'_>, list: &ParameterList) -> fmt::Result {
    let mut rows = vec![["parameter", "value", "unit", "95 % interval"].map(str::to_owned)];
    rows.extend(list.parameters.iter().map(|parameter| {
        let (value, within) = match &parameter.estimate {
            Some(e) => (with_uncertainty(e.value, e.std), interval(e.ci95, e.value, e.std)),
            None => ("refused".to_owned(), "see the findings".to_owned()),
        };
        [parameter.name.clone(), value, parameter.unit.clone(), within]
    }));
    let mut widths = [0; 4];
    for row in &rows {
        for (width, cell) in widths.iter_mut().zip(row) {
            *width = (*width).max(cell.chars().count() + GAP);
        }
    }
    for (k, row) in rows.iter().enumerate() {
        let mut text = String::new();
        for (cell, width) in row.iter().zip(widths) {
            write!(text, "{cell:width$}")?;
        }
        let end = if k + 1 < rows.len() { "\n" } else { "" };
        write!(f, "{}{end}", text.trim_end())?;
    }
    Ok(())
}
