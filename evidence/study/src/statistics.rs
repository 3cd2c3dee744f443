//! Quantiles, and shares with their uncertainty.

use std::fmt;

pub(crate) use lissom::identify::NORMAL_95;

/// The quantile `share` of the values, interpolated linearly; `None` without values.
pub fn quantile(values: &[f64], share: f64) -> Option<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let at = share * (sorted.len().checked_sub(1)? as f64);
    let below = sorted[at.floor() as usize];
    let above = sorted[at.ceil() as usize];
    // Between infinite neighbours there is no difference to take.
    Some(if above.is_infinite() { above } else { below + (above - below) * at.fract() })
}

/// The median of the values.
pub fn median(values: &[f64]) -> Option<f64> {
    quantile(values, 0.5)
}

/// A number of hits out of a number of cases.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Share {
    /// The hits.
    pub hits: usize,
    /// All cases.
    pub of: usize,
}

impl Share {
    /// Counts the values for which `is` is true.
    pub fn count<T>(values: &[T], is: impl Fn(&T) -> bool) -> Self {
        Self { hits: values.iter().filter(|v| is(v)).count(), of: values.len() }
    }

    /// The share; NaN without cases.
    pub fn value(&self) -> f64 {
        self.hits as f64 / self.of as f64
    }

    /// Wilson's 95 % interval of the probability of a hit.
    pub fn band(&self) -> (f64, f64) {
        let (n, p, z2) = (self.of as f64, self.value(), NORMAL_95 * NORMAL_95);
        let middle = (p + 0.5 * z2 / n) / (1.0 + z2 / n);
        let half = NORMAL_95 * (p * (1.0 - p) / n + 0.25 * z2 / (n * n)).sqrt() / (1.0 + z2 / n);
        ((middle - half).max(0.0), (middle + half).min(1.0))
    }
}

/// `93.1 % (91.0-94.8)`, or a dash without cases.
impl fmt::Display for Share {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.of == 0 {
            return f.write_str("–");
        }
        let (low, high) = self.band();
        let [share, low, high] = [self.value(), low, high].map(|v| 100.0 * v);
        write!(f, "{share:.1} % ({low:.1}-{high:.1})")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_lie_between_values() {
        let values = [3.0, 1.0, 2.0, 5.0, 4.0];
        assert_eq!(median(&values), Some(3.0));
        assert_eq!(quantile(&values, 0.95), Some(4.8));
        assert_eq!(quantile(&values, 1.0), Some(5.0));
        assert_eq!(median(&[]), None);
        assert_eq!(median(&[f64::INFINITY, f64::INFINITY]), Some(f64::INFINITY));
    }

    /// Wilson's interval for 19 of 20 from his formula, computed by hand: 0.764 to 0.991.
    #[test]
    fn a_share_has_an_interval() {
        let (low, high) = Share { hits: 19, of: 20 }.band();
        assert!((low - 0.7639).abs() < 1e-3 && (high - 0.9911).abs() < 1e-3, "{low} {high}");
        assert_eq!(Share { hits: 0, of: 0 }.to_string(), "–");
    }
}
