//! The verdict: which parameters the logs identify, on the report page.

use lissom::identify::{Identified, Separability};
use lissom::plan::percent;
use lissom_io::UnitNames;
use lissom_report::{Cells, Page, Table};

/// Adds the verdict to the page: the words, the standard errors, and the contribution of each run.
pub(crate) fn section(page: Page, names: UnitNames, id: &Identified) -> Page {
    let Some(found) = &id.separability else { return page };
    let mut page = page.heading("Verdict: what the logs identify");
    for words in found.words(names.axis) {
        page = page.paragraph(&words);
    }
    if !found.parameters.is_empty() {
        page = page.table(&parameters(found));
    }
    if let Some(table) = correlations(found) {
        page = page.table(&table);
    }
    if found.runs.is_empty() { page } else { page.table(&runs(found)) }
}

fn parameters(found: &Separability) -> Table {
    let title = if found.condition.is_finite() {
        format!("Relative standard errors (condition number {:.0})", found.condition)
    } else {
        "Relative standard errors".to_owned()
    };
    let mut table = Table::new(
        &title,
        &[
            ("parameter", Cells::Text),
            ("standard error", Cells::Numbers),
            ("if the other parameters were known", Cells::Numbers),
        ],
    );
    for known in &found.parameters {
        table = table.row([known.parameter.name(), share(known.std), share(known.alone)]);
    }
    table
}

/// Correlation of the estimates, below the diagonal; `None` with fewer than two parameters.
fn correlations(found: &Separability) -> Option<Table> {
    let parameters = &found.parameters;
    if parameters.len() < 2 || found.correlation.nrows() != parameters.len() {
        return None;
    }
    let names: Vec<String> = parameters.iter().map(|known| known.parameter.name()).collect();
    let columns = names.iter().take(names.len() - 1).map(|name| (name.as_str(), Cells::Numbers));
    let columns: Vec<(&str, Cells)> = std::iter::once(("", Cells::Text)).chain(columns).collect();
    let mut table = Table::new("Correlation of the estimates", &columns);
    for (row, name) in names.iter().enumerate().skip(1) {
        let of = |column: usize| {
            let value = found.correlation[(row, column)];
            if value.is_finite() {
                format!("{value:+.2}").replace('-', "−")
            } else {
                "–".to_owned()
            }
        };
        table = table.row(std::iter::once(name.clone()).chain((0..row).map(of)));
    }
    Some(table)
}

fn runs(found: &Separability) -> Table {
    let mut table = Table::new(
        "Contribution of each run: by which factor a standard error grows without the run",
        &[
            ("run", Cells::Text),
            ("residual relative to the other runs", Cells::Numbers),
            ("parameter with the largest factor", Cells::Text),
            ("factor", Cells::Numbers),
        ],
    );
    for run in &found.runs {
        let most = run.parameters.iter().max_by(|a, b| a.growth.total_cmp(&b.growth));
        table = table.row([
            run.run.clone(),
            format!("{:.2}", run.residual),
            most.map_or_else(String::new, |c| c.parameter.name()),
            most.map_or_else(String::new, |c| growth(c.growth)),
        ]);
    }
    table
}

fn share(std: f64) -> String {
    if std.is_finite() { percent(std) } else { "not identified".to_owned() }
}

fn growth(factor: f64) -> String {
    if factor.is_finite() { format!("{factor:.1}") } else { "only from this run".to_owned() }
}
