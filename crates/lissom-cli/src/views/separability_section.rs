//! What the logs separate, in words and on the report's page.

use lissom::identify::{Identified, Separability};
use lissom::plan::percent;
use lissom::record::Axis;
use lissom_io::UnitNames;
use lissom_report::{Cells, Page, Table};

use super::printer::line;

/// What the logs separate, in words.
pub(crate) fn print(axis: Axis, id: &Identified) {
    let words = id.separability.as_ref().map_or(Vec::new(), |found| found.words(axis));
    if words.is_empty() {
        return;
    }
    line("\nverdict");
    for text in words {
        line(&format!("  {text}"));
    }
}

/// The words, the figures beside each other, and what each run carries.
pub(crate) fn section(page: Page, names: UnitNames, id: &Identified) -> Page {
    let Some(found) = &id.separability else { return page };
    let mut page = page.heading("What the logs separate");
    for words in found.words(names.axis) {
        page = page.paragraph(&words);
    }
    if !found.figures.is_empty() {
        page = page.table(&figures(found));
    }
    if found.runs.is_empty() { page } else { page.table(&runs(found)) }
}

fn figures(found: &Separability) -> Table {
    let title = if found.condition.is_finite() {
        format!("Each figure beside the others (condition {:.0})", found.condition)
    } else {
        "Each figure beside the others".to_owned()
    };
    let mut table = Table::new(
        &title,
        &[
            ("figure", Cells::Text),
            ("deviation", Cells::Numbers),
            ("if the others were known", Cells::Numbers),
        ],
    );
    for known in &found.figures {
        table = table.row([known.figure.name(), share(known.std), share(known.alone)]);
    }
    table
}

fn runs(found: &Separability) -> Table {
    let mut table = Table::new(
        "What each run carries: deviations grow by so much without it",
        &[
            ("run", Cells::Text),
            ("residual beside the others", Cells::Numbers),
            ("most", Cells::Text),
            ("growth", Cells::Numbers),
        ],
    );
    for run in &found.runs {
        let most = run.figures.iter().max_by(|a, b| a.growth.total_cmp(&b.growth));
        table = table.row([
            run.run.clone(),
            format!("{:.2}", run.residual),
            most.map_or_else(String::new, |c| c.figure.name()),
            most.map_or_else(String::new, |c| growth(c.growth)),
        ]);
    }
    table
}

fn share(std: f64) -> String {
    if std.is_finite() { percent(std) } else { "not told".to_owned() }
}

fn growth(factor: f64) -> String {
    if factor.is_finite() { format!("{factor:.1}") } else { "only there".to_owned() }
}
