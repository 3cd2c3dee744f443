//! Parameters as a text table.

use std::fmt;

use lissom_io::ParameterList;
use lissom_text::{interval, table_lines, with_uncertainty};

/// Writes name, value with standard error, unit and 95 % interval of each parameter, a line each.
pub(crate) fn table(f: &mut fmt::Formatter<'_>, list: &ParameterList) -> fmt::Result {
    let heading = ["parameter", "value", "unit", "95 % interval"];
    let mut rows = vec![heading.map(str::to_owned).to_vec()];
    rows.extend(list.parameters.iter().map(|parameter| {
        let (value, within) = match &parameter.estimate {
            Some(e) => (with_uncertainty(e.value, e.std), interval(e.ci95, e.value, e.std)),
            None => ("refused".to_owned(), "see the findings".to_owned()),
        };
        vec![parameter.name.clone(), value, parameter.unit.clone(), within]
    }));
    f.write_str(&table_lines(&rows).join("\n"))
}
