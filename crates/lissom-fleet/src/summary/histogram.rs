//! How many values are in each interval.

use lissom_io::fleet::Histogram;

use super::robust::quantile;

/// Values farther than this many distances between quartiles from a quartile are counted as below or above.
const TAILS: f64 = 3.0;
/// Largest number of intervals.
const MOST: f64 = 60.0;

/// Counts ascending values, with the width of Freedman and Diaconis (Z. Wahrscheinlichkeitstheorie verw. Geb. 57, 1981):
/// 2·IQR/n^(1/3). None without values.
pub(super) fn histogram(ascending: &[f64]) -> Option<Histogram> {
    let (low, high) = (quantile(ascending, 0.25)?, quantile(ascending, 0.75)?);
    let reach = TAILS * (high - low);
    let from = ascending.first()?.max(low - reach);
    let to = ascending.last()?.min(high + reach);
    let wanted = 2.0 * (high - low) / (ascending.len() as f64).cbrt();
    let number = ((to - from) / wanted).ceil();
    let number = if number.is_finite() { number.clamp(1.0, MOST) } else { 1.0 };
    let width = (to - from) / number;
    let (mut counts, mut below, mut above) = (vec![0; number as usize], 0, 0);
    for value in ascending {
        if *value < from {
            below += 1;
        } else if *value > to {
            above += 1;
        } else {
            let place = if width > 0.0 { ((value - from) / width) as usize } else { 0 };
            let last = counts.len() - 1;
            counts[place.min(last)] += 1;
        }
    }
    Some(Histogram { from, width, counts, below, above })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_value_is_counted_once() {
        let mut values: Vec<f64> = (0..1000).map(|k| f64::from(k) / 1000.0).collect();
        values.extend([50.0, 60.0]);
        let found = histogram(&values).unwrap();
        assert_eq!(found.counts.iter().sum::<usize>(), 1000);
        assert_eq!((found.below, found.above), (0, 2));
        assert!(found.counts.len() > 5 && found.counts.len() <= 60, "{found:?}");
        let equal = histogram(&[2.0; 5]).unwrap();
        assert_eq!(equal.counts, [5]);
        assert_eq!(histogram(&[]), None);
    }
}
