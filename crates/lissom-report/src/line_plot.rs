//! Plots over one pair of axes: friction against frequency, residuals, time traces.

use crate::axis::{Ruler, Steps};
use crate::canvas::{Anchor, Canvas, Drawing, Rect, Stroke, TextStyle};
use crate::figure_data::{AxisData, BandData, FigureData, PanelData, RegionData, TraceData};
use crate::figure_error::FigureError;
use crate::figure_trait::{Figure, Sealed};
use crate::font::Weight;
use crate::legend::{Entry, Sample, header, skipped_note};
use crate::marks::{Mark, with_bars};
use crate::palette::{DASHES, FAINT_INK, INK, Role, SHADE, WHITE};
use crate::panel::{LINE_WIDTH, Panel, TICK_SIZE, X_AXIS_HEIGHT};
use crate::pdf_writer::pdf;
use crate::png_writer::png;
use crate::scale::{Scale, extent};
use crate::svg_writer::svg;
use crate::text_fit::width;
use crate::trace::{Axis, Band, Region, Trace, TraceStyle};

const SHEET_WIDTH: f64 = 760.0;
const RIGHT_MARGIN: f64 = 24.0;
const HEIGHT: f64 = 300.0;
/// Between frames that are one above the other.
const FRAME_GAP: f64 = 16.0;
/// The part of the distance between neighbours that a column fills.
const COLUMN_FILL: f64 = 0.7;
/// The widest column.
const MAX_COLUMN: f64 = 44.0;

/// Traces, bands and regions over one pair of axes.
///
/// Points that are not finite, or not positive on a logarithmic axis, are left out, and a note below the figure counts
/// them; lines stop there. A band or region that cannot be drawn is left out of the figure and of the legend.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LinePlot {
    /// The title.
    pub title: String,
    /// A line below the title.
    pub subtitle: Option<String>,
    /// Interactive figures with the same name here show the same part of the horizontal axis.
    pub linked: Option<String>,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// The traces.
    pub traces: Vec<Trace>,
    /// The bands, below the traces.
    pub bands: Vec<Band>,
    /// The regions, below the bands. They do not widen the horizontal axis.
    pub regions: Vec<Region>,
}

impl LinePlot {
    /// A plot without traces.
    pub fn new(title: impl Into<String>, x: Axis, y: Axis) -> Self {
        Self { title: title.into(), x, y, ..Self::default() }
    }

    /// Links the horizontal axis with that of all figures that are linked by the same name.
    #[must_use]
    pub fn linked(mut self, name: impl Into<String>) -> Self {
        self.linked = Some(name.into());
        self
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

    /// Adds a region.
    #[must_use]
    pub fn region(mut self, region: Region) -> Self {
        self.regions.push(region);
        self
    }

    fn drawable_regions(&self) -> impl Iterator<Item = &Region> {
        self.regions
            .iter()
            .filter(|r| self.x.scale.admits(r.from) && self.x.scale.admits(r.to))
            .filter(|r| r.from < r.to)
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
        let regions = self
            .drawable_regions()
            .map(|r| Entry { sample: Sample::Region(r.role), label: r.label.clone() });
        let mut entries: Vec<Entry> = traces.chain(bands).chain(regions).collect();
        if self.traces.iter().filter_map(|t| t.flagged.as_ref()).flatten().any(|f| *f) {
            entries.push(Entry { sample: Sample::Flagged, label: "flagged".to_owned() });
        }
        entries
    }

    /// The vertical range: all points, their bars up to a limit, the bands, and zero if columns start there.
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
        // Lines may run from edge to edge; markers need a margin.
        let x = if lines && self.x.scale == Scale::Linear {
            Scale::Linear.widened(x, 0.0)
        } else {
            self.x.scale.padded(x, 0.0)
        };
        let y = self.y.scale.widened(self.y_range(marks).ok_or_else(nothing)?, 0.0);
        Ok([self.x.fixed_range()?.unwrap_or(x), self.y.fixed_range()?.unwrap_or(y)])
    }

    fn draw_data(&self, canvas: &mut Canvas, panel: &Panel, marks: &[Vec<Mark>]) {
        for region in self.drawable_regions() {
            let [left, right] = [region.from, region.to].map(|x| panel.at(x, panel.y.low).0);
            let frame = panel.frame;
            let shade = Rect { left, top: frame.top, width: right - left, height: frame.height };
            canvas.rect(shade, region.role.colour(), SHADE);
        }
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
                SHADE,
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

    /// The drawable points of every trace, and the count of the others.
    fn marks(&self) -> Result<(Vec<Vec<Mark>>, usize), FigureError> {
        let (mut marks, mut skipped) = (Vec::new(), 0);
        for trace in &self.traces {
            let (drawable, left_out) = trace.marks([self.x.scale, self.y.scale])?;
            skipped += left_out;
            marks.push(drawable);
        }
        Ok((marks, skipped))
    }

    /// The vertical axis over its range, `height` pixels long.
    fn y_ruler(&self, range: (f64, f64), height: f64) -> Ruler {
        let fixed = self.y.range.is_some();
        match self.y.scale {
            Scale::Linear => Ruler::linear(range, Steps::Decimal, 6.0, !fixed),
            Scale::Log => {
                Ruler::log(if fixed { range } else { Scale::Log.padded(range, 0.0) }, height)
            }
        }
    }

    fn drawing(&self) -> Result<Drawing, FigureError> {
        sheet(&self.title, self.subtitle.as_deref(), &[self], HEIGHT)
    }
}

/// Plots one above the other in frames of `height`, the axis labelled below the last one, the legend of all on top. The
/// horizontal axis covers the ranges of all.
pub(crate) fn sheet(
    title: &str,
    subtitle: Option<&str>,
    plots: &[&LinePlot],
    height: f64,
) -> Result<Drawing, FigureError> {
    let marks = plots.iter().map(|plot| plot.marks()).collect::<Result<Vec<_>, _>>()?;
    let skipped = marks.iter().map(|(_, skipped)| skipped).sum();
    let (mut x_ends, mut rulers, mut entries) = (Vec::new(), Vec::new(), Vec::new());
    for (plot, (marks, skipped)) in plots.iter().zip(&marks) {
        let [x_range, y_range] = plot.ranges(marks, *skipped)?;
        x_ends.extend([x_range.0, x_range.1]);
        rulers.push(plot.y_ruler(y_range, height));
        for entry in plot.entries() {
            if !entries.contains(&entry) {
                entries.push(entry);
            }
        }
    }
    let nothing = || FigureError::NothingToDraw { title: title.to_owned(), skipped };
    let (Some(last), Some(x_range)) = (plots.last(), extent(x_ends)) else { return Err(nothing()) };
    let labels = rulers.iter().flat_map(|y| &y.ticks);
    let widest = labels.map(|t| width(&t.label, TICK_SIZE, Weight::Regular)).fold(0.0, f64::max);
    let left = 30.0 + widest + 14.0;
    let right = SHEET_WIDTH - RIGHT_MARGIN;
    let x = match last.x.scale {
        Scale::Linear => Ruler::linear(x_range, Steps::Decimal, 8.0, false),
        Scale::Log => Ruler::log(x_range, right - left),
    };
    let mut canvas = Canvas::default();
    let mut top = header(&mut canvas, (left, right), title, subtitle, &entries);
    for ((k, (plot, (marks, _))), y) in plots.iter().zip(&marks).enumerate().zip(rulers) {
        // The power of ten is written above the frame.
        top += if y.factor.is_some() { 18.0 } else { 0.0 };
        let frame = Rect { left, top, width: right - left, height };
        let panel = Panel { frame, x: x.clone(), y };
        panel.grid(&mut canvas);
        canvas.clipped(frame, |canvas| plot.draw_data(canvas, &panel, marks));
        panel.frame(&mut canvas);
        panel.y_labels(&mut canvas, &plot.y.label, 22.0);
        if k + 1 == plots.len() {
            panel.x_labels(&mut canvas, &plot.x.label);
        }
        top += height + FRAME_GAP;
    }
    let mut bottom = top - FRAME_GAP + X_AXIS_HEIGHT;
    if let Some(note) = skipped_note(skipped) {
        let style = TextStyle { colour: FAINT_INK, ..TextStyle::new(12.0, Anchor::End) };
        canvas.text((right, bottom + 8.0), &note, style);
        bottom += 18.0;
    }
    Ok(canvas.finish(SHEET_WIDTH, bottom, title))
}

/// What an interactive drawing of plots one above the other needs.
pub(crate) fn sheet_data(
    title: &str,
    subtitle: Option<&str>,
    plots: &[&LinePlot],
    points: usize,
) -> Result<FigureData, FigureError> {
    let (mut panels, mut all) = (Vec::new(), 0);
    for plot in plots {
        let (marks, skipped) = plot.marks()?;
        all += skipped;
        let traces = plot.traces.iter().zip(&marks);
        let traces = traces.filter(|(_, marks)| !marks.is_empty());
        panels.push(PanelData {
            y: AxisData::of(&plot.y),
            traces: traces
                .map(|(t, marks)| TraceData::of(&t.label, t.role, t.style, marks, points))
                .collect(),
            bands: plot.drawable_bands().map(BandData::of).collect(),
            regions: plot.drawable_regions().map(RegionData::of).collect(),
        });
    }
    match plots.last() {
        Some(last) if panels.iter().any(|panel| !panel.traces.is_empty()) => Ok(FigureData {
            title: title.to_owned(),
            subtitle: subtitle.map(str::to_owned),
            x: AxisData::of(&last.x),
            linked: None,
            panels,
            skipped: all,
        }),
        _ => Err(FigureError::NothingToDraw { title: title.to_owned(), skipped: all }),
    }
}

impl Sealed for LinePlot {}

impl Figure for LinePlot {
    fn data(&self, points: usize) -> Result<FigureData, FigureError> {
        let data = sheet_data(&self.title, self.subtitle.as_deref(), &[self], points)?;
        Ok(FigureData { linked: self.linked.clone(), ..data })
    }

    fn to_svg(&self) -> Result<String, FigureError> {
        Ok(svg(&self.drawing()?))
    }

    fn to_png(&self, scale: f32) -> Result<Vec<u8>, FigureError> {
        png(&self.drawing()?, scale)
    }

    fn to_pdf(&self) -> Result<Vec<u8>, FigureError> {
        Ok(pdf(&self.drawing()?))
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
