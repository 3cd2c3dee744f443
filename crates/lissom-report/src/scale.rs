//! Linear and logarithmic scales.

/// How an axis maps values to places.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Scale {
    /// Equal steps.
    #[default]
    Linear,
    /// Equal ratios; only positive values can be drawn.
    Log,
}

/// Values beyond are not drawn: differences of them need not be finite.
const LARGEST: f64 = 1e300;
/// Positive values below are not drawn on a logarithmic axis.
const SMALLEST_LOG: f64 = 1e-300;
/// The pad on each side of the data, as a part of their span.
const PAD: f64 = 0.04;
/// Data that vary less than this part of their size are drawn as constant.
const CONSTANT: f64 = 1e-9;

impl Scale {
    /// Whether a value has a place on this scale.
    pub(crate) fn admits(self, value: f64) -> bool {
        value.abs() <= LARGEST && (self == Self::Linear || value >= SMALLEST_LOG)
    }

    /// The coordinate that is linear along the axis; −∞ for values a logarithmic scale cannot show.
    pub(crate) fn forward(self, value: f64) -> f64 {
        match self {
            Self::Linear => value,
            Self::Log if value > 0.0 => value.log10(),
            Self::Log => f64::NEG_INFINITY,
        }
    }

    fn back(self, coordinate: f64) -> f64 {
        match self {
            Self::Linear => coordinate,
            Self::Log => 10f64.powf(coordinate),
        }
    }

    /// A range around `low..high` with a small pad, at least `least` wide in the axis's linear coordinate.
    pub(crate) fn padded(self, (low, high): (f64, f64), least: f64) -> (f64, f64) {
        let (low, high) = self.widened((low, high), least);
        let (a, b) = (self.forward(low), self.forward(high));
        let pad = PAD * (b - a);
        (self.back(a - pad), self.back(b + pad))
    }

    /// `low..high`, widened about its middle if it is narrower than `least` or practically a point.
    pub(crate) fn widened(self, (low, high): (f64, f64), least: f64) -> (f64, f64) {
        let (a, b) = (self.forward(low), self.forward(high));
        let size = a.abs().max(b.abs());
        let point = b - a <= CONSTANT * size.max(f64::MIN_POSITIVE);
        let wanted = match self {
            _ if !point => least,
            Self::Linear if size > 0.0 => least.max(0.2 * size),
            Self::Linear => least.max(2.0),
            Self::Log => least.max(0.6),
        };
        if b - a >= wanted {
            return (low, high);
        }
        let middle = f64::midpoint(a, b);
        (self.back(middle - wanted / 2.0), self.back(middle + wanted / 2.0))
    }
}

/// The smallest and the largest of `values`, none of which may be NaN.
pub(crate) fn extent(values: impl IntoIterator<Item = f64>) -> Option<(f64, f64)> {
    values.into_iter().fold(None, |range, v| match range {
        None => Some((v, v)),
        Some((low, high)) => Some((v.min(low), v.max(high))),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constants_get_a_range() {
        for value in [0.0, 1.0, -3e-12, 1e300] {
            let (low, high) = Scale::Linear.padded((value, value), 0.0);
            assert!(low < value && value < high && (high - low).is_finite(), "{value}");
        }
        let (low, high) = Scale::Log.padded((1e-300, 1e-300), 0.0);
        assert!(0.0 < low && low < 1e-300 && 1e-300 < high);
    }

    #[test]
    fn only_drawable_values_are_admitted() {
        assert!(
            Scale::Linear.admits(0.0)
                && !Scale::Linear.admits(f64::NAN)
                && !Scale::Linear.admits(f64::MAX)
        );
        assert!(
            Scale::Log.admits(1e-9) && !Scale::Log.admits(0.0) && !Scale::Log.admits(f64::INFINITY)
        );
        assert_eq!(extent([3.0, -1.0, 2.0]).unwrap(), (-1.0, 3.0));
        assert_eq!(extent([]), None);
    }
}
