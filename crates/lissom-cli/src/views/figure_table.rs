//! The list of figures of a result.

use lissom_views::NamedFigure;

use super::printer::line;

/// Runs in a line; the others are counted.
const MOST: usize = 4;

/// Prints the names of the figures, each once, with the runs of those that exist for several runs.
pub(crate) fn figures(all: &[NamedFigure], without_logs: bool) {
    let mut names: Vec<&str> = Vec::new();
    for figure in all {
        if !names.contains(&figure.name.as_str()) {
            names.push(&figure.name);
        }
    }
    for name in names {
        let of_name = all.iter().filter(|figure| figure.name == name);
        let runs: Vec<&str> = of_name.filter_map(|figure| figure.run.as_deref()).collect();
        if runs.is_empty() {
            line(name);
        } else {
            let first = runs.iter().take(MOST).copied().collect::<Vec<_>>().join(", ");
            let more = runs.len().saturating_sub(MOST);
            let more = if more > 0 { format!(" and {more} more") } else { String::new() };
            line(&format!("{name}  (--run {first}{more})"));
        }
    }
    if without_logs {
        line(
            "with logs also: motion, torque, cycle, autocorrelation and cross-correlation of each channel",
        );
    }
}
