//! The motor's response, corrected for friction, against the truth.

use super::markdown::{percent, significant, table};
use super::{Outcome, scores};
use crate::score::{CIRCLE_95, PointScore, Score};
use crate::statistics::{Share, median, quantile};

/// Kinds of points, and whether they are of sines.
const KINDS: [(&str, bool); 2] = [("sinusoidal runs", true), ("bands of other runs", false)];
/// So many times nearer than (30) the corrected points are asked to be.
pub(super) const CLOSER: f64 = 10.0;

pub(super) fn section(outcome: &Outcome) -> String {
    let points: Vec<&PointScore> = scores(outcome).iter().flat_map(|(_, s)| &s.points).collect();
    let rows: Vec<Vec<String>> = KINDS
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
         {}\n\nPer campaign: median at most 1 % in {median_good}, worst at most 5 % in {worst_good}.\n\n{}\n\n{}",
        table(&header, &rows),
        circles(&points, outcome),
        beside_thirty(&points)
    )
}

/// Campaigns in which a point that is vouched for is off by more than five of its deviations.
pub(super) fn silently_wrong(all: &[&Score]) -> Share {
    Share::count(all, |s| s.points.iter().any(PointScore::silently_wrong))
}

/// How errors are to deviations.
fn circles(points: &[&PointScore], outcome: &Outcome) -> String {
    let row = |(name, sinusoidal): &(&str, bool)| {
        let of = |p: &&&PointScore| p.vouched && p.sinusoidal == *sinusoidal;
        let vouched: Vec<&PointScore> = points.iter().filter(of).copied().collect();
        let covered: Vec<bool> = vouched.iter().filter_map(|p| p.covers()).collect();
        let deviations: Vec<f64> = vouched.iter().filter_map(|p| p.deviations).collect();
        vec![
            (*name).to_owned(),
            vouched.len().to_string(),
            Share::count(&covered, |c| *c).to_string(),
            median(&deviations).map_or_else(|| "–".to_owned(), significant),
        ]
    };
    let all: Vec<&Score> = scores(outcome).into_iter().map(|(_, score)| score).collect();
    let wrong = silently_wrong(&all);
    let header = ["points", "vouched for", "95 % circles that hold", "deviations, median size"];
    format!(
        "A point's deviation is √E|Ĝ − G|², that of the complex value: where the error is circular, its 95 % interval is the \
         circle of √(−ln 0.05) = {CIRCLE_95:.2} deviations, and honest deviations have a median size of √(ln 2) = 0.83. \
         Points of one campaign err together, so that the brackets are too narrow.\n\n{}\n\n\
         Campaigns with a vouched-for point off by more than 5 of its deviations: {} of {}, {wrong}.",
        table(&header, &KINDS.iter().map(row).collect::<Vec<_>>()),
        wrong.hits,
        wrong.of
    )
}

/// Whether the corrected points are nearer to the truth than (30).
fn beside_thirty(points: &[&PointScore]) -> String {
    let row = |(name, only_vouched): (&str, bool)| {
        let of: Vec<&&PointScore> =
            points.iter().filter(|p| p.sinusoidal && (p.vouched || !only_vouched)).collect();
        let nearer = |times: f64| {
            let nearer: Vec<bool> = of.iter().filter_map(|p| p.nearer(times)).collect();
            Share::count(&nearer, |n| *n)
        };
        let (nearer, much_nearer) = (nearer(1.0), nearer(CLOSER));
        let not_nearer = of.iter().filter(|p| p.nearer(1.0) == Some(false));
        let within = not_nearer.filter(|p| p.covers() == Some(true)).count();
        vec![
            name.to_owned(),
            nearer.of.to_string(),
            nearer.to_string(),
            much_nearer.to_string(),
            (nearer.of - nearer.hits).to_string(),
            within.to_string(),
        ]
    };
    let header = [
        "sinusoidal points",
        "with (30)",
        "nearer than (30)",
        "ten times nearer",
        "not nearer",
        "of these within their 95 % circle",
    ];
    format!(
        "Sinusoidal points where (30) exists; one that is not corrected is not nearer. Where the error of (30) is below the \
         noise, the nearer of the two is a matter of chance: the corrected point is within its circle then.\n\n{}",
        table(&header, &[row(("all", false)), row(("vouched for", true))])
    )
}

fn row(name: &str, of: &[&PointScore]) -> Vec<String> {
    let vouched: Vec<&PointScore> = of.iter().copied().filter(|p| p.vouched).collect();
    let errors: Vec<f64> = vouched.iter().filter_map(|p| p.corrected).collect();
    let raw: Vec<f64> = vouched.iter().map(|p| p.raw).collect();
    let third: Vec<f64> = vouched.iter().filter_map(|p| p.third_harmonic).collect();
    let closer: Vec<f64> =
        vouched.iter().filter_map(|p| Some(p.third_harmonic? / p.corrected?)).collect();
    let far = vouched.iter().filter(|p| p.silently_wrong()).count();
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
