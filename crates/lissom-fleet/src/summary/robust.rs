//! Robust location and scale.

/// Scale of a normal distribution over its median absolute deviation: 1/Φ⁻¹(3/4).
const NORMAL: f64 = 1.482_602_218_505_602;

/// A quantile of ascending values, with linear interpolation between them (Hyndman and Fan's type 7); none without values.
pub(super) fn quantile(ascending: &[f64], share: f64) -> Option<f64> {
    let at = share * ascending.len().checked_sub(1)? as f64;
    let (low, part) = (at.floor() as usize, at.fract());
    let high = (low + 1).min(ascending.len() - 1);
    Some(ascending[low] + part * (ascending[high] - ascending[low]))
}

/// Values in ascending order.
pub(super) fn ascending(values: impl IntoIterator<Item = f64>) -> Vec<f64> {
    let mut values: Vec<f64> = values.into_iter().collect();
    values.sort_by(f64::total_cmp);
    values
}

/// The median; none without values.
pub(super) fn median(values: impl IntoIterator<Item = f64>) -> Option<f64> {
    quantile(&ascending(values), 0.5)
}

/// The scale of a normal distribution with the same median absolute value.
pub(super) fn scale(deviations: impl IntoIterator<Item = f64>) -> Option<f64> {
    median(deviations.into_iter().map(f64::abs)).map(|median| NORMAL * median)
}

/// Median, and the scales below and above it, which differ for skew values.
pub(super) fn center_and_scales(values: &[f64]) -> Option<(f64, [f64; 2])> {
    let center = median(values.iter().copied())?;
    let below = scale(values.iter().filter(|v| **v <= center).map(|v| v - center))?;
    let above = scale(values.iter().filter(|v| **v >= center).map(|v| v - center))?;
    Some((center, [below, above]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_few_values() {
        assert_eq!(quantile(&[], 0.5), None);
        assert_eq!(quantile(&[3.0], 0.9), Some(3.0));
        // numpy.quantile([1, 2, 4, 8], 0.4) is 2.4.
        assert!((quantile(&[1.0, 2.0, 4.0, 8.0], 0.4).unwrap() - 2.4).abs() < 1e-12);
        assert!((scale([-1.0, 1.0, 1.0]).unwrap() - NORMAL).abs() < 1e-12);
        let (center, [below, above]) = center_and_scales(&[0.0, 1.0, 2.0, 6.0, 12.0]).unwrap();
        assert!((center - 2.0).abs() < 1e-12 && (below - NORMAL).abs() < 1e-12);
        assert!((above - 4.0 * NORMAL).abs() < 1e-12);
    }
}
