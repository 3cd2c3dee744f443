//! The motor's response, corrected for friction, against the truth.

use super::markdown::{percent, significant, table};
use super::{Outcome, scores};
use crate::score::PointScore;
use crate::statistics::{Share, median, quantile};

pub(super) fn section(outcome: &Outcome) -> String {
    let points: Vec<&PointScore> = scores(outcome).iter().flat_map(|(_, s)| &s.points).collect();
    let kinds: [(&str, bool); 2] = [("sinusoidal runs", true), ("bands of other runs", false)];
    let rows: Vec<Vec<String>> = kinds
        .iter()
        .map(|(name, sinusoidal)| {
            let of: Vec<&PointScore> =
                points.iter().copied().filter(|p| p.sinusoidal == *sinusoidal).collect();
            row(name, &of)
        })
        .collect();
    let header = [
        "points",
        "all",
        "vouched for",
        "raw, median",
        "corrected, median",
        "95th percentile",
        "worst",
        "(30), median",
        "times closer than (30), median",
        "within 5 %",
        "off by more than 5 deviations",
    ];
    let by_campaign = scores(outcome).into_iter().filter_map(|(_, score)| {
        let of = |p: &PointScore| p.corrected.filter(|_| p.vouched);
        let errors: Vec<f64> = score.points.iter().filter_map(of).collect();
        Some((median(&errors)?, quantile(&errors, 1.0)?))
    });
    let (middle, worst): (Vec<f64>, Vec<f64>) = by_campaign.unzip();
    let median_good = Share::count(&middle, |e| *e <= 0.01);
    let worst_good = Share::count(&worst, |e| *e <= 0.05);
    format!(
        "## Frequency response\n\nθ_m/i against the exact response of the arm without Coulomb friction, \
         |Ĝ − G|/|G|. Corrected figures are of the points that are vouched for: nothing speaks against \
         them, and their 95 % interval is within 5 %. (30) is the report's correction with the third harmonic's friction, of the same points where it exists.\n\n\
         {}\n\nPer campaign: median at most 1 % in {median_good}, worst at most 5 % in {worst_good}.",
        table(&header, &rows)
    )
}

fn row(name: &str, of: &[&PointScore]) -> Vec<String> {
    let vouched: Vec<&PointScore> = of.iter().copied().filter(|p| p.vouched).collect();
    let errors: Vec<f64> = vouched.iter().filter_map(|p| p.corrected).collect();
    let raw: Vec<f64> = vouched.iter().map(|p| p.raw).collect();
    let third: Vec<f64> = vouched.iter().filter_map(|p| p.third_harmonic).collect();
    let closer: Vec<f64> =
        vouched.iter().filter_map(|p| Some(p.third_harmonic? / p.corrected?)).collect();
    let far =
        vouched.iter().filter(|p| p.deviations.is_some_and(|d| d.is_nan() || d > 5.0)).count();
    vec![
        name.to_owned(),
        of.len().to_string(),
        vouched.len().to_string(),
        percent(median(&raw)),
        percent(median(&errors)),
        percent(quantile(&errors, 0.95)),
        percent(quantile(&errors, 1.0)),
        percent(median(&third)),
        median(&closer).map_or_else(|| "–".to_owned(), significant),
        Share::count(&errors, |e| *e <= 0.05).to_string(),
        far.to_string(),
    ]
}
