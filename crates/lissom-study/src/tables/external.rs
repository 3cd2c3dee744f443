//! Campaigns of another simulator beside the rig's.

use super::figures::{ROWS, errors};
use super::limit::variance;
use super::markdown::{percent, significant, table};
use super::{Outcome, drawn, limit, scores, worst};
use crate::score::FigureScore;
use crate::statistics::{Share, median, quantile};
use crate::study::{Both, Study};

/// The page about campaigns that the rig simulated and another simulator did.
pub fn report(study: &Study, found: &Both) -> String {
    let (ours, theirs) = (&found.ours, &found.theirs);
    let all = scores(theirs);
    let silent = all.iter().filter(|(_, s)| s.figures.iter().any(FigureScore::silently_wrong));
    let silent = Share { hits: silent.count(), of: all.len() };
    [
        include_str!("external.md").trim_end().to_owned(),
        format!(
            "## Random arms\n\nSeed {}, {} campaigns identified. Campaigns with a figure silently wrong: {silent}. \
             {}\n\nEvery figure given:",
            study.seed,
            all.len(),
            agreement(found),
        ),
        errors(&all, |f| f.estimate.is_some()),
        "The same campaigns by both simulators, other numbers for noise: median error (95th \
         percentile), intervals that hold, variance over the square of the Cramér-Rao bound."
            .to_owned(),
        beside(ours, theirs),
        limit::section(theirs),
        worst::section(theirs),
    ]
    .join("\n\n")
        + "\n"
}

/// How near the rig and the true arm's replay are to the other simulator's motion.
fn agreement(found: &Both) -> String {
    let all: Vec<f64> = drawn(&found.theirs).iter().flat_map(|s| s.left.iter().copied()).collect();
    let at = |share| quantile(&all, share).map_or_else(|| "–".to_owned(), |v| format!("{v:.3}"));
    format!(
        "{} of {} readings without noise are the rig's. The true arm's replay of the logs leaves {} of a sensor's deviation \
         √(s² + q²/12) in median, {} to {} of the channels.",
        found.alike.hits,
        found.alike.of,
        at(0.5),
        at(0.0),
        at(1.0)
    )
}

fn beside(ours: &Outcome, theirs: &Outcome) -> String {
    let cells = |outcome: &Outcome, row: usize| -> Vec<String> {
        let all = scores(outcome);
        let of: Vec<FigureScore> = all
            .iter()
            .flat_map(|(_, s)| ROWS[row].1.iter().filter_map(|f| s.of(*f).cloned()))
            .collect();
        let errors: Vec<f64> = of.iter().filter_map(FigureScore::error).map(f64::abs).collect();
        let covered: Vec<bool> = of.iter().filter_map(FigureScore::covers).collect();
        vec![
            format!("{} ({})", percent(median(&errors)), percent(quantile(&errors, 0.95))),
            Share::count(&covered, |c| *c).to_string(),
            variance(&of).map_or_else(|| "–".to_owned(), significant),
        ]
    };
    let rows: Vec<Vec<String>> = ROWS
        .iter()
        .enumerate()
        .map(|(k, (name, _))| {
            let name = std::iter::once((*name).to_owned());
            name.chain(cells(ours, k)).chain(cells(theirs, k)).collect()
        })
        .collect();
    let header = [
        "figure",
        "rig: error",
        "rig: hold",
        "rig: variance",
        "independent: error",
        "independent: hold",
        "independent: variance",
    ];
    table(&header, &rows)
}
