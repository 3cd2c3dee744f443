//! A drawing as SVG text, without a single id.

use std::fmt::Write as _;

use crate::canvas::{Anchor, Drawing, Rect, Shape, Stroke, TextStyle};
use crate::font::{FAMILY, Weight};
use crate::html::escape;
use crate::palette::{Colour, MARKER_RADIUS, Marker};

/// Families a browser may use where DejaVu Sans is missing: the widest of them is no wider.
const FALLBACK: &str = "Verdana,'Segoe UI',Helvetica,Arial,sans-serif";

/// The complete document.
pub(crate) fn svg(drawing: &Drawing) -> String {
    let Drawing { width, height, .. } = drawing;
    let title = escape(&drawing.title);
    let mut body = String::new();
    shapes(&mut body, &drawing.shapes);
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" height=\"{height:.0}\" viewBox=\"0 0 {width:.0} {height:.0}\" \
         font-family=\"'{FAMILY}',{FALLBACK}\" role=\"img\" aria-label=\"{title}\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n{body}</svg>\n"
    )
}

// Writing to a String cannot fail, so that the results of `write!` below are not looked at.

fn shapes(body: &mut String, shapes: &[Shape]) {
    for shape in shapes {
        match shape {
            Shape::Rect { rect, fill, opacity } => rectangle(body, *rect, *fill, *opacity),
            Shape::Lines { lines, stroke } => path(body, &separate(lines), *stroke),
            Shape::Polyline { points, stroke } => path(body, &connected(points), *stroke),
            Shape::Area { corners, fill, opacity } => {
                let path = connected(corners);
                let _ =
                    writeln!(body, r#"<path d="{path}z" fill="{fill}" fill-opacity="{opacity}"/>"#);
            }
            Shape::Markers { marker, places, fill, stroke } => {
                markers(body, *marker, places, *fill, *stroke);
            }
            Shape::Text { at, text, style } => line_of_text(body, *at, text, *style),
            Shape::Clipped { frame, shapes } => clipped(body, *frame, shapes),
        }
    }
}

fn rectangle(body: &mut String, r: Rect, fill: Colour, opacity: f64) {
    let Rect { left, top, width, height } = r;
    let _ = writeln!(
        body,
        r#"<rect x="{left:.2}" y="{top:.2}" width="{width:.2}" height="{height:.2}" fill="{fill}" fill-opacity="{opacity}"/>"#
    );
}

fn separate(lines: &[[(f64, f64); 2]]) -> String {
    let mut path = String::with_capacity(lines.len() * 28);
    for [(x1, y1), (x2, y2)] in lines {
        let _ = write!(path, "M{x1:.2} {y1:.2}L{x2:.2} {y2:.2}");
    }
    path
}

fn connected(points: &[(f64, f64)]) -> String {
    let mut path = String::with_capacity(points.len() * 14);
    for (k, (x, y)) in points.iter().enumerate() {
        let _ = write!(path, "{}{x:.2} {y:.2}", if k == 0 { 'M' } else { 'L' });
    }
    path
}

fn path(body: &mut String, path: &str, stroke: Stroke) {
    let Stroke { colour, width, dash } = stroke;
    let _ =
        write!(body, r#"<path d="{path}" fill="none" stroke="{colour}" stroke-width="{width}""#);
    if let Some(dash) = dash {
        let lengths: Vec<String> = dash.iter().map(u8::to_string).collect();
        let _ = write!(body, r#" stroke-dasharray="{}""#, lengths.join(" "));
    }
    body.push_str(" stroke-linejoin=\"round\"/>\n");
}

fn markers(body: &mut String, marker: Marker, places: &[(f64, f64)], fill: Colour, stroke: Stroke) {
    let mut path = String::new();
    for (x, y) in places {
        let corners = marker.corners();
        let Some((first, _)) = corners.split_first() else {
            let (r, d) = (MARKER_RADIUS, 2.0 * MARKER_RADIUS);
            let _ = write!(path, "M{:.2} {y:.2}a{r} {r} 0 1 0 {d} 0a{r} {r} 0 1 0 -{d} 0z", x - r);
            continue;
        };
        let _ = write!(path, "M{:.2} {:.2}", x + first.0, y + first.1);
        for pair in corners.windows(2) {
            let (dx, dy) = (pair[1].0 - pair[0].0, pair[1].1 - pair[0].1);
            let _ = match (dx == 0.0, dy == 0.0) {
                (_, true) => write!(path, "h{dx:.2}"),
                (true, _) => write!(path, "v{dy:.2}"),
                _ => write!(path, "l{dx:.2} {dy:.2}"),
            };
        }
        path.push('z');
    }
    let Stroke { colour, width, .. } = stroke;
    let _ = writeln!(
        body,
        r#"<path d="{path}" fill="{fill}" stroke="{colour}" stroke-width="{width}"/>"#
    );
}

fn line_of_text(body: &mut String, (x, y): (f64, f64), text: &str, style: TextStyle) {
    let anchor = match style.anchor {
        Anchor::Start => "start",
        Anchor::Middle => "middle",
        Anchor::End => "end",
    };
    let (size, colour, text) = (style.size, style.colour, escape(text));
    let _ = write!(
        body,
        r#"<text x="{x:.2}" y="{y:.2}" font-size="{size}" fill="{colour}" text-anchor="{anchor}""#
    );
    if style.weight == Weight::Bold {
        body.push_str(r#" font-weight="bold""#);
    }
    if style.upward {
        let _ = write!(body, r#" transform="rotate(-90 {x:.2} {y:.2})""#);
    }
    let _ = writeln!(body, ">{text}</text>");
}

/// A nested viewport clips without a clip path, which would need an id.
fn clipped(body: &mut String, frame: Rect, inside: &[Shape]) {
    let Rect { left: x, top: y, width: w, height: h } = frame;
    let _ = writeln!(
        body,
        r#"<svg x="{x:.2}" y="{y:.2}" width="{w:.2}" height="{h:.2}" viewBox="{x:.2} {y:.2} {w:.2} {h:.2}" overflow="hidden">"#
    );
    shapes(body, inside);
    body.push_str("</svg>\n");
}
