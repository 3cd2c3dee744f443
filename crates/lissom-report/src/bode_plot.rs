//! Bode plots: magnitude in dB and phase in degrees over one logarithmic frequency axis.

use std::f64::consts::TAU;

use crate::axis::{Ruler, Steps};
use crate::bode_series::{FrequencyAxis, Series, Style};
use crate::canvas::{Anchor, Canvas, Drawing, Rect, TextStyle};
use crate::figure_data::{AxisData, FigureData, PanelData, TraceData};
use crate::figure_error::FigureError;
use crate::figure_trait::{Figure, Sealed};
use crate::font::Weight;
use crate::legend::{Entry, Sample, header, skipped_note};
use crate::marks::{Mark, with_bars};
use crate::palette::FAINT_INK;
use crate::panel::{Panel, TICK_SIZE, X_AXIS_HEIGHT};
use crate::pdf_writer::pdf;
use crate::phase::{Track, unwrap_together};
use crate::png_writer::png;
use crate::scale::{Scale, extent};
use crate::svg_writer::svg;
use crate::text_fit::width;
use crate::trace::{Axis, Quantity, TraceStyle};

const SHEET_WIDTH: f64 = 760.0;
const RIGHT_MARGIN: f64 = 24.0;
const MAGNITUDE_HEIGHT: f64 = 250.0;
const PHASE_HEIGHT: f64 = 210.0;
const PANEL_GAP: f64 = 16.0;
const TOP_AXIS_HEIGHT: f64 = 42.0;
/// The least magnitude range in dB: a smaller one would magnify rounding errors.
const LEAST_DB: f64 = 1.0;
/// The least phase range in degrees.
const LEAST_DEGREES: f64 = 10.0;
/// Name of the link of all frequency axes.
const FREQUENCIES: &str = "frequency";
/// Label of the lower axis.
const PHASE_LABEL: &str = "Phase (°)";

/// Magnitude and phase of frequency responses.
///
/// Phases are continuous along each series and never 360° apart between series: all are adjusted to the densest line,
/// or the longest series if there is no line. Points with a frequency that is not positive, a response of zero or one
/// that is not finite are left out, and a note below the figure counts them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BodePlot {
    /// The title.
    pub title: String,
    /// A line below the title.
    pub subtitle: Option<String>,
    /// What 0 dB means, for example `rad/A`; empty when the response has no unit.
    pub unit: String,
    /// What the frequency axis shows.
    pub frequency_axis: FrequencyAxis,
    /// The responses.
    pub series: Vec<Series>,
}

/// A series ready to draw.
struct Prepared<'a> {
    series: &'a Series,
    magnitude: Vec<Mark>,
    phase: Vec<Mark>,
}

impl BodePlot {
    /// A plot without series.
    pub fn new(title: impl Into<String>, unit: impl Into<String>) -> Self {
        Self { title: title.into(), unit: unit.into(), ..Self::default() }
    }

    /// Adds a line below the title.
    #[must_use]
    pub fn subtitle(mut self, subtitle: impl Into<String>) -> Self {
        self.subtitle = Some(subtitle.into());
        self
    }

    /// Chooses the frequency axis.
    #[must_use]
    pub fn frequency_axis(mut self, axis: FrequencyAxis) -> Self {
        self.frequency_axis = axis;
        self
    }

    /// Adds a series.
    #[must_use]
    pub fn series(mut self, series: Series) -> Self {
        self.series.push(series);
        self
    }

    /// The drawable points of every series by frequency, and the count of the others.
    fn prepare(&self) -> Result<(Vec<Prepared<'_>>, usize), FigureError> {
        let (mut prepared, mut tracks, mut skipped) = (Vec::new(), Vec::new(), 0);
        let per_unit = if self.frequency_axis == FrequencyAxis::Hertz { TAU } else { 1.0 };
        for series in &self.series {
            series.check()?;
            let mut order: Vec<usize> = (0..series.response.len()).collect();
            order.sort_by(|a, b| series.omega_rad_s[*a].total_cmp(&series.omega_rad_s[*b]));
            let mut track = Track {
                x: vec![],
                degrees: vec![],
                doubtful: vec![],
                dense: series.style == Style::Line,
            };
            let (mut magnitude, mut phase, mut after_gap) = (Vec::new(), Vec::new(), false);
            for k in order {
                let (omega, value) = (series.omega_rad_s[k], series.response[k]);
                let size = value.re.hypot(value.im);
                if !Scale::Log.admits(omega) || !Scale::Log.admits(size) {
                    (skipped, after_gap) = (skipped + 1, true);
                    continue;
                }
                let std = series.std.as_ref().map(|s| s[k]).filter(|s| *s > 0.0 && s.is_finite());
                let std = std.filter(|_| series.style == Style::PointsWithBars);
                let flagged = series.flagged.as_ref().is_some_and(|f| f[k]);
                let (x, y) = (omega / per_unit, decibels(size));
                let band = series.band.as_ref().map(|band| band[k]);
                let band = band.filter(|half| half.iter().all(|h| h.is_finite()));
                let bar = match (std, band) {
                    (Some(std), _) => Some((decibel_bar(size, std), degree_bar(size, std))),
                    (None, Some([relative, rad])) => {
                        let half = decibels(1.0_f64.exp()) * relative;
                        Some(((y - half, y + half), rad.to_degrees()))
                    }
                    (None, None) => None,
                };
                let mark = Mark { x, y, bar: bar.map(|b| b.0), across: None, flagged, after_gap };
                magnitude.push(mark);
                // The bar is relative until the branch is known.
                phase.push(Mark { y: 0.0, bar: bar.map(|(_, d)| (-d, d)), ..mark });
                track.x.push(omega.log10());
                track.degrees.push(value.im.atan2(value.re).to_degrees());
                track.doubtful.push(flagged);
                after_gap = false;
            }
            prepared.push(Prepared { series, magnitude, phase });
            tracks.push(track);
        }
        unwrap_together(&mut tracks);
        for (prepared, track) in prepared.iter_mut().zip(tracks) {
            for (mark, degrees) in prepared.phase.iter_mut().zip(track.degrees) {
                mark.y = degrees;
                mark.bar = mark.bar.map(|(low, high)| (degrees + low, degrees + high));
            }
        }
        Ok((prepared, skipped))
    }

    fn magnitude_label(&self) -> String {
        if self.unit.is_empty() {
            "Magnitude (dB)".to_owned()
        } else {
            format!("Magnitude (dB re 1 {})", self.unit)
        }
    }

    /// What an interactive drawing of one of the two panels needs.
    fn panel_data(y: &Axis, marks: &[(&Series, Vec<Mark>)], points: usize) -> PanelData {
        let style = |series: &Series| match series.style {
            Style::Line => TraceStyle::Line,
            Style::Points | Style::PointsWithBars => TraceStyle::Points,
        };
        let traces =
            marks.iter().map(|(s, marks)| TraceData::of(&s.label, s.role, style(s), marks, points));
        PanelData {
            y: AxisData::of(y),
            traces: traces.collect(),
            bands: Vec::new(),
            regions: Vec::new(),
        }
    }

    fn entries(&self) -> Vec<Entry> {
        let mut entries: Vec<Entry> = Vec::new();
        for series in self.series.iter().filter(|s| !s.omega_rad_s.is_empty()) {
            let sample = match series.style {
                Style::Line => Sample::Line(series.role),
                Style::Points => Sample::Points(series.role),
                Style::PointsWithBars => Sample::PointsWithBars(series.role),
            };
            entries.push(Entry { sample, label: series.label.clone() });
        }
        if self.series.iter().filter_map(|s| s.flagged.as_ref()).flatten().any(|f| *f) {
            entries.push(Entry { sample: Sample::Flagged, label: "flagged".to_owned() });
        }
        entries
    }

    /// The sheet with everything on it, given the axes.
    fn draw(
        &self,
        prepared: &[Prepared<'_>],
        skipped: usize,
        frequencies: (f64, f64),
        [db, degrees]: [Ruler; 2],
    ) -> Drawing {
        let mut canvas = Canvas::default();
        let widest = db
            .ticks
            .iter()
            .chain(&degrees.ticks)
            .map(|t| width(&t.label, TICK_SIZE, Weight::Regular))
            .fold(0.0, f64::max);
        let left = 30.0 + widest + 14.0;
        let wide = SHEET_WIDTH - RIGHT_MARGIN - left;
        let mut top = header(
            &mut canvas,
            (left, SHEET_WIDTH - RIGHT_MARGIN),
            &self.title,
            self.subtitle.as_deref(),
            &self.entries(),
        );
        let both = self.frequency_axis == FrequencyAxis::Both;
        top += if both { TOP_AXIS_HEIGHT } else { 0.0 };
        let x = Ruler::log(frequencies, wide);
        let upper = Panel {
            frame: Rect { left, top, width: wide, height: MAGNITUDE_HEIGHT },
            x: x.clone(),
            y: db,
        };
        let below = upper.frame.bottom() + PANEL_GAP;
        let lower = Panel {
            frame: Rect { left, top: below, width: wide, height: PHASE_HEIGHT },
            x,
            y: degrees,
        };
        let marks = [
            (&upper, prepared.iter().map(|p| &p.magnitude).collect::<Vec<_>>()),
            (&lower, prepared.iter().map(|p| &p.phase).collect()),
        ];
        for (panel, marks) in marks {
            panel.grid(&mut canvas);
            canvas.clipped(panel.frame, |canvas| {
                for (p, marks) in
                    prepared.iter().zip(&marks).filter(|(p, _)| p.series.style == Style::Line)
                {
                    panel.ribbon(canvas, marks, p.series.role.colour());
                    panel.curve(canvas, marks, p.series.role, false);
                }
                let points = prepared.iter().zip(&marks);
                for (p, marks) in points.filter(|(p, _)| p.series.style != Style::Line) {
                    panel.bars(canvas, marks, p.series.role);
                    panel.points(canvas, marks, p.series.role, true);
                }
            });
            panel.frame(&mut canvas);
        }
        upper.y_labels(&mut canvas, &self.magnitude_label(), 22.0);
        lower.y_labels(&mut canvas, PHASE_LABEL, 22.0);
        let hertz = self.frequency_axis == FrequencyAxis::Hertz;
        lower.x_labels(&mut canvas, if hertz { "Frequency (Hz)" } else { "Frequency (rad/s)" });
        if both {
            let ruler = Ruler::log((frequencies.0 / TAU, frequencies.1 / TAU), wide);
            upper.top_labels(&mut canvas, &ruler, "Frequency (Hz)");
        }
        let mut bottom = lower.frame.bottom() + X_AXIS_HEIGHT;
        if let Some(note) = skipped_note(skipped) {
            let style = TextStyle { colour: FAINT_INK, ..TextStyle::new(12.0, Anchor::End) };
            canvas.text((SHEET_WIDTH - RIGHT_MARGIN, bottom + 8.0), &note, style);
            bottom += 18.0;
        }
        canvas.finish(SHEET_WIDTH, bottom, &self.title)
    }

    fn drawing(&self) -> Result<Drawing, FigureError> {
        let (prepared, skipped) = self.prepare()?;
        let nothing = || FigureError::NothingToDraw { title: self.title.clone(), skipped };
        let magnitude: Vec<&Mark> = prepared.iter().flat_map(|p| &p.magnitude).collect();
        let phase: Vec<&Mark> = prepared.iter().flat_map(|p| &p.phase).collect();
        let frequencies = extent(magnitude.iter().map(|m| m.x)).ok_or_else(nothing)?;
        let frequencies = Scale::Log.padded(frequencies, 0.0);
        let db = Scale::Linear.widened(with_bars(&magnitude).ok_or_else(nothing)?, LEAST_DB);
        let degrees = Scale::Linear.widened(with_bars(&phase).ok_or_else(nothing)?, LEAST_DEGREES);
        let db = Ruler::linear(db, Steps::Decibels, 6.0, true);
        let degrees = Ruler::linear(degrees, Steps::Degrees, 6.0, true);
        Ok(self.draw(&prepared, skipped, frequencies, [db, degrees]))
    }
}

impl Sealed for BodePlot {}

impl Figure for BodePlot {
    fn data(&self, points: usize) -> Result<FigureData, FigureError> {
        let (prepared, skipped) = self.prepare()?;
        let per_unit = if self.frequency_axis == FrequencyAxis::Hertz { TAU } else { 1.0 };
        let of = |marks: &dyn Fn(&Prepared<'_>) -> Vec<Mark>| {
            let in_rad_s =
                |p| marks(p).into_iter().map(|m| Mark { x: m.x * per_unit, ..m }).collect();
            let shown = prepared.iter().filter(|p| !p.magnitude.is_empty());
            shown.map(|p| (p.series, in_rad_s(p))).collect::<Vec<_>>()
        };
        let magnitude = of(&|p| p.magnitude.clone());
        if magnitude.is_empty() {
            return Err(FigureError::NothingToDraw { title: self.title.clone(), skipped });
        }
        let decibels = Axis::linear(self.magnitude_label()).quantity(Quantity::Decibels);
        let degrees = Axis::linear(PHASE_LABEL).quantity(Quantity::Degrees);
        let frequency = Axis::log("Frequency (rad/s)").quantity(Quantity::FrequencyRadPerSecond);
        Ok(FigureData {
            title: self.title.clone(),
            subtitle: self.subtitle.clone(),
            x: AxisData::of(&frequency),
            linked: Some(FREQUENCIES.to_owned()),
            panels: vec![
                Self::panel_data(&decibels, &magnitude, points),
                Self::panel_data(&degrees, &of(&|p| p.phase.clone()), points),
            ],
            skipped,
        })
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

/// A magnitude in dB.
fn decibels(size: f64) -> f64 {
    20.0 * size.log10()
}

/// The ends in dB of an error bar of one standard error; the lower is −∞ if the standard error reaches the magnitude.
fn decibel_bar(size: f64, std: f64) -> (f64, f64) {
    (decibels((size - std).max(0.0)), decibels(size + std))
}

/// Half the angle in degrees under which the circle of one standard error appears from the origin; 180° from inside it.
fn degree_bar(size: f64, std: f64) -> f64 {
    if std < size { (std / size).asin().to_degrees() } else { 180.0 }
}

#[cfg(test)]
#[path = "bode_plot_tests.rs"]
mod tests;
