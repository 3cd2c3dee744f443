//! The verdict: which parameters the logs identify, on the report page.

use lissom::plan::percent;
use lissom_io::ResultFile;
use lissom_io::result::{RunEffectEntry, SeparabilityEntry};
use lissom_report::{Cells, Page, Table};

/// Adds the verdict to the page: the words, the standard errors, and the contribution of each run.
pub(crate) fn section(page: Page, result: &ResultFile) -> Page {
    let Some(found) = &result.verdict else { return page };
    let mut page = page.heading("Verdict: what the logs identify");
    for words in &found.words {
        page = page.paragraph(words);
    }
    if !found.parameters.is_empty() {
        page = page.table(&parameters(found));
    }
    if let Some(table) = correlations(found) {
        page = page.table(&table);
    }
    if found.runs.is_empty() { page } else { page.table(&runs(found)) }
}

fn parameters(found: &SeparabilityEntry) -> Table {
    let title = match found.condition {
        Some(condition) => format!("Relative standard errors (condition number {condition:.0})"),
        None => "Relative standard errors".to_owned(),
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
        let alone = known.relative_std_if_others_known;
        let refused = if known.given { "" } else { " (estimate refused)" };
        let name = format!("{}{refused}", known.parameter);
        table = table.row([name, share(known.relative_std), share(alone)]);
    }
    table
}

/// Correlation of the estimates, below the diagonal; `None` with fewer than two parameters.
fn correlations(found: &SeparabilityEntry) -> Option<Table> {
    let parameters = &found.parameters;
    if parameters.len() < 2 || found.correlation.matrix.len() != parameters.len() {
        return None;
    }
    let names: Vec<&str> = parameters.iter().map(|known| known.parameter.as_str()).collect();
    let columns = names.iter().take(names.len() - 1).map(|name| (*name, Cells::Numbers));
    let columns: Vec<(&str, Cells)> = std::iter::once(("", Cells::Text)).chain(columns).collect();
    let mut table = Table::new("Correlation of the estimates", &columns);
    for (row, name) in names.iter().enumerate().skip(1) {
        let of = |column: usize| {
            let value = found.correlation.matrix[row].get(column).copied().flatten();
            value.map_or("–".to_owned(), |value| format!("{value:+.2}").replace('-', "−"))
        };
        table = table.row(std::iter::once((*name).to_owned()).chain((0..row).map(of)));
    }
    Some(table)
}

fn runs(found: &SeparabilityEntry) -> Table {
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
        let most = run.parameters.iter().max_by(|a, b| {
            let growth =
                |effect: &RunEffectEntry| effect.std_growth_without.unwrap_or(f64::INFINITY);
            growth(a).total_cmp(&growth(b))
        });
        table = table.row([
            run.name.clone(),
            run.residual_beside_others.map_or("–".to_owned(), |ratio| format!("{ratio:.2}")),
            most.map_or_else(String::new, |effect| effect.parameter.clone()),
            most.map_or_else(String::new, |effect| growth(effect.std_growth_without)),
        ]);
    }
    table
}

fn share(std: Option<f64>) -> String {
    std.map_or("not identified".to_owned(), percent)
}

fn growth(factor: Option<f64>) -> String {
    factor.map_or("only from this run".to_owned(), |factor| format!("{factor:.1}"))
}
