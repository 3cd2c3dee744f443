//! The frequency response of the motor, corrected for friction, compared with the truth.

use super::markdown::{percent, significant, table};
use super::{Outcome, scores};
use crate::score::{CIRCLE_95, PointScore, Score};
use crate::statistics::{Share, median, quantile};

/// Kinds of points, and whether they are of sines.
const KINDS: [(&str, bool); 2] = [("sinusoidal runs", true), ("bands of other runs", false)];
/// How many times smaller the error of the corrected points must be than that of (30).
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
        "largest",
        "(30), median",
        "error of (30) / error, median",
        "within 5 %",
        "more than 5 standard errors off",
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
        "## Frequency response\n\nError |Ĝ − G|/|G| of θ_m/i against the exact response of the arm without Coulomb \
         friction. Columns from *raw* on are for points that are *vouched for*: no finding speaks against them, and their \
         95 % interval is within 5 %. (30) is the correction of the 1989 report, with the friction that the third harmonic \
         gives, at the same points where it exists.\n\n\
         {}\n\nPer campaign: median error at most 1 % in {median_good}, largest error at most 5 % in {worst_good}.\n\n{}\n\n{}",
        table(&header, &rows),
        circles(&points, outcome),
        compared_with_thirty(&points)
    )
}

/// Campaigns in which a vouched-for point is more than five of its standard errors off.
pub(super) fn silently_wrong(all: &[&Score]) -> Share {
    Share::count(all, |s| s.points.iter().any(PointScore::silently_wrong))
}

/// Compares the errors of points with their standard errors.
fn circles(points: &[&PointScore], outcome: &Outcome) -> String {
    let row = |(name, sinusoidal): &(&str, bool)| {
        let of = |p: &&&PointScore| p.vouched && p.sinusoidal == *sinusoidal;
        let vouched: Vec<&PointScore> = points.iter().filter(of).copied().collect();
        let covered: Vec<bool> = vouched.iter().filter_map(|p| p.covers()).collect();
        let standard_errors: Vec<f64> = vouched.iter().filter_map(|p| p.standard_errors).collect();
        vec![
            (*name).to_owned(),
            vouched.len().to_string(),
            Share::count(&covered, |c| *c).to_string(),
            median(&standard_errors).map_or_else(|| "–".to_owned(), significant),
        ]
    };
    let all: Vec<&Score> = scores(outcome).into_iter().map(|(_, score)| score).collect();
    let wrong = silently_wrong(&all);
    let header = [
        "points",
        "vouched for",
        "95 % circles that contain the truth",
        "\\|error\\| / standard error, median",
    ];
    format!(
        "The standard error of a point is that of the complex value, √E|Ĝ − G|². If the error is circular, the 95 % interval \
         is a circle with a radius of √(−ln 0.05) = {CIRCLE_95:.2} standard errors, and the median of |error| / standard error \
         is √(ln 2) = 0.83. Points of one campaign have correlated errors, so the intervals in parentheses are too \
         narrow.\n\n{}\n\nCampaigns with a vouched-for point more than 5 standard errors off: {} of {}, {wrong}.",
        table(&header, &KINDS.iter().map(row).collect::<Vec<_>>()),
        wrong.hits,
        wrong.of
    )
}

/// Compares the corrected points with those of (30).
fn compared_with_thirty(points: &[&PointScore]) -> String {
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
        "of these, within their 95 % circle",
    ];
    format!(
        "The next table compares with (30), at points of sines where (30) exists. A point that is not corrected counts as not \
         nearer. If the error of (30) is below the noise, chance decides which of the two is nearer; the corrected point is \
         then within its circle.\n\n{}",
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
