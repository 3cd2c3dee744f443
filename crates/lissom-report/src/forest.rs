//! Error bars of several quantities beside each other: each 95 % interval relative to its estimate.

use std::fmt::Write as _;

use lissom_text::significant;

use crate::html::escape;
use crate::page_parts::KeyFigure;

/// Width and height of a row's picture.
const SIZE: (f64, f64) = (120.0, 18.0);
/// Free space at the ends.
const MARGIN: f64 = 8.0;
/// Half height of the ends of a bar.
const END: f64 = 4.0;
/// Axes show at most this relative deviation; longer bars end in an arrow.
const MOST: f64 = 0.5;
/// Width of the names of results.
const NAME: f64 = 24.0;
/// Width of the end of an axis in words.
const SCALE: f64 = 70.0;
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

    /// The axis of a parameter in several results, relative to the first one.
    fn of_bars(bars: &[Option<[f64; 3]>]) -> Self {
        let sizes = bars.iter().flatten().flatten().map(|end| end.abs());
        let most = sizes.filter(|size| *size <= MOST).fold(0.0, f64::max);
        Self(if most > 0.0 { nice(most) } else { MOST })
    }

    /// A picture of a parameter with a bar for each result, from above, and the end of its axis; none without a first result.
    pub(crate) fn side_by_side(names: &[String], row: &[Option<[f64; 3]>]) -> Option<String> {
        let bars = relative_to_first(row)?;
        Some(Self::of_bars(&bars).picture(names, &bars))
    }

    fn picture(self, names: &[String], bars: &[Option<[f64; 3]>]) -> String {
        let width = NAME + SIZE.0 + SCALE;
        let height = SIZE.1 * bars.len() as f64;
        let center = NAME + SIZE.0 / 2.0;
        let reach = SIZE.0 / 2.0 - MARGIN;
        let at = |deviation: f64| center + reach * (deviation / self.0).clamp(-1.0, 1.0);
        let mut svg = format!(
            "<svg class=\"forest\" role=\"img\" aria-label=\"95 % intervals\" viewBox=\"0 0 {width} {height}\" \
             width=\"{width}\" height=\"{height}\"><path class=\"axis\" d=\"M{center} 0V{height}\"/>"
        );
        for (k, (bar, name)) in bars.iter().zip(names).enumerate() {
            let Some([low, value, high]) = bar else { continue };
            let middle = SIZE.1 * (k as f64 + 0.5);
            let _ = write!(
                svg,
                "<text x=\"0\" y=\"{:.1}\" font-size=\"11\" fill=\"currentColor\">{}</text><path d=\"M{:.1} {middle}H{:.1}",
                middle + END,
                escape(name),
                at(*low),
                at(*high)
            );
            // Of a bar beyond the axis only the arrow towards it is drawn.
            if *low <= self.0 {
                self.end(&mut svg, at(*low), middle, 1.0, *low);
            }
            if *high >= -self.0 {
                self.end(&mut svg, at(*high), middle, -1.0, *high);
            }
            svg.push_str("\"/>");
            if value.abs() <= self.0 {
                let _ = write!(svg, "<circle cx=\"{:.1}\" cy=\"{middle}\" r=\"3\"/>", at(*value));
            }
        }
        let _ = write!(
            svg,
            "<text x=\"{}\" y=\"{:.1}\" font-size=\"11\" fill=\"currentColor\">± {} %</text></svg>",
            NAME + SIZE.0,
            height / 2.0 + END,
            significant(100.0 * self.0, 1)
        );
        svg
    }

    /// Draws the end of a bar, an arrow if the deviation is beyond the axis.
    fn end(self, svg: &mut String, place: f64, middle: f64, inward: f64, deviation: f64) {
        let (tip, top, bottom) = (place + inward * END, middle - END, middle + END);
        let _ = if deviation.abs() > self.0 {
            write!(svg, "M{tip:.1} {top}L{place:.1} {middle}L{tip:.1} {bottom}")
        } else {
            write!(svg, "M{place:.1} {top}V{bottom}")
        };
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
            self.end(&mut svg, place, middle, inward, deviation);
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

/// Intervals with their values, relative to the first value; none if that is missing or its interval contains zero.
fn relative_to_first(row: &[Option<[f64; 3]>]) -> Option<Vec<Option<[f64; 3]>>> {
    let [low, first, high] = row.first().copied().flatten()?;
    if low <= 0.0 && high >= 0.0 || !first.is_finite() {
        return None;
    }
    let relative = |interval: [f64; 3]| {
        let all = interval.map(|value| (value - first) / first.abs());
        all.iter().all(|value| value.is_finite()).then_some(all)
    };
    Some(row.iter().map(|interval| interval.and_then(relative)).collect())
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

    #[test]
    fn results_are_drawn_relative_to_the_first() {
        let names = ["A", "B"].map(str::to_owned);
        let row = [Some([1.99, 2.0, 2.01]), Some([2.06, 2.08, 2.1])];
        let picture = |row: &[Option<[f64; 3]>]| ForestAxis::side_by_side(&names, row);
        let svg = picture(&row).unwrap();
        assert!(svg.contains(">± 5 %</text>"), "{svg}");
        // 52 units are 5 %: B is 4 % above A, whose value is at 84.
        assert!(svg.contains(r#"<circle cx="84.0" cy="9" r="3"/>"#), "{svg}");
        assert!(svg.contains(r#"<circle cx="125.6" cy="27" r="3"/>"#), "{svg}");
        assert_eq!(picture(&[None, row[0]]), None);
        // Nothing is relative to a value that may be zero.
        assert_eq!(picture(&[Some([-0.1, 0.1, 0.3]), row[0]]), None);
        // A bar beyond the axis is an arrow: its end is at 136, and no circle is drawn.
        let far = picture(&[row[0], Some([3.1, 3.2, 3.3])]).unwrap();
        assert!(far.contains("H136.0M132.0 23L136.0 27L132.0 31\"/><text"), "{far}");
    }
}
