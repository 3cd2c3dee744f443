//! The friction curve compared with the truth.

use super::markdown::{percent, significant, table};
use super::{Outcome, scores};
use crate::score::CurveScore;
use crate::statistics::{Share, median, quantile};

pub(super) fn section(outcome: &Outcome) -> String {
    let of_campaigns: Vec<&[CurveScore]> =
        scores(outcome).iter().map(|(_, s)| &s.curve[..]).filter(|c| !c.is_empty()).collect();
    let points: Vec<&CurveScore> = of_campaigns.iter().copied().flatten().collect();
    let errors: Vec<f64> = points.iter().map(|p| p.error.abs()).collect();
    let standard_errors: Vec<f64> = points.iter().map(|p| p.standard_errors.abs()).collect();
    let row = vec![
        of_campaigns.len().to_string(),
        points.len().to_string(),
        percent(median(&errors)),
        percent(quantile(&errors, 0.95)),
        Share::count(&points, |p| p.covers()).to_string(),
        median(&standard_errors).map_or_else(|| "–".to_owned(), significant),
        quantile(&standard_errors, 1.0).map_or_else(|| "–".to_owned(), significant),
    ];
    let header = [
        "campaigns with a curve",
        "points",
        "median error",
        "95th percentile",
        "95 % bands that contain the truth",
        "\\|error\\| / standard error, median",
        "largest",
    ];
    format!(
        "## Friction curve\n\nFriction against speed from slip phases (stretches of time in which the joint moves in one \
         direction without stopping), without an assumed law, compared with CF + V·|v| forward and backward. Points of one \
         campaign have correlated errors, so the intervals in parentheses are too narrow.\n\n{}",
        table(&header, &[row])
    )
}
