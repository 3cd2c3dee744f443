//! Campaigns of arms whose friction or damping follows another law.

use std::collections::BTreeMap;

use super::markdown::{percent, table};
use super::{Outcome, scores};
use crate::score::Score;
use crate::scored_parameter::ScoredParameter;
use crate::statistics::{Share, median, quantile};
use crate::study::Study;

pub(super) fn section(studies: &[(Study, Outcome)]) -> String {
    let rows: Vec<Vec<String>> = studies.iter().map(row).collect();
    let header = ["law", "campaigns", "inertia", "coupling", "frequency 1", "Coulomb", "reported"];
    let mut codes: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    for (at, (_, outcome)) in studies.iter().enumerate() {
        let all: Vec<Vec<&str>> = scores(outcome).iter().map(|(_, s)| s.law_alarms()).collect();
        let seen: std::collections::BTreeSet<&str> = all.iter().flatten().copied().collect();
        for code in seen {
            let cells = codes.entry(code).or_insert_with(|| vec!["0 %".to_owned(); studies.len()]);
            cells[at] = percent(Some(Share::count(&all, |alarms| alarms.contains(&code)).value()));
        }
    }
    let code_rows: Vec<Vec<String>> = codes
        .into_iter()
        .map(|(code, cells)| std::iter::once(format!("`{code}`")).chain(cells).collect())
        .collect();
    let names: Vec<String> = studies.iter().map(|(study, _)| study.law.to_string()).collect();
    let code_header: Vec<&str> =
        std::iter::once("finding").chain(names.iter().map(String::as_str)).collect();
    format!(
        "{}\n\n{}\n\nWhich findings reported it, in shares of the campaigns:\n\n{}",
        include_str!("laws.md").trim_end().replace("{command}", &command(studies)),
        table(&header, &rows),
        table(&code_header, &code_rows)
    )
}

/// The command that makes the page.
fn command(studies: &[(Study, Outcome)]) -> String {
    let law = match studies {
        [(only, _)] => only.law.option(),
        _ => "wrong".to_owned(),
    };
    let study = studies.first().map(|(study, _)| study);
    let (campaigns, seed) = study.map_or((0, 0), |s| (s.campaigns, s.seed));
    format!("cargo xtask study --law {law} --campaigns {campaigns} --seed {seed}")
}

fn row((study, outcome): &(Study, Outcome)) -> Vec<String> {
    let all: Vec<&Score> = scores(outcome).into_iter().map(|(_, score)| score).collect();
    let errors = |parameter: ScoredParameter| -> Vec<f64> {
        all.iter().filter_map(|s| s.of(parameter)?.error()).map(f64::abs).collect()
    };
    let cell = |parameter: ScoredParameter| {
        let errors = errors(parameter);
        format!("{} / {}", percent(median(&errors)), percent(quantile(&errors, 0.95)))
    };
    vec![
        study.law.to_string(),
        all.len().to_string(),
        cell(ScoredParameter::Inertia),
        cell(ScoredParameter::Coupling),
        cell(ScoredParameter::Frequency(0)),
        cell(ScoredParameter::Coulomb),
        Share::count(&all, |s| !s.law_alarms().is_empty()).to_string(),
    ]
}
