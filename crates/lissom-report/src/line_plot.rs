//! Plots over one pair of axes: friction against frequency, residuals, time traces.

use crate::axis::{Ruler, Steps};
use crate::canvas::{Anchor, Canvas, Drawing, Rect, Stroke, TextStyle};
use crate::figure_error::FigureError;
use crate::figure_trait::{Figure, Sealed};
use crate::font::Weight;
use crate::legend::{Entry, Sample, header, skipped_note};
use crate::marks::{Mark, with_bars};
use crate::palette::{DASHES, FAINT_INK, INK, Role, WHITE};
use crate::panel::{LINE_WIDTH, Panel, TICK_SIZE, X_AXIS_HEIGHT};
use crate::png_writer::png;
use crate::scale::{Scale, extent};
use crate::svg_writer::svg;
use crate::text_fit::width;
use crate::trace::{Axis, Band, Trace, TraceStyle};

const SHEET_WIDTH: f64 = 760.0;
const RIGHT_MARGIN: f64 = 24.0;
const HEIGHT: f64 = 300.0;
/// The part of the distance between neighbours that a column fills.
const COLUMN_FILL: f64 = 0.7;
/// The widest column.
const MAX_COLUMN: f64 = 44.0;

/// Traces and bands over one pair of axes.
///
/// Points that are not finite, or not positive on a logarithmic axis, are left out, and a note below the figure counts them;
/// lines stop there. A band that cannot be drawn is left out of figure and legend.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LinePlot {
    /// The title.
    pub title: String,
    /// A line below the title.
    pub subtitle: Option<String>,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// The traces.
    pub traces: Vec<Trace>,
    /// The bands, below the traces.
    pub bands: Vec<Band>,
}

impl LinePlot {
    /// A plot without traces.
    pub fn new(title: impl Into<String>, x: Axis, y: Axis) -> Self {
        Self { title: title.into(), x, y, ..Self::default() }
    }

    /// Adds a line below the title.
    #[must_use]
    pub fn subtitle(mut self, subtitle: impl Into<String>) -> Self {
        self.subtitle = Some(subtitle.into());
        self
    }

    /// Adds a trace.
    #[must_use]
    pub fn trace(mut self, trace: Trace) -> Self {
        self.traces.push(trace);
        self
    }

    /// Adds a band.
    #[must_use]
    pub fn band(mut self, band: Band) -> Self {
        self.bands.push(band);
        self
    }

    fn drawable_bands(&self) -> impl Iterator<Item = &Band> {
        let ordered = |b: &&Band| b.low <= b.middle && b.middle <= b.high;
        self.bands
            .iter()
            .filter(|b| [b.low, b.middle, b.high].iter().all(|v| self.y.scale.admits(*v)))
            .filter(ordered)
    }

    fn entries(&self) -> Vec<Entry> {
        let traces = self
            .traces
            .iter()
            .filter(|t| !t.x.is_empty())
            .map(|t| Entry { sample: t.sample(), label: t.label.clone() });
        let bands = self
            .drawable_bands()
            .map(|b| Entry { sample: Sample::Band(b.role), label: b.label.clone() });
        let mut entries: Vec<Entry> = traces.chain(bands).collect();
        if self.traces.iter().filter_map(|t| t.flagged.as_ref()).flatten().any(|f| *f) {
            entries.push(Entry { sample: Sample::Flagged, label: "flagged".to_owned() });
        }
        entries
    }

    /// The vertical range: all points, their bars within reason, the bands, and zero where columns stand on it.
    fn y_range(&self, marks: &[Vec<Mark>]) -> Option<(f64, f64)> {
        let columns = self.traces.iter().any(|t| t.style == TraceStyle::Columns)
            && self.y.scale == Scale::Linear;
        let points = with_bars(&marks.iter().flatten().collect::<Vec<_>>());
        let points = points.map(|(low, high)| {
            if self.y.scale == Scale::Linear {
                (low, high)
            } else {
                self.positive(marks, (low, high))
            }
        });
        let ends = points.into_iter().flat_map(|(a, b)| [a, b]);
        extent(
            ends.chain(self.drawable_bands().flat_map(|b| [b.low, b.high]))
                .chain(columns.then_some(0.0)),
        )
    }

    /// A range for a logarithmic axis: error bars that reach zero do not count.
    fn positive(&self, marks: &[Vec<Mark>], (low, high): (f64, f64)) -> (f64, f64) {
        let lowest = extent(marks.iter().flatten().map(|m| m.y)).map_or(low, |(lowest, _)| lowest);
        (if low >= lowest / 3.0 && self.y.scale.admits(low) { low } else { lowest }, high)
    }

    /// The ends of both axes.
    fn ranges(&self, marks: &[Vec<Mark>], skipped: usize) -> Result<[(f64, f64); 2], FigureError> {
        let nothing = || FigureError::NothingToDraw { title: self.title.clone(), skipped };
        let x = extent(marks.iter().flatten().map(|m| m.x)).ok_or_else(nothing)?;
        let lines = self
            .traces
            .iter()
            .all(|t| matches!(t.style, TraceStyle::Line | TraceStyle::Dashes | TraceStyle::Steps));
        // Lines may run from edge to edge; markers want room.
        let x = if lines && self.x.scale == Scale::Linear {
            Scale::Linear.widened(x, 0.0)
        } else {
            self.x.scale.padded(x, 0.0)
        };
        let y = self.y.scale.widened(self.y_range(marks).ok_or_else(nothing)?, 0.0);
        Ok([self.x.fixed_range()?.unwrap_or(x), self.y.fixed_range()?.unwrap_or(y)])
    }

    fn draw_data(&self, canvas: &mut Canvas, panel: &Panel, marks: &[Vec<Mark>]) {
        for band in self.drawable_bands() {
            let ((_, top), (_, bottom), (_, y)) = (
                panel.at(panel.x.low, band.high),
                panel.at(panel.x.low, band.low),
                panel.at(panel.x.low, band.middle),
            );
            canvas.rect(
                Rect {
                    left: panel.frame.left,
                    top,
                    width: panel.frame.width,
                    height: bottom - top,
                },
                band.role.colour(),
                0.16,
            );
            canvas.lines(
                [[(panel.frame.left, y), (panel.frame.right(), y)]],
                Stroke { colour: band.role.colour(), width: 1.5, dash: None },
            );
        }
        let drawn = || self.traces.iter().zip(marks);
        for (trace, marks) in drawn() {
            match trace.style {
                TraceStyle::Line => panel.curve(canvas, marks, trace.role, false),
                TraceStyle::Dashes => {
                    let colour = trace.role.colour();
                    let stroke = Stroke { colour, width: LINE_WIDTH, dash: Some(DASHES) };
                    panel.curve_in(canvas, marks, stroke, false);
                }
                TraceStyle::Steps => panel.curve(canvas, marks, trace.role, true),
                TraceStyle::Columns => columns(canvas, panel, marks, trace.role),
                TraceStyle::Points | TraceStyle::PointsWithBars => {}
            }
        }
        for (trace, marks) in drawn() {
            // On a column the bar must stand out from the fill.
            panel.bars(
                canvas,
                marks,
                if trace.style == TraceStyle::Columns { Role::Fitted } else { trace.role },
            );
            panel.points(
                canvas,
                marks,
                trace.role,
                matches!(trace.style, TraceStyle::Points | TraceStyle::PointsWithBars),
            );
        }
    }

    fn drawing(&self) -> Result<Drawing, FigureError> {
        let (mut marks, mut skipped) = (Vec::new(), 0);
        for trace in &self.traces {
            let (drawable, left_out) = trace.marks([self.x.scale, self.y.scale])?;
            skipped += left_out;
            marks.push(drawable);
        }
        let [x_range, y_range] = self.ranges(&marks, skipped)?;
        let y = match self.y.scale {
            Scale::Linear => Ruler::linear(y_range, Steps::Decimal, 6.0, self.y.range.is_none()),
            Scale::Log => Ruler::log(
                if self.y.range.is_none() { Scale::Log.padded(y_range, 0.0) } else { y_range },
                HEIGHT,
            ),
        };
        let widest =
            y.ticks.iter().map(|t| width(&t.label, TICK_SIZE, Weight::Regular)).fold(0.0, f64::max);
        let left = 30.0 + widest + 14.0;
        let wide = SHEET_WIDTH - RIGHT_MARGIN - left;
        let x = match self.x.scale {
            Scale::Linear => Ruler::linear(x_range, Steps::Decimal, 8.0, false),
            Scale::Log => Ruler::log(x_range, wide),
        };
        let mut canvas = Canvas::default();
        let top = header(
            &mut canvas,
            (left, SHEET_WIDTH - RIGHT_MARGIN),
            &self.title,
            self.subtitle.as_deref(),
            &self.entries(),
        );
        // The power of ten stands above the frame.
        let top = top + if y.factor.is_some() { 18.0 } else { 0.0 };
        let panel = Panel { frame: Rect { left, top, width: wide, height: HEIGHT }, x, y };
        panel.grid(&mut canvas);
        canvas.clipped(panel.frame, |canvas| self.draw_data(canvas, &panel, &marks));
        panel.frame(&mut canvas);
        panel.y_labels(&mut canvas, &self.y.label, 22.0);
        panel.x_labels(&mut canvas, &self.x.label);
        let mut bottom = panel.frame.bottom() + X_AXIS_HEIGHT;
        if let Some(note) = skipped_note(skipped) {
            let style = TextStyle { colour: FAINT_INK, ..TextStyle::new(12.0, Anchor::End) };
            canvas.text((SHEET_WIDTH - RIGHT_MARGIN, bottom + 8.0), &note, style);
            bottom += 18.0;
        }
        Ok(canvas.finish(SHEET_WIDTH, bottom, &self.title))
    }
}

impl Sealed for LinePlot {}

impl Figure for LinePlot {
    fn to_svg(&self) -> Result<String, FigureError> {
        Ok(svg(&self.drawing()?))
    }

    fn to_png(&self, scale: f32) -> Result<Vec<u8>, FigureError> {
        png(&self.drawing()?, scale)
    }
}

/// Columns from zero, as wide as the closest neighbours allow.
fn columns(canvas: &mut Canvas, panel: &Panel, marks: &[Mark], role: Role) {
    let mut places: Vec<f64> = marks.iter().map(|m| panel.at(m.x, m.y).0).collect();
    places.sort_by(f64::total_cmp);
    let gaps = places.windows(2).map(|w| w[1] - w[0]).filter(|gap| *gap > 0.0);
    let width = (COLUMN_FILL * gaps.fold(f64::INFINITY, f64::min)).clamp(1.0, MAX_COLUMN);
    let foot = panel.at(panel.x.low, 0.0).1.min(panel.frame.bottom());
    for mark in marks {
        let (x, y) = panel.at(mark.x, mark.y);
        let (left, top, height) = (x - width / 2.0, y.min(foot), (y - foot).abs());
        let column = Rect { left, top, width, height };
        // White first: the grid must not show through.
        canvas.rect(column, WHITE, 1.0);
        canvas.rect(column, role.colour(), 0.8);
    }
    let line = [(panel.frame.left, foot), (panel.frame.right(), foot)];
    canvas.lines([line], Stroke { colour: INK, width: 1.0, dash: None });
}

#[cfg(test)]
#[path = "line_plot_tests.rs"]
mod tests;
