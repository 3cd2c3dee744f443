//! The canvas of a figure: a list of shapes, from which SVG and PNG are written.

use crate::font::Weight;
use crate::palette::{Colour, INK, Marker};

/// Coordinates are kept within: beyond, rasterisers lose precision.
const FAR: f64 = 1e5;

/// A rectangle in SVG units.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rect {
    pub(crate) left: f64,
    pub(crate) top: f64,
    pub(crate) width: f64,
    pub(crate) height: f64,
}

impl Rect {
    pub(crate) fn right(&self) -> f64 {
        self.left + self.width
    }

    pub(crate) fn bottom(&self) -> f64 {
        self.top + self.height
    }
}

/// Where a text starts from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
}

/// The look of a text.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TextStyle {
    pub(crate) size: f64,
    pub(crate) weight: Weight,
    pub(crate) colour: Colour,
    pub(crate) anchor: Anchor,
    /// Set upward along a vertical axis.
    pub(crate) upward: bool,
}

impl TextStyle {
    pub(crate) fn new(size: f64, anchor: Anchor) -> Self {
        Self { size, weight: Weight::Regular, colour: INK, anchor, upward: false }
    }
}

/// The look of a line. Ends are cut square, joins are round.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stroke {
    pub(crate) colour: Colour,
    pub(crate) width: f64,
    /// Lengths of dashes and gaps in turn, an even number of them.
    pub(crate) dash: Option<&'static [u8]>,
}

/// A shape on the sheet. Units are those of SVG, y points downward.
#[derive(Clone, Debug)]
pub(crate) enum Shape {
    /// A filled rectangle.
    Rect { rect: Rect, fill: Colour, opacity: f64 },
    /// Separate straight lines.
    Lines { lines: Vec<[(f64, f64); 2]>, stroke: Stroke },
    /// A broken line.
    Polyline { points: Vec<(f64, f64)>, stroke: Stroke },
    /// A filled area within straight lines.
    Area { corners: Vec<(f64, f64)>, fill: Colour, opacity: f64 },
    /// Markers of one kind; `stroke` is their outline.
    Markers { marker: Marker, places: Vec<(f64, f64)>, fill: Colour, stroke: Stroke },
    /// One line of text with its baseline at `at`.
    Text { at: (f64, f64), text: String, style: TextStyle },
    /// Shapes that are cut off at the edges of `frame`.
    Clipped { frame: Rect, shapes: Vec<Shape> },
}

/// A finished figure.
#[derive(Clone, Debug)]
pub(crate) struct Drawing {
    pub(crate) width: f64,
    pub(crate) height: f64,
    pub(crate) title: String,
    pub(crate) shapes: Vec<Shape>,
}

/// A figure under way.
#[derive(Debug, Default)]
pub(crate) struct Canvas {
    shapes: Vec<Shape>,
}

impl Canvas {
    /// Adds a filled rectangle.
    pub(crate) fn rect(&mut self, r: Rect, fill: Colour, opacity: f64) {
        let (left, top, width, height) = (near(r.left), near(r.top), near(r.width), near(r.height));
        self.shapes.push(Shape::Rect { rect: Rect { left, top, width, height }, fill, opacity });
    }

    /// Adds separate straight lines.
    pub(crate) fn lines(
        &mut self,
        lines: impl IntoIterator<Item = [(f64, f64); 2]>,
        stroke: Stroke,
    ) {
        let lines: Vec<_> = lines.into_iter().map(|ends| ends.map(near_point)).collect();
        if !lines.is_empty() {
            self.shapes.push(Shape::Lines { lines, stroke });
        }
    }

    /// Adds a broken line through `points`.
    pub(crate) fn polyline(&mut self, points: &[(f64, f64)], stroke: Stroke) {
        if !points.is_empty() {
            let points = points.iter().copied().map(near_point).collect();
            self.shapes.push(Shape::Polyline { points, stroke });
        }
    }

    /// Adds a filled area within straight lines.
    pub(crate) fn area(&mut self, corners: &[(f64, f64)], fill: Colour, opacity: f64) {
        if corners.len() > 2 {
            let corners = corners.iter().copied().map(near_point).collect();
            self.shapes.push(Shape::Area { corners, fill, opacity });
        }
    }

    /// Adds markers of one kind; `stroke` is their outline.
    pub(crate) fn markers(
        &mut self,
        marker: Marker,
        places: impl IntoIterator<Item = (f64, f64)>,
        fill: Colour,
        stroke: Stroke,
    ) {
        let places: Vec<_> = places.into_iter().map(near_point).collect();
        if !places.is_empty() {
            self.shapes.push(Shape::Markers { marker, places, fill, stroke });
        }
    }

    /// Adds one line of text with its baseline at `at`.
    pub(crate) fn text(&mut self, at: (f64, f64), text: &str, style: TextStyle) {
        self.shapes.push(Shape::Text { at, text: text.to_owned(), style });
    }

    /// Draws what `draw` draws, cut off at the edges of `frame`.
    pub(crate) fn clipped(&mut self, frame: Rect, draw: impl FnOnce(&mut Self)) {
        let mut inside = Self::default();
        draw(&mut inside);
        self.shapes.push(Shape::Clipped { frame, shapes: inside.shapes });
    }

    /// The finished figure; its sides are whole units.
    pub(crate) fn finish(self, width: f64, height: f64, title: &str) -> Drawing {
        Drawing {
            width: width.round_ties_even(),
            height: height.round_ties_even(),
            title: title.to_owned(),
            shapes: self.shapes,
        }
    }
}

fn near_point((x, y): (f64, f64)) -> (f64, f64) {
    (near(x), near(y))
}

/// A coordinate kept where rasterisers can handle it.
fn near(coordinate: f64) -> f64 {
    if coordinate.is_nan() { FAR } else { coordinate.clamp(-FAR, FAR) }
}
