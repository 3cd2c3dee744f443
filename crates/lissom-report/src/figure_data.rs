//! What an interactive drawing of a figure needs, as JSON.

use serde::Serialize;

use crate::marks::Mark;
use crate::packed::Packed;
use crate::palette::Role;
use crate::scale::Scale;
use crate::trace::{Axis, Band, Quantity, Region, TraceStyle};

/// Most points of a line of a figure on its own.
pub(crate) const POINTS_MOST: usize = 2000;
/// Digits of numbers after the first.
const DIGITS: usize = 6;

/// What an interactive drawing of a figure needs. All points that the SVG shows, but for those of long lines.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FigureData {
    /// The title.
    pub title: String,
    /// A line below the title.
    pub subtitle: Option<String>,
    /// The horizontal axis of all panels.
    pub x: AxisData,
    /// Figures with the same name here show the same part of the horizontal axis.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub linked: Option<String>,
    /// The panels, from the top.
    pub panels: Vec<PanelData>,
    /// Points that cannot be drawn.
    pub skipped: usize,
}

/// An axis.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AxisData {
    /// The quantity with its unit.
    pub label: String,
    /// `linear` or `log`.
    pub scale: &'static str,
    /// `frequency` (rad/s), `decibels`, `degrees`, or `plain`: which other units the reader can choose.
    pub quantity: &'static str,
    /// The ends of the axis, if they are fixed.
    pub range: Option<[f64; 2]>,
}

/// What is over one vertical axis.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PanelData {
    /// The vertical axis.
    pub y: AxisData,
    /// The traces.
    pub traces: Vec<TraceData>,
    /// Horizontal bands.
    pub bands: Vec<BandData>,
    /// Shaded intervals of the horizontal axis.
    pub regions: Vec<RegionData>,
}

/// A trace.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct TraceData {
    /// The label in the legend.
    pub label: String,
    /// `raw`, `corrected`, `fitted`, `truth`, `pole`, `zero`, or `other0` and so on.
    pub role: String,
    /// `line`, `dashes`, `steps`, `points` or `columns`.
    pub style: &'static str,
    /// The abscissae.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub x: Vec<f64>,
    /// The ordinates; a line stops where one is missing.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub y: Vec<Option<f64>>,
    /// The points of a sampled signal, in place of `x` and `y`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub packed: Option<Packed>,
    /// The lower ends of error bars.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub low: Vec<Option<f64>>,
    /// The upper ends of error bars.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub high: Vec<Option<f64>>,
    /// The left ends of error bars of the abscissae.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub left: Vec<Option<f64>>,
    /// The right ends of error bars of the abscissae.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub right: Vec<Option<f64>>,
    /// Places of points with which something is wrong.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub flagged: Vec<usize>,
    /// Number of points before some were left out; none if all are here.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub points: Option<usize>,
}

/// A horizontal band.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BandData {
    /// The label in the legend.
    pub label: String,
    /// As in [`TraceData`].
    pub role: String,
    /// The value.
    pub middle: f64,
    /// The lower end.
    pub low: f64,
    /// The upper end.
    pub high: f64,
}

/// A shaded interval of the horizontal axis.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RegionData {
    /// The label in the legend.
    pub label: String,
    /// As in [`TraceData`].
    pub role: String,
    /// The left end.
    pub from: f64,
    /// The right end.
    pub to: f64,
}

impl AxisData {
    pub(crate) fn of(axis: &Axis) -> Self {
        let range = axis.range.map(|(low, high)| [low, high]);
        Self {
            label: axis.label.clone(),
            scale: axis.scale.name(),
            quantity: axis.quantity.name(),
            range,
        }
    }
}

impl BandData {
    pub(crate) fn of(band: &Band) -> Self {
        let (label, role) = (band.label.clone(), band.role.name());
        Self {
            label,
            role,
            middle: short(band.middle),
            low: short(band.low),
            high: short(band.high),
        }
    }
}

impl RegionData {
    pub(crate) fn of(region: &Region) -> Self {
        let (label, role) = (region.label.clone(), region.role.name());
        Self { label, role, from: short(region.from), to: short(region.to) }
    }
}

impl TraceData {
    /// A trace of marks. Lines have at most about so many points.
    pub(crate) fn of(
        label: &str,
        role: Role,
        style: TraceStyle,
        marks: &[Mark],
        most: usize,
    ) -> Self {
        let is_line = matches!(style, TraceStyle::Line | TraceStyle::Dashes | TraceStyle::Steps);
        if let Some((packed, whole)) = is_line.then(|| Packed::of(marks, most)).flatten() {
            return Self {
                label: label.to_owned(),
                role: role.name(),
                style: style.name(),
                packed: Some(packed),
                points: (!whole).then_some(marks.len()),
                ..Self::default()
            };
        }
        let kept = if is_line { thinned(marks, most) } else { marks.to_vec() };
        let mut trace = Self {
            label: label.to_owned(),
            role: role.name(),
            style: style.name(),
            points: (kept.len() < marks.len()).then_some(marks.len()),
            ..Self::default()
        };
        let has_bars = marks.iter().any(|mark| mark.bar.is_some());
        let has_bars_across = marks.iter().any(|mark| mark.across.is_some());
        let finite = |end: f64| end.is_finite().then(|| short(end));
        let mut put = |x: f64, y: Option<f64>, bar: Option<(f64, f64)>, across| {
            trace.x.push(short(x));
            trace.y.push(y.map(short));
            if has_bars {
                trace.low.push(bar.and_then(|(low, _)| finite(low)));
                trace.high.push(bar.and_then(|(_, high)| finite(high)));
            }
            if has_bars_across {
                let across: Option<(f64, f64)> = across;
                trace.left.push(across.and_then(|(left, _)| finite(left)));
                trace.right.push(across.and_then(|(_, right)| finite(right)));
            }
        };
        let mut flagged = Vec::new();
        let mut place = 0;
        for (k, mark) in kept.iter().enumerate() {
            if is_line && mark.after_gap && k > 0 {
                put(mark.x, None, None, None);
                place += 1;
            }
            put(mark.x, Some(mark.y), mark.bar, mark.across);
            if mark.flagged {
                flagged.push(place);
            }
            place += 1;
        }
        trace.flagged = flagged;
        trace
    }
}

/// The marks of a line that show it: all of a short one, or one that does not go from left to right.
fn thinned(marks: &[Mark], most: usize) -> Vec<Mark> {
    let rises = marks.is_sorted_by(|a, b| a.x <= b.x);
    let (Some(first), Some(last)) = (marks.first(), marks.last()) else { return Vec::new() };
    if marks.len() <= most || !rises || last.x <= first.x {
        return marks.to_vec();
    }
    // Four points of each part.
    let parts = (most / 4).max(1) as f64;
    let part = |mark: &Mark| (parts * (mark.x - first.x) / (last.x - first.x)).floor();
    let mut kept = Vec::new();
    for run in marks.chunk_by(|a, b| (part(a) - part(b)).abs() < 0.5 && !b.after_gap) {
        let place = |best: fn(f64, f64) -> bool| {
            (0..run.len()).fold(0, |k, j| if best(run[j].y, run[k].y) { j } else { k })
        };
        let mut places = [0, place(|a, b| a < b), place(|a, b| a > b), run.len() - 1];
        places.sort_unstable();
        let new = places.iter().enumerate().filter(|(k, p)| *k == 0 || places[k - 1] != **p);
        kept.extend(new.map(|(_, p)| run[*p]));
    }
    kept
}

/// A number with few digits.
fn short(value: f64) -> f64 {
    format!("{value:.DIGITS$e}").parse().unwrap_or(value)
}

impl Role {
    fn name(self) -> String {
        match self {
            Self::Raw => "raw".to_owned(),
            Self::Corrected => "corrected".to_owned(),
            Self::Fitted => "fitted".to_owned(),
            Self::Truth => "truth".to_owned(),
            Self::Pole => "pole".to_owned(),
            Self::Zero => "zero".to_owned(),
            Self::Other(k) => format!("other{}", k % 4),
        }
    }
}

impl TraceStyle {
    fn name(self) -> &'static str {
        match self {
            Self::Line => "line",
            Self::Dashes => "dashes",
            Self::Steps => "steps",
            Self::Points | Self::PointsWithBars => "points",
            Self::Columns => "columns",
        }
    }
}

impl Scale {
    fn name(self) -> &'static str {
        match self {
            Self::Linear => "linear",
            Self::Log => "log",
        }
    }
}

impl Quantity {
    fn name(self) -> &'static str {
        match self {
            Self::Plain => "plain",
            Self::FrequencyRadPerSecond => "frequency",
            Self::Decibels => "decibels",
            Self::Degrees => "degrees",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mark(x: f64, y: f64) -> Mark {
        Mark { x, y, bar: None, across: None, flagged: false, after_gap: false }
    }

    #[test]
    fn long_lines_keep_their_extremes_and_say_how_long_they_were() {
        let marks: Vec<Mark> = (0..100_000)
            .map(|k| (f64::from(k), if k == 51_234 { 9.0 } else { f64::from(k % 7) }))
            .map(|(k, y)| mark(k * k, y))
            .collect();
        let line = TraceData::of("a", Role::Raw, TraceStyle::Line, &marks, POINTS_MOST);
        assert!(line.x.len() <= POINTS_MOST && line.points == Some(100_000), "{}", line.x.len());
        assert!(line.y.contains(&Some(9.0)));
        let points = TraceData::of("a", Role::Raw, TraceStyle::Points, &marks, POINTS_MOST);
        assert_eq!((points.x.len(), points.points), (100_000, None));
    }

    #[test]
    fn gaps_bars_and_flags() {
        let mut marks = [mark(0.0, 1.0), mark(1.0, 2.0), mark(2.0, 1.0 / 3.0)];
        marks[1].after_gap = true;
        marks[2].flagged = true;
        let line = TraceData::of("", Role::Other(5), TraceStyle::Line, &marks, 9);
        assert_eq!(line.y, [Some(1.0), None, Some(2.0), Some(0.333_333_3)]);
        assert_eq!((line.flagged, line.role.as_str(), line.low.len()), (vec![3], "other1", 0));
        marks[0].bar = Some((0.5, f64::INFINITY));
        let points = TraceData::of("", Role::Raw, TraceStyle::PointsWithBars, &marks, 9);
        assert_eq!(points.low, [Some(0.5), None, None]);
        assert_eq!(points.high, [None, None, None]);
    }
}
