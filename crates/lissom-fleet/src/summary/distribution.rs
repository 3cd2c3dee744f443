//! The distribution of a parameter over the logs of a fleet.

use lissom_io::fleet::Distribution;

use super::histogram::histogram;
use super::robust::{ascending, median, quantile, scale};

/// The distribution of values with their standard errors; none without values.
pub(super) fn distribution(
    values: &[f64],
    stds: &[f64],
    identified: usize,
) -> Option<Distribution> {
    let sorted = ascending(values.iter().copied());
    let at = |share: f64| quantile(&sorted, share);
    let center = at(0.5)?;
    Some(Distribution {
        logs: values.len(),
        refused: identified.saturating_sub(values.len()),
        smallest: *sorted.first()?,
        percent_5: at(0.05)?,
        percent_25: at(0.25)?,
        median: center,
        percent_75: at(0.75)?,
        percent_95: at(0.95)?,
        largest: *sorted.last()?,
        spread: scale(sorted.iter().map(|v| v - center))?,
        typical_std: median(stds.iter().copied())?,
        histogram: histogram(&sorted)?,
    })
}
