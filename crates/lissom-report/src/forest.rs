//! Error bars of several quantities beside each other: each 95 % interval relative to its estimate.

use std::fmt::Write as _;

use crate::page_parts::KeyFigure;

/// Width and height of a row's picture.
const SIZE: (f64, f64) = (120.0, 18.0);
/// Free space at the ends.
const MARGIN: f64 = 8.0;
/// Half height of the ends of a bar.
const END: f64 = 4.0;
/// Axes show at most this relative deviation; longer bars end in an arrow.
const MOST: f64 = 0.5;
/// Relative deviations below are drawn as this.
const LEAST: f64 = 1e-6;

/// The axis that all rows share: relative deviations from minus to plus this.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ForestAxis(f64);

impl ForestAxis {
    /// The axis of figures: the longest bar, and the furthest known value, up to a limit. None without a bar.
    pub(crate) fn of(figures: &[KeyFigure]) -> Option<Self> {
        let longest = figures
            .iter()
            .filter_map(relative)
            .flat_map(|bar| [bar.low.abs(), bar.high.abs(), bar.known.map_or(0.0, f64::abs)]);
        let most = longest.filter(|size| *size <= MOST).fold(0.0, f64::max);
        let any = figures.iter().any(|figure| relative(figure).is_some());
        any.then_some(Self(if most > 0.0 { nice(most) } else { MOST }))
    }

    /// The end of the axis in percent.
    pub(crate) fn percent(self) -> String {
        let percent = 100.0 * self.0;
        if percent >= 1.0 { format!("{percent:.0}") } else { percent.to_string() }
    }

    /// A row's picture; none without an estimate, or if it is zero.
    pub(crate) fn row(self, figure: &KeyFigure) -> Option<String> {
        let bar = relative(figure)?;
        let (width, height) = SIZE;
        let (center, middle) = (width / 2.0, height / 2.0);
        let reach = center - MARGIN;
        let at = |deviation: f64| center + reach * (deviation / self.0).clamp(-1.0, 1.0);
        let (left, right) = (at(bar.low), at(bar.high));
        let half = 100.0 * bar.low.abs().max(bar.high.abs());
        let mut svg = format!(
            "<svg class=\"forest\" role=\"img\" aria-label=\"95 % interval ±{half:.2} %\" viewBox=\"0 0 {width} {height}\" \
             width=\"{width}\" height=\"{height}\"><path class=\"axis\" d=\"M{center} 0V{height}\"/>\
             <path class=\"bar\" d=\"M{left:.1} {middle}H{right:.1}"
        );
        for (place, deviation, inward) in [(left, bar.low, 1.0), (right, bar.high, -1.0)] {
            let tip = place + inward * END;
            let (top, bottom) = (middle - END, middle + END);
            let _ = if deviation.abs() > self.0 {
                write!(svg, "M{tip:.1} {top}L{place:.1} {middle}L{tip:.1} {bottom}")
            } else {
                write!(svg, "M{place:.1} {top}V{bottom}")
            };
        }
        let _ = write!(svg, "\"/><circle cx=\"{center}\" cy=\"{middle}\" r=\"3\"/>");
        if let Some(known) = bar.known.filter(|known| known.abs() <= self.0) {
            let (x, top) = (at(known), middle - 6.0);
            let _ = write!(
                svg,
                "<path class=\"known\" d=\"M{x:.1} {top}l4 6l-4 6l-4 -6z\"><title>known value</title></path>"
            );
        }
        svg.push_str("</svg>");
        Some(svg)
    }
}

/// The ends of an interval, and the known value, relative to the estimate.
struct Relative {
    low: f64,
    high: f64,
    known: Option<f64>,
}

fn relative(figure: &KeyFigure) -> Option<Relative> {
    let value = figure.value.filter(|value| value.is_finite() && *value != 0.0)?;
    let [low, high] = figure.ci95.filter(|ends| ends.iter().all(|end| end.is_finite()))?;
    let of = |end: f64| (end - value) / value.abs();
    let known = figure.known.map(of).filter(|known| known.is_finite());
    Some(Relative { low: of(low).min(-LEAST), high: of(high).max(LEAST), known })
}

/// The next of 1, 2, 5, 10, … from a size on.
fn nice(size: f64) -> f64 {
    let power = 10f64.powi(size.log10().floor() as i32);
    let step = [1.0, 2.0, 5.0].into_iter().find(|step| step * power >= size * (1.0 - 1e-9));
    step.unwrap_or(10.0) * power
}

#[cfg(test)]
mod tests {
    use super::*;

    fn figure(value: f64, half: f64) -> KeyFigure {
        let ci95 = Some([value - half, value + half]);
        KeyFigure { value: Some(value), ci95, ..KeyFigure::default() }
    }

    #[test]
    fn bars_share_an_axis() {
        let mut all =
            [figure(2.0, 0.06), figure(-1.0, 0.01), figure(1.0, 3.0), KeyFigure::default()];
        let axis = ForestAxis::of(&all).unwrap();
        assert_eq!((axis, axis.percent().as_str()), (ForestAxis(0.05), "5"));
        // 52 units are 5 %: the bar of 3 % ends at 60 + 31.2.
        assert!(axis.row(&all[0]).unwrap().contains("M28.8 9H91.2M28.8 5V13M91.2 5V13"));
        // Longer bars end in arrows.
        assert!(axis.row(&all[2]).unwrap().contains("M12.0 5L8.0 9L12.0 13"));
        assert_eq!(axis.row(&all[3]), None);
        all[0].known = Some(2.05);
        assert!(axis.row(&all[0]).unwrap().contains("class=\"known\" d=\"M86.0 3"));
        assert_eq!(ForestAxis::of(&all[3..]), None);
        assert_eq!(ForestAxis::of(&[figure(1.0, 0.002)]).unwrap().percent(), "0.2");
    }
}
