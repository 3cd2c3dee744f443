//! The page of a comparison.

use lissom_io::ComparedFile;
use lissom_io::result::{ComparedParameterEntry, EstimateEntry};
use lissom_report::{Cells, Page, Table};

use crate::compare_words::{letter, method, rows, sentences};

/// The page of results side by side: the differences in words, the results, and a table with the 95 % intervals.
pub fn page(title: &str, found: &ComparedFile) -> Page {
    let mut words = sentences(found).into_iter();
    let mut page = Page::new(title);
    if let Some(first) = words.next() {
        page = page.summary(&first);
    }
    page = page.table(&results(found));
    for text in words {
        page = page.paragraph(&text);
    }
    let letters: Vec<String> = (0..found.results.len()).map(letter).collect();
    let intervals: Vec<Vec<Option<[f64; 3]>>> = found.parameters.iter().map(intervals).collect();
    page.heading("Parameters")
        .interval_table(&table(found), &letters, &intervals)
        .footer(&format!("lissom {}", found.lissom))
}

fn results(found: &ComparedFile) -> Table {
    let columns = [("", Cells::Text), ("result", Cells::Text), ("method", Cells::Text)];
    found.results.iter().enumerate().fold(Table::new("", &columns), |table, (k, result)| {
        table.row([letter(k), result.file.clone(), method(result).to_owned()])
    })
}

/// The table as the command prints it, with whole names.
fn table(found: &ComparedFile) -> Table {
    let mut rows = rows(found).into_iter();
    let heading = rows.next().unwrap_or_default();
    let columns: Vec<(&str, Cells)> = heading
        .iter()
        .enumerate()
        .map(|(k, name)| {
            let cells = if k < 2 || name == "warning" { Cells::Text } else { Cells::Numbers };
            (name.as_str(), cells)
        })
        .collect();
    let caption = "Each result compared with A; [s.e.]: the difference in its standard errors";
    let named = rows.zip(&found.parameters).map(|(mut row, parameter)| {
        row[0].clone_from(&parameter.name);
        row
    });
    named.fold(Table::new(caption, &columns), Table::row)
}

/// Low end, value and high end of the 95 % interval of each result.
fn intervals(parameter: &ComparedParameterEntry) -> Vec<Option<[f64; 3]>> {
    let interval = |entry: &EstimateEntry| [entry.ci95[0], entry.value, entry.ci95[1]];
    parameter.values.iter().map(|value| value.as_ref().map(interval)).collect()
}
