//! The list of thresholds.

use lissom::{Threshold, ThresholdValue};
use lissom_views::digits::trimmed;

use super::printer::{line, wrapped};

/// Significant digits of values.
const DIGITS: usize = 7;
/// Width of the lines.
const WIDTH: usize = 96;
/// Indent of the reasons.
const INDENT: &str = "      ";

/// Prints every threshold with its value, unit and origin, and its reason below, grouped by method.
pub(crate) fn thresholds() {
    let all: Vec<&Threshold> = lissom::thresholds().collect();
    for (place, of_method) in all.chunk_by(|a, b| a.method == b.method).enumerate() {
        if place > 0 {
            line("");
        }
        line(of_method[0].method);
        let width = of_method.iter().map(|t| t.name.len()).max().unwrap_or(0);
        for t in of_method {
            let unit = if t.unit == "1" { String::new() } else { format!(" {}", t.unit) };
            line(&format!("  {:width$}  {}{unit}, {}", t.name, value(t.value), t.basis.name()));
            for part in wrapped(t.reason, WIDTH - INDENT.len()) {
                line(&format!("{INDENT}{part}"));
            }
        }
    }
}

fn value(value: ThresholdValue) -> String {
    let number = |x: &f64| trimmed(*x, DIGITS);
    match value {
        ThresholdValue::Count(count) => count.to_string(),
        ThresholdValue::Numbers(values) => values.iter().map(number).collect::<Vec<_>>().join(", "),
        ThresholdValue::Number(x) => number(&x),
    }
}
