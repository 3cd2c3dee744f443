//! Positions and labels of the ticks of an axis.

use crate::scale::Scale;
use lissom_text::{exponent, fixed, power_of_ten};

/// Which distances between ticks read well.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Steps {
    /// 1, 2 and 5 by powers of ten.
    Decimal,
    /// As decimal, then 10, 20, 40, 60, 100 ... dB.
    Decibels,
    /// As decimal, then 5, 10, 15, 45, 90, 180 degrees and multiples of 360.
    Degrees,
}

/// A labelled tick.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Tick {
    pub(crate) at: f64,
    pub(crate) label: String,
}

/// An axis with its range and ticks.
#[derive(Clone, Debug)]
pub(crate) struct Ruler {
    pub(crate) scale: Scale,
    pub(crate) low: f64,
    pub(crate) high: f64,
    pub(crate) ticks: Vec<Tick>,
    /// Unlabelled grid lines.
    pub(crate) minor: Vec<f64>,
    /// The power of ten the labels leave out.
    pub(crate) factor: Option<i32>,
}

/// Ticks a linear axis never exceeds, whatever the rounding.
const MAX_TICKS: usize = 40;
/// The least distance of the data from a snapped end, as a part of their span.
const SNAP_PAD: f64 = 0.02;
/// Pixels a decade needs for labels at 1, 2 and 5.
const ROOMY_DECADE: f64 = 130.0;
/// Pixels a decade needs for labels at 1, 2, 3, 5 and 7.
const WIDE_DECADE: f64 = 420.0;
/// Pixels a decade needs for labels at 1 to 9.
const VAST_DECADE: f64 = 1100.0;
/// Pixels a labelled decade needs.
const NARROW_DECADE: f64 = 44.0;
/// Pixels a decade needs to show its minor grid lines.
const MINOR_DECADE: f64 = 36.0;

impl Steps {
    /// The smallest good step that is at least `rough`.
    fn at_least(self, rough: f64) -> f64 {
        let special: &[f64] = match self {
            Self::Decimal => &[],
            Self::Decibels => &[5.0, 10.0, 20.0, 40.0, 60.0, 100.0],
            Self::Degrees => &[5.0, 10.0, 15.0, 45.0, 90.0, 180.0, 360.0],
        };
        if rough > 2.0 {
            if let Some(step) = special.iter().find(|step| **step >= rough) {
                return *step;
            }
            if self == Self::Degrees {
                return 360.0 * (rough / 360.0).ceil();
            }
        }
        let decade = 10f64.powi(exponent(rough));
        [1.0, 2.0, 5.0]
            .iter()
            .map(|m| m * decade)
            .find(|step| *step >= rough * (1.0 - 1e-12))
            .unwrap_or(10.0 * decade)
    }
}

impl Ruler {
    /// A linear axis over `low..high` with about `count` ticks; `snap` moves its ends outward to
    /// the next tick or half way between two.
    pub(crate) fn linear((low, high): (f64, f64), steps: Steps, count: f64, snap: bool) -> Self {
        let step = steps.at_least((high - low) / count);
        let (mut low, mut high) = (low, high);
        if snap {
            let (half, pad) = (step / 2.0, SNAP_PAD * (high - low));
            // Zero is a natural end: data that stop there need no pad.
            let (bottom, top) = (
                if low == 0.0 { 0.0 } else { low - pad },
                if high == 0.0 { 0.0 } else { high + pad },
            );
            low = (bottom / half + 1e-9).floor() * half;
            high = (top / half - 1e-9).ceil() * half;
        }
        let (first, last) = ((low / step - 1e-9).ceil(), (high / step + 1e-9).floor());
        let places: Vec<f64> = (0..MAX_TICKS)
            .map(|k| first + k as f64)
            .take_while(|k| *k <= last)
            .map(|k| k * step)
            .collect();
        let size = exponent(low.abs().max(high.abs()));
        let factor = (steps == Steps::Decimal && !(-3..5).contains(&size)).then_some(size);
        // In two steps: the divisor alone may not be representable.
        let unit = |v: f64| factor.map_or(v, |e| v / 10f64.powi(e / 2) / 10f64.powi(e - e / 2));
        let decimals = decimals(unit(step));
        let ticks =
            places.iter().map(|at| Tick { at: *at, label: fixed(unit(*at), decimals) }).collect();
        Self { scale: Scale::Linear, low, high, ticks, minor: Vec::new(), factor }
    }

    /// A logarithmic axis over `low..high` that is `length` pixels long.
    pub(crate) fn log((low, high): (f64, f64), length: f64) -> Self {
        let decades = (high / low).log10();
        let decade = length / decades;
        let labelled: &[f64] = match decade {
            d if d >= VAST_DECADE => &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0],
            d if d >= WIDE_DECADE => &[1.0, 2.0, 3.0, 5.0, 7.0],
            d if d >= ROOMY_DECADE => &[1.0, 2.0, 5.0],
            _ => &[1.0],
        };
        #[expect(clippy::cast_possible_truncation, reason = "at most 600 decades over a pixel")]
        let stride = (NARROW_DECADE / decade).ceil().max(1.0) as i32;
        let inside = |v: f64| v >= low * (1.0 - 1e-9) && v <= high * (1.0 + 1e-9);
        let plain = low >= 1e-3 && high <= 1e5 * (1.0 + 1e-9);
        let (mut ticks, mut minor) = (Vec::new(), Vec::new());
        for e in exponent(low)..=exponent(high) {
            for m in 1..=9 {
                let mantissa = f64::from(m);
                let at = mantissa * 10f64.powi(e);
                if !inside(at) {
                    continue;
                }
                let on_stride = e.rem_euclid(stride) == 0;
                if labelled.contains(&mantissa) && on_stride {
                    ticks.push(Tick { at, label: log_label(m, e, plain) });
                } else if (m == 1) || (stride == 1 && decade >= MINOR_DECADE) {
                    minor.push(at);
                }
            }
        }
        if ticks.len() < 2 {
            let linear =
                Self::linear((low, high), Steps::Decimal, (length / 110.0).max(2.0), false);
            return Self { scale: Scale::Log, minor, ..linear };
        }
        Self { scale: Scale::Log, low, high, ticks, minor, factor: None }
    }

    /// The place of a value along the axis: 0 at the lower end, 1 at the upper.
    pub(crate) fn fraction(&self, value: f64) -> f64 {
        let (a, b) = (self.scale.forward(self.low), self.scale.forward(self.high));
        (self.scale.forward(value) - a) / (b - a)
    }
}

/// The decimals that show every multiple of `step`.
fn decimals(step: f64) -> i32 {
    (0..12)
        .find(|d| {
            (step * 10f64.powi(*d)).round() * 10f64.powi(-d) >= step * (1.0 - 1e-6)
                && ((step * 10f64.powi(*d)) - (step * 10f64.powi(*d)).round()).abs() < 1e-6
        })
        .unwrap_or(12)
}

fn log_label(mantissa: i32, e: i32, plain: bool) -> String {
    match (plain, mantissa) {
        (true, m) => fixed(f64::from(m) * 10f64.powi(e), -e),
        (false, 1) => power_of_ten(e),
        (false, m) => format!("{m}×{}", power_of_ten(e)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(ruler: &Ruler) -> Vec<&str> {
        ruler.ticks.iter().map(|t| t.label.as_str()).collect()
    }

    #[test]
    fn phases_take_multiples_of_45_and_90() {
        assert_eq!(
            labels(&Ruler::linear((-188.0, 4.0), Steps::Degrees, 6.0, true)),
            ["−180", "−135", "−90", "−45", "0"]
        );
        assert_eq!(
            labels(&Ruler::linear((-350.0, -10.0), Steps::Degrees, 6.0, true)),
            ["−360", "−270", "−180", "−90", "0"]
        );
    }

    #[test]
    fn decibels_snap_outward() {
        let ruler = Ruler::linear((-37.0, 41.0), Steps::Decibels, 6.0, true);
        assert_eq!(labels(&ruler), ["−40", "−20", "0", "20", "40"]);
        assert_eq!((ruler.low, ruler.high), (-40.0, 50.0));
        assert_eq!(
            labels(&Ruler::linear((0.1, 0.32), Steps::Decibels, 5.0, false)),
            ["0.10", "0.15", "0.20", "0.25", "0.30"]
        );
    }

    #[test]
    fn large_and_small_numbers_share_a_factor() {
        let ruler = Ruler::linear((0.0, 4.2e-5), Steps::Decimal, 5.0, true);
        assert_eq!((ruler.factor, labels(&ruler)), (Some(-5), vec!["0", "1", "2", "3", "4"]));
    }

    #[test]
    fn decades_and_what_stands_between() {
        assert_eq!(
            labels(&Ruler::log((0.09, 120.0), 600.0)),
            ["0.1", "0.2", "0.5", "1", "2", "5", "10", "20", "50", "100"]
        );
        assert_eq!(
            labels(&Ruler::log((0.01, 0.3), 650.0)),
            ["0.01", "0.02", "0.03", "0.05", "0.07", "0.1", "0.2", "0.3"]
        );
        assert_eq!(
            labels(&Ruler::log((0.9, 1.2e6), 600.0)),
            ["10⁰", "10¹", "10²", "10³", "10⁴", "10⁵", "10⁶"]
        );
        assert_eq!(labels(&Ruler::log((10.1, 10.9), 600.0)), ["10.2", "10.4", "10.6", "10.8"]);
        let many = Ruler::log((1e-300, 1e300), 600.0);
        assert!(
            (2..20).contains(&many.ticks.len()) && many.minor.len() < 700,
            "{}",
            many.ticks.len()
        );
    }
}
