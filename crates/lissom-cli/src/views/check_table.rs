//! A check of a log against limits.

use lissom_io::limits::{CheckFile, CheckedParameterEntry, Outcome};
use lissom_text::with_uncertainty;
use lissom_views::digits::trimmed;

use super::printer::{line, table};

/// Significant digits of a limit.
const DIGITS: usize = 5;

/// Prints a check.
pub(crate) fn print(check: &CheckFile) {
    line(&check.log);
    for (name, value) in &check.path {
        line(&format!("{name}: {value}"));
    }
    line("");
    let head = ["parameter", "value", "smallest", "largest", "outcome"].map(str::to_owned);
    let mut rows = vec![head.to_vec()];
    rows.extend(check.parameters.iter().map(row));
    table(&rows);
    line("");
    line(match check.outcome {
        Outcome::Pass => "pass",
        Outcome::Undecided => {
            "undecided: a 95 % interval contains a limit, or an estimate is refused or doubtful"
        }
        Outcome::Fail => "fail",
    });
}

fn row(entry: &CheckedParameterEntry) -> Vec<String> {
    let limit = |value: Option<f64>| value.map_or_else(|| "–".to_owned(), |v| trimmed(v, DIGITS));
    let value = match entry.value.zip(entry.std) {
        Some((value, std)) => with_uncertainty(value, std),
        None => "refused".to_owned(),
    };
    let outcome = match entry.outcome {
        Outcome::Pass => "pass".to_owned(),
        Outcome::Fail => "fail".to_owned(),
        Outcome::Undecided if entry.warnings.is_empty() => "undecided".to_owned(),
        Outcome::Undecided => format!("undecided ({})", entry.warnings.join(", ")),
    };
    vec![entry.parameter.clone(), value, limit(entry.min), limit(entry.max), outcome]
}
