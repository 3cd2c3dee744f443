//! The summary of a fleet.

use lissom_fleet::FleetSummary;
use lissom_report::Table;
use lissom_views::fleet_page;

use super::printer::{line, table};

/// Prints a summary.
pub(crate) fn print(summary: &FleetSummary) {
    line(&fleet_page::in_words(summary));
    for sentence in fleet_page::conspicuous(summary) {
        line(&sentence);
    }
    section(&fleet_page::parameter_table(summary));
    for (parameter, keys) in fleet_page::alike(summary) {
        let parts = [
            (!parameter.drifts.is_empty()).then(|| fleet_page::drift_table(&parameter.drifts)),
            (!parameter.outlying_machines.is_empty())
                .then(|| fleet_page::machine_table(&parameter.outlying_machines)),
            (!parameter.outlying_logs.is_empty())
                .then(|| fleet_page::log_table(&parameter.outlying_logs)),
        ];
        for mut part in parts.into_iter().flatten() {
            part.caption = format!("{}: {}", keys.join(", "), part.caption);
            section(&part);
        }
    }
    if !summary.failures.is_empty() {
        section(&fleet_page::failure_table(&summary.failures));
    }
    if !summary.findings.is_empty() {
        section(&fleet_page::finding_table(&summary.findings, summary.identified));
    }
}

/// Prints a table below its caption.
fn section(shown: &Table) {
    line("");
    line(&shown.caption);
    let head = shown.columns.iter().map(|(title, _)| title.clone()).collect();
    let mut rows = vec![head];
    rows.extend(shown.rows.iter().cloned());
    table(&rows);
}
