//! The table of the demo: estimates compared with the true parameters.

use std::path::Path;

use lissom::identify::Identified;
use lissom::plan::percent;
use lissom::record::Campaign;
use lissom_io::UnitNames;

use super::{campaign_summary, finding_list, printer, separability_words};
use crate::tasks::demo_comparison::DemoRow;

pub(crate) fn report(out: &Path, campaign: &Campaign, id: &Identified, rows: &[DemoRow]) {
    campaign_summary::campaign(UnitNames::new(&campaign.channels), campaign);
    campaign_summary::runs(id);
    printer::line("");
    let head = ["parameter", "unit", "true", "third harmonic", "error", "regression", "error"];
    let head = head.into_iter().chain(["output-error", "error"]);
    let mut table = vec![head.map(str::to_owned).collect::<Vec<_>>()];
    for r in rows {
        let mut line = vec![r.name.to_owned(), r.unit.to_owned(), significant(r.truth)];
        for e in [r.third, r.regression, r.output_error] {
            match e {
                Some(e) => {
                    line.push(significant(e.value));
                    let error = e.value / r.truth - 1.0;
                    let sign = if error < 0.0 { "−" } else { "+" };
                    line.push(format!("{sign}{}", percent(error.abs())));
                }
                None => line.extend(["refused".to_owned(), String::new()]),
            }
        }
        table.push(line);
    }
    printer::table(&table);
    separability_words::print(campaign.channels.axis, id);
    finding_list::findings(&id.findings);
    printer::line("");
    printer::line(&format!(
        "logs, campaign.toml, result.json, report.html and the Bode plots are in {}",
        out.display()
    ));
    printer::line(&format!(
        "identify them again with: lissom identify {}",
        out.join("campaign.toml").display()
    ));
}

/// Five significant digits.
fn significant(value: f64) -> String {
    let digits = (4.0 - value.abs().log10().floor()).clamp(0.0, 12.0);
    let digits = digits as usize;
    format!("{value:.digits$}")
}
