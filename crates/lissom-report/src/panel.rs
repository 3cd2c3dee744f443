//! One pair of axes: grid, frame, ticks, and the data drawn in it.

use crate::axis::Ruler;
use crate::canvas::{Anchor, Canvas, Rect, Stroke, TextStyle};
use crate::font::Weight;
use crate::marks::{Mark, thinned};
use crate::palette::{Colour, FLAGGED, GRID, INK, MINOR_GRID, Role, SHADE, WHITE};
use crate::text_fit::{shorten, width};
use lissom_text::power_of_ten;

/// The size of tick labels.
pub(crate) const TICK_SIZE: f64 = 14.0;
/// The size of axis labels and legends.
pub(crate) const LABEL_SIZE: f64 = 15.0;
/// The length of a tick.
const TICK: f64 = 5.0;
/// Half the width of the cap of an error bar.
const CAP: f64 = 3.5;
/// From the frame to the baseline of tick labels below it.
const TICK_BASELINE: f64 = 20.0;
/// From the frame to the baseline of the axis label below it.
const LABEL_BASELINE: f64 = 44.0;
/// The space a horizontal axis takes below its frame.
pub(crate) const X_AXIS_HEIGHT: f64 = 54.0;
/// Lines of data are this wide.
pub(crate) const LINE_WIDTH: f64 = 2.0;

/// A frame with its two axes.
#[derive(Debug)]
pub(crate) struct Panel {
    pub(crate) frame: Rect,
    pub(crate) x: Ruler,
    pub(crate) y: Ruler,
}

impl Panel {
    /// The place of a datum on the sheet.
    pub(crate) fn at(&self, x: f64, y: f64) -> (f64, f64) {
        (
            self.frame.left + self.frame.width * self.x.fraction(x),
            self.frame.bottom() - self.frame.height * self.y.fraction(y),
        )
    }

    fn grid_x(&self, places: impl Iterator<Item = f64>) -> Vec<[(f64, f64); 2]> {
        let (top, bottom) = (self.frame.top, self.frame.bottom());
        places.map(|x| self.at(x, self.y.low).0).map(|x| [(x, top), (x, bottom)]).collect()
    }

    fn grid_y(&self, places: impl Iterator<Item = f64>) -> Vec<[(f64, f64); 2]> {
        let (left, right) = (self.frame.left, self.frame.right());
        places.map(|y| self.at(self.x.low, y).1).map(|y| [(left, y), (right, y)]).collect()
    }

    /// The grid lines.
    pub(crate) fn grid(&self, canvas: &mut Canvas) {
        let minor = Stroke { colour: MINOR_GRID, width: 1.0, dash: None };
        let major = Stroke { colour: GRID, width: 1.0, dash: None };
        canvas.lines(self.grid_x(self.x.minor.iter().copied()), minor);
        canvas.lines(self.grid_y(self.y.minor.iter().copied()), minor);
        canvas.lines(self.grid_x(self.x.ticks.iter().map(|t| t.at)), major);
        canvas.lines(self.grid_y(self.y.ticks.iter().map(|t| t.at)), major);
    }

    /// The frame with its ticks; it goes over the data.
    pub(crate) fn frame(&self, canvas: &mut Canvas) {
        let Rect { left, top, .. } = self.frame;
        let (right, bottom) = (self.frame.right(), self.frame.bottom());
        let ink = Stroke { colour: INK, width: 1.0, dash: None };
        canvas.polyline(
            &[
                (left, top),
                (right, top),
                (right, bottom),
                (left, bottom),
                (left, top),
                (right, top),
            ],
            ink,
        );
        let across = self
            .grid_y(self.y.ticks.iter().map(|t| t.at))
            .into_iter()
            .map(|[(x, y), _]| [(x, y), (x - TICK, y)]);
        let down = self
            .grid_x(self.x.ticks.iter().map(|t| t.at))
            .into_iter()
            .map(|[_, (x, y)]| [(x, y), (x, y + TICK)]);
        canvas.lines(across.chain(down), ink);
    }

    /// The numbers and the label of the vertical axis, the label centred at `label_x`.
    pub(crate) fn y_labels(&self, canvas: &mut Canvas, label: &str, label_x: f64) {
        for tick in &self.y.ticks {
            let (x, y) = self.at(self.x.low, tick.at);
            canvas.text(
                (x - TICK - 4.0, y + 0.35 * TICK_SIZE),
                &tick.label,
                TextStyle::new(TICK_SIZE, Anchor::End),
            );
        }
        let style = TextStyle { upward: true, ..TextStyle::new(LABEL_SIZE, Anchor::Middle) };
        let middle = self.frame.top + self.frame.height / 2.0;
        if let Some(e) = self.y.factor {
            let place = (self.frame.left, self.frame.top - 8.0);
            canvas.text(place, &factor(e), TextStyle::new(TICK_SIZE, Anchor::Start));
        }
        canvas.text(
            (label_x, middle),
            &shorten(label, LABEL_SIZE, Weight::Regular, self.frame.height * 1.1),
            style,
        );
    }

    /// The numbers and the label of the horizontal axis, below the frame.
    pub(crate) fn x_labels(&self, canvas: &mut Canvas, label: &str) {
        self.x_numbers(canvas, &self.x, self.frame.bottom() + TICK_BASELINE);
        self.x_label(canvas, &self.x, label, self.frame.bottom() + LABEL_BASELINE);
    }

    /// A second horizontal axis above the frame.
    pub(crate) fn top_labels(&self, canvas: &mut Canvas, ruler: &Ruler, label: &str) {
        let ink = Stroke { colour: INK, width: 1.0, dash: None };
        let places =
            ruler.ticks.iter().map(|t| self.frame.left + self.frame.width * ruler.fraction(t.at));
        canvas.lines(places.map(|x| [(x, self.frame.top), (x, self.frame.top - TICK)]), ink);
        self.x_numbers(canvas, ruler, self.frame.top - TICK - 5.0);
        self.x_label(canvas, ruler, label, self.frame.top - 28.0);
    }

    /// The label of a horizontal axis, and at its right end the power of ten the numbers leave out.
    fn x_label(&self, canvas: &mut Canvas, ruler: &Ruler, label: &str, baseline: f64) {
        let middle = self.frame.left + self.frame.width / 2.0;
        let room = self.frame.width - if ruler.factor.is_some() { 120.0 } else { 0.0 };
        canvas.text(
            (middle, baseline),
            &shorten(label, LABEL_SIZE, Weight::Regular, room),
            TextStyle::new(LABEL_SIZE, Anchor::Middle),
        );
        if let Some(e) = ruler.factor {
            let place = (self.frame.right(), baseline);
            canvas.text(place, &factor(e), TextStyle::new(TICK_SIZE, Anchor::End));
        }
    }

    fn x_numbers(&self, canvas: &mut Canvas, ruler: &Ruler, baseline: f64) {
        let mut free = f64::NEG_INFINITY;
        for tick in &ruler.ticks {
            let x = self.frame.left + self.frame.width * ruler.fraction(tick.at);
            let half = width(&tick.label, TICK_SIZE, Weight::Regular) / 2.0;
            if x - half >= free {
                canvas.text((x, baseline), &tick.label, TextStyle::new(TICK_SIZE, Anchor::Middle));
                free = x + half + 6.0;
            }
        }
    }

    /// A line through the marks in its role's dash; see [`curve_in`](Self::curve_in).
    pub(crate) fn curve(&self, canvas: &mut Canvas, marks: &[Mark], role: Role, steps: bool) {
        let stroke = Stroke { colour: role.colour(), width: LINE_WIDTH, dash: role.dash() };
        self.curve_in(canvas, marks, stroke, steps);
    }

    /// A line through the marks, broken at gaps; a point with gaps on both sides becomes a dot.
    pub(crate) fn curve_in(
        &self,
        canvas: &mut Canvas,
        marks: &[Mark],
        stroke: Stroke,
        steps: bool,
    ) {
        for run in marks.chunk_by(|_, next| !next.after_gap) {
            let mut path: Vec<(f64, f64)> = Vec::with_capacity(run.len());
            for mark in run {
                let (x, y) = self.at(mark.x, mark.y);
                if let (true, Some((_, held))) = (steps, path.last().copied()) {
                    path.push((x, held));
                }
                path.push((x, y));
            }
            match path.as_slice() {
                [(x, y)] => canvas.rect(
                    Rect { left: x - 2.0, top: y - 2.0, width: 4.0, height: 4.0 },
                    stroke.colour,
                    1.0,
                ),
                path => canvas.polyline(&thinned(path), stroke),
            }
        }
    }

    /// The area between the ends of the bars of a line, broken at gaps and where there is no bar.
    pub(crate) fn ribbon(&self, canvas: &mut Canvas, marks: &[Mark], colour: Colour) {
        for run in marks.chunk_by(|a, b| a.bar.is_some() && b.bar.is_some() && !b.after_gap) {
            let ends = run.iter().filter_map(|m| Some((m.x, m.bar?)));
            let ends: Vec<_> = ends.collect();
            let low = ends.iter().map(|(x, (low, _))| self.at(*x, *low));
            let high = ends.iter().rev().map(|(x, (_, high))| self.at(*x, *high));
            let corners: Vec<_> = low.chain(high).collect();
            canvas.area(&corners, colour, SHADE);
        }
    }

    /// The error bars of the marks that have one.
    pub(crate) fn bars(&self, canvas: &mut Canvas, marks: &[Mark], role: Role) {
        for (flagged, colour) in [(true, FLAGGED), (false, role.colour())] {
            let ends =
                marks.iter().filter(|m| m.flagged == flagged).filter_map(|m| Some((m.x, m.bar?)));
            let lines = ends.flat_map(|(x, (low, high))| {
                let ((x, bottom), (_, top)) = (self.at(x, low), self.at(x, high));
                [
                    [(x, bottom), (x, top)],
                    [(x - CAP, bottom), (x + CAP, bottom)],
                    [(x - CAP, top), (x + CAP, top)],
                ]
            });
            canvas.lines(lines.collect::<Vec<_>>(), Stroke { colour, width: 1.3, dash: None });
            let ends = marks.iter().filter(|m| m.flagged == flagged);
            let across = ends.filter_map(|m| Some((m.y, m.across?))).flat_map(|(y, (from, to))| {
                let ((left, y), (right, _)) = (self.at(from, y), self.at(to, y));
                [
                    [(left, y), (right, y)],
                    [(left, y - CAP), (left, y + CAP)],
                    [(right, y - CAP), (right, y + CAP)],
                ]
            });
            canvas.lines(across.collect::<Vec<_>>(), Stroke { colour, width: 1.3, dash: None });
        }
    }

    /// The markers; flagged ones are grey and hollow and lie below the others. `all` draws those without flag too.
    pub(crate) fn points(&self, canvas: &mut Canvas, marks: &[Mark], role: Role, all: bool) {
        let places =
            |flagged| marks.iter().filter(move |m| m.flagged == flagged).map(|m| self.at(m.x, m.y));
        canvas.markers(
            role.marker(),
            places(true),
            WHITE,
            Stroke { colour: FLAGGED, width: 1.5, dash: None },
        );
        if all {
            let [fill, colour] = role.marker_colours();
            let width = if fill == WHITE { 1.6 } else { 0.8 };
            let stroke = Stroke { colour, width, dash: None };
            canvas.markers(role.marker(), places(false), fill, stroke);
        }
    }
}

/// The power of ten that the numbers of an axis leave out.
fn factor(e: i32) -> String {
    format!("×{}", power_of_ten(e))
}
