//! The distribution of a parameter over the logs of a fleet.

use serde::{Deserialize, Serialize};

use super::histogram::Histogram;
use super::robust::{ascending, median, quantile, scale};

/// The distribution of a parameter over the logs of a fleet, in the unit of its key.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Distribution {
    /// Number of logs that give the parameter.
    pub logs: usize,
    /// Number of logs that were identified and do not give it.
    pub refused: usize,
    /// Smallest value.
    pub smallest: f64,
    /// 5 % of the values are below.
    pub percent_5: f64,
    /// 25 % of the values are below.
    pub percent_25: f64,
    /// Half of the values are below.
    pub median: f64,
    /// 75 % of the values are below.
    pub percent_75: f64,
    /// 95 % of the values are below.
    pub percent_95: f64,
    /// Largest value.
    pub largest: f64,
    /// Standard deviation of a normal distribution with the same median absolute deviation.
    pub spread: f64,
    /// Median of the standard errors: the part of the spread that is uncertainty of the estimates.
    pub typical_std: f64,
    /// How many values are in each of several intervals.
    pub histogram: Histogram,
}

impl Distribution {
    /// The distribution of values with their standard errors; none without values.
    pub(super) fn of(values: &[f64], stds: &[f64], identified: usize) -> Option<Self> {
        let sorted = ascending(values.iter().copied());
        let at = |share: f64| quantile(&sorted, share);
        let center = at(0.5)?;
        Some(Self {
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
            histogram: Histogram::of(&sorted)?,
        })
    }
}
