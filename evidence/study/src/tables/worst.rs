//! The campaigns with the largest errors.

use super::markdown::{percent, significant, table};
use super::{Outcome, scores};
use crate::score::EstimateScore;
use crate::study::Scored;

/// Campaigns in each list.
const SHOWN: usize = 10;

pub(super) fn section(outcome: &Outcome) -> String {
    let all = scores(outcome);
    let mut worst: Vec<(f64, &Scored, &EstimateScore)> = all
        .iter()
        .filter_map(|(scored, score)| {
            let far = |f: &EstimateScore| Some(f.error()?.abs() / f.parameter.bar()?);
            let estimates = score.estimates.iter().filter_map(|f| Some((far(f)?, *scored, f)));
            estimates.max_by(|a, b| a.0.total_cmp(&b.0))
        })
        .collect();
    worst.sort_by(|a, b| b.0.total_cmp(&a.0));
    let worst: Vec<_> = worst.iter().take(SHOWN).map(|(_, s, f)| row(s, f)).collect();
    let mut silent: Vec<(f64, &Scored, &EstimateScore)> = all
        .iter()
        .flat_map(|(scored, score)| {
            let wrong = score.estimates.iter().filter(|f| f.silently_wrong());
            wrong.map(|f| (f.standard_errors().map_or(0.0, f64::abs), *scored, f))
        })
        .collect();
    silent.sort_by(|a, b| b.0.total_cmp(&a.0));
    let silent: Vec<_> = silent.iter().take(SHOWN).map(|(_, s, f)| row(s, f)).collect();
    let header = [
        "index",
        "n",
        "runs",
        "bits, motor/tips",
        "noise",
        "T",
        "CF",
        "stuck",
        "parameter",
        "error",
        "error in standard errors",
        "warned",
    ];
    let silent = if silent.is_empty() {
        "No estimate is silently wrong.".to_owned()
    } else {
        let table = table(&header, &silent);
        format!(
            "The silently wrong estimates, at most {SHOWN}, the one with the most standard errors first:\n\n{table}"
        )
    };
    format!(
        "## Worst campaigns\n\nThe {SHOWN} campaigns in which an error is largest compared with the limit of its parameter. \
         n is the number of masses, noise is in encoder steps, *stuck* is the largest share of a run in which the joint \
         sticks.\n\n{}\n\n{silent}",
        table(&header, &worst)
    )
}

fn row(scored: &Scored, parameter: &EstimateScore) -> Vec<String> {
    let stratum = &scored.stratum;
    vec![
        scored.index.to_string(),
        stratum.masses.to_string(),
        format!("{} {}", scored.runs.len(), stratum.kind),
        format!("{}/{}", stratum.motor_bits, stratum.tip_bits),
        stratum.noise_steps.map_or_else(|| "0".to_owned(), significant),
        format!("{:.2} ms", 1e3 * stratum.sample_time_s),
        percent(Some(scored.coulomb_share)),
        percent(Some(scored.stuck_share)),
        parameter.parameter.to_string(),
        percent(parameter.error()),
        parameter.standard_errors().map_or_else(|| "–".to_owned(), significant),
        if parameter.warned { "yes" } else { "no" }.to_owned(),
    ]
}
