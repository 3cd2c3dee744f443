//! The estimates of all campaigns.

use super::markdown::{percent, significant, table};
use super::{Outcome, drawn, scores};
use crate::score::{EstimateScore, Score};
use crate::scored_parameter::ScoredParameter;
use crate::statistics::{Share, median, quantile};
use crate::study::{Scored, Study};

/// Rows of the tables: their names and the parameters that they contain.
pub(super) const ROWS: [(&str, &[ScoredParameter]); 9] = [
    ("Coulomb friction", &[ScoredParameter::Coulomb]),
    ("Coulomb friction by direction", &[ScoredParameter::Forward, ScoredParameter::Backward]),
    ("inertia", &[ScoredParameter::Inertia]),
    ("coupling", &[ScoredParameter::Coupling]),
    ("viscous friction", &[ScoredParameter::Viscous]),
    ("frequency 1", &[ScoredParameter::Frequency(0)]),
    ("frequency 2, 3", &[ScoredParameter::Frequency(1), ScoredParameter::Frequency(2)]),
    ("damping ratio 1", &[ScoredParameter::Damping(0)]),
    ("damping ratio 2, 3", &[ScoredParameter::Damping(1), ScoredParameter::Damping(2)]),
];

pub(super) fn section(study: &Study, outcome: &Outcome) -> String {
    let all = scores(outcome);
    let lost = drawn(outcome).len() - all.len();
    let silent = all.iter().filter(|(_, s)| s.estimates.iter().any(EstimateScore::silently_wrong));
    let silent = Share { hits: silent.count(), of: all.len() };
    [
        format!(
            "## Parameters\n\nSeed {}, {} campaigns identified; {lost} campaigns gave no result. \
             Campaigns with a silently wrong parameter: {silent}.\n\nAll estimates:",
            study.seed,
            all.len(),
        ),
        errors(&all, |f| f.estimate.is_some()),
        "Estimates that no warning affects:".to_owned(),
        errors(&all, EstimateScore::vouched),
        time(outcome),
    ]
    .join("\n\n")
}

/// Errors, coverage and refusals of the estimates that are `taken`.
pub(super) fn errors(all: &[(&Scored, &Score)], taken: impl Fn(&EstimateScore) -> bool) -> String {
    let row = |(name, estimates): &(&str, &[ScoredParameter])| {
        let of: Vec<&EstimateScore> = all
            .iter()
            .flat_map(|(_, score)| estimates.iter().filter_map(|f| score.of(*f)))
            .collect();
        let given: Vec<&EstimateScore> = of.iter().copied().filter(|f| taken(f)).collect();
        let error: Vec<f64> = given.iter().filter_map(|f| f.error()).map(f64::abs).collect();
        let refused = Share::count(&of, |f| f.estimate.is_none());
        let bar = estimates[0].bar();
        let within = bar.map_or_else(
            || "–".to_owned(),
            |bar| format!("{} within {}", Share::count(&error, |e| *e <= bar), percent(Some(bar))),
        );
        let covered: Vec<bool> = given.iter().filter_map(|f| f.covers()).collect();
        let standard_errors: Vec<f64> =
            given.iter().filter_map(|f| f.standard_errors()).map(f64::abs).collect();
        vec![
            (*name).to_owned(),
            given.len().to_string(),
            percent(Some(refused.value())),
            percent(Some(Share::count(&of, |f| f.warned).value())),
            percent(median(&error)),
            percent(quantile(&error, 0.95)),
            within,
            Share::count(&covered, |c| *c).to_string(),
            median(&standard_errors).map_or_else(|| "–".to_owned(), significant),
            of.iter().filter(|f| f.silently_wrong()).count().to_string(),
        ]
    };
    let header = [
        "parameter",
        "given",
        "refused",
        "warned",
        "median error",
        "95th percentile",
        "within the limit",
        "95 % intervals that contain the truth",
        "\\|error\\| / standard error, median",
        "silently wrong",
    ];
    table(&header, &ROWS.iter().map(row).collect::<Vec<_>>())
}

fn time(outcome: &Outcome) -> String {
    let all = drawn(outcome);
    let seconds = |of: fn(&Scored) -> f64| all.iter().map(|s| of(s)).collect::<Vec<f64>>();
    let shown = |values: &[f64]| {
        let at = |share| quantile(values, share).map_or_else(|| "–".to_owned(), significant);
        format!("median {} s, 95th percentile {} s, largest {} s", at(0.5), at(0.95), at(1.0))
    };
    let samples = median(&seconds(|s| s.samples as f64))
        .map_or_else(|| "–".to_owned(), |v| format!("{v:.0}"));
    format!(
        "If standard errors are right, the median of |error| / standard error is 0.67.\n\nTime of one identification \
         (median of {samples} samples, other campaigns on the same cores): {}. Simulation, with repeated runs: {}.",
        shown(&seconds(|s| s.identification.as_secs_f64())),
        shown(&seconds(|s| s.simulation.as_secs_f64())),
    )
}
