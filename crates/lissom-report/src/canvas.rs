//! SVG text, primitive by primitive, without a single id.

use std::fmt::{Arguments, Write as _};

use crate::html::escape;
use crate::palette::{INK, Marker};
use crate::text::{FAMILY, Weight};

/// Families a browser may use where DejaVu Sans is missing: the widest of them is no wider.
const FALLBACK: &str = "Verdana,'Segoe UI',Helvetica,Arial,sans-serif";
/// Coordinates are kept within: beyond, rasterisers lose precision.
const FAR: f64 = 1e5;
/// Half the size of a marker.
const MARKER_RADIUS: f64 = 4.0;

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
    pub(crate) colour: &'static str,
    pub(crate) anchor: Anchor,
    /// Set upward along a vertical axis.
    pub(crate) upward: bool,
}

impl TextStyle {
    pub(crate) fn new(size: f64, anchor: Anchor) -> Self {
        Self { size, weight: Weight::Regular, colour: INK, anchor, upward: false }
    }
}

/// The look of a line.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stroke {
    pub(crate) colour: &'static str,
    pub(crate) width: f64,
    pub(crate) dash: Option<&'static str>,
}

/// An SVG document under way.
#[derive(Debug, Default)]
pub(crate) struct Canvas {
    body: String,
}

impl Canvas {
    fn put(&mut self, text: Arguments<'_>) {
        // Writing to a String cannot fail.
        let _ = self.body.write_fmt(text);
    }

    /// A filled rectangle.
    pub(crate) fn rect(&mut self, r: Rect, fill: &str, opacity: f64) {
        let (x, y, w, h) = (near(r.left), near(r.top), near(r.width), near(r.height));
        self.put(format_args!(r#"<rect x="{x:.2}" y="{y:.2}" width="{w:.2}" height="{h:.2}" fill="{fill}" fill-opacity="{opacity}"/>"#));
        self.body.push('\n');
    }

    /// Separate straight lines, as one path.
    pub(crate) fn lines(
        &mut self,
        lines: impl IntoIterator<Item = [(f64, f64); 2]>,
        stroke: Stroke,
    ) {
        let mut path = String::new();
        for [(x1, y1), (x2, y2)] in lines {
            let _ =
                write!(path, "M{:.2} {:.2}L{:.2} {:.2}", near(x1), near(y1), near(x2), near(y2));
        }
        self.path(&path, stroke);
    }

    /// A broken line through `points`.
    pub(crate) fn polyline(&mut self, points: &[(f64, f64)], stroke: Stroke) {
        let mut path = String::with_capacity(points.len() * 14);
        for (k, (x, y)) in points.iter().enumerate() {
            let _ =
                write!(path, "{}{:.2} {:.2}", if k == 0 { 'M' } else { 'L' }, near(*x), near(*y));
        }
        self.path(&path, stroke);
    }

    fn path(&mut self, path: &str, stroke: Stroke) {
        if path.is_empty() {
            return;
        }
        let Stroke { colour, width, dash } = stroke;
        self.put(format_args!(
            r#"<path d="{path}" fill="none" stroke="{colour}" stroke-width="{width}""#
        ));
        if let Some(dash) = dash {
            self.put(format_args!(r#" stroke-dasharray="{dash}""#));
        }
        self.body.push_str(" stroke-linejoin=\"round\"/>\n");
    }

    /// Markers of one kind; `stroke` is their outline.
    pub(crate) fn markers(
        &mut self,
        shape: Marker,
        places: impl IntoIterator<Item = (f64, f64)>,
        fill: &str,
        stroke: Stroke,
    ) {
        let r = MARKER_RADIUS;
        let mut path = String::new();
        for (x, y) in places {
            let (x, y) = (near(x), near(y));
            let _ = match shape {
                Marker::Circle => write!(
                    path,
                    "M{:.2} {y:.2}a{r} {r} 0 1 0 {d} 0a{r} {r} 0 1 0 -{d} 0z",
                    x - r,
                    d = 2.0 * r
                ),
                Marker::Square => {
                    let s = 0.88 * r;
                    write!(path, "M{:.2} {:.2}h{d:.2}v{d:.2}h-{d:.2}z", x - s, y - s, d = 2.0 * s)
                }
                Marker::Diamond => {
                    let s = 1.2 * r;
                    write!(
                        path,
                        "M{x:.2} {:.2}l{s:.2} {s:.2}l-{s:.2} {s:.2}l-{s:.2} -{s:.2}z",
                        y - s
                    )
                }
                Marker::Up => write!(
                    path,
                    "M{x:.2} {:.2}l{:.2} {h:.2}h-{:.2}z",
                    y - 1.2 * r,
                    1.1 * r,
                    2.2 * r,
                    h = 2.0 * r
                ),
                Marker::Down => write!(
                    path,
                    "M{x:.2} {:.2}l{:.2} -{h:.2}h-{:.2}z",
                    y + 1.2 * r,
                    1.1 * r,
                    2.2 * r,
                    h = 2.0 * r
                ),
            };
        }
        if !path.is_empty() {
            let Stroke { colour, width, .. } = stroke;
            self.put(format_args!(
                r#"<path d="{path}" fill="{fill}" stroke="{colour}" stroke-width="{width}"/>"#
            ));
            self.body.push('\n');
        }
    }

    /// One line of text with its baseline at `(x, y)`.
    pub(crate) fn text(&mut self, (x, y): (f64, f64), text: &str, style: TextStyle) {
        let anchor = match style.anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let (size, colour, text) = (style.size, style.colour, escape(text));
        self.put(format_args!(r#"<text x="{x:.2}" y="{y:.2}" font-size="{size}" fill="{colour}" text-anchor="{anchor}""#));
        if style.weight == Weight::Bold {
            self.put(format_args!(r#" font-weight="bold""#));
        }
        if style.upward {
            self.put(format_args!(r#" transform="rotate(-90 {x:.2} {y:.2})""#));
        }
        self.put(format_args!(">{text}</text>\n"));
    }

    /// Draws what `draw` draws, cut off at the edges of `frame`.
    ///
    /// A nested viewport clips without a clip path, which would need an id.
    pub(crate) fn clipped(&mut self, frame: Rect, draw: impl FnOnce(&mut Self)) {
        let Rect { left: x, top: y, width: w, height: h } = frame;
        self.put(format_args!(r#"<svg x="{x:.2}" y="{y:.2}" width="{w:.2}" height="{h:.2}" viewBox="{x:.2} {y:.2} {w:.2} {h:.2}" overflow="hidden">"#));
        self.body.push('\n');
        draw(self);
        self.body.push_str("</svg>\n");
    }

    /// The finished document.
    pub(crate) fn finish(self, width: f64, height: f64, title: &str) -> String {
        let (title, body) = (escape(title), self.body);
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" height=\"{height:.0}\" viewBox=\"0 0 {width:.0} {height:.0}\" \
             font-family=\"'{FAMILY}',{FALLBACK}\" role=\"img\" aria-label=\"{title}\">\n\
             <rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n{body}</svg>\n"
        )
    }
}

/// A coordinate kept where rasterisers can handle it.
fn near(coordinate: f64) -> f64 {
    if coordinate.is_nan() { FAR } else { coordinate.clamp(-FAR, FAR) }
}
