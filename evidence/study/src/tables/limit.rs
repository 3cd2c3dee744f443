//! Errors and intervals compared with the Cramér-Rao bound.

use super::estimates::ROWS;
use super::markdown::{percent, significant, table};
use super::{Outcome, scores};
use crate::score::{EstimateScore, Score};
use crate::statistics::{median, quantile};

/// Median of the square of a standard normal number.
const MEDIAN_SQUARE: f64 = 0.454_936;

pub(super) fn section(outcome: &Outcome) -> String {
    let all: Vec<&Score> = scores(outcome).into_iter().map(|(_, score)| score).collect();
    let header = [
        "parameter",
        "estimates with a bound",
        "bound, median",
        "interval / bound, median",
        "95th percentile",
        "variance / bound²",
        "rms error / bound, smallest 95 %",
    ];
    let rows: Vec<Vec<String>> = ROWS
        .iter()
        .map(|(name, estimates)| {
            let of: Vec<EstimateScore> = all
                .iter()
                .flat_map(|s| estimates.iter().filter_map(|f| s.of(*f).cloned()))
                .collect();
            row(name, &of)
        })
        .collect();
    format!("{}\n\n{}", include_str!("limit.md").trim_end(), table(&header, &rows))
}

fn row(name: &str, of: &[EstimateScore]) -> Vec<String> {
    let relative: Vec<f64> = of.iter().filter_map(|f| Some(f.bound? / f.truth)).collect();
    let widths = widths(of);
    let number = |v: Option<f64>| v.map_or_else(|| "–".to_owned(), significant);
    vec![
        name.to_owned(),
        relative.len().to_string(),
        percent(median(&relative)),
        number(median(&widths)),
        number(quantile(&widths, 0.95)),
        number(variance(of)),
        number(trimmed(of)),
    ]
}

/// Widths of the intervals divided by those of the bounds.
pub(super) fn widths(of: &[EstimateScore]) -> Vec<f64> {
    of.iter().filter_map(EstimateScore::width_over_bound).collect()
}

/// Variance divided by the square of the bound, from the median of the squared errors.
pub(super) fn variance(of: &[EstimateScore]) -> Option<f64> {
    let squares: Vec<f64> =
        of.iter().filter_map(EstimateScore::error_over_bound).map(|e| e * e).collect();
    Some(median(&squares)? / MEDIAN_SQUARE)
}

/// Root mean square of the errors divided by the bound, without the largest 5 %.
fn trimmed(of: &[EstimateScore]) -> Option<f64> {
    let mut squares: Vec<f64> =
        of.iter().filter_map(EstimateScore::error_over_bound).map(|e| e * e).collect();
    squares.sort_by(f64::total_cmp);
    squares.truncate(squares.len() * 19 / 20);
    let mean = squares.iter().sum::<f64>() / squares.len() as f64;
    mean.is_finite().then(|| mean.sqrt())
}

#[cfg(test)]
mod tests {
    use lissom::identify::Estimate;

    use super::*;
    use crate::scored_parameter::ScoredParameter;

    /// Errors at the quantiles of a normal distribution with a standard deviation of 1.2 bounds.
    #[test]
    fn an_error_of_1_2_bounds_is_a_variance_of_1_44() {
        let quantiles = [-1.281_552, -0.674_490, 0.0, 0.674_490, 1.281_552];
        let of: Vec<EstimateScore> = quantiles
            .iter()
            .map(|z| EstimateScore {
                parameter: ScoredParameter::Inertia,
                truth: 2.0,
                estimate: Some(Estimate { value: 2.0 + 1.2 * 0.1 * z, std: 0.15 }),
                warned: false,
                bound: Some(0.1),
            })
            .collect();
        assert!((variance(&of).unwrap() - 1.44).abs() < 1e-5);
        assert!(widths(&of).iter().all(|w| (w - 1.5).abs() < 1e-6));
    }
}
